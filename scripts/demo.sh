#!/usr/bin/env bash
# Generates the sample house, builds its volume and draws it, whole and cut open. Pictures are written to build/demo.
set -euo pipefail
cd "$(dirname "$0")/.."
svt=build/release/bin/svt
out=build/demo
mkdir -p "$out"
step() { echo "demo: $1"; }

step "generating a house and a tower of flats"
$svt sample house -o "$out/house.gml"
$svt sample tower -o "$out/tower.gml"
step "building their volumes"
$svt build "$out/house.gml" -o "$out/house.svt" --spacing 0.02 --vectors edges
$svt build "$out/house.gml" -o "$out/house_patterns.svt" --spacing 0.02 --style examples/styles/drawing.json
$svt build "$out/tower.gml" -o "$out/tower.svt" --spacing 0.05

step "drawing"
draw() { # name, title, arguments...
  local name=$1
  shift
  $svt render "$@" -o "$out/$name.png"
  echo "  $out/$name.png"
}
draw house "$out/house.svt"
draw house_open "$out/house.svt" --hide class=BuildingRoom --section 'y<4.3'
draw house_rooms "$out/house.svt" --hide 'name~"Roof|Rafter|Ridge"' --opacity class=BuildingRoom:0.25 --section 'z>5.2'
draw house_plan "$out/house.svt" --hide class=BuildingRoom --section 'z>1.4' --camera top --ortho
draw house_beam "$out/house.svt" --hide class=BuildingRoom --section 'y<4.3' --color 'name="Hidden beam":red' --camera front
draw house_patterns "$out/house_patterns.svt" --hide class=BuildingRoom --section 'y<4.3' --camera front
draw house_lens "$out/house.svt" --hide class=BuildingRoom --lens 'view(0.5,0.5,0.35)' --section 'y<4.3'
draw house_cutaway "$out/house.svt" --look paper --hide class=BuildingRoom --cutaway 'name="Hidden beam"' --color 'name="Hidden beam":red'
draw tower_flats "$out/tower.svt" --scene examples/scenes/two_flats_in_their_tower.scene.json
$svt section "$out/house.svt" -o "$out/house_plan.svg" --plane 'storey=Ground floor+1.2'
echo "  $out/house_plan.svg"
echo "demo: the pictures are in $out, the volumes beside them ('$svt info $out/house.svt --tree' shows what is inside)"
