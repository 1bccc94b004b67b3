#!/bin/bash -eu
# SPDX-License-Identifier: MIT
#
# Builds a fuzz target, target.cpp of $SRC/project, with terrane::fuzzing from $SRC/terrane. ClusterFuzzLite sets $CXX,
# $CXXFLAGS (with the sanitizers), $LIB_FUZZING_ENGINE, $SRC, $WORK and $OUT.
mkdir -p "$WORK/include"
ln -sfn "$SRC/terrane" "$WORK/include/terrane"
# shellcheck disable=SC2086 # flags are words
$CXX $CXXFLAGS -std=c++20 -I"$WORK/include" "$SRC"/terrane/fuzzing/*.cpp "$SRC/project/target.cpp" \
    $LIB_FUZZING_ENGINE -o "$OUT/target"
printf '[libfuzzer]\nmax_len = 4096\n' >"$OUT/target.options"
