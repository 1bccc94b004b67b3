// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/tetgen_helper.hpp>

#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

namespace terrane {
namespace {

namespace fs = std::filesystem;

constexpr auto file_name = "terrane-tetgen";

bool can_be_run(const fs::path& path) {
    std::error_code failed;
    return fs::is_regular_file(path, failed) && access(path.c_str(), X_OK) == 0;
}

/// Returns the places where the helper is looked for by default, in this order.
std::vector<fs::path> usual_places() {
    std::vector<fs::path> places;
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    if (!failed) {
        const fs::path folder = program.parent_path();
        places.push_back(folder / file_name);
        places.push_back(folder.parent_path() / "libexec" / "terrane" / file_name);
    }
    places.emplace_back(fs::path(TERRANE_HELPER_FOLDER) / file_name);
    return places;
}

Result<fs::path> named(const fs::path& path, const char* by) {
    if (can_be_run(path)) return path;
    return Error{ErrorCode::cannot_open,
                 fmt::format("is no program that can be run; {} names it as TetGen's helper", by),
                 path.string()};
}

} // namespace

Result<fs::path> find_tetgen_helper(const fs::path& given) {
    if (!given.empty()) return named(given, "the option helper");
    const char* const variable = secure_getenv("TERRANE_TETGEN");
    if (variable != nullptr && *variable != '\0')
        return named(variable, "the environment variable TERRANE_TETGEN");
    std::string looked_at;
    for (const fs::path& place : usual_places()) {
        if (can_be_run(place)) return place;
        looked_at += (looked_at.empty() ? "" : ", ") + place.string();
    }
    return Error{ErrorCode::cannot_open,
                 fmt::format("TetGen's helper program was not found; it was looked for as {}; the "
                             "environment variable TERRANE_TETGEN can name it",
                             looked_at),
                 ""};
}

} // namespace terrane
