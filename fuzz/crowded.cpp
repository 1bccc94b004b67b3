// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: that of rounding.cpp, for up to 110 triangles of which very many are in one plane, at one
// line or at one vertex, which the library treats as a whole; and proven bounds decide as tests of
// all pairs do.
#include "property.hpp"
#include "shapes.hpp"

#include "support/soup_laws.hpp"

namespace terrane::fuzz {

namespace {

constexpr std::size_t most_triangles = 110;

/// Triangles with the corners that a plane has at integer multiples of two directions.
class Crowd {
public:
    Crowd(Surface& surface, Bytes& bytes, double far) :
        surface_(surface), far_(far), origin_(vector(bytes)), u_(vector(bytes)), v_(vector(bytes)) {
    }

    void add_piece(Bytes& bytes) {
        switch (bytes.below(5)) {
        case 0:
            return add_nested(20 + bytes.below(60));
        case 1:
            return add_at_line(bytes, 20 + bytes.below(60));
        case 2:
            return add_at_vertex(bytes, 20 + bytes.below(80));
        case 3:
            return add_overlapping(bytes, 10 + bytes.below(20));
        default:
            return add_in_plane(bytes);
        }
    }

private:
    static Point3 vector(Bytes& bytes) {
        const double x = bytes.between(-4, 4), y = bytes.between(-4, 4);
        return {x, y, static_cast<double>(bytes.between(-4, 4))};
    }
    /// Returns far + origin + s u + t v + h (1, 2, 4). No sum is rounded, so coplanar points stay
    /// coplanar: nearly coplanar triangles would cross in as many lines as there are pairs.
    [[nodiscard]] Point3 at(double s, double t, double h = 0) const {
        return {far_ + origin_.x + s * u_.x + t * v_.x + h,
                far_ + origin_.y + s * u_.y + t * v_.y + 2 * h,
                far_ + origin_.z + s * u_.z + t * v_.z + 4 * h};
    }
    void add_nested(unsigned count) {
        for (unsigned i = 1; i <= count; ++i)
            add_triangle(surface_, {at(0, 0), at(i, 0), at(0, i)});
    }
    /// The sides on the line overlap; no plane is the same as another.
    void add_at_line(Bytes& bytes, unsigned count) {
        const unsigned step = 1 + bytes.below(16);
        for (unsigned i = 0; i < count; ++i) {
            const double from = i * step % 17;
            add_triangle(surface_, {at(from, 0), at(from + 1 + i % 5, 0), at(from, i, 1 + i % 3)});
        }
    }
    void add_at_vertex(Bytes& bytes, unsigned count) {
        const unsigned step = 1 + bytes.below(16);
        for (unsigned i = 0; i < count; ++i)
            add_triangle(surface_, {at(0, 0), at(1 + i % 7, i * step % 31, i % 11),
                                    at(i % 13, 1 + i % 5, i * step % 19)});
    }
    void add_overlapping(Bytes& bytes, unsigned count) {
        unsigned state = 1 + bytes.byte();
        const auto next = [&] {
            state = (state * 75 + 74) % 65537;
            return state % 64;
        };
        for (unsigned i = 0; i < count; ++i) {
            std::array<Point3, 3> corners;
            for (Point3& p : corners) {
                const double s = next(), t = next();
                p = at(s, t);
            }
            add_triangle(surface_, corners);
        }
    }
    void add_in_plane(Bytes& bytes) {
        std::array<Point3, 3> corners;
        for (Point3& p : corners) {
            const double s = bytes.byte(), t = bytes.byte();
            p = at(s, t);
        }
        add_triangle(surface_, corners);
    }

    Surface& surface_;
    double far_;
    Point3 origin_, u_, v_;
};

} // namespace

std::vector<Surface> input(Bytes& bytes) {
    Points points(bytes);
    constexpr std::array far{0.0, 0x1p36, 0x1p46, 0x1p40};
    const double by = far[bytes.below(4)];
    std::vector<Surface> surfaces(1);
    surfaces[0].name = "a";
    Crowd crowd(surfaces[0], bytes, by);
    while (!bytes.empty()) {
        const Surface before = surfaces[0];
        if (bytes.below(4) == 0)
            add_triangle(surfaces[0], {points.next(bytes), points.next(bytes), points.next(bytes)});
        else
            crowd.add_piece(bytes);
        if (surfaces[0].triangles.size() > most_triangles) {
            surfaces[0] = before;
            break;
        }
    }
    return surfaces;
}

std::string flaw(std::span<const Surface> input_surfaces) {
    const std::vector<Surface> surfaces(input_surfaces.begin(), input_surfaces.end());
    const auto made = arrange(surfaces);
    if (!made) return made.error().message();
    // Rounding tries many grids where all is within some hundred doubles, and rationals take a second
    // for that many triangles. Larger inputs cost too much for a fuzzer.
    constexpr std::size_t most_in_rationals = 500, most_in_doubles = 1500;
    const std::size_t size = made->triangles.size();
    if (size > most_in_doubles) return "";
    for (const unsigned rounds : {8U, 0U}) {
        const RoundingOptions quick{.max_rounds = rounds},
            slow{.max_rounds = rounds, .check = {PairCheck::full}};
        const auto by_bounds = round_to_doubles(made.value(), quick),
                   by_tests = round_to_doubles(made.value(), slow);
        if (by_bounds.has_value() != by_tests.has_value()) return "a full check fails, or does not";
        if (by_bounds && (by_bounds->report.clean != by_tests->report.clean ||
                          by_bounds->mesh->vertices != by_tests->mesh->vertices ||
                          by_bounds->mesh->triangles != by_tests->mesh->triangles))
            return "a full check changes the mesh";
        if (size > most_in_rationals) continue;
        if (auto what = soup_laws::rounding_flaw(surfaces, made.value(), quick); !what.empty())
            return what + ", with " + std::to_string(rounds) + " rounds";
    }
    return "";
}

} // namespace terrane::fuzz
