#!/usr/bin/env bash
# Checks that need no build: layers, error pages, format (if clang-format is installed).
set -euo pipefail
cd "$(dirname "$0")/.."
python3 scripts/check_layers.py
python3 scripts/check_error_pages.py
if command -v clang-format >/dev/null; then
  mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
  if ! clang-format --dry-run --Werror "${files[@]}" >/dev/null 2>&1; then
    echo "check: not formatted; run: clang-format -i \$(git ls-files '*.cpp' '*.hpp')" >&2
    exit 1
  fi
fi
