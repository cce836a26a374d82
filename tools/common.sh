# SPDX-License-Identifier: Apache-2.0
# What demo and check share. Read with "." from the project's folder.

say() { printf '\n== %s\n' "$*"; }

stop() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# How many compilers at once: one per core, and 1.5 GB of memory for each.
build_jobs() {
  local cores by_memory
  cores=$(nproc)
  by_memory=$(awk '/^MemAvailable/ {n = int($2 / 1500000); print n < 1 ? 1 : n}' /proc/meminfo)
  echo $((cores < by_memory ? cores : by_memory))
}

# configure PRESET [-DNAME=VALUE...]: quiet unless it fails.
configure() {
  local preset=$1
  shift
  mkdir -p build
  local log=build/configure-$preset.log
  cmake --preset "$preset" "$@" >"$log" 2>&1 || {
    tail -n 25 "$log" >&2
    stop "configuring failed (end of $log above)"
  }
}
