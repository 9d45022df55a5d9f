#!/usr/bin/env bash
# Makes the .deb files svt, libsvt-dev and, where Python is there, python3-svt in build/package, from the release build and the
# page (make viewer).
set -euo pipefail
cd "$(dirname "$0")/.."
[ -f build/release/share/svt/viewer/index.html ] || { echo "package: the page is missing; 'make viewer' builds it" >&2; exit 1; }
targets=(svt svt_manual)
grep -q '^build svt_python_package:' build/release/build.ninja && targets+=(svt_python_package)
scripts/build.sh release "${targets[@]}"
log=build/release/package.log
rm -rf build/package
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || echo 0) \
  cpack --config build/release/CPackConfig.cmake -B "$PWD/build/package" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
rm -rf build/package/_CPack_Packages
ls -1 build/package/*.deb
