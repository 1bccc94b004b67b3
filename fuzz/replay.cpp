// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs a target on files without libFuzzer: replay_TARGET FILE|FOLDER...
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

/// Returns the files, and those in the folders, by name.
std::vector<fs::path> files(int argc, char** argv) {
    std::vector<fs::path> all;
    for (int i = 1; i < argc; ++i) {
        if (!fs::is_directory(argv[i])) all.emplace_back(argv[i]);
        if (fs::is_directory(argv[i]))
            for (const auto& entry : fs::recursive_directory_iterator(argv[i]))
                if (entry.is_regular_file()) all.push_back(entry.path());
    }
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace

int main(int argc, char** argv) {
    const auto all = files(argc, argv);
    for (const fs::path& file : all) {
        std::printf("%s\n", file.c_str());
        std::fflush(stdout); // it is the last line if this one ends the process
        std::ifstream in(file, std::ios::binary);
        const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), {});
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    std::printf("%zu files\n", all.size());
    return all.empty() ? 1 : 0;
}
