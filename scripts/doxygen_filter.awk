# SPDX-License-Identifier: LGPL-3.0-or-later
# Shows Doxygen the comment at the top of a header as the description of the file, word for word.
NR == 1 { print; next }
!started && /^\/\// {
    if (!open) { print "/** \\file"; print "\\verbatim"; open = 1 }
    sub(/^\/\/ ?/, "")
    print
    next
}
!started {
    if (open) { print "\\endverbatim"; print "*/" }
    started = 1
}
{ print }
