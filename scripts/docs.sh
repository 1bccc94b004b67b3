#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Builds the site of the documentation in out/site, and with Doxygen the reference of declarations in
# out/site/api. It needs Debian's packages mkdocs and doxygen, which scripts/setup.sh does not
# install: building and testing Terrane works without them.
set -euo pipefail
cd "$(dirname "$0")/.."

command -v mkdocs >/dev/null || {
    echo "docs: mkdocs is missing: apt-get install --no-install-recommends mkdocs" >&2
    exit 1
}
mkdocs build --strict --quiet
if command -v doxygen >/dev/null; then
    scripts/doxygen.sh out # warnings are errors
    rm -rf out/site/api
    mv out/api out/site/api
else
    echo "docs: without doxygen there is no reference of declarations" >&2
fi
echo "docs: open out/site/index.html"
