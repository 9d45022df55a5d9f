#!/usr/bin/env bash
# Checks that need no build: layers, error pages, banned calls, table of folders, format.
set -euo pipefail
cd "$(dirname "$0")/.."
python3 scripts/check_layers.py
python3 scripts/check_error_pages.py
python3 scripts/check_banned_calls.py
python3 scripts/update_architecture.py --check
command -v clang-format >/dev/null || { echo "check: clang-format is missing; scripts/setup.sh installs it" >&2; exit 1; }
mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
if ! clang-format --dry-run --Werror "${files[@]}" >/dev/null 2>&1; then
  echo "check: not formatted; run: clang-format -i \$(git ls-files '*.cpp' '*.hpp')" >&2
  exit 1
fi
