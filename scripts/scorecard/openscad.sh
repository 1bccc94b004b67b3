#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# OpenSCAD for the score card: openscad.sh OPERATION OUTPUT.off INPUT.off ...
set -euo pipefail
operation=$1 output=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
{
    echo "$operation() {"
    printf 'import("%s");\n' "$@"
    echo "}"
} >"$work/body.scad"
status=0
openscad -o "$output" "$work/body.scad" 2>"$work/log" || status=$?
if grep -q "Current top level object is empty" "$work/log"; then
    printf 'OFF\n0 0 0\n' >"$output"
    exit
fi
cat "$work/log"
exit "$status"
