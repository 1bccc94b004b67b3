// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/paths.hpp"

namespace test_support {

std::string source_dir() {
    return TERRANE_SOURCE_DIR;
}

std::string test_data() {
    return TERRANE_SOURCE_DIR "/tests/data";
}

std::string program() {
    return TERRANE_PROGRAM;
}

} // namespace test_support
