#!/usr/bin/env bash
# What can be said without building: layers, error pages, format (where clang-format is installed).
set -euo pipefail
cd "$(dirname "$0")/.."
python3 scripts/check_layers.py
python3 scripts/check_error_pages.py
if command -v clang-format >/dev/null; then
  mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
  clang-format --dry-run --Werror "${files[@]}" 2>&1 | head -n 20 || { echo "check: run clang-format -i on these files" >&2; exit 1; }
fi
