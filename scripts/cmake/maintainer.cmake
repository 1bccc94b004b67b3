# SPDX-License-Identifier: LGPL-3.0-or-later
# cpack reads this first. Debian demands an address at which somebody answers for a package, and none is made up.
if(CPACK_GENERATOR STREQUAL DEB AND NOT CPACK_PACKAGE_CONTACT MATCHES "^[^<>]+ <[^<>@ ]+@[^<>@ ]+>$")
  message(FATAL_ERROR "packages need who answers for them: configure with -DTERRANE_MAINTAINER=\"NAME <ADDRESS>\""
                      " (now: \"${CPACK_PACKAGE_CONTACT}\")")
endif()
