#!/usr/bin/env bash
# Tests the built documentation site (`make site`): every link and anchor, then the pages in a browser (tests/site).
#   SVT_SITE_PAGES=REGEX     only pages whose address matches, in the browser
#   SVT_SITE_PICTURES=DIR    also keeps pictures of the live views of the gallery
set -euo pipefail
cd "$(dirname "$0")/.."
[ -f build/site/index.html ] || { echo "test_site: build/site is missing; 'make site' builds it" >&2; exit 1; }
[ -x "${SVT_CHROMIUM:-/usr/bin/chromium-headless-shell}" ] || { echo "test_site: chromium is missing; 'scripts/setup.sh web' installs it" >&2; exit 1; }
[ -d web/viewer/node_modules/axe-core ] || { echo "test_site: npm packages are missing; 'make viewer' installs them" >&2; exit 1; }
scripts/check_site_links.py build/site
exec node --test --test-reporter=spec tests/site/site.test.mjs
