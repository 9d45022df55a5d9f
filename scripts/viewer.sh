#!/usr/bin/env bash
# Builds the viewer page into build/release/share/svt/viewer. Does nothing if it is newer than all its sources.
# Needs node with npm (scripts/setup.sh web) and the library as WebAssembly (build/web, `make web`).
set -euo pipefail
cd "$(dirname "$0")/.."
page=build/release/share/svt/viewer
module=build/web/svt_view.wasm
[ -f "$module" ] || { echo "viewer: $module is missing; 'make web' builds it" >&2; exit 1; }

log=$(mktemp)
trap 'rm -f "$log"' EXIT
quietly() {
  if ! "$@" >"$log" 2>&1; then
    cat "$log" >&2
    echo "viewer: '$*' failed; see above" >&2
    exit 1
  fi
}

scripts/npm_packages.sh
cd web/viewer
if [ -f "../../$page/index.html" ] && [ -z "$(find . ../../$module ../../build/web/svt*.js ../../build/web-sources/components.tsv -path ./node_modules -prune -o -type f -newer "../../$page/index.html" -print -quit)" ]; then
  exit 0
fi
quietly npx --no-install tsc
quietly npx --no-install vite build
touch "../../$page/index.html"
echo "viewer: built in $page"
