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
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <terrane/io/files.hpp>

#include "property.hpp"
#include "report.hpp"

using namespace terrane;
namespace fs = std::filesystem;

namespace {

using Surfaces = std::vector<Surface>;

constexpr unsigned seconds_per_attempt = 5;

/// Tells whether the property fails, crashes or never ends.
bool fails(const Surfaces& surfaces) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        alarm(seconds_per_attempt);
        std::freopen("/dev/null", "w", stderr);
        _exit(fuzz::flaw(surfaces).empty() ? 0 : 1);
    }
    int status = 0;
    return child > 0 && waitpid(child, &status, 0) == child &&
           !(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

/// Accepts a change if the property still fails.
bool accept(Surfaces& current, const Surfaces& changed) {
    if (!fails(changed)) return false;
    current = changed;
    return true;
}

/// Removes pieces of half the triangles, of a quarter, ..., of one triangle, if the property still
/// fails without them.
bool drop_triangles(Surfaces& current) {
    bool any = false;
    for (std::size_t s = 0; s < current.size(); ++s)
        for (std::size_t piece = std::max<std::size_t>(1, current[s].triangles.size() / 2);
             piece > 0; piece /= 2)
            for (std::size_t at = 0; at < current[s].triangles.size();) {
                Surfaces changed = current;
                auto& triangles = changed[s].triangles;
                const auto first = triangles.begin() + static_cast<std::ptrdiff_t>(at);
                const auto count = std::min(piece, triangles.size() - at);
                triangles.erase(first, first + static_cast<std::ptrdiff_t>(count));
                if (accept(current, changed))
                    any = true;
                else
                    at += piece;
            }
    return any;
}

/// Merges vertices at equal points and removes unused ones. The points of the triangles do not
/// change.
void compact(Surface& s) {
    Surface result{s.name, s.role, {}, s.triangles};
    for (Triangle& t : result.triangles)
        for (std::uint32_t& v : t) {
            const Point3 p = s.vertices[v];
            const auto at = std::find(result.vertices.begin(), result.vertices.end(), p);
            v = static_cast<std::uint32_t>(at - result.vertices.begin());
            if (at == result.vertices.end()) result.vertices.push_back(p);
        }
    s = result;
}

/// Returns simpler numbers near x, the simplest first.
std::vector<double> simpler(double x) {
    std::vector<double> tries{0, 1, -1, std::round(x), std::trunc(x / 2)};
    for (int digits = 1; digits < 16; ++digits) {
        char text[40];
        std::snprintf(text, sizeof text, "%.*g", digits, x);
        tries.push_back(std::strtod(text, nullptr));
    }
    return tries;
}

std::size_t length(double x) {
    char text[40];
    return static_cast<std::size_t>(std::to_chars(text, text + sizeof text, x).ptr - text);
}

/// Tells whether a is simpler than b: it has fewer digits, or as many and is nearer to zero.
bool is_simpler(double a, double b) {
    return length(a) < length(b) || (length(a) == length(b) && std::fabs(a) < std::fabs(b));
}

/// Replaces a number everywhere, so that shared points and coplanar triangles mostly remain so.
Surfaces replaced(Surfaces surfaces, double from, double to) {
    for (Surface& s : surfaces)
        for (Point3& p : s.vertices)
            for (double* x : {&p.x, &p.y, &p.z})
                if (*x == from) *x = to;
    return surfaces;
}

bool simplify_numbers(Surfaces& current) {
    std::vector<double> numbers;
    for (const Surface& s : current)
        for (const Point3& p : s.vertices) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    bool any = false;
    for (const double x : numbers)
        for (const double y : simpler(x))
            if (is_simpler(y, x) && accept(current, replaced(current, x, y))) {
                any = true;
                break;
            }
    return any;
}

bool simplify_coordinates(Surfaces& current) {
    bool any = false;
    for (std::size_t s = 0; s < current.size(); ++s)
        for (std::size_t v = 0; v < current[s].vertices.size(); ++v)
            for (double Point3::*k : {&Point3::x, &Point3::y, &Point3::z})
                for (const double y : simpler(current[s].vertices[v].*k)) {
                    Surfaces changed = current;
                    if (!is_simpler(y, current[s].vertices[v].*k)) continue;
                    changed[s].vertices[v].*k = y;
                    if (accept(current, changed)) {
                        any = true;
                        break;
                    }
                }
    return any;
}

Surfaces read(const fs::path& path) {
    if (path.extension() == ".obj") {
        auto surfaces = read_surfaces(path);
        if (!surfaces) fuzz::fail(surfaces.error().message());
        return surfaces.value();
    }
    std::ifstream in(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    fuzz::Bytes bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    return fuzz::input(bytes);
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
    Surfaces surfaces = read(argv[1]);
    if (argc == 2) {
        std::fputs(fuzz::obj_text(surfaces).c_str(), stdout);
        return 0;
    }
    if (!fails(surfaces)) {
        std::fprintf(stderr, "%s: nothing fails here\n", argv[1]);
        return 1;
    }
    bool again = true;
    while (again) {
        again = drop_triangles(surfaces);
        for (Surface& s : surfaces) compact(s);
        again = simplify_numbers(surfaces) || again;
        again = simplify_coordinates(surfaces) || again;
    }
    std::erase_if(surfaces, [](const Surface& s) { return s.triangles.empty(); });
    const auto path = next_file(argc > 3 ? argv[3] : ".", argv[2]);
    std::ofstream(path) << "# " << argv[2] << "\n" << fuzz::obj_text(surfaces);
    std::printf("%s\n", path.c_str());
    return 0;
}
