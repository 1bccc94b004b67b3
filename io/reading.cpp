// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/reading.hpp>

#include <algorithm>

namespace terrane {
namespace {

/// Whether a file may have points; one whose format is not known may.
bool has_points(std::optional<Format> format) {
    return !format || format == Format::xyz || format == Format::vset || format == Format::pline;
}

bool has_depths(std::optional<Format> format) {
    return has_points(format) || format == Format::irap || format == Format::zmap ||
           format == Format::cps3 || format == Format::esri || format == Format::surfer ||
           format == Format::sticks;
}

} // namespace

Status check_reading(const std::vector<std::optional<Format>>& files, const ReadOptions& options,
                     const std::array<const char*, 2>& option_names) {
    if (options.depth && std::none_of(files.begin(), files.end(), has_depths))
        return Error{ErrorCode::bad_option, "is for grids and points, and no file is one",
                     option_names[0]};
    if (options.max_edge != 0 && std::none_of(files.begin(), files.end(), has_points))
        return Error{ErrorCode::bad_option, "is for points, and no file has any", option_names[1]};
    return Done{};
}

} // namespace terrane
