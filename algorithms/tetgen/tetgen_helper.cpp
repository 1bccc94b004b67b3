// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <terrane/algorithms/core/guarded.hpp>

namespace terrane {
namespace {

namespace fs = std::filesystem;

/// A mesher's helper program.
struct Helper {
    const char* mesher;
    const char* file_name;
    const char* variable; ///< of the environment, which may name the program
    const char* option;   ///< of TetrahedraOptions
};

constexpr Helper tetgen{"TetGen", "terrane-tetgen", "TERRANE_TETGEN", "helper"};
constexpr Helper gmsh{"Gmsh", "terrane-gmsh", "TERRANE_GMSH", "gmsh_helper"};

bool can_be_run(const fs::path& path) {
    std::error_code failed;
    return fs::is_regular_file(path, failed) && access(path.c_str(), X_OK) == 0;
}

/// Returns the folder of the shared library that contains this code; empty for a program, and where
/// the system states no whole path: a helper must not depend on the current folder.
fs::path library_folder() {
    Dl_info found{};
    if (dladdr(reinterpret_cast<const void*>(&can_be_run), &found) == 0 || !found.dli_fname)
        return {};
    const fs::path file = found.dli_fname;
    std::error_code failed;
    if (!file.is_absolute() || fs::equivalent(file, "/proc/self/exe", failed)) return {};
    const fs::path whole = fs::canonical(file, failed);
    return failed ? fs::path() : whole.parent_path();
}

/// Returns the places where a helper is looked for by default, in this order.
std::vector<fs::path> usual_places(const Helper& helper) {
    std::vector<fs::path> places;
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    if (!failed) {
        const fs::path folder = program.parent_path();
        places.push_back(folder / helper.file_name);
        places.push_back(folder.parent_path() / "libexec" / "terrane" / helper.file_name);
    }
    // The library is in lib/ or lib/ARCHITECTURE/, a module of Python in lib/python3/dist-packages/terrane/.
    fs::path prefix = library_folder();
    for (int up = 0; up < 4 && prefix.has_relative_path(); ++up) {
        prefix = prefix.parent_path();
        places.push_back(prefix / "libexec" / "terrane" / helper.file_name);
    }
    places.emplace_back(fs::path(TERRANE_HELPER_FOLDER) / helper.file_name);
    return places;
}

Result<fs::path> named(const Helper& helper, const fs::path& path, const std::string& by) {
    if (can_be_run(path)) return path;
    return Error{
        ErrorCode::cannot_open,
        fmt::format("is no program that can be run; {} names it as {}'s helper", by, helper.mesher),
        path.string()};
}

Result<fs::path> find(const Helper& helper, const fs::path& given) {
    if (!given.empty()) return named(helper, given, fmt::format("the option {}", helper.option));
    const char* const variable = secure_getenv(helper.variable);
    if (variable != nullptr && *variable != '\0')
        return named(helper, variable, fmt::format("the environment variable {}", helper.variable));
    std::string looked_at;
    for (const fs::path& place : usual_places(helper)) {
        if (can_be_run(place)) return place;
        looked_at += (looked_at.empty() ? "" : ", ") + place.string();
    }
    return Error{ErrorCode::cannot_open,
                 fmt::format("{}'s helper program was not found; it was looked for as {}; the "
                             "environment variable {} can name it",
                             helper.mesher, looked_at, helper.variable),
                 ""};
}

} // namespace

Result<fs::path> find_tetgen_helper(const fs::path& given) {
    return guarded("to find the helper", "helper", [&] { return find(tetgen, given); });
}

Result<fs::path> find_gmsh_helper(const fs::path& given) {
    return guarded("to find the helper", "helper", [&] { return find(gmsh, given); });
}

} // namespace terrane
