#!/usr/bin/env bash
# Runs all tests of the release build; skipped ones state the reason. Ends with the number of tests.
set -euo pipefail
cd "$(dirname "$0")/.."
export SVT_DATA_DIR=${SVT_DATA_DIR:-$PWD/../shared/data}
[ -d "$SVT_DATA_DIR" ] || echo "test: no real models at $SVT_DATA_DIR (SVT_DATA_DIR); tests that need them are skipped"
[ -f build/release/share/svt/viewer/index.html ] || echo "test: the viewer page is not built (make viewer); its tests are skipped"
ctest --test-dir build/release -j "$(nproc)" --output-on-failure --progress
