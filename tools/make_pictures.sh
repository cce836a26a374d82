#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes the pictures of the guides anew, with the build of ./demo.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh

command=build/release/bin/facegraph
[ -x $command ] || stop "$command is not there: run ./demo first"
export FACEGRAPH_STORE="${FACEGRAPH_STORE:-$PWD/build/store}"
$command run --quiet graphs/speech/talk.json --set text=graphs/speech/demo.txt --set sheet.pictures=12 --set sheet.picture_px=190 \
  --out build/pictures >/dev/null
cp build/pictures/talk.sheet.png docs/pictures/demo.png

# One picture of each of the other systems (docs/systems.md).
$command get graphs/video_to_mesh/phantom_tiny.json 'map_beside[20]' --set map_beside.height_px=240 -o docs/pictures/video_to_mesh.png
$command get graphs/scan_stream/phantom_tiny.json learned/review.sheet --set learned/review.pictures=16 --set learned/review.picture_px=120 -o docs/pictures/scan_stream.png
$command get graphs/laser_scan/build_tiny.json posed_sheet --set posed.width_px=160 --set posed.height_px=160 -o docs/pictures/laser_scan.png
$command get graphs/speech_to_video/phantom_tiny.json 'beside[20]' --set beside.height_px=240 -o docs/pictures/speech_to_video.png

for picture in demo video_to_mesh scan_stream laser_scan speech_to_video; do
  bytes=$(stat -c %s docs/pictures/$picture.png)
  [ "$bytes" -le 300000 ] || stop "docs/pictures/$picture.png has $bytes bytes, expected at most 300000: ask for fewer or smaller pictures"
  echo "docs/pictures/$picture.png: $bytes bytes"
done
