// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Returns the paths of the sources, the test data and the program. Only paths.cpp is compiled with
// them, so that a compiler's cache serves all checkouts.
#pragma once

#include <string>

namespace test_support {

std::string source_dir(); ///< the root of the repository
std::string test_data();  ///< tests/data
std::string program();    ///< the program under test

} // namespace test_support
