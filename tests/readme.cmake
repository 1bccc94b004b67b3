# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DREADME=... -DEXAMPLE=... -P readme.cmake
# README.md must show the lines of the example that stand between its marks, and nothing else of it.
file(READ ${README} readme)
file(READ ${EXAMPLE} example)
string(REGEX REPLACE "^.*// \\[readme\\]\n(.*)    // \\[readme\\].*$" "\\1" lines "${example}")
string(REPLACE "\n    " "\n" lines "\n${lines}") # one level of indentation goes
string(REGEX REPLACE "^\n" "" lines "${lines}")
string(FIND "${readme}" "```cpp\n${lines}```" place)
if(lines STREQUAL example OR place EQUAL -1)
  message(FATAL_ERROR "README.md does not show exactly these lines:\n${lines}")
endif()
