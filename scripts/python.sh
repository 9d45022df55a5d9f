#!/usr/bin/env bash
# Builds the Python module in build/release/python and packs it as a wheel in build/wheel.
set -euo pipefail
cd "$(dirname "$0")/.."
# A build folder that was configured before Python and pybind11 were installed does not know the target.
if [ -f build/release/build.ninja ] && ! grep -q '^build svt_python_package:' build/release/build.ninja; then
  cmake --preset release >build/release/build.log 2>&1 || { cat build/release/build.log >&2; exit 1; }
fi
scripts/build.sh release svt_python_package svt
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' build/release/CMakeCache.txt)
python=$(sed -n 's/^SVT_PYTHON_EXECUTABLE:FILEPATH=//p' build/release/CMakeCache.txt)
case $python in '' | *-NOTFOUND) python=python3 ;; esac
rm -rf build/wheel
wheel=$("$python" python/pack_wheel.py build/release build/wheel "$version")
echo "python: $wheel; or PYTHONPATH=$PWD/build/release/python"
