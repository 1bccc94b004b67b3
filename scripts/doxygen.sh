#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# scripts/doxygen.sh FOLDER: makes the reference of the declarations in FOLDER/api from the public headers.
set -euo pipefail
folder=$(realpath "$1")
cd "$(dirname "$0")/.."
headers=$(sed -n 's,^#include <terrane/\(.*\)>,\1,p' terrane.hpp advanced.hpp)
{
    cat scripts/Doxyfile
    echo INPUT = advanced.hpp $headers
    echo "OUTPUT_DIRECTORY = $folder"
} | doxygen -
