# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DREADME=... -DEXAMPLE=... -P readme.cmake
# Checks that README.md shows exactly the lines of the example between its marks.
file(READ ${README} readme)
file(READ ${EXAMPLE} example)
string(REGEX REPLACE "^.*// \\[readme\\]\n(.*)    // \\[readme\\].*$" "\\1" lines "${example}")
string(REPLACE "\n    " "\n" lines "\n${lines}") # removes one level of indentation
string(REGEX REPLACE "^\n" "" lines "${lines}")
string(FIND "${readme}" "```cpp\n${lines}```" place)
if(lines STREQUAL example OR place EQUAL -1)
  message(FATAL_ERROR "README.md does not show exactly these lines:\n${lines}")
endif()
