#!/usr/bin/env bash
# Runs tests under a sanitizer of the compiler; any finding is a failure.
#   scripts/sanitize.sh asan [FOLDER...]   address and undefined behaviour: all tests, or those of folders of svt/ and of `cli`
#   scripts/sanitize.sh tsan               threads: the tests of what is parallel
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:?usage: $0 asan|tsan [FOLDER...]}
shift
folders=("$@")
# The programs whose tests start threads.
[ "$preset" = tsan ] && \
  folders=(core readers mesh volume voxelize render fields simulate analyze quantities compare drawing illustrate serve pipeline city)
targets=()
for folder in "${folders[@]}"; do
  targets+=("svt_${folder}_test")
  [ "$folder" = cli ] && targets+=(svt)
done
scripts/build.sh "$preset" "${targets[@]}"
export SVT_DATA_DIR=${SVT_DATA_DIR:-$PWD/../shared/data}
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:allocator_may_return_null=1
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1
select=()
# What starts threads: loops, readers, bricks and columns, the voxelizer, both casters, quantities, shells, contacts, the server.
[ "$preset" = tsan ] && select=(-R '(Thread|Parallel|Deterministic|SameBytes|AnyNumber|Server|Hostile|Contacts|Shell|LodPyramid|BrickVolume|ColumnBlocks|Voxelize|PacketCaster|RayCaster|Quantities|TouchingFaces)' -E '^(Picture|Viewer|WebModule|Documents|Package)')
# Pages and pictures are tested by the release build; drivers of OpenGL are no code of ours.
[ "$preset" = asan ] && select=(-E '^(Viewer|WebModule|Gl|Package)')
if [ ${#folders[@]} -gt 0 ]; then
  select+=(-L "^($(IFS='|'; echo "${folders[*]}"))$")
fi
ctest --test-dir "build/$preset" -j "$(nproc)" --timeout 900 --no-tests=error --output-on-failure --progress "${select[@]}"
