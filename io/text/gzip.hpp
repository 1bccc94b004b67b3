// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::detail {

/// Whether contents begin as those of gzip do.
bool is_gzip(std::string_view contents);

/// Returns what gzip has compressed, one or several members. `source` is the place of errors: bad_syntax where the
/// data are cut off or damaged; unsupported where they grow to more than 64 MiB and 100 times their size, as
/// no text of coordinates does.
Result<std::string> gunzipped(std::string_view contents, std::string_view source);

} // namespace terrane::detail
