# SPDX-License-Identifier: LGPL-3.0-or-later
# Debian packages: cpack -G DEB in the build tree of the preset package (scripts/packages.sh does all of it).
# There is one package per component of installation; python3-terrane appears where there is a component python.
set(TERRANE_MAINTAINER "" CACHE STRING
    "\"NAME <ADDRESS>\" of who answers for Debian packages; cpack makes none without it")
set(TERRANE_DEBIAN_REVISION 1 CACHE STRING "Debian revision of the packages")
get_cmake_property(installed_components COMPONENTS) # before those of this file
set(debian_folder ${PROJECT_SOURCE_DIR}/scripts/packaging/debian)
set(debian_version ${PROJECT_VERSION}-${TERRANE_DEBIAN_REVISION})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME terrane)
set(CPACK_PACKAGE_VENDOR Terrane)
set(CPACK_PACKAGE_CONTACT "${TERRANE_MAINTAINER}")
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/maintainer.cmake) # refuses packages that name nobody
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${TERRANE_DEBIAN_REVISION})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

function(terrane_gzip text name) # as Debian wants it: best compression, no name and time
  file(WRITE ${PROJECT_BINARY_DIR}/debian/${name} "${text}")
  execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/debian/${name} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# What every package has in /usr/share/doc: changelogs and copyright. A plain installation does not get them.
