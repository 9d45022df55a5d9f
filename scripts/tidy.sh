#!/usr/bin/env bash
# clang-tidy over all sources, with the checks of .clang-tidy; a finding is a failure.
#   scripts/tidy.sh [PATTERN]   only sources whose path matches the regular expression
set -euo pipefail
cd "$(dirname "$0")/.."
command -v run-clang-tidy >/dev/null || { echo "tidy: run-clang-tidy is missing; scripts/setup.sh checks installs it" >&2; exit 1; }
# Clang reads no precompiled header of gcc.
cmake --preset tidy >/dev/null
cmake --build build/tidy --target svt_version >/dev/null
log=build/tidy/tidy.log
echo "tidy: $(git ls-files '*.cpp' | grep -cE "${1:-.}") sources (log: $log)"
run-clang-tidy -p build/tidy -quiet -j "$(nproc)" "$PWD/(svt|apps)/.*${1:-}" >"$log" 2>&1 || true
if grep -qE "(warning|error): " "$log"; then
  grep -E "(warning|error): " "$log" | sort -u
  echo "tidy: $(grep -E "(warning|error): " "$log" | sort -u | wc -l) findings" >&2
  exit 1
fi
