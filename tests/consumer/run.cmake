# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DBUILD=... -DSOURCE=... -DWORK=... -DTETGEN=... -DCOMPILER=... -P run.cmake
# Installs the build tree into WORK/prefix; then configures, builds and runs the consumer against it, with the
# library's compiler and, if installed, with the other one of gcc and clang. The first build has all C and C++ of the
# documentation.
# Then a project fuzzes its own engine with terrane::fuzzing.
# At last it does what README.md says: the programs there print what it shows.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed)
  if(failed)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "failed (${failed}): ${command}")
  endif()
endfunction()

# Checks the files from which the consumer was compiled: Terrane's are installed ones, and none belongs to a
# library that Terrane uses inside. (libstdc++ asks whether tbb/tbb.h exists, which clang lists; a file that
# includes it would list oneapi/tbb as well.)
function(judge_dependencies build)
  execute_process(COMMAND ninja -C ${build} -t deps OUTPUT_VARIABLE files RESULT_VARIABLE failed)
  if(failed OR NOT files MATCHES "prefix/include/terrane/advanced.hpp")
    message(FATAL_ERROR "ninja does not say what the consumer was compiled from: ${files}")
  endif()
  string(REGEX MATCHALL "[^\n]*(CGAL|boost|[Ee]igen3?/|gmp(xx)?\\.h|mpfr\\.h|oneapi/tbb|fmt/|nlohmann|nettle|tetgen\\.h)[^\n]*"
         strange "${files}")
  if(strange)
    message(FATAL_ERROR "installed headers include ${strange}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
set(compilers ${COMPILER})
if(COMPILER MATCHES "clang")
  find_program(other NAMES g++)
else()
  find_program(other NAMES clang++-14 clang++)
endif()
if(other)
  list(APPEND compilers ${other})
endif()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
file(GLOB licences ${WORK}/prefix/share/doc/*/LICENSES/LGPL-3.0-or-later.txt)
if(NOT licences)
  message(FATAL_ERROR "the text of the licence is not installed")
endif()
run(/usr/bin/python3 -B ${SOURCE}/snippets.py ${WORK})
file(GLOB cases ${SOURCE}/../corpus/cubes-cross-at-a-corner* ${SOURCE}/../corpus/wall-ends-in-a-square*)
file(COPY ${cases} DESTINATION ${WORK}/cases)
set(snippets ${WORK}/snippets)
foreach(compiler IN LISTS compilers)
  cmake_path(GET compiler FILENAME name)
  set(build ${WORK}/build-${name})
  run(${CMAKE_COMMAND} -S ${SOURCE} -B ${build} -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${compiler} -DWITH_TETGEN=${TETGEN} -DSNIPPETS=${snippets}
      -DCASES=${WORK}/cases)
  set(snippets "")
  run(${CMAKE_COMMAND} --build ${build})
  judge_dependencies(${build})
  run(${build}/consumer)
endforeach()

# A project that fuzzes its own engine. Meshes are counted, so that the load of the machine does not matter;
# scripts/nightly.sh tries more.
list(POP_BACK compilers compiler) # clang, if it is installed
run(${CMAKE_COMMAND} -S ${SOURCE}/fuzzing -B ${WORK}/fuzzing -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${compiler})
run(${CMAKE_COMMAND} --build ${WORK}/fuzzing)
execute_process(COMMAND ninja -C ${WORK}/fuzzing -t deps CMakeFiles/alone.dir/alone.cpp.o OUTPUT_VARIABLE files
                COMMAND_ERROR_IS_FATAL ANY)
if(NOT files MATCHES "terrane/fuzzing/meshes.hpp" OR files MATCHES "terrane/(kernel|algorithms|io)/")
  message(FATAL_ERROR "terrane::fuzzing is compiled from ${files}")
endif()
run(${WORK}/fuzzing/alone)
run(${WORK}/fuzzing/fuzz_engine 10000)
if(EXISTS ${WORK}/fuzzing/libfuzzer_engine)
  execute_process(COMMAND ${WORK}/fuzzing/libfuzzer_engine -seed=1 -runs=20000 -max_len=4096
                  WORKING_DIRECTORY ${WORK}/fuzzing OUTPUT_VARIABLE printed ERROR_QUIET)
  if(NOT printed MATCHES "misses a pair.*2 triangles")
    message(FATAL_ERROR "libFuzzer does not find the planted bug: ${printed}")
  endif()
endif()
run(${CMAKE_CTEST_COMMAND} --test-dir ${build} -E union)
execute_process(COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${build} -R union OUTPUT_VARIABLE printed)
if(NOT printed MATCHES "0% tests passed, 1 tests failed out of 1")
  message(FATAL_ERROR "a wrong union is accepted: ${printed}")
endif()

# Runs a program of README.md, which is next to the three files that it reads.
function(run_of_readme program)
  execute_process(COMMAND ${program} WORKING_DIRECTORY ${SOURCE}/../../docs/data OUTPUT_VARIABLE printed
                  COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${SOURCE}/../../README.md readme)
  string(FIND "${readme}" "```text\n${printed}```" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "README.md does not show that ${program} prints\n${printed}")
  endif()
endfunction()

run(${CMAKE_COMMAND} -S ${WORK}/readme -B ${WORK}/readme/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${WORK}/readme/build)
run_of_readme(${WORK}/readme/build/blocks)
file(GLOB_RECURSE package ${WORK}/prefix/lib/*/terrane_c.pc)
if(package)
  cmake_path(GET package PARENT_PATH folder)
  cmake_path(GET folder PARENT_PATH folder)
  run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder}/pkgconfig sh -c
      "cd ${WORK}/readme && cc blocks.c $(pkg-config --cflags --libs terrane_c) -Wl,-rpath,${folder} -o blocks")
  run_of_readme(${WORK}/readme/blocks)
endif()
# The installed programs find each other after the installation is moved.
file(RENAME ${WORK}/prefix ${WORK}/moved)
file(GLOB program ${WORK}/moved/bin/terrane)
if(program AND TETGEN)
  run(${program} tetrahedralize ${SOURCE}/../data/arrangements/three_cubes.stl -o ${WORK}/cubes.vtu)
endif()
