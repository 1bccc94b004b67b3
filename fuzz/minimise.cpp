// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reduces a finding of a target about surfaces to as few triangles and as simple numbers as
// possible:
//
//     minimise_arrange CRASH|SOUP.obj WHAT [FOLDER]
//
// reads the bytes of the fuzzer, or an OBJ file, and writes FOLDER/NNN-WHAT.obj with the next free
// number. Each attempt runs in a process of its own, so that crashes and hangs can be reduced too.
// Without WHAT it prints the surfaces that the bytes stand for as an OBJ file.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <terrane/fuzzing/minimise.hpp>
#include <terrane/io/files.hpp>

#include "property.hpp"
#include "report.hpp"

using namespace terrane;
namespace fs = std::filesystem;

namespace {

constexpr unsigned seconds_per_attempt = 5;

/// Tells whether the property fails, crashes or never ends.
bool fails(const fuzzing::Soup& soup) {
    return fuzzing::fails_apart([&] { return fuzz::flaw(fuzz::surfaces_of(soup)).empty(); },
                                seconds_per_attempt);
}

fuzzing::Soup read(const fs::path& path) {
    if (path.extension() == ".obj") {
        const auto surfaces = read_surfaces(path);
        if (!surfaces) fuzz::fail(surfaces.error().message());
        fuzzing::Soup soup;
        for (const Surface& s : surfaces.value()) {
            fuzzing::Part& part = soup.emplace_back();
            for (const Point3& p : s.vertices) part.points.push_back({p.x, p.y, p.z});
            part.triangles = s.triangles;
        }
        return soup;
    }
    std::ifstream in(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    return fuzzing::mesh_of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(),
                            fuzz::input);
}

/// Returns FOLDER/NNN-what.obj, with the number after the highest one there.
fs::path next_file(const fs::path& folder, const std::string& what) {
    int last = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        int number = 0;
        std::from_chars(name.data(), name.data() + name.size(), number);
        last = std::max(last, number);
    }
    char number[16];
    std::snprintf(number, sizeof number, "%03d-", last + 1);
    return folder / (number + what + ".obj");
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s CRASH|SOUP.obj [WHAT [FOLDER]]\n", argv[0]);
        return 2;
    }
    fuzzing::Soup soup = read(argv[1]);
    if (argc == 2) {
        std::fputs(fuzzing::obj_text(soup).c_str(), stdout);
        return 0;
    }
    if (!fails(soup)) {
        std::fprintf(stderr, "%s: nothing fails here\n", argv[1]);
        return 1;
    }
    soup = fuzzing::minimise(soup, fails);
    std::erase_if(soup, [](const fuzzing::Part& part) { return part.triangles.empty(); });
    const auto path = next_file(argc > 3 ? argv[3] : ".", argv[2]);
    std::ofstream(path) << "# " << argv[2] << "\n" << fuzzing::obj_text(soup);
    std::printf("%s\n", path.c_str());
    return 0;
}
