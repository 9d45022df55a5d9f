#!/usr/bin/env bash
# Installs the release build into a folder of its own, builds the programs of examples/cpp against it as another project
# would, and runs them on a generated house.
#   scripts/test_package.sh [FOLDER]   of the release build
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/usr" >"$work/log"
for file in bin/svt share/man/man1/svt.1.gz share/man/man1/svt-render.1.gz share/bash-completion/completions/svt include/svt/render/ray_caster.hpp; do
  [ -s "$work/usr/$file" ] || { echo "package: $file is not installed" >&2; exit 1; }
done
scripts/test_desktop.sh "$work/usr/bin/svt" "$work/usr/share"
# The inside of a folder is no header of the package.
inside=$(find "$work/usr/include/svt" -mindepth 2 -type d; find "$work/usr/include/svt" -name '*_test.hpp')
[ -z "$inside" ] || { echo "package: installed, but private: $inside" >&2; exit 1; }

logged() { "$@" >>"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }; }
logged cmake -S examples/cpp -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/usr"
logged cmake --build "$work/build"
cd "$work"
usr/bin/svt sample house -o house.gml
build/build_and_query house.gml house.svt 'class=BuildingRoom'
build/draw_section house.svt z=1.2 plan.svg
build/draw_picture house.svt house.png
usr/bin/svt render house.svt -o same.png --size 960x540 --look paper --hide class=BuildingRoom --section 'y<4'
cmp house.png same.png
# pkg-config tells a plain compiler the same.
PKG_CONFIG_PATH=usr/lib/pkgconfig:$(dirname "$(find usr/lib -name svt.pc)") pkg-config --exists svt
echo "package: installed, and used by another project"