string(TIMESTAMP debian_year %Y UTC)
string(TIMESTAMP debian_date "%a, %d %b %Y %H:%M:%S +0000" UTC) # SOURCE_DATE_EPOCH counts
terrane_gzip("terrane (${debian_version}) unstable; urgency=medium

  * Version ${PROJECT_VERSION}; changelog.gz lists the changes.

 -- ${TERRANE_MAINTAINER}  ${debian_date}
" changelog.Debian)
file(READ CHANGELOG.md changes)
string(REPLACE ";" "\;" changes "${changes}")
terrane_gzip("${changes}" changelog)

function(terrane_licence_text out name file) # a paragraph of a copyright file with the whole text
  file(READ ${file} text)
  string(REGEX REPLACE "\n\n" "\n.\n" text "${text}")
  string(REGEX REPLACE "\n\n" "\n.\n" text "${text}")
  string(REGEX REPLACE "\n" "\n " text "${text}")
  string(STRIP "${text}" text)
  set(${out} "\nLicense: ${name}\n ${text}" PARENT_SCOPE)
endfunction()

# terrane_package(COMPONENT PACKAGE SECTION LICENCE SUMMARY DESCRIPTION [FIELD VALUE]...) describes a package. LICENCE
# is the name in its copyright file. Fields are those of CPack, as DEPENDS; CONTROL_EXTRA has several values.
function(terrane_package component package section licence summary description)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${description}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${description}" PARENT_SCOPE)
  set(fields DEPENDS RECOMMENDS SUGGESTS ENHANCES MULTIARCH)
  cmake_parse_arguments(PARSE_ARGV 6 arg "" "${fields}" CONTROL_EXTRA)
  foreach(field IN LISTS fields)
    if(arg_${field})
      set(CPACK_DEBIAN_${upper}_PACKAGE_${field} "${arg_${field}}" PARENT_SCOPE)
    endif()
  endforeach()
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA "${arg_CONTROL_EXTRA}" PARENT_SCOPE)
  set(package_licence ${licence})
  set(package_comment "This is the package ${package}.")
  set(more_licences)
  set(package_files)
  if(component STREQUAL "dev") # which has terrane::fuzzing
    set(package_files "\nFiles: fuzzing/*\nCopyright: ${debian_year}, the authors of Terrane\nLicense: Expat\n")
    terrane_licence_text(more_licences Expat ${PROJECT_SOURCE_DIR}/LICENSES/MIT.txt)
  endif()
  if(licence STREQUAL "AGPL-3+")
    set(package_comment "The sources are LGPL-3+; the program is linked with TetGen, and AGPL-3+ as a whole.")
    terrane_licence_text(more_licences AGPL-3+ ${PROJECT_SOURCE_DIR}/LICENSES/AGPL-3.0-or-later.txt)
  elseif(licence STREQUAL "GPL-3+")
    set(package_comment "The sources are LGPL-3+; the program is linked with Gmsh, and GPL-3+ as a whole.")
    set(more_licences "\nLicense: GPL-3+\n On Debian systems, the full text of the GNU General Public License\
 version 3 is in the file\n /usr/share/common-licenses/GPL-3.")
  endif()
  configure_file(${debian_folder}/copyright.in ${PROJECT_BINARY_DIR}/debian/${package}/copyright @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/debian/${package}/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz
                ${PROJECT_BINARY_DIR}/debian/changelog.Debian.gz
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

set(what "Terrane turns geological surfaces as they come (open, crossing, overlapping,
holed horizons and faults) into one conforming mesh, the blocks that they
bound, and tetrahedra, with exact arithmetic.")
set(c_abi 1)
if(TARGET terrane_c)
  get_target_property(c_abi terrane_c SOVERSION)
endif()
set(c_package libterrane-c${c_abi})
file(WRITE ${PROJECT_BINARY_DIR}/debian/shlibs "libterrane_c ${c_abi} ${c_package} (>= ${PROJECT_VERSION})\n")
file(WRITE ${PROJECT_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
terrane_package(library ${c_package} libs LGPL-3+ "exact meshes of geological surfaces - C interface"
    "${what}\n.\nThis package has the shared library with the C interface, for C and other\nlanguages." MULTIARCH same
    CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/shlibs ${PROJECT_BINARY_DIR}/debian/triggers)
terrane_package(dev libterrane-dev libdevel LGPL-3+ "exact meshes of geological surfaces - development files"
    "${what}\n.\nThis package has the headers of the C and C++ interfaces, the static\nlibraries and the CMake files."
    DEPENDS "${c_package} (= ${debian_version}), libfmt-dev, libgmp-dev, liblz4-dev, liblzma-dev, libmpfr-dev, libpugixml-dev, libshp-dev, libtbb-dev, nettle-dev, zlib1g-dev"
    RECOMMENDS terrane-tetgen)
terrane_package(program terrane science LGPL-3+ "exact meshes of geological surfaces - program"
    "${what}\n.\nThis package has the program." RECOMMENDS terrane-tetgen
    SUGGESTS "terrane-gmsh, terrane-mpi")
terrane_package(mpi terrane-mpi science LGPL-3+ "exact meshes of geological surfaces - many machines"
    "${what}\n.\nThis package has the program for one model on many machines, by MPI." RECOMMENDS terrane SUGGESTS openmpi-bin)
terrane_package(tetgen terrane-tetgen science AGPL-3+ "exact meshes of geological surfaces - tetrahedra by TetGen"
    "${what}\n.\nThis package has the helper program that makes tetrahedra by TetGen." ENHANCES "terrane, ${c_package}")
terrane_package(gmsh terrane-gmsh science GPL-3+ "exact meshes of geological surfaces - tetrahedra by Gmsh"
    "${what}\n.\nThis package has the helper program that makes tetrahedra by Gmsh." ENHANCES "terrane, ${c_package}")
# Python's compiled files come and go with the package, as dh_python3 has it.
file(WRITE ${PROJECT_BINARY_DIR}/debian/python/postinst "#!/bin/sh
set -e
if [ \"$1\" = configure ] && command -v py3compile >/dev/null 2>&1; then
    py3compile -p python3-terrane
fi
")
file(WRITE ${PROJECT_BINARY_DIR}/debian/python/prerm "#!/bin/sh
set -e
if command -v py3clean >/dev/null 2>&1; then
    py3clean -p python3-terrane
fi
")
file(CHMOD ${PROJECT_BINARY_DIR}/debian/python/postinst ${PROJECT_BINARY_DIR}/debian/python/prerm
     PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
terrane_package(python python3-terrane python LGPL-3+ "exact meshes of geological surfaces - Python package"
    "${what}\n.\nThis package has the module terrane for Python 3." DEPENDS "python3, python3-numpy"
    SUGGESTS "terrane-tetgen, python3-meshio, python3-distributed, python3-h5py"
    CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/python/postinst ${PROJECT_BINARY_DIR}/debian/python/prerm)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/scripts/cmake/compress_pages.cmake)

# Packages of what this build has.
set(CPACK_COMPONENTS_ALL dev)
foreach(pair library:terrane_c program:terrane_program mpi:terrane_mpi tetgen:terrane_tetgen_helper gmsh:terrane_gmsh_helper)
  string(REPLACE ":" ";" pair ${pair})
  list(POP_FRONT pair component target)
  if(TARGET ${target})
    list(APPEND CPACK_COMPONENTS_ALL ${component})
  endif()
endforeach()
if(python IN_LIST installed_components)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
include(CPack)
