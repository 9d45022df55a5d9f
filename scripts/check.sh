#!/usr/bin/env bash
# Checks that need no build, several at once: layers, error pages, banned calls, format, linters, types. Says one line for each that
# fails; what it found stands in build/check/NAME.log. A checker that is missing fails, too.
#   scripts/check.sh [NAME...]    these checks alone
set -euo pipefail
cd "$(dirname "$0")/.."
logs=build/check
bin=web/viewer/node_modules/.bin
mkdir -p "$logs"
scripts/npm_packages.sh

# git knows what is checked. Files with another name that are scripts, too, stand after it.
files() { git ls-files --cached --others --exclude-standard "$@" | while read -r file; do [ -f "$file" ] && echo "$file"; done; }
mapfile -t cpp < <(files '*.cpp' '*.hpp')
mapfile -t python < <(files '*.py' '*.pyi')
mapfile -t script < <(files '*.ts' '*.mjs')
mapfile -t shell < <(files '*.sh'; echo .ci/run; files cmake/debian/python)

# name, remedy, command: runs it in the background.
names=() remedies=() processes=() wanted=("$@")
check() {
  local name=$1 remedy=$2
  shift 2
  [ ${#wanted[@]} -eq 0 ] || [[ " ${wanted[*]} " == *" $name "* ]] || return 0
  if ! command -v "$1" >/dev/null; then remedy="it is missing: scripts/setup.sh installs it"; set -- false; fi
  "$@" >"$logs/$name.log" 2>&1 </dev/null &
  names+=("$name") remedies+=("$remedy") processes+=($!)
}
check layers "svt/layers.txt says who may include whom" python3 scripts/check_layers.py
check error-pages "each code has its page in docs/errors" python3 scripts/check_error_pages.py
check banned-calls "mend what it names" python3 scripts/check_banned_calls.py
check architecture "scripts/update_architecture.py writes the table of folders" python3 scripts/update_architecture.py --check
check version "scripts/release/version.py --set VERSION writes it" python3 scripts/release/version.py --check
check badges "scripts/release/badges.py renews them" python3 scripts/release/badges.py --check
check prose "docs/dev/english.md has the rules" python3 scripts/check_prose.py
check clang-format "clang-format -i FILE formats" clang-format --dry-run --Werror "${cpp[@]}"
check shellcheck "mend what it names" shellcheck "${shell[@]}"
# Stubs name what stands below them, and mypy reads them.
mapfile -t code < <(printf '%s\n' "${python[@]}" | grep -v '\.pyi$')
check flake8 "mend what it names" flake8 "${code[@]}"
check black "'black .' formats" black --check "${python[@]}"
check mypy "mend what it names" mypy --cache-dir build/check/mypy "${python[@]}"
check prettier "'$bin/prettier --write FILE' formats" \
  "$bin/prettier" --check --log-level warn --cache --cache-location "$logs/prettier.json" "${script[@]}"
check eslint "mend what it names" "$bin/eslint" --config web/viewer/eslint.config.mjs --no-warn-ignored --max-warnings 0 \
  --cache --cache-location "$logs/eslint.json" "${script[@]}"
check tsc "mend what it names" "$bin/tsc" --project web/viewer --incremental --tsBuildInfoFile "$logs/tsc.json"
check tsc-npm "mend what it names" "$bin/tsc" --project web/npm --incremental --tsBuildInfoFile "$logs/tsc-npm.json"
check tsc-scripts "mend what it names" \
  "$bin/tsc" --project web/viewer/tsconfig.scripts.json --incremental --tsBuildInfoFile "$logs/tsc-scripts.json"

result=0
for i in "${!names[@]}"; do
  wait "${processes[$i]}" && continue
  echo "check: ${names[$i]} failed (${remedies[$i]}); see $logs/${names[$i]}.log" >&2
  grep -v '^$' "$logs/${names[$i]}.log" | head -n 5 >&2 || true
  result=1
done
exit $result
