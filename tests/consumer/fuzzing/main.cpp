// SPDX-License-Identifier: LGPL-3.0-or-later
//
// fuzz_engine MESHES [SEED]   plants each bug of the engine, looks for it in at most MESHES meshes, without coverage,
// and reduces what it finds; then looks for a flaw of the sound engine in a tenth as many. The status is 1 if a bug is
// not found, if its mesh is not reduced to ten triangles, or if the sound engine has a flaw.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <terrane/fuzzing/minimise.hpp>
#include <terrane/fuzzing/mutate.hpp>

#include "flaw.hpp"

namespace {

namespace fuzzing = terrane::fuzzing;
constexpr int bugs = 18;
constexpr std::size_t most_triangles = 10;

/// Tells whether the bug is found and reduced.
bool is_found(int bug, std::size_t most, unsigned seed) {
    engine::bug = bug;
    const auto begin = std::chrono::steady_clock::now();
    const auto since = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    const auto found = fuzzing::find_flaw(under_test::generate, under_test::flaw, most, seed);
    if (found.flaw.empty()) {
        std::printf("%2d not found in %zu meshes\n", bug, found.tried);
        return false;
    }
    const double after = since();
    const auto least = fuzzing::minimise(found.soup, [&](const fuzzing::Soup& soup) {
        return under_test::flaw(soup) == found.flaw;
    });
    const std::size_t count = triangle_count(least);
    std::printf("%2d %-45s %6zu meshes %6.2f s, %3zu -> %2zu triangles, %5.2f s\n", bug,
                found.flaw.c_str(), found.tried, after, triangle_count(found.soup), count,
                since() - after);
    if (count <= most_triangles) return true;
    std::fputs(obj_text(least).c_str(), stdout);
    return false;
}

bool is_sound(std::size_t most, unsigned seed) {
    engine::bug = 0;
    const auto found = fuzzing::find_flaw(under_test::generate, under_test::flaw, most, seed);
    std::printf("sound: %zu meshes %s\n%s", found.tried, found.flaw.c_str(),
                obj_text(found.soup).c_str());
    return found.flaw.empty();
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    const auto most = std::strtoul(argv[1], nullptr, 10);
    const unsigned seed = argc > 2 ? unsigned(std::atoi(argv[2])) : 1;
    bool good = true;
    for (int bug = 1; bug <= bugs; ++bug) good = is_found(bug, most, seed) && good;
    return is_sound(most / 10, seed) && good ? 0 : 1;
}
