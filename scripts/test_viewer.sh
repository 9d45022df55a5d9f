#!/usr/bin/env bash
# Tests of the viewer: `units` (state, links, camera) or `page` (the built page in a browser).
# Exits with 77 and the reason if a requirement is missing.
set -euo pipefail
cd "$(dirname "$0")/../web/viewer"
skip() { echo "skipped: $1"; exit 77; }
command -v node >/dev/null || skip "node is missing (scripts/setup.sh web)"
[ -d node_modules/vitest ] || skip "npm packages are missing (make viewer)"
case "${1:-}" in
  units) exec npx --no-install vitest run ;;
  page)
    [ -x "${SVT_CHROMIUM:-/usr/bin/chromium}" ] || skip "chromium is missing (scripts/setup.sh web)"
    [ -f ../../build/release/share/svt/viewer/index.html ] || skip "the page is not built (make viewer)"
    exec node --test --test-reporter=spec e2e/*.test.mjs
    ;;
  *) echo "usage: $0 units|page" >&2; exit 2 ;;
esac
