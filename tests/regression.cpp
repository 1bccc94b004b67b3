// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Arranges, verifies, rounds and checks inputs that once failed, which are named after what they
// broke, both unchanged and transformed. Adding a file to the folder needs no compiling.
//   regression FOLDER
#include "support/soup_laws.hpp"

#include <terrane/io/files.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const char* folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (terrane::format_of(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string flaw(const fs::path& file) {
    const auto surfaces = terrane::read_surfaces(file);
    return surfaces ? soup_laws::flaw(surfaces.value()) : surfaces.error().message();
}

} // namespace

int main(int argc, char** argv) {
    const auto files = argc == 2 ? files_in(argv[1]) : std::vector<fs::path>();
    int failed = 0;
    for (const fs::path& file : files) {
        const auto what = flaw(file);
        std::printf("%s: %s\n", file.filename().c_str(), what.empty() ? "holds" : what.c_str());
        failed += !what.empty();
    }
    std::printf("%zu files, %d failed\n", files.size(), failed);
    return failed == 0 && !files.empty() ? 0 : 1;
}
