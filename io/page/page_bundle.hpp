// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

namespace terrane::page {

/// The program and the style of all pages, as io/page/web/build.mjs bundles them.
struct Bundle {
    std::string_view script; ///< JavaScript; holds no "</script"
    std::string_view style;  ///< CSS; holds no "</style"
};

/// Returns the bundle; null in a build without npm.
const Bundle* bundle();

/// Returns why there is no bundle: what the build lacked; empty if there is one.
std::string_view bundle_missing();

} // namespace terrane::page
