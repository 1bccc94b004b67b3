# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DBUILD=... -DSOURCE=... -DWORK=... -DTETGEN=... -DCOMPILER=... -DSANITIZE=... -P run.cmake
# Installs the build tree into WORK/prefix; configures, builds and runs the consumer against it.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed)
  if(failed)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "failed (${failed}): ${command}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
set(flags)
if(SANITIZE)
  set(flags "-DCMAKE_CXX_FLAGS=-fsanitize=address,undefined")
endif()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
file(GLOB licences ${WORK}/prefix/share/doc/*/LICENSES/LGPL-3.0-or-later.txt)
if(NOT licences)
  message(FATAL_ERROR "the text of the licence is not installed")
endif()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${COMPILER} -DWITH_TETGEN=${TETGEN} ${flags})
run(${CMAKE_COMMAND} --build ${WORK}/build)
# The installed programs find each other wherever they are: what was installed is moved first.
file(RENAME ${WORK}/prefix ${WORK}/moved)
file(GLOB program ${WORK}/moved/bin/terrane)
if(program AND TETGEN)
  run(${program} tetrahedralize ${SOURCE}/../data/arrangements/three_cubes.stl -o ${WORK}/cubes.vtu)
endif()
file(RENAME ${WORK}/moved ${WORK}/prefix)
run(${WORK}/build/consumer)
