# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Bundles the report page (cli/page/web) with npm's packages and sets page_source to the C++ file that holds it.
# Without Node.js, npm or the packages, page_source is a file without a page, and the program says so.
set(page_packages ${PROJECT_BINARY_DIR}/page)
set(page_web ${PROJECT_SOURCE_DIR}/cli/page/web)
set(page_missing "")
if(NOT TERRANE_REPORT)
  set(page_missing "TERRANE_REPORT is off")
else()
  find_program(NODE_PROGRAM node)
  find_program(NPM_PROGRAM npm)
  if(NOT NODE_PROGRAM OR NOT NPM_PROGRAM)
    set(page_missing "npm was not found")
  endif()
endif()

# The packages of the lock file are installed once.
if(NOT page_missing)
  file(SHA256 ${page_web}/package-lock.json page_lock)
  set(page_installed "")
  if(EXISTS ${page_packages}/installed)
    file(READ ${page_packages}/installed page_installed)
  endif()
  if(NOT page_installed STREQUAL page_lock)
    file(MAKE_DIRECTORY ${page_packages})
    file(COPY ${page_web}/package.json ${page_web}/package-lock.json ${page_web}/tsconfig.json DESTINATION ${page_packages})
    execute_process(COMMAND ${NPM_PROGRAM} ci --ignore-scripts --no-audit --no-fund WORKING_DIRECTORY ${page_packages}
                    RESULT_VARIABLE page_failed OUTPUT_QUIET ERROR_QUIET)
    if(page_failed)
      set(page_missing "npm could not install the packages of cli/page/web")
    else()
      file(WRITE ${page_packages}/installed ${page_lock})
    endif()
  endif()
endif()

if(page_missing)
  message(STATUS "${page_missing}: no report pages (terrane report, --report)")
  set(page_source ${PROJECT_BINARY_DIR}/no_page.cpp)
  configure_file(${PROJECT_SOURCE_DIR}/cli/page/no_bundle.cpp.in ${page_source} COPYONLY)
else()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page_web}/package-lock.json)
  file(GLOB page_sources CONFIGURE_DEPENDS ${page_web}/src/*)
  set(page_source ${PROJECT_BINARY_DIR}/page_bundle.cpp)
  add_custom_command(
    OUTPUT ${page_source}
    COMMAND ${NODE_PROGRAM} ${page_web}/build.mjs ${page_packages} ${page_web} ${page_source}
            ${page_packages}/page.js ${page_packages}/page.css
    DEPENDS ${page_sources} ${page_web}/build.mjs ${page_packages}/installed
    COMMENT "Bundling the report page" VERBATIM)
endif()
