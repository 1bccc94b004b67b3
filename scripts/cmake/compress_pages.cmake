# SPDX-License-Identifier: LGPL-3.0-or-later
# CPack includes this before it makes packages: it compresses the manual pages in them, as Debian wants it.
file(GLOB_RECURSE manual_pages LIST_DIRECTORIES false "${CPACK_TEMPORARY_DIRECTORY}/*.1")
list(FILTER manual_pages INCLUDE REGEX "/share/man/man1/[^/]+$")
foreach(page IN LISTS manual_pages)
  execute_process(COMMAND gzip -9nf ${page} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
