#!/usr/bin/env bash
# Runs tests of the release build; skipped ones state the reason.
#   scripts/test.sh                  all tests; ends with their number
#   scripts/test.sh changed [BASE]   builds and runs the tests of the folders of svt/ and of the command that differ from BASE,
#                                    a commit; without BASE: from the branch that this one tracks, else from the last commit
set -euo pipefail
cd "$(dirname "$0")/.."
export SVT_NO_CONFIG=1  # files with defaults of the user do not change results
export SVT_DATA_DIR=${SVT_DATA_DIR:-$PWD/../shared/data}
[ -d "$SVT_DATA_DIR" ] || echo "test: no real models at $SVT_DATA_DIR (SVT_DATA_DIR); tests that need them are skipped"
select=()
if [ "${1:-}" = changed ]; then
  base=${2:-$(git merge-base HEAD '@{upstream}' 2>/dev/null || git rev-parse HEAD~1)}
  mapfile -t folders < <({ git diff --name-only "$base"; git ls-files --others --exclude-standard; } |
    sed -nE 's#^svt/([a-z_]+)/.*#\1#p; s#^(apps|tests)/cli/.*#cli#p; s#^tests/(locale)/.*#\1#p' | sort -u)
  targets=()
  for folder in "${folders[@]}"; do
    grep -qsr --include='*_test.cpp' . "svt/$folder" "tests/$folder" && targets+=("svt_${folder}_test")
    [ "$folder" = cli ] && targets+=(svt)
  done
  [ ${#targets[@]} -gt 0 ] || { echo "test: no folder with tests differs from $(git describe --always "$base")"; exit 0; }
  echo "test: ${folders[*]}"
  scripts/build.sh release "${targets[@]}"
  select=(-L "^($(IFS='|'; echo "${folders[*]}"))$" --no-tests=error)
else
  [ -f build/release/share/svt/viewer/index.html ] || echo "test: the viewer page is not built (make viewer); its tests are skipped"
fi
ctest --test-dir build/release -j "$(nproc)" --output-on-failure --progress "${select[@]}"
