#!/usr/bin/env bash
# What happens to a city when the disk is full, two runs share a folder, clocks are wrong, files are damaged.
# Nothing is lost, everything is named. Disks that fill up are small file systems in memory, which need root.
#   scripts/test_city.sh SVT
set -euo pipefail
svt=$(realpath "$1")
work=$(mktemp -d /tmp/svt-city.XXXXXX)
finish() {
  umount "$work/small" 2>/dev/null || true
  rm -rf "$work"
}
trap finish EXIT
trap 'exit 1' INT TERM
cd "$work"
fail() { echo "city: $1" >&2; [ ! -s said ] || cat said >&2; exit 1; }
same() { # folder, what
  local name
  for name in city.json index.bin ids.bin words.bin packs.bin packs; do diff -rq "good/$name" "$1/$name" >&2 || fail "$2: $1/$name differs"; done
  [ -z "$(find "$1" -name '*.tmp*')" ] || fail "$2: temporary files are left: $(find "$1" -name '*.tmp*')"
  echo "city: $2"
}
refused() { # exit code, words, command ...
  local code=$1 words=$2 got=0
  shift 2
  "$@" >said 2>&1 || got=$?
  [ "$got" = "$code" ] || fail "exit code $got instead of $code: $*"
  grep -q "$words" said || fail "'$words' is not said: $*"
}
"$svt" sample city --buildings 1500 --files 3 -o files -q
plan() { "$svt" city plan files -o "$1" --spacing 1 --pack-seconds 0.2 -q; }
plan good
"$svt" city run good -q

plan two
"$svt" city run two -q --jobs 2 & first=$!
"$svt" city run two -q --jobs 2 & second=$!
if ! wait $first || ! wait $second; then fail "two runs into one folder"; fi
same two "two runs into one folder have the bytes of one"

plan skewed
find files skewed -exec touch -d '2040-01-01' {} +
"$svt" city task skewed 0 --of 2 -q
find skewed/packs skewed/reports -exec touch -d '1975-01-01' {} +
"$svt" city run skewed -q
same skewed "times of files, far in the future and the past, decide nothing"

plan damaged
"$svt" city run damaged -q
packs=(damaged/packs/*.svtp)
cp "${packs[1]}" whole.svtp
truncate -s 2000 "${packs[1]}"
refused 3 "E605" "$svt" city merge damaged
mv whole.svtp "${packs[1]}"
printf 'x' | dd of="${packs[0]}" bs=1 seek=5000 conv=notrunc status=none
[ "$("$svt" city status damaged --proven | grep -c '^missing: 0$')" = 1 ] || fail "a damaged pack is not seen"
refused 3 "E603.*tile" "$svt" city merge damaged
truncate -s 2000 "${packs[1]}"
refused 3 "E603" "$svt" city extract damaged -o x.svt --detail 0 --box=0,0,-100,1e6,1e7,1000
[ ! -e x.svt ] || fail "a volume of a damaged pack"
"$svt" city run damaged -q
same damaged "a damaged and a cut pack are named, and built again"
top=$(python3 -c 'import json; print("%05d" % json.load(open("damaged/city.json"))["top"]["pack"])')
truncate -s 300 "damaged/packs/$top.svtp"
refused 3 "E603" "$svt" city extract damaged -o x.svt --detail 2 --box=0,0,-100,1e6,1e7,1000
for name in index.bin ids.bin words.bin; do
  truncate -s 20 "damaged/$name"
  refused 3 "E604.*merge" "$svt" city extract damaged -o x.svt --id BLDG_0000000100000005
done
"$svt" city merge damaged -q
same damaged "damaged levels, index and ids are named, and merged again"
truncate -s 100 damaged/reports/00001.json
"$svt" city run damaged -q
same damaged "a damaged report: its pack is built again"

cp -r good other
sed -i 's/"version": 1,/"version": 99,/' other/plan/plan.json
refused 3 "E602" "$svt" city run other
sed -i 's/"version": 99,/"version": 1,/' other/plan/plan.json
sed -i 's/"version": [0-9]*,/"version": 99,/' other/city.json
refused 3 "E602" "$svt" city info other
head -c 200 good/plan/plan.json >other/plan/plan.json
refused 3 "E601" "$svt" city run other
echo "city: plans and cities of another version are refused"

if [ "$(id -u)" -ne 0 ] || ! { mkdir small && mount -t tmpfs -o size=700k tmpfs small 2>said; }; then
  echo "city: no small file system can be made here; disks that are full are not tested"
  exit 0
fi
plan small/town
refused 5 "E405" "$svt" city task small/town 0 --of 1
mount -o remount,size=200m "$work/small"
"$svt" city run small/town -q
same small/town "a disk that is full in a task: named; with space the run goes on"
rm small/town/city.json small/town/index.bin small/town/ids.bin small/town/words.bin
top=$(printf 'small/town/packs/%05d.svtp' "$("$svt" city status small/town --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["packs"])')")
rm "$top"
used=$(df --output=used -k small | tail -n 1)
mount -o remount,size=$((used + 24))k "$work/small"
refused 5 "E405" "$svt" city merge small/town
[ ! -e small/town/city.json ] || fail "a city on a full disk"
mount -o remount,size=200m "$work/small"
"$svt" city merge small/town -q
same small/town "a disk that is full in the merge: likewise"
