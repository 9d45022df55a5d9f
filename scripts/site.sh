#!/usr/bin/env bash
# Builds the documentation site into build/site; docs/dev/site.md describes it. Needs the command, the viewer and the Python module
# (`make site` builds them).
#   scripts/site.sh [--repository URL] [--branch NAME]    edit links lead to this repository; without it, no page has one
#   scripts/site.sh --update-pictures                     renews the pictures of docs/tutorials, docs/explanation and docs/gallery.md
set -euo pipefail
cd "$(dirname "$0")/.."
# Files with defaults of the user do not change results.
export PYTHONPATH=scripts PYTHONDONTWRITEBYTECODE=1 SVT_NO_CONFIG=1
# Debian's Python has Debian's MkDocs.
exec /usr/bin/python3 -m docs_site "$@"
