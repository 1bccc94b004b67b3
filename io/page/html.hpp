// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include <terrane/io/page/arrays.hpp>
#include <terrane/io/page/page_bundle.hpp>

namespace terrane::page {

/// Makes one HTML file that needs nothing else. `content` and the arrays become one compressed
/// block: the length of the JSON in four bytes, the lowest first, the JSON, the arrays. `run`,
/// which holds all that differs from run to run, stays readable. A Content-Security-Policy allows
/// the bundle's script and style by their hashes, and no request at all.
std::string html_of(const Json& content, const Arrays& arrays, const Json& run,
                    const Bundle& bundle);

} // namespace terrane::page
