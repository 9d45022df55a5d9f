#!/usr/bin/env bash
# Installs the npm packages of the page, and of what checks it, where they are missing or older than the lock file.
set -euo pipefail
cd "$(dirname "$0")/../web/viewer"
command -v npm >/dev/null || { echo "npm: npm is missing; scripts/setup.sh node installs it" >&2; exit 1; }
lock=node_modules/.package-lock.json
[ -f "$lock" ] && [ ! package-lock.json -nt "$lock" ] && exit 0
echo "npm: installing the packages of web/viewer"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
npm ci --no-audit --no-fund --ignore-scripts >"$log" 2>&1 || { cat "$log" >&2; echo "npm: 'npm ci' failed; see above" >&2; exit 1; }
touch "$lock"
