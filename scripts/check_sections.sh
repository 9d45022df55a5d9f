#!/bin/sh
# Compares section drawings of any models with an independent cut of their triangles, and prints the rows of the table in
# docs/dev/drawings.md:
#
#     scripts/check_sections.sh MODEL.gml MODEL.ifc ...
#
# BIN is the folder of the tests (build/release/bin).
set -eu
[ $# -gt 0 ] || { echo "usage: $0 MODEL..." >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
files=
for file in "$@"; do
    files="$files${files:+:}$(realpath "$file")"
done
SVT_SECTION_FILES="$files" exec "${BIN:-$root/build/release/bin}/svt_pipeline_test" \
    --gtest_filter=ExactSectionOfFiles.AgreeWithTheirTriangles --gtest_brief=1
