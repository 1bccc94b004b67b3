# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DREADME=... -DPROJECT=... -P readme_project.cmake
# README.md must show the whole project.
file(READ ${README} readme)
file(READ ${PROJECT} project)
string(FIND "${readme}" "```json\n${project}```" place)
if(project STREQUAL "" OR place EQUAL -1)
  message(FATAL_ERROR "README.md does not show exactly this project:\n${project}")
endif()
