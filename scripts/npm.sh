#!/usr/bin/env bash
# Packs the command as WebAssembly, the module and the page as an npm package: build/npm/svt-VERSION.tgz.
# Needs node with npm (scripts/setup.sh web), build/web (targets svt_web and svt_node) and the page (make viewer).
set -euo pipefail
cd "$(dirname "$0")/.."
page=build/release/share/svt/viewer
for file in build/web/svt_node.wasm build/web/svt.wasm "$page/index.html"; do
  [ -f "$file" ] || { echo "npm: $file is missing; 'make npm' builds it" >&2; exit 1; }
done
package=build/npm/package
rm -rf build/npm
mkdir -p "$package/bin" "$package/lib" "$package/module" "$package/share/svt"
version=$(sed -n 's/^project(svt VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
sed "s/\"version\": \"0.0.0\"/\"version\": \"$version\"/" web/npm/package.json >"$package/package.json"
cp web/npm/README.md LICENSE "$package"
node web/viewer/sbom.mjs "$page/sbom.cdx.json" >"$package/sbom.cdx.json"
cp web/npm/bin/svt.mjs "$package/bin"
cp web/npm/lib/host.mjs web/npm/lib/server.mjs "$package/lib"
cp build/web/svt_node.js "$package/lib/svt_node.cjs"  # a CommonJS module
cp build/web/svt_node.wasm "$package/lib"
cp build/web/svt.js build/web/svt.wasm build/web/svt.d.ts build/web/DejaVuSans.ttf "$package/module"
cp -r "$page" "$package/share/svt/viewer"
(cd build/npm && npm pack --silent ./package >/dev/null)
echo "npm: build/npm/svt-$version.tgz, $(du -h "build/npm/svt-$version.tgz" | cut -f1)"
