# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DBUILD=... -DEXAMPLE=docs/examples/c -DDATA=docs/data -DWORK=... -DCOMPILER=... [-DTESTS=capi_tests] -P installed.cmake
# Installs the build tree into WORK/prefix, builds the example against it by CMake and by pkg-config, both in C alone,
# and runs it: from the prefix, and after that was moved. TESTS then makes tetrahedra with the moved library, which finds the
# helper program beside it.
function(run out)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${DATA} RESULT_VARIABLE failed OUTPUT_VARIABLE printed
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "failed (${failed}): ${command}\n${printed}")
  endif()
  set(${out} "${printed}" PARENT_SCOPE)
endfunction()

# The program finds the library where LIB says, and lists six blocks.
function(judge program lib)
  set(ENV{LD_LIBRARY_PATH} ${lib})
  run(printed ${program})
  string(REGEX MATCHALL "block [0-9]+, [^\n]*: volume " blocks "${printed}")
  list(LENGTH blocks count)
  if(NOT count EQUAL 6 OR NOT printed MATCHES "is in block 2$")
    message(FATAL_ERROR "${program} printed\n${printed}")
  endif()
  unset(ENV{LD_LIBRARY_PATH})
endfunction()

file(REMOVE_RECURSE ${WORK})
run(none ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
file(GLOB_RECURSE pc ${WORK}/prefix/*/terrane_c.pc)
if(NOT pc)
  message(FATAL_ERROR "terrane_c.pc is not installed")
endif()
cmake_path(GET pc PARENT_PATH pc_folder)
cmake_path(GET pc_folder PARENT_PATH lib)

run(none ${CMAKE_COMMAND} -S ${EXAMPLE} -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=${COMPILER})
run(none ${CMAKE_COMMAND} --build ${WORK}/build)
judge(${WORK}/build/blocks "")

set(ENV{PKG_CONFIG_PATH} ${pc_folder})
run(flags pkg-config --cflags --libs terrane_c)
separate_arguments(flags UNIX_COMMAND "${flags}")
run(none ${COMPILER} -std=c11 -Wall -Wextra -Wpedantic -Werror ${EXAMPLE}/blocks.c ${flags} -o ${WORK}/by_pkg_config)
judge(${WORK}/by_pkg_config ${lib})

file(RENAME ${WORK}/prefix ${WORK}/moved)
string(REPLACE "${WORK}/prefix" "${WORK}/moved" lib ${lib})
judge(${WORK}/by_pkg_config ${lib})
set(ENV{PKG_CONFIG_PATH} ${lib}/pkgconfig)
run(flags pkg-config --cflags terrane_c)
if(NOT flags MATCHES "/moved/")
  message(FATAL_ERROR "pkg-config does not find what was moved: ${flags}")
endif()
if(TESTS)
  unset(ENV{TERRANE_TETGEN})
  set(ENV{LD_LIBRARY_PATH} ${lib})
  run(none /usr/bin/python3 -B ${CMAKE_CURRENT_LIST_DIR}/run.py --program ${WORK}/moved/bin/terrane --tests ${TESTS}
      --data ${DATA} --work ${WORK}/work --tetrahedra project)
endif()
