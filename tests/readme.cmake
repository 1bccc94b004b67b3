# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DREADME=... -DEXAMPLE=... -DPROGRAM=... -DDATA=docs/data -P readme.cmake
# Checks that README.md shows exactly the lines of the example between its marks, and then what the program prints.
file(READ ${README} readme)
file(READ ${EXAMPLE} example)
string(REGEX REPLACE "^.*// \\[readme\\]\n(.*)    // \\[readme\\].*$" "\\1" lines "${example}")
string(REPLACE "\n    " "\n" lines "\n${lines}") # removes one level of indentation
string(REGEX REPLACE "^\n" "" lines "${lines}")
execute_process(COMMAND ${PROGRAM} WORKING_DIRECTORY ${DATA} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
set(shown "```cpp\n${lines}```\n\n```text\n${printed}```")
string(FIND "${readme}" "${shown}" place)
if(lines STREQUAL example OR place EQUAL -1)
  message(FATAL_ERROR "README.md does not show exactly these lines:\n${shown}")
endif()
