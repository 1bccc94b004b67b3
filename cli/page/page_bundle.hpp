// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

namespace terrane::cli::page {

/// The program and the style of all pages, as cli/page/web/build.mjs bundles them.
struct Bundle {
    std::string_view script; ///< JavaScript; holds no "</script"
    std::string_view style;  ///< CSS; holds no "</style"
};

/// Returns the bundle; null in a build without npm.
const Bundle* bundle();

} // namespace terrane::cli::page
