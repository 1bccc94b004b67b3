# SPDX-License-Identifier: LGPL-3.0-or-later
#
# cmake -DSOURCE=... -DWORK=... -P without.cmake: where npm is missing, or TERRANE_REPORT is off, page.cmake says so in one
# line and chooses the source without a page.
foreach(reason "npm was not found" "TERRANE_REPORT is off")
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(without LANGUAGES NONE)
set(PROJECT_SOURCE_DIR ${SOURCE})
include(${SOURCE}/scripts/cmake/page.cmake)
file(READ \${page_source} text)
if(NOT page_missing OR NOT text MATCHES \"return nullptr\" OR NOT text MATCHES \"return .\${page_missing}\")
  message(FATAL_ERROR \"there is a page\")
endif()
")
  set(on ON)
  if(reason MATCHES off)
    set(on OFF)
  endif()
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK} -B ${WORK}/build -DTERRANE_REPORT=${on}
                          -DCMAKE_MAKE_PROGRAM=${CMAKE_COMMAND} -DCMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF -DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF
                  RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE error)
  if(failed OR NOT said MATCHES "-- ${reason}: no report pages")
    message(FATAL_ERROR "${reason} is not said: ${said}${error}")
  endif()
endforeach()
