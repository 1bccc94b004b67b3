# SPDX-License-Identifier: LGPL-3.0-or-later
# The public headers, which are installed, by library: terrane.hpp, advanced.hpp and what they include.
# tests/test_include_order.cpp says what these may include.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS terrane.hpp advanced.hpp)
file(STRINGS terrane.hpp terrane_headers REGEX "^#include <terrane/")
file(STRINGS advanced.hpp advanced_headers REGEX "^#include <terrane/")
list(APPEND terrane_headers ${advanced_headers})
list(TRANSFORM terrane_headers REPLACE "^#include <terrane/(.*)>$" "\\1")
set(verify_headers ${terrane_headers})
list(FILTER verify_headers INCLUDE REGEX "^algorithms/verify/")
list(FILTER terrane_headers EXCLUDE REGEX "^algorithms/verify/")
list(APPEND terrane_headers advanced.hpp)
set(fuzzing_headers fuzzing/files.hpp fuzzing/meshes.hpp fuzzing/minimise.hpp fuzzing/mutate.hpp)
# The C interface. terrane.h includes the others.
set(terrane_c_headers
    terrane.h
    capi/arrangement.h
    capi/base.h
    capi/certificate.h
    capi/mesh.h
    capi/model.h
    capi/project.h
    capi/reconstruction.h
    capi/sealing.h
    capi/selection.h
    capi/structure.h
    capi/surfaces.h
    capi/tetrahedra.h
    capi/verification.h)
