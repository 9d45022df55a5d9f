#!/usr/bin/env bash
# Installs the npm packages of build/npm into an empty folder. The command answers there with the same bytes as the program. The library
# (in Node.js and in Chromium) and the web component give the pictures of the program. Bundlers and TypeScript take both packages. Their
# bills of materials name the libraries and packages that they hold, with their versions.
# Exits with 77 and the reason if a requirement is missing.
#   scripts/test_npm.sh SVT   the program to compare with
set -euo pipefail
cd "$(dirname "$0")/.."
svt=$(realpath "$1")
root=$PWD
skip() { echo "skipped: $1"; exit 77; }
command -v npm >/dev/null || skip "npm is missing (scripts/setup.sh web)"
node --test tests/npm/*_test.mjs
packages=(build/npm/semantic-volume-texture-{svt,viewer}-*.tgz)
for package in "${packages[@]}"; do [ -f "$package" ] || skip "the packages are not there (make npm)"; done
work=$(mktemp -d)
trap 'kill %1 2>/dev/null || true; rm -rf "$work"' EXIT
packages=("${packages[@]/#/$root/}")
cd "$work"
npm init -y >/dev/null
npm install --offline --no-audit --no-fund "${packages[@]}" >log 2>&1 || { cat log >&2; exit 1; }
installed=node_modules/@semantic-volume-texture
node "$root/tests/npm/bill_of_materials.mjs" command $installed/svt/sbom.cdx.json
node "$root/tests/npm/bill_of_materials.mjs" page $installed/svt/share/svt/viewer/sbom.cdx.json
node "$root/tests/npm/bill_of_materials.mjs" element $installed/viewer/sbom.cdx.json
mkdir 'my models' there
npx --no-install svt --version >version 2>>log
head -n 1 version
commands() { # program, folder
  "$1" sample house -o "$2/h 1.gml"
  "$1" build "$2/h 1.gml" -o "$2/h.svt" --vectors edges
  "$1" render "$2/h.svt" -o "$2/h.png" --size 320x200 --section 'y<5'
  "$1" render "$2/h.svt" -o "$2/names.png" --size 320x200 --names class=BuildingRoom
  "$1" section "$2/h.svt" --plane z=1.2 -o "$2/plan.svg"
  "$1" query "$2/h.svt" class=BuildingRoom --csv >"$2/rooms.csv"
  for ending in nrrd vdb glb vox; do "$1" convert "$2/h.svt" "$2/h.$ending"; done
} 2>>log
commands node_modules/.bin/svt 'my models' >>log || { cat log >&2; exit 1; }
commands "$svt" there >>log || { cat log >&2; exit 1; }
for file in 'h 1.gml' h.svt h.png names.png plan.svg rooms.csv h.nrrd h.vdb h.glb h.vox; do cmp "my models/$file" "there/$file"; done
node_modules/.bin/svt publish 'my models/h.svt' -o site >>log
[ -f site/index.html ] && cmp site/models/h.svt there/h.svt
# Errors end as those of the program do.
set +e
node_modules/.bin/svt build none.gml -o none.svt 2>error1; code1=$?
"$svt" build none.gml -o none.svt 2>error2; code2=$?
set -e
[ $code1 -eq $code2 ] && cmp error1 error2
# The page is served until the program is stopped; then nothing is left.
node_modules/.bin/svt view 'my models/h.svt' --no-browser >address 2>/dev/null &
for _ in $(seq 3000); do [ -s address ] && break; sleep 0.1; done
node -e 'fetch(require("fs").readFileSync("address","utf8").trim()+"models/h.svt").then(r=>r.arrayBuffer()).then(b=>{
  if (Buffer.compare(Buffer.from(b), require("fs").readFileSync("my models/h.svt")) !== 0) throw new Error("another volume")})'
kill %1
wait %1 2>/dev/null || true
echo "npm: the command answers as the program does"

# The library and the web component, as programs and pages use them.
tests=("$root"/tests/npm/packed/*_test.mjs)
if [ ! -x "${SVT_CHROMIUM:-/usr/bin/chromium-headless-shell}" ]; then
  echo "skipped: the web component in a page: chromium is missing (scripts/setup.sh web)"
  tests=("$root"/tests/npm/packed/{library,bundles,readme}_test.mjs)
fi
SVT_COMMAND=$svt SVT_NPM_FOLDER=$work node --test --test-concurrency=1 --test-reporter=spec "${tests[@]}" >tests.log 2>&1 || { cat tests.log >&2; exit 1; }
echo "npm: the library and the web component give the pictures of the program"
