#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Measures the time from a clone to the first picture of somebody who has the packages of scripts/setup.sh:
#   scripts/first_plot.sh [REPOSITORY]
# It clones REPOSITORY (this one, unless given) into a folder for temporary files, builds the Python package without the
# compiler's cache, and runs the first model of docs/how-to/python.md, whose page model.html is the picture. Prints wall
# and CPU seconds of each step; wall seconds need an idle machine.
set -euo pipefail
repository=$(cd "${1:-$(dirname "$0")/..}" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export CCACHE_DISABLE=1

step() { # step NAME COMMAND...
    local name=$1
    shift
    local TIMEFORMAT="$name: %R s, %U + %S CPU s"
    time "$@" >"$folder/log" 2>&1 || { tail -n 20 "$folder/log"; exit 1; }
}

step "clone" git clone "$repository" terrane
cd terrane
step "configure" cmake --preset release -DTERRANE_TESTS=OFF
step "build" cmake --build --preset release --target terrane_python
# The page's first example, with the picture after it.
awk '/^```python/ && !done { inside = 1; next } /^```/ && inside { inside = 0; done = 1 } inside' docs/how-to/python.md >first.py
echo 'model.report("model.html")' >>first.py
PYTHONPATH=$PWD/build/release/python step "first model and its picture" /usr/bin/python3 first.py
ls -l model.html | awk '{ print $5 " bytes: " $9 }'
