// SPDX-License-Identifier: MIT
#include <terrane/fuzzing/meshes.hpp>

#include <cmath>
#include <cstring>

namespace terrane::fuzzing {

namespace {

/// Returns a number of the lattice; the highest bytes stand for neighbours, halves and 0.
double coordinate(Bytes& bytes, int range) {
    const unsigned byte = bytes.byte();
    const double lattice = static_cast<int>(byte % static_cast<unsigned>(2 * range + 1)) - range;
    if (byte < 176) return lattice;
    if (byte < 200) return std::nextafter(lattice, HUGE_VAL);
    if (byte < 224) return std::nextafter(lattice, -HUGE_VAL);
    if (byte < 248) return lattice / 2;
    return 0;
}

Point rotated(const Point& p, unsigned axis) {
    if (axis == 0) return p;
    return axis == 1 ? Point{p.y, p.z, p.x} : Point{p.z, p.x, p.y};
}

std::uint32_t add_point(Part& part, const Point& p) {
    part.points.push_back(p);
    return static_cast<std::uint32_t>(part.points.size() - 1);
}

/// Appends a shifted copy of another part, if it has triangles: copies of copies of points only would become too many.
void add_copy(Part& part, const Part& other, const Point& by) {
    if (other.triangles.empty()) return;
    const auto first = static_cast<std::uint32_t>(part.points.size());
    const auto points = other.points; // it may be the same part
    const auto triangles = other.triangles;
    for (const Point& p : points) part.points.push_back({p.x + by.x, p.y + by.y, p.z + by.z});
    for (const Triangle& t : triangles)
        part.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

void add_piece(const Soup& soup, Part& to, Points& points, Bytes& bytes) {
    const auto next = [&] { return points.next(bytes); };
    switch (bytes.below(12)) {
    case 0:
        return add_fan(to, points, bytes);
    case 1:
        return add_sheet(to, points, bytes, true);
    case 2:
        return add_tetrahedron(to, {next(), next(), next(), next()});
    case 3: {
        const Point zero = points.placed({}),
                    step = points.placed(
                        {double(bytes.between(-1, 1)), double(bytes.between(-1, 1)), 0});
        const Part& other = soup[bytes.below(static_cast<unsigned>(soup.size()))];
        return add_copy(to, other, {step.x - zero.x, step.y - zero.y, step.z - zero.z});
    }
    case 4:
        return add_box(to, points, bytes);
    default:
        return add_triangle(to, {next(), next(), next()});
    }
}

} // namespace

double Bytes::any_double() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

Frame::Frame(Bytes& bytes) {
    const unsigned how = bytes.byte();
    if (how % 4 == 2) step_ = 0.1;
    if (how % 4 == 3) step_ = 1.0 / 3;
    turned_ = how / 4 % 4 == 3;
    if (how / 16 % 4 == 2) shift_ = {500000, 4200000, 0};
    if (how / 16 % 4 == 3) shift_ = {0x1p40, -0x1p20, 1.0 / 3};
    if (how / 64 == 2) exponent_ = bytes.between(-12, 12);
    if (how / 64 == 3) exponent_ = 8 * bytes.between(-120, 120);
}

Point Frame::operator()(Point p) const {
    p = {p.x * step_, p.y * step_, p.z * step_};
    if (turned_) p = {0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z};
    p = {p.x + shift_.x, p.y + shift_.y, p.z + shift_.z};
    return {std::ldexp(p.x, exponent_), std::ldexp(p.y, exponent_), std::ldexp(p.z, exponent_)};
}

Point Points::next(Bytes& bytes) {
    const unsigned tag = bytes.byte();
    if (!earlier_.empty() && tag % 3 == 0) return earlier_[tag / 3 % earlier_.size()];
    const double x = coordinate(bytes, range_), y = coordinate(bytes, range_),
                 z = coordinate(bytes, range_);
    earlier_.push_back(frame_({x, y, z}));
    return earlier_.back();
}

void add_triangle(Part& part, const std::array<Point, 3>& corners) {
    Triangle t{};
    for (unsigned i = 0; i < 3; ++i) t[i] = add_point(part, corners[i]);
    part.triangles.push_back(t);
}

void add_fan(Part& part, Points& points, Bytes& bytes) {
    const auto a = add_point(part, points.next(bytes)), b = add_point(part, points.next(bytes));
    const unsigned blades = 2 + bytes.below(4);
    for (unsigned i = 0; i < blades; ++i)
        part.triangles.push_back({a, b, add_point(part, points.next(bytes))});
}

void add_sheet(Part& part, const Points& points, Bytes& bytes, bool holes) {
    const unsigned n = 1 + bytes.below(2), m = 1 + bytes.below(2), axis = bytes.below(3);
    const unsigned missing = holes ? bytes.byte() : 0, diagonals = bytes.byte();
    const double u = bytes.between(-points.range(), points.range()) / 2.0,
                 v = bytes.between(-points.range(), points.range()) / 2.0;
    const auto first = static_cast<std::uint32_t>(part.points.size());
    for (unsigned j = 0; j <= m; ++j)
        for (unsigned i = 0; i <= n; ++i) {
            const Point p{u + i, v + j, coordinate(bytes, points.range())};
            part.points.push_back(points.placed(rotated(p, axis)));
        }
    for (unsigned j = 0; j < m; ++j)
        for (unsigned i = 0; i < n; ++i) {
            const std::uint32_t a = first + j * (n + 1) + i, b = a + n + 1;
            const unsigned square = j * n + i;
            const bool other = (diagonals >> square & 1) != 0;
            if ((missing >> (2 * square) & 1) == 0)
                part.triangles.push_back({a, a + 1, other ? b + 1 : b});
            if ((missing >> (2 * square + 1) & 1) == 0)
                part.triangles.push_back(other ? Triangle{a, b + 1, b} : Triangle{a + 1, b + 1, b});
        }
}

void add_tetrahedron(Part& part, const std::array<Point, 4>& corners) {
    const auto v = static_cast<std::uint32_t>(part.points.size());
    part.points.insert(part.points.end(), corners.begin(), corners.end());
    for (const Triangle& t : {Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
        part.triangles.push_back({v + t[0], v + t[1], v + t[2]});
}

void add_double_pyramid(Part& part, const std::array<Point, 5>& corners) {
    const auto v = static_cast<std::uint32_t>(part.points.size());
    part.points.insert(part.points.end(), corners.begin(), corners.end());
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t a = v + i, b = v + (i + 1) % 3;
        part.triangles.push_back({a, b, v + 3});
        part.triangles.push_back({b, a, v + 4});
    }
}

void add_box(Part& part, const Points& points, Bytes& bytes) {
    const auto v = static_cast<std::uint32_t>(part.points.size());
    std::array<double, 3> low{}, high{};
    for (unsigned k = 0; k < 3; ++k) {
        low[k] = bytes.between(-points.range(), points.range());
        high[k] = low[k] + bytes.between(1, 2);
    }
    for (unsigned i = 0; i < 8; ++i)
        part.points.push_back(
            points.placed({(i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1],
                           (i & 4) != 0 ? high[2] : low[2]}));
    constexpr std::uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& s : sides) {
        part.triangles.push_back({v + s[0], v + s[1], v + s[2]});
        part.triangles.push_back({v + s[0], v + s[2], v + s[3]});
    }
}

Soup soup(Bytes& bytes, std::size_t most) {
    Points points(bytes);
    Soup parts(1 + bytes.below(4));
    while (!bytes.empty()) {
        Soup before = parts;
        Part& to = parts[bytes.below(static_cast<unsigned>(parts.size()))];
        add_piece(parts, to, points, bytes);
        if (triangle_count(parts) > most) return before;
    }
    return parts;
}

Soup any_mesh(Bytes& bytes, std::size_t most) {
    switch (bytes.below(4)) {
    case 0:
        return crowd(bytes, most);
    case 1:
        return near_plane(bytes, most);
    case 2:
        return solids(bytes, most).operands;
    default:
        return soup(bytes, most);
    }
}

} // namespace terrane::fuzzing
