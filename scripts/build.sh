#!/usr/bin/env bash
# scripts/build.sh PRESET [TARGET...]: configures once and builds quietly; shows the log if something fails.
# With SVT_KEEP_GOING=1 an error does not end the build, so that all errors are seen.
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
targets=() further=()
[ -n "${SVT_KEEP_GOING:-}" ] && further=(-- -k 0)
[ $# -gt 0 ] && targets=(--target "$@")
if [ -t 1 ]; then
  cmake --build "build/$preset" "${targets[@]}" "${further[@]}"
else
  cmake --build "build/$preset" "${targets[@]}" "${further[@]}" >"$log" 2>&1 || {
    grep -E -A3 "(error|FAILED):" "$log" | head -n 60 >&2 || true
    tail -n 60 "$log" >&2
    exit 1
  }
fi
