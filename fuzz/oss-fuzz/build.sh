#!/bin/bash -eu
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Builds all fuzz targets into $OUT, with seeds, dictionaries and options, as OSS-Fuzz requires:
# with $CC, $CXX, $CFLAGS, $CXXFLAGS (which contain the sanitizers) and $LIB_FUZZING_ENGINE. The
# sources are in $SRC/terrane; dependencies that are not in $SRC come from the system.
# TetGen is left out, since it is slow and its bugs are not ours.

work=${WORK:-$SRC/work}
prefix=$work/prefix
mkdir -p "$work/static" "$OUT"

# dependency NAME OPTION...
dependency() {
    [[ -d $SRC/$1 ]] || return 0
    cmake -S "$SRC/$1" -B "$work/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DBUILD_SHARED_LIBS=OFF -DCMAKE_INSTALL_PREFIX="$prefix" "${@:2}"
    cmake --build "$work/$1" --target install
}
dependency oneTBB -DTBB_TEST=OFF -DTBB_STRICT=OFF
dependency fmt -DFMT_TEST=OFF -DFMT_DOC=OFF

# This folder has only archives and is searched first, so that -lgmp is the static library.
for library in gmp gmpxx mpfr nettle z; do
    archive=$("$CC" -print-file-name="lib$library.a")
    [[ -e $archive ]] && ln -sf "$archive" "$work/static/"
done

options=()
[[ -d $SRC/cgal ]] && options+=(-DCGAL_DIR="$SRC/cgal")
cmake -S "$SRC/terrane" -B "$work/terrane" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE= -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_EXE_LINKER_FLAGS="-L$work/static" -DTERRANE_FUZZ=ON \
    -DTERRANE_FUZZ_ENGINE="$LIB_FUZZING_ENGINE" -DTERRANE_TESTS=OFF -DTERRANE_TETGEN=OFF \
    -DTERRANE_WERROR=OFF -DZLIB_LIBRARY="$work/static/libz.a" \
    -DGMP_LIBRARIES="$work/static/libgmp.a" -DGMPXX_LIBRARIES="$work/static/libgmpxx.a" \
    -DMPFR_LIBRARIES="$work/static/libmpfr.a" \
    -DNETTLE_LIBRARY="$work/static/libnettle.a" "${options[@]}"
cmake --build "$work/terrane" --target fuzzers

fuzz=$SRC/terrane/fuzz
for binary in "$work"/terrane/fuzz/fuzz_*; do
    [[ -f $binary && -x $binary ]] || continue
    name=${binary##*/} target=${binary##*/fuzz_} length=400
    [[ $target == read_* || $target == forge_arrangement || $target == pieces ]] && length=4096
    [[ ! -e ${binary%/*}/minimise_$target ]] || length=1500 # literal meshes
    cp "$binary" "$OUT/"
    zip -qj "$OUT/${name}_seed_corpus.zip" "$fuzz/corpus/$target"/*
    printf '[libfuzzer]\nmax_len = %d\n' "$length" >"$OUT/$name.options"
    dictionary=$fuzz/dictionaries/${target#read_}.dict
    [[ ! -e $dictionary ]] || cp "$dictionary" "$OUT/$name.dict"
done
