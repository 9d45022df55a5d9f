#!/usr/bin/env bash
# Tests of the viewer: `units` (state, links, camera) or `page TOPIC...` (the built page in a browser: e2e/TOPIC.test.mjs).
# Topics can run side by side: each has its own servers, browser and folders. Exits with 77 and the reason if a
# requirement is missing.
set -euo pipefail
cd "$(dirname "$0")/../web/viewer"
skip() { echo "skipped: $1"; exit 77; }
command -v node >/dev/null || skip "node is missing (scripts/setup.sh web)"
[ -d node_modules/vitest ] || skip "npm packages are missing (make viewer)"
what=${1:-}
case $what in
  units) exec npx --no-install vitest run ;;
  page)
    shift
    [ -x "${SVT_CHROMIUM:-/usr/bin/chromium-headless-shell}" ] || skip "chromium is missing (scripts/setup.sh web)"
    [ -f ../../build/release/share/svt/viewer/index.html ] || skip "the page is not built (make viewer)"
    tests=("${@/%/.test.mjs}")
    [ $# -gt 0 ] || mapfile -t tests < <(cd e2e && ls -- *.test.mjs)
    exec node --test --test-reporter=spec "${tests[@]/#/e2e/}"
    ;;
  *) echo "usage: $0 units | page [TOPIC...]" >&2; exit 2 ;;
esac
