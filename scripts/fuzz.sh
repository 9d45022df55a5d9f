#!/usr/bin/env bash
# Feeds each fuzz target for some seconds, from its corpus in tests/fuzz/corpus; a crash, a hang or too much memory is a failure.
#   scripts/fuzz.sh [SECONDS] [TARGET...]   60 seconds each; all targets
#   scripts/fuzz.sh Nruns [TARGET...]       N inputs each from a fixed seed: the same inputs wherever it runs
set -euo pipefail
cd "$(dirname "$0")/.."
amount=${1:-60}
[ $# -gt 0 ] && shift
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for source in tests/fuzz/*_fuzz.cpp; do targets+=("$(basename "$source" .cpp)"); done
fi
case $amount in
  *runs) limit=(-runs="${amount%runs}" -seed=1 -reload=0) said="${amount%runs} inputs" ;;
  *) limit=(-max_total_time="$amount") said="$amount s" ;;
esac
scripts/build.sh fuzz "${targets[@]}"
for target in "${targets[@]}"; do
  work=build/fuzz/corpus/$target
  [[ $amount == *runs ]] && work=build/fuzz/runs/$target && rm -rf "$work"
  mkdir -p "$work"
  words=()
  [ -f "tests/fuzz/$target.dict" ] && words=(-dict="tests/fuzz/$target.dict")
  echo "fuzz: $target with $said, from $(find "tests/fuzz/corpus/$target" -type f 2>/dev/null | wc -l) files"
  if ! "build/fuzz/bin/$target" "${limit[@]}" "${words[@]}" -timeout=20 -rss_limit_mb=2048 -max_len=65536 -print_final_stats=1 \
      -artifact_prefix="build/fuzz/$target-" "$work" "tests/fuzz/corpus/$target" >"build/fuzz/$target.log" 2>&1; then
    tail -n 40 "build/fuzz/$target.log" >&2
    echo "fuzz: $target failed; the input is build/fuzz/$target-*" >&2
    exit 1
  fi
  grep -E "stat::number_of_executed_units|cov:" "build/fuzz/$target.log" | tail -n 1
done
