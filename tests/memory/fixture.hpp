// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Small models for all stages.
#pragma once

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <terrane/advanced.hpp>
#include <terrane/io/exact_text.hpp>

#include "support/files.hpp"

namespace failing {

/// Ends the program: the fixture itself must not fail.
[[noreturn]] inline void fail(const std::string& message) {
    std::fprintf(stderr, "the fixture: %s\n", message.c_str());
    std::exit(2);
}

/// Returns the value, or ends the program.
template <class T>
T needed(terrane::Result<T> made) {
    if (!made) fail(made.error().message());
    return std::move(made).value();
}

/// Tells whether this is the first of the names of a format.
inline bool is_first_name(std::string_view name) {
    for (const std::string_view other : terrane::format_names())
        if (terrane::format_named(other) == terrane::format_named(name)) return other == name;
    return false;
}

inline std::string text_of(const terrane::Mesh& mesh) {
    return needed(terrane::format_mesh(mesh, terrane::Format::obj));
}

inline std::string text_of(const terrane::Arrangement& arrangement) {
    return terrane::to_text(terrane::to_exact(arrangement));
}

/// Returns all digits of a number, whatever the locale.
inline std::string shown(double number) {
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

inline std::string text_of(const std::vector<terrane::Surface>& surfaces) {
    std::string text;
    for (const auto& s : surfaces) {
        text += s.name + " " + std::to_string(s.triangles.size());
        for (const auto& v : s.vertices)
            text += " " + shown(v.x) + " " + shown(v.y) + " " + shown(v.z);
    }
    return text;
}

/// A horizon with waves and a square hole in the middle, of n * n squares.
inline terrane::Surface waves(unsigned n, double height, bool hole) {
    terrane::Surface s{.name = "horizon at " + shown(height),
                       .role = terrane::Role::horizon,
                       .vertices = {},
                       .triangles = {}};
    for (unsigned j = 0; j <= n; ++j)
        for (unsigned i = 0; i <= n; ++i)
            s.vertices.push_back({double(i), double(j), height + 0.125 * ((i * j + i) % 3)});
    for (unsigned j = 0; j < n; ++j)
        for (unsigned i = 0; i < n; ++i) {
            if (hole && (i == n / 2 || i + 1 == n / 2) && (j == n / 2 || j + 1 == n / 2)) continue;
            const std::uint32_t a = j * (n + 1) + i, b = a + n + 1;
            s.triangles.push_back({a, a + 1, b + 1});
            s.triangles.push_back({a, b + 1, b});
        }
    return s;
}

/// Two horizons and a fault that ends 0.01 above the upper one, in a box.
struct Fixture {
    std::vector<terrane::Surface> surfaces{
        {"a horizon with a name that needs memory",
         terrane::Role::horizon,
         {{-1, -1, 3}, {9, -1, 3}, {9, 9, 3.5}, {-1, 9, 3}},
         {{0, 1, 2}, {0, 2, 3}}},
        {"top",
         terrane::Role::horizon,
         {{-1, -1, 5}, {9, -1, 5}, {9, 9, 5}, {-1, 9, 5}},
         {{0, 1, 2}, {0, 2, 3}}},
        {"fault",
         terrane::Role::fault,
         {{4, -1, -1}, {4, 9, -1}, {4.5, 9, 4.99}, {4.5, -1, 4.99}},
         {{0, 1, 2}, {0, 2, 3}}}};
    std::vector<terrane::Surface> box = needed(terrane::box_boundary({0, 0, 0}, {8, 8, 8}));
    terrane::Arranged arranged = needed(terrane::arrange_within(surfaces, box));
    terrane::ConformingMesh mesh = needed(terrane::prove_conforming(arranged.rounded.mesh));
    terrane::Volumes volumes = needed(terrane::find_volumes(*mesh));
    terrane::Model model = needed(terrane::make_model(arranged.exact, mesh));

    static const Fixture& get() {
        static const Fixture fixture;
        return fixture;
    }
};

} // namespace failing
