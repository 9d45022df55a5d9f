#!/usr/bin/env bash
# Draws the pictures of README.md that are scenes of examples/scenes, and the drawings and sheets of the manual. Needs the
# FZK-Haus (CityGML 3.0):
#   scripts/update_pictures.sh FZK_HAUS.gml
set -euo pipefail
model=$(realpath "${1:?usage: $0 FZK_HAUS.gml}")
cd "$(dirname "$0")/.."
svt=build/release/bin/svt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
$svt build "$model" -o "$work/house.svt" --dimension 800,700,400 --vectors edges,meshes
$svt sample tower -o "$work/tower.gml"
$svt build "$work/tower.gml" -o "$work/tower.svt" --spacing 0.05
draw() { # picture, volume, scene, size
  $svt render "$work/$2.svt" --scene "examples/scenes/$3.scene.json" --size "$4" -o "docs/images/$1.png"
  echo "docs/images/$1.png"
}
draw section_beam house slab_and_beam 900x540
draw cutaway house beam_cutaway 900x640
$svt render "$work/house.svt" -o docs/images/cutaway_walls.png --size 900x640 --look paper --hide class=BuildingRoom \
  --cutaway 'name~"Wand-Int"' --color 'name~"Wand-Int":red'
draw lens house lens 900x640
draw wireframe house wireframe 600x400
draw storeys_apart house storeys_apart 900x640
draw inset house inset 900x640
draw rooms_by_area house rooms_by_area 900x640
draw flats tower two_flats_in_their_tower 640x720
draw hulls tower hulls_of_storeys 560x640

# Drawings: as the pages that show them say.
mkdir "$work/plan"
$svt sample house -o "$work/plan/house.gml"
$svt build "$work/plan/house.gml" -o "$work/sample.svt" --spacing 0.05
draw plan_names sample plan_with_names 900x640
$svt render "$work/sample.svt" --scene examples/scenes/film.scene.json -o docs/images/film.webp
$svt build "$work/plan/house.gml" -o "$work/fine.svt" --spacing 0.03
$svt render "$work/fine.svt" --scene examples/scenes/section_moving.scene.json -o docs/images/section_moving.webp
$svt render "$work/fine.svt" -o docs/images/quantities_walls.png --size 900x560 --look paper \
  --show 'class=BuildingConstructiveElement and storey="Ground floor"' --hide 'name~"Intermediate slab"' \
  --color 'name~"^Exterior wall":#d9a441' --color 'name~"^(Spine|Wall)":#6aa0c8'
$svt section "$work/sample.svt" -o docs/images/section.svg
$svt section "$work/sample.svt" -o docs/images/section_beyond.svg --plane 'x>5' --beyond
$svt section "$work/sample.svt" -o docs/images/plan_dimensions.svg --dimensions
$svt sample house -o "$work/after.gml" --change 6 --change-list "$work/known.json"
$svt diff "$work/plan/house.gml" "$work/after.gml" --spacing 0.2 --tolerance 0.002 --properties none -q -o "$work/changes.svt" || [ $? -eq 7 ]
$svt section "$work/changes.svt" -o docs/images/revisions.svg --revisions --plane 'storey=Ground floor+1.2' --beyond
$svt sample house --format ifc -o "$work/house.ifc"
$svt section "$work/house.ifc" -o docs/images/plan_doors.svg --plane z=1.5 --beyond --dimensions
sheet() { # picture, number of the sheet, model, options
  local picture=$1 number=$2 of=$3
  shift 3
  $svt sheets "$of" --svg "$work/$picture" "$@"
  local sheets=("$work/$picture"/*.svg)
  cp "${sheets[$number - 1]}" "docs/images/$picture.svg"
}
sheet sheet_plans 1 "$work/plan/house.gml" --paper A2 --scale 1:50
sheet sheet_fzk 3 "$model"
sheet sheet_tower 1 "$work/tower.gml"
