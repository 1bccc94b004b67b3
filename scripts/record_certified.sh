#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Makes a case for tests/certified, if the verifier accepts the result:
#   scripts/record_certified.sh NAME INPUT...
#   scripts/record_certified.sh --all           records the expected results of all cases again
# BUILD names the build tree (default: build/release).
set -euo pipefail
cd "$(dirname "$0")/.."

certified=${BUILD:-build/release}/tests/certified
cases=tests/certified
if [[ $# -eq 0 || ($1 != --all && $# -lt 2) ]]; then
    sed -n '3,7s/^# \?//p' "$0"
    exit 2
fi
if [[ ! -x $certified ]]; then
    echo "record_certified: build the tests first (no $certified)" >&2
    exit 2
fi

if [[ $1 == --all ]]; then
    failed=0
    for folder in "$cases"/*/; do
        "$certified" record "${folder%/}" || failed=1
    done
    exit "$failed"
fi

name=$1
shift
if [[ -e $cases/$name ]]; then
    echo "record_certified: there is a case $name already" >&2
    exit 2
fi
mkdir "$cases/$name"
if ! { cp -- "$@" "$cases/$name/" && "$certified" record "$cases/$name"; }; then
    rm -r "${cases:?}/$name"
    exit 1
fi
