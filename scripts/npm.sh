#!/usr/bin/env bash
# Packs two npm packages: the command as WebAssembly with the library and the page, and the web component <svt-viewer>:
# build/npm/semantic-volume-texture-svt-VERSION.tgz and semantic-volume-texture-viewer-VERSION.tgz.
# Needs node with npm (scripts/setup.sh web), build/web (targets svt_web and svt_node) and the page (make viewer).
# REPOSITORY is the address of the repository on the web, for package.json; by default `repository-code` of CITATION.cff.
set -euo pipefail
cd "$(dirname "$0")/.."
page=build/release/share/svt/viewer
for file in build/web/svt_node.wasm build/web/svt.wasm build/web/svt_view.wasm "$page/index.html"; do
  [ -f "$file" ] || { echo "npm: $file is missing; 'make npm' builds it" >&2; exit 1; }
done
repository=${REPOSITORY:-$(sed -n 's/^repository-code: *"\{0,1\}\([^"]*\)"\{0,1\} *$/\1/p' CITATION.cff)}
[ -n "$repository" ] || echo "npm: the packages name no repository; 'make npm REPOSITORY=https://...' does, which publishing needs" >&2

log=build/npm.log
quietly() { "$@" >"$log" 2>&1 || { cat "$log" >&2; echo "npm: '$*' failed; see above" >&2; exit 1; }; }
npm=$PWD/build/npm
svt=$npm/svt
viewer=$npm/viewer
rm -rf "$npm"
mkdir -p "$svt/bin" "$svt/lib" "$svt/share/svt" "$svt/types" "$viewer"

# Scripts and declarations of the page's sources.
vite() { (cd web/viewer && SVT_PACKAGE_OUT=$2 quietly npx --no-install vite build --config vite.packages.config.ts --mode "$1"); }
log=$PWD/$log
vite element "$viewer/dist"
vite browser "$svt/library"
vite node "$svt/library"
(cd web/viewer && quietly npx --no-install tsc --project tsconfig.types.json --outDir "$npm/declarations")
node web/viewer/package_types.mjs "$npm/declarations" "$svt/types" library/node
node web/viewer/package_types.mjs "$npm/declarations" "$viewer/types" element/svt_viewer
web/viewer/node_modules/.bin/tsc --project web/npm/tsconfig.json --noEmit false --declaration --emitDeclarationOnly --outDir "$npm/declarations/npm"
cp "$npm/declarations/npm/lib/run.d.mts" "$svt/types/run.d.mts"

node web/npm/complete.mjs web/npm/package.json web/npm "$repository" >"$svt/package.json"
cp web/npm/README.md LICENSE NOTICE "$svt"
node web/viewer/sbom.mjs "$page/sbom.cdx.json" >"$svt/sbom.cdx.json"
cp web/npm/bin/svt.mjs "$svt/bin"
cp web/npm/lib/host.mjs web/npm/lib/server.mjs web/npm/lib/run.mjs "$svt/lib"
cp build/web/svt_node.js "$svt/lib/svt_node.cjs"  # a CommonJS module
cp build/web/svt_node.wasm "$svt/lib"
cp build/web/svt.js build/web/svt.d.ts "$svt/library"
cp -r "$page" "$svt/share/svt/viewer"

node web/npm/complete.mjs web/npm/viewer/package.json web/npm/viewer "$repository" >"$viewer/package.json"
cp web/npm/viewer/README.md web/npm/viewer/custom-elements.json LICENSE "$viewer"
mv "$viewer/dist/sbom.cdx.json" "$viewer"

rm -r "$npm/declarations"
for package in svt viewer; do
  (cd "$npm" && npm pack --silent "./$package" >/dev/null)
done
for file in "$npm"/*.tgz; do echo "npm: build/npm/$(basename "$file"), $(du -h "$file" | cut -f1)"; done
