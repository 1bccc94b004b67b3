#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Builds the site of the documentation in out/site. It needs Debian's package mkdocs, which
# scripts/setup.sh does not install: building and testing Terrane works without it.
set -euo pipefail
cd "$(dirname "$0")/.."

command -v mkdocs >/dev/null || {
    echo "docs: mkdocs is missing: apt-get install --no-install-recommends mkdocs" >&2
    exit 1
}
mkdocs build --strict --quiet
echo "docs: open out/site/index.html"
