#!/usr/bin/env bash
# Adds an option to the scene of a copy of the tree, by its field and its declaration, builds, and finds the option in help,
# manual, schema, scene files (read, written, between keys), as a keyword of Python and on the page.
set -euo pipefail
cd "$(dirname "$0")/.."
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$copy" 2>/dev/null || true
cd "$copy"

# The two lines of docs/dev/howto/add-an-option.md.
field='    double haze = 0;  ///< between the viewer and the building, 0 to 1'
member='        member<\&Scene::haze>("haze", "thickness of the haze", {.least = 0, .most = 1, .group = "Illustrate", .option = "--haze"}),'
sed -i "/^    bool hasNorthArrow = false;/i\\$field" svt/illustrate/scene.hpp
sed -i "/^        member<&Scene::hasNorthArrow>/i\\$member" svt/illustrate/scene/scene_members.cpp

scripts/build.sh release svt svt_python_package
svt=build/release/bin/svt
fail() { echo "new option: $*" >&2; exit 1; }
found() { grep -q -e "$1" || fail "not found in $2"; }

"$svt" render --help | found '--haze NUMBER  *thickness of the haze, 0 to 1; default: 0$' help
"$svt" describe man render 2>/dev/null | found 'haze' 'the manual page'
"$svt" describe bash | found '--haze' completions
python3 scripts/update_options.py --svt "$svt" >/dev/null
grep -A6 '"haze"' docs/formats/scene.schema.json | found '"maximum": 1' 'the schema'
grep -q 'haze' docs/user/render.md || fail "not found in docs/user/render.md"
grep -q '  haze?: number' web/viewer/src/generated/scene_members.ts || fail "not found in the types of the page"
grep -q '"/haze": { type: "number", .*option: "--haze", group: "Illustrate"' web/viewer/src/generated/scene_members.ts ||
  fail "not found among the controls of the page"

"$svt" sample house -o house.gml >/dev/null
"$svt" render house.gml -o p.png --spacing 0.4 --size 64x48 --haze 0.25 --write-scene s.scene.json --quiet
found '"haze": 0.25' 'the scene that is written' <s.scene.json
"$svt" render house.gml -o p.png --spacing 0.4 --size 64x48 --scene s.scene.json --title T --write-scene again.scene.json --quiet
found '"haze": 0.25' 'the scene that is read' <again.scene.json
code=0
"$svt" render house.gml -o p.png --haze 2 >error.txt 2>&1 || code=$?
[ "$code" -eq 2 ] || fail "--haze 2 ends with exit code $code"
found '2 is out of range; possible is 0 to 1' 'the message for a value out of range' <error.txt

cat >between_test.cpp <<'CPP'
#include <svt/illustrate/motion.hpp>
#include <cstdio>
int main() {
    using namespace svt;
    const auto scene = illustrate::parseScene(R"({"motion":{"pace":"even","seconds":2,"keys":[{"at":2,"scene":{"haze":1}}]}})");
    const auto now = illustrate::sceneAt(*scene, 0.5, {});
    return now && now->haze == 0.25 ? 0 : 1;
}
CPP
libraries=$(for name in illustrate drawing plane render analyze record image volume model crs core; do echo "build/release/libsvt_$name.a"; done)
# shellcheck disable=SC2086
c++ -std=c++20 -D_GLIBCXX_ASSERTIONS -I. between_test.cpp -Wl,--start-group $libraries -Wl,--end-group -lfmt -ltbb -lz -lzstd \
  -lpng -lfreetype -lhwy -ldl -o between
./between || fail "not between its keys"

python=$(sed -n 's/^SVT_PYTHON_EXECUTABLE:FILEPATH=//p' build/release/CMakeCache.txt)
PYTHONPATH=build/release/python "$python" - <<'PYTHON' || fail "no keyword of Python"
import svt
volume = svt.build("house.gml", spacing=0.4)
volume.render(size="64x48", haze=0.5)
try:
    volume.render(size="64x48", haze=2)
except (svt.Error, ValueError, TypeError) as error:
    assert "0 to 1" in str(error), error
else:
    raise AssertionError("haze=2 is accepted")
PYTHON
echo "new option: found in help, manual, completions, schema, page, scene files, between keys, in Python"
