// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <terrane/io/page/arrays.hpp>
#include <terrane/io/page/page_bundle.hpp>

namespace terrane::page {

/// Returns the Content-Security-Policy of a page with one script, or none, and one style: no request at all, and no other
/// script or style.
std::string content_policy(std::string_view script, std::string_view style);

/// Makes one HTML file that needs nothing else. `content` and the arrays become one compressed
/// block: the length of the JSON in four bytes, the lowest first, the JSON, the arrays. `run`,
/// which holds all that differs from run to run, stays readable. Its policy is that of the bundle's script and style.
std::string html_of(const Json& content, const Arrays& arrays, const Json& run,
                    const Bundle& bundle);

} // namespace terrane::page
