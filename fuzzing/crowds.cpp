// SPDX-License-Identifier: MIT
//
// Parts whose triangles are nearly all in one plane, at one line or at one point.
#include <terrane/fuzzing/meshes.hpp>

#include <cmath>

namespace terrane::fuzzing {

namespace {

/// Returns a vector of the lattice from -range to range.
Point vector_of(Bytes& bytes, int range) {
    const double x = bytes.between(-range, range), y = bytes.between(-range, range);
    return {x, y, static_cast<double>(bytes.between(-range, range))};
}

/// Triangles with the corners that a plane has at integer multiples of two directions.
class Crowd {
public:
    Crowd(Part& part, Bytes& bytes, double far) :
        part_(part), far_(far), origin_(vector_of(bytes, 4)), u_(vector_of(bytes, 4)),
        v_(vector_of(bytes, 4)) {}

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
    /// Returns far + origin + s u + t v + h (1, 2, 4). No sum is rounded, so coplanar points stay
    /// coplanar: nearly coplanar triangles would cross in as many lines as there are pairs.
    [[nodiscard]] Point at(double s, double t, double h = 0) const {
        return {far_ + origin_.x + s * u_.x + t * v_.x + h,
                far_ + origin_.y + s * u_.y + t * v_.y + 2 * h,
                far_ + origin_.z + s * u_.z + t * v_.z + 4 * h};
    }
    void add_nested(unsigned count) {
        for (unsigned i = 1; i <= count; ++i) add_triangle(part_, {at(0, 0), at(i, 0), at(0, i)});
    }
    /// The sides on the line overlap; no plane is the same as another.
    void add_at_line(Bytes& bytes, unsigned count) {
        const unsigned step = 1 + bytes.below(16);
        for (unsigned i = 0; i < count; ++i) {
            const double from = i * step % 17;
            add_triangle(part_, {at(from, 0), at(from + 1 + i % 5, 0), at(from, i, 1 + i % 3)});
        }
    }
    void add_at_vertex(Bytes& bytes, unsigned count) {
        const unsigned step = 1 + bytes.below(16);
        for (unsigned i = 0; i < count; ++i)
            add_triangle(part_, {at(0, 0), at(1 + i % 7, i * step % 31, i % 11),
                                 at(i % 13, 1 + i % 5, i * step % 19)});
    }
    void add_overlapping(Bytes& bytes, unsigned count) {
        unsigned state = 1 + bytes.byte();
        const auto next = [&] {
            state = (state * 75 + 74) % 65537;
            return state % 64;
        };
        for (unsigned i = 0; i < count; ++i) {
            std::array<Point, 3> corners;
            for (Point& p : corners) {
                const double s = next(), t = next();
                p = at(s, t);
            }
            add_triangle(part_, corners);
        }
    }
    void add_in_plane(Bytes& bytes) {
        std::array<Point, 3> corners;
        for (Point& p : corners) {
            const double s = bytes.byte(), t = bytes.byte();
            p = at(s, t);
        }
        add_triangle(part_, corners);
    }

    Part& part_;
    double far_;
    Point origin_, u_, v_;
};

/// Integer points nearest to one plane.
class NearPlane {
public:
    explicit NearPlane(Bytes& bytes) :
        exponent_(bytes.between(-60, 60)), u_(large(bytes)), v_(large(bytes)) {}

    /// Returns the integers nearest to s u + t v.
    [[nodiscard]] Point at(double s, double t) const {
        return {rounded(s * u_.x + t * v_.x), rounded(s * u_.y + t * v_.y),
                rounded(s * u_.z + t * v_.z)};
    }
    Point next(Bytes& bytes) const {
        const unsigned s = bytes.byte(), t = bytes.byte();
        return at(s / 256.0, t / 256.0);
    }
    /// A needle: two corners and one between them, an integer away from their line or none.
    void add_needle(Part& part, Bytes& bytes) const {
        const unsigned from = bytes.below(8), to = bytes.below(8), between = bytes.byte();
        const Point a = at(from / 8.0, 0), b = at(to / 8.0, 1);
        const auto mixed = [&](double x, double y) {
            return std::round(x + (y - x) * between / 256);
        };
        Point c{mixed(unscaled(a.x), unscaled(b.x)), mixed(unscaled(a.y), unscaled(b.y)),
                mixed(unscaled(a.z), unscaled(b.z))};
        c.z += bytes.between(-1, 1);
        add_triangle(part, {a, b, {scaled(c.x), scaled(c.y), scaled(c.z)}});
    }

private:
    /// Two bytes for each coordinate, below 2^19.
    static Point large(Bytes& bytes) {
        std::array<double, 3> x{};
        for (double& each : x) {
            const unsigned high = bytes.byte();
            each = 16.0 * (high * 256.0 + bytes.byte()) - 0x1p19;
        }
        return {x[0], x[1], x[2]};
    }
    [[nodiscard]] double scaled(double x) const { return std::ldexp(x, exponent_); }
    [[nodiscard]] double unscaled(double x) const { return std::ldexp(x, -exponent_); }
    [[nodiscard]] double rounded(double x) const { return scaled(std::round(x)); }

    int exponent_;
    Point u_, v_;
};

} // namespace

Soup crowd(Bytes& bytes, std::size_t most) {
    Points points(bytes);
    constexpr std::array far{0.0, 0x1p36, 0x1p46, 0x1p40};
    const double by = far[bytes.below(4)];
    Soup parts(1);
    Crowd pieces(parts[0], bytes, by);
    while (!bytes.empty()) {
        const Part before = parts[0];
        if (bytes.below(4) == 0)
            add_triangle(parts[0], {points.next(bytes), points.next(bytes), points.next(bytes)});
        else
            pieces.add_piece(bytes);
        if (parts[0].triangles.size() > most) {
            parts[0] = before;
            break;
        }
    }
    return parts;
}

Soup near_plane(Bytes& bytes, std::size_t most) {
    const NearPlane plane(bytes);
    Soup parts(1 + bytes.below(2));
    while (!bytes.empty() && triangle_count(parts) < most) {
        const unsigned how = bytes.byte();
        Part& to = parts[how % parts.size()];
        if (how / 4 % 4 == 0)
            plane.add_needle(to, bytes);
        else
            add_triangle(to, {plane.next(bytes), plane.next(bytes), plane.next(bytes)});
    }
    return parts;
}

} // namespace terrane::fuzzing
