#!/usr/bin/env bash
# Generates a town in several files, builds it as a city, draws it, and asks it. Written to build/demo-city, in about a minute.
set -euo pipefail
cd "$(dirname "$0")/.."
svt=build/release/bin/svt
out=build/demo-city
step() { echo "demo-city: $1"; }
rm -rf "$out"
mkdir -p "$out"

step "generating 3000 buildings in 4 files"
$svt sample city --buildings 3000 --files 4 -o "$out/files" -q
step "building the city"
$svt city plan "$out/files" -o "$out/town" --spacing 0.5 -q
$svt city run "$out/town" -q
$svt info "$out/town"

step "drawing"
$svt render "$out/town" -o "$out/town.png" --eye 500,350,150 --target 800,750,0 --sun '2026-06-21 17:00'
$svt render "$out/town" -o "$out/town_cut.png" --eye 500,350,150 --target 800,750,0 --section 'z>20'
$svt section "$out/town" --plane 'z=abs(50)' -o "$out/town_section.geojson" -q
step "asking"
$svt query "$out/town" class=Building -o "$out/buildings.gpkg"
$svt query "$out/town" class=Building --sort height --first 3
echo "demo-city: pictures, a section and a table of the buildings are in $out"
