#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
set -euo pipefail

# TetGen and Gmsh, whose licences are the AGPL and the GPL, are left out.
cmake -G Ninja -S . -B build ${CMAKE_ARGS} \
    -DCMAKE_BUILD_TYPE=Release \
    -DTERRANE_TETGEN=OFF \
    -DTERRANE_GMSH=OFF \
    -DTERRANE_TESTS=OFF \
    -DTERRANE_WERROR=OFF \
    -DTERRANE_UNITY=ON
cmake --build build
cmake --install build
