#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Installs those packages of tools/packages.txt that are missing.
#   tools/setup.sh                 what a build needs
#   tools/setup.sh build test      also what the tests need (groups: build test bench node browser)
#   tools/setup.sh --list build    prints the names of the missing packages, installs nothing
# Uses sudo when not root. FACEGRAPH_SKIP_SETUP=1: the packages, or others that do the same, are already there.
set -euo pipefail
cd "$(dirname "$0")/.."

fail() {
  printf 'setup: %s\n' "$@" >&2
  exit 1
}

list_only=no
if [ "${1:-}" = --list ]; then
  list_only=yes
  shift
fi
[ $# -gt 0 ] || set -- build
[ "${FACEGRAPH_SKIP_SETUP:-}" != 1 ] || exit 0

# The code is compiled for x86-64-v3.
[ "$(uname -m)" = x86_64 ] || fail "this machine is $(uname -m); Facegraph is built for x86-64 only"
for flag in avx2 bmi2 fma movbe; do
  grep -qwm1 "$flag" /proc/cpuinfo || fail "this processor lacks $flag; Facegraph needs x86-64-v3 (Intel Haswell, AMD Excavator or newer)"
done

wanted=$(for group in "$@"; do awk -v group="$group" '$1 == group {print $2}' tools/packages.txt; done)
system=$(. /usr/lib/os-release 2>/dev/null && echo "${ID:-unknown} ${VERSION_ID:-}" || echo unknown)
if [ "$system" != "debian 12" ] || ! command -v dpkg-query >/dev/null; then
  fail "this system is '$system'; packages can be installed on Debian 12 only" \
       "elsewhere install what stands for these, then set FACEGRAPH_SKIP_SETUP=1: $(echo $wanted)"
fi

installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' 2>/dev/null | awk '$2 == "installed" {print $1}')
missing=$(for package in $wanted; do grep -qxF "$package" <<<"$installed" || echo "$package"; done)
[ -n "$missing" ] || exit 0
if [ $list_only = yes ]; then
  echo "$missing"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail "packages are missing, you are not root, and there is no sudo" \
    "as root run: apt-get install --no-install-recommends $(echo $missing)"
  as_root=(sudo)
fi
echo "setup: installing $(wc -w <<<"$missing") of Debian's packages: $(echo $missing)"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
export DEBIAN_FRONTEND=noninteractive
run_apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 "$@" >"$log" 2>&1
}
run_apt update || {
  tail -n 5 "$log" >&2
  fail "apt-get update failed (messages above): is there a network, and may you use apt-get or sudo?"
}
run_apt install --no-install-recommends $missing || {
  tail -n 15 "$log" >&2
  fail "apt-get install failed (messages above): is there a network and room on the disk?"
}
