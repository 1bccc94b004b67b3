# SPDX-License-Identifier: LGPL-3.0-or-later
vcpkg_download_distfile(ARCHIVE
    URLS "@URL@"
    FILENAME "terrane-${VERSION}.tar.gz"
    SHA512 @SHA512@
)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${ARCHIVE}")

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS
    FEATURES
        c        TERRANE_C
        shapelib TERRANE_SHAPELIB
        tools    TERRANE_PROGRAM
)

# The library is static; the C interface is a shared library in any triplet. TetGen (AGPL) and Gmsh (GPL) are
# left out: terrane-tetgen is looked for when tetrahedra are made.
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        ${FEATURE_OPTIONS}
        -DBUILD_SHARED_LIBS=OFF
        -DTERRANE_GMSH=OFF
        -DTERRANE_LZ4=OFF
        -DTERRANE_LZMA=OFF
        -DTERRANE_TESTS=OFF
        -DTERRANE_TETGEN=OFF
        -DTERRANE_UNITY=ON
        -DTERRANE_WERROR=OFF
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/terrane)
if("c" IN_LIST FEATURES)
    vcpkg_fixup_pkgconfig()
endif()
if("tools" IN_LIST FEATURES)
    vcpkg_copy_tools(TOOL_NAMES terrane AUTO_CLEAN)
endif()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST
    "${SOURCE_PATH}/LICENSE"
    "${SOURCE_PATH}/LICENSES/GPL-3.0-or-later.txt"
)
