# SPDX-License-Identifier: LGPL-3.0-or-later
# Configures the project with its tests but without TetGen, and without report pages, whose source is made while building,
# and checks that no source that is compiled then includes TetGen's header, or the header with tests of filled
# meshes. Nothing is built.
#   cmake -DSOURCE=... -DWORK=... -DCOMPILER=... -P without_tetgen.cmake
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK} -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER}
                -DTERRANE_TETGEN=OFF -DTERRANE_REPORT=OFF -DTERRANE_TESTS=ON
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(READ ${WORK}/compile_commands.json commands)
string(REGEX MATCHALL "\"file\": \"[^\"]+\"" files "${commands}")
list(TRANSFORM files REPLACE "\"file\": \"([^\"]+)\"" "\\1")
list(LENGTH files count)
if(count LESS 300)
  message(FATAL_ERROR "only ${count} sources: the tests are missing")
endif()
set(found)
foreach(file IN LISTS files)
  file(STRINGS ${file} includes REGEX "^#include (<tetgen.h>|\"support/(filled|impostor|tetgen_cases).hpp\")")
  if(includes)
    list(APPEND found ${file})
  endif()
endforeach()
if(found)
  message(FATAL_ERROR "compiled without TetGen, but these need it: ${found}")
endif()
message(STATUS "none of ${count} sources needs TetGen")
