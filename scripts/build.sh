#!/usr/bin/env bash
# scripts/build.sh PRESET [TARGET...]: configures once and builds quietly; shows the log if something fails.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
mkdir -p "build/$preset"
log=build/$preset/build.log
if [ ! -f "build/$preset/build.ninja" ]; then
  cmake --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
fi
echo "build: $preset ${*:-all} (log: $log)"
targets=()
[ $# -gt 0 ] && targets=(--target "$@")
if [ -t 1 ]; then
  cmake --build "build/$preset" "${targets[@]}"
else
  cmake --build "build/$preset" "${targets[@]}" >"$log" 2>&1 || { tail -n 60 "$log" >&2; exit 1; }
fi
