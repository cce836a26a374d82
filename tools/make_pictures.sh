#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes the pictures of the guides anew, with the build of ./demo: docs/pictures/demo.png.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh

command=build/release/bin/facegraph
[ -x $command ] || stop "$command is not there: run ./demo first"
export FACEGRAPH_STORE="${FACEGRAPH_STORE:-$PWD/build/store}"
$command run --quiet graphs/speech/talk.json --set text=graphs/speech/demo.txt --set sheet.pictures=12 --set sheet.picture_px=190 \
  --out build/pictures >/dev/null
cp build/pictures/talk.sheet.png docs/pictures/demo.png
bytes=$(stat -c %s docs/pictures/demo.png)
[ "$bytes" -le 300000 ] || stop "docs/pictures/demo.png has $bytes bytes, expected at most 300000: ask for fewer or smaller pictures"
echo "docs/pictures/demo.png: $bytes bytes"
