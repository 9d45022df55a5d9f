#!/usr/bin/env bash
# A city built by job arrays of a real Slurm with two nodes on this machine (scripts/slurm_nodes.sh), against the bytes of a
# local run, and what happens when tasks, jobs and a node are lost. Exits with 77 and the reason if a requirement is missing.
#   scripts/test_slurm.sh SVT [long]   long: also a lost node (two and a half minutes, Slurm's own delay)
set -euo pipefail
cd "$(dirname "$0")/.."
svt=$(realpath "$1") nodes=$PWD/scripts/slurm_nodes.sh
skip() { echo "skipped: $1"; exit 77; }
[ "$(id -u)" -eq 0 ] || skip "two nodes on one machine need root"
for program in sbatch slurmctld slurmd munged; do
  command -v "$program" >/dev/null || [ -x "/usr/sbin/$program" ] || skip "$program is missing (scripts/setup.sh slurm)"
done
PATH=$PATH:/usr/sbin
work=$(mktemp -d /tmp/svt-slurm.XXXXXX)
finish() {
  "$nodes" stop "$work/slurm" >/dev/null 2>&1 || true
  rm -rf "$work"
}
trap finish EXIT
trap 'exit 1' INT TERM
fail() {
  tail -qn 3 "$work"/slurm/*.log >&2 2>/dev/null || true
  echo "slurm: $1" >&2
  exit 1
}

MAX_ARRAY=21 PORT=$((20000 + RANDOM % 9000)) "$nodes" start "$work/slurm" >/dev/null || fail "the nodes do not start"
export SLURM_CONF=$work/slurm/slurm.conf
cd "$work"
"$svt" sample city --buildings 4000 --files 4 -o files -q
plan() { "$svt" city plan files -o "$1" --pack-seconds 0.05 --tasks 1000 --spacing 1 -q; }
submit() { "$svt" city run "$1" --engine slurm -- --time=5 "${@:2}" >said || fail "not submitted"; sed -n 's/.*as job \([0-9]*\), .*/\1/p' said; }
release() { # all that was submitted with --hold, the merge, too
  for job in $(squeue -h -t PD -o %A | sort -u); do scontrol release "$job"; done
}
drained() { # until no job is left, at most $1 seconds
  for _ in $(seq "$(($1 * 40))"); do [ -z "$(squeue -h)" ] && return; sleep 0.25; done
  squeue >&2
  fail "jobs do not end"
}
same() { # the city $1 has the bytes of the local one, $3
  local name
  for name in city.json index.bin ids.bin words.bin packs.bin packs; do diff -rq "${3:-local}/$name" "$1/$name" >&2 || fail "$1/$name differs: $2"; done
  echo "slurm: $2"
}
plan local
"$svt" city run local -q
packs=$("$svt" city status local --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["packs"])')
[ "$packs" -gt 21 ] || fail "the plan has $packs packs, too few for what is tested"

plan array
submit array >/dev/null
grep -q "^21 of 21 tasks" said || fail "21 elements are what MaxArraySize allows: $(cat said)"
drained 90
same array "an array has the bytes of a local run; $packs packs in 21 elements, as MaxArraySize allows"
sbatch --parsable --array=0-21 --wrap=true >said 2>&1 && fail "Slurm took an array beyond its own limit"
grep -q "Invalid job array specification" said || fail "Slurm refuses for another reason: $(cat said)"

plan refused
"$svt" city run refused --engine slurm -- --partition=nowhere >said 2>&1 && fail "a partition that is not there"
grep -q "E609.*nowhere\|E609.*nvalid partition" said || fail "Slurm's reason is not told: $(cat said)"

plan killed
submit killed >/dev/null
killed=0
for _ in $(seq 400); do
  # The task and the process in which it builds a pack; one that came to its end before is none.
  victim=$(pgrep -f "^$svt city task $work/killed " | head -n 1) || true
  if [ -n "$victim" ]; then
    mapfile -t below < <(pgrep -P "$victim")
    if kill -KILL "$victim" "${below[@]}" 2>/dev/null; then killed=$((killed + 1)); fi
  fi
  [ $killed -lt 2 ] || break
  sleep 0.02
done
[ $killed -gt 0 ] || fail "no task was seen"
drained 90
"$svt" city status killed >said
grep -q "^missing: " said || fail "nothing is missing after kill -9"
grep -l "E605" killed/logs/merge_* >/dev/null || fail "the merge does not name what is missing"
eval "$(grep '^svt city run' said | sed "s|^svt|$svt|")" >again
grep -q "^[1-4] of 21" again || fail "few elements are enough for what was killed: $(cat again)"
drained 60
same killed "a task killed with -9 is missing, named, and alone run again by the line of 'svt city status'"

plan cancelled
job=$(submit cancelled)
sleep 1.5
scancel "$job"
drained 60
[ "$("$svt" city status cancelled | grep -c '^missing')" = 1 ] || fail "all was done before it was cancelled"
submit cancelled >/dev/null
drained 90
same cancelled "cancelled with scancel and submitted again"

plan failing
job=$(submit failing --hold)
RANDOM=7
for task in $(seq 0 20); do [ $((RANDOM % 10)) -ge 1 ] || scancel "${job}_$task"; done
scancel "${job}_4"
release
drained 90
for _ in 1 2 3; do
  [ "$("$svt" city status failing | grep -c '^missing')" = 0 ] && break
  submit failing >/dev/null
  drained 90
done
same failing "some tasks of ten fail at random, and are run again"

# A building as high as its tile is wide takes minutes: it is left out, within the limit, and named.
cp -r files more
cat >more/zz.gml <<'END'
<?xml version="1.0"?>
<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="EPSG:25833" srsDimension="3" uomLabels="m m m"><gml:lowerCorner>384000 5812000 30</gml:lowerCorner><gml:upperCorner>390000 5812100 90</gml:upperCorner></gml:Envelope></gml:boundedBy>
<cityObjectMember><bldg:Building gml:id="slow"><bldg:lod1Solid><gml:Solid><gml:exterior><gml:CompositeSurface>
<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>370000 5800000 0 395000 5803000 0 385000 5825000 0 370000 5800000 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>370000 5800000 0 384000 5812000 20000 395000 5803000 0 370000 5800000 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>395000 5803000 0 384000 5812000 20000 385000 5825000 0 395000 5803000 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>385000 5825000 0 384000 5812000 20000 370000 5800000 0 385000 5825000 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod1Solid></bldg:Building></cityObjectMember>
</CityModel>
END
"$svt" city plan more -o hanging --pack-seconds 0.05 --tasks 1000 --spacing 1 -q
"$svt" city run hanging --engine slurm --tile-seconds 6 --feature-seconds 2 -- --time=5 >/dev/null
drained 180
"$svt" city status hanging >said 2>&1
if ! grep -q "4000 buildings of 4001 features" said || grep -q "^missing" said || ! grep -q "zz.gml.*left out.*too long" said; then
  fail "a feature that takes too long: $(cat said)"
fi
echo "slurm: a feature that takes too long is left out and named, all others are there"

# Killed anywhere, a merge leaves the city before it or none, and is run again.
cp -r local merged
for milliseconds in 5 15 30 60 120; do
  rm -f merged/city.json
  "$svt" city merge merged -q &
  sleep "0.$(printf %03d "$milliseconds")"
  kill -KILL $! 2>/dev/null || true
  wait 2>/dev/null || true
  [ ! -e merged/city.json ] || cmp -s merged/city.json local/city.json || fail "half a city after a killed merge"
done
plan late
submit late >/dev/null
for _ in $(seq 600); do
  pid=$(pgrep -f "^$svt city merge $work/late") && { kill -KILL "$pid"; break; }
  sleep 0.02
done || true
drained 90
"$svt" city merge merged -q
"$svt" city merge late -q
same merged "a merge killed midway is run again"
same late "also one that Slurm ran"

if command -v buoyantBoussinesqPimpleFoam >/dev/null; then
  "$svt" sample house -o house.gml -q
  "$svt" build house.gml -o house.svt --spacing 0.2 -q
  "$svt" convert house.svt room.foam --air name=Kitchen --surface-temperature 'class~Window:12' -q
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  (cd room.foam && sbatch --wait --overcommit Allrun.slurm) >said 2>&1 || fail "the air of a room: $(cat said room.foam/slurm-*.out)"
  [ -d room.foam/processor1 ] || fail "the air of a room is not computed by two processes"
  "$svt" field add house.svt room.foam --quantity T -q || fail "the results of OpenFOAM are not read"
  echo "slurm: OpenFOAM computes the air of a room with two processes"
else
  echo "slurm: OpenFOAM is missing (scripts/setup.sh readers), so no air of a room is computed"
fi

if [ "${2:-}" = long ]; then
  # Tasks of some seconds, so that one is at work when its node goes.
  for town in lost-local lost; do "$svt" city plan files -o $town --pack-seconds 4 --tasks 2 --spacing 0.1 -q; done
  "$svt" city run lost-local -q
  submit lost >/dev/null
  for _ in $(seq 200); do squeue -h -n svt-city -t R -o %N | grep -q n2 && break; sleep 0.05; done
  sleep 1
  "$nodes" kill "$work/slurm" n2
  start=$SECONDS
  drained 400
  sinfo -h -n n2 -o %T | grep -qi down || fail "the lost node is not down"
  grep -qi "requeue.*n2" "$work/slurm/ctld.log" || fail "nothing was requeued"
  same lost "a lost node's task is requeued and runs on the other node ($((SECONDS - start)) s)" lost-local
fi
if pgrep -f "$work/" >/dev/null; then sleep 2; fi
echo "slurm: done"
