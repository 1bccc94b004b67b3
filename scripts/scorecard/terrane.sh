#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Terrane for the score card: terrane.sh PROGRAM OPERATION OUTPUT.off INPUT.off ...
set -euo pipefail
program=$1 operation=$2 output=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
if [[ $operation == arrangement ]]; then
    "$program" arrange "$@" -o "$output" --stats "$work/stats.json" --quiet || status=$?
else
    declare -A operators=([union]='|' [intersection]='&' [difference]='-')
    expression=
    for input in "$@"; do # a surface of an OFF file has the name of the file
        name=${input##*/}
        expression+="${expression:+ ${operators[$operation]} }\"${name%.off}\""
    done
    "$program" select "$expression" "$@" -o "$output" --stats "$work/stats.json" 2>"$work/errors" >"$work/said" || status=$?
    cat "$work/said" "$work/errors"
    if [[ $status == 1 ]] && grep -q "^region: empty" "$work/said"; then
        printf 'OFF\n0 0 0\n' >"$output"
        exit
    fi
fi
# The seconds of all stages without those of files.
sed -n '/^  "seconds"/,/^  }/s/^    "\(total\|read\|write\)": \([^,]*\),\?$/\1 \2/p' "$work/stats.json" |
    awk '{ s += $1 == "total" ? $2 : -$2 } END { if (NR) printf "operation: %.6f s\n", s }'
exit "$status"
