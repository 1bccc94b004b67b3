// SPDX-License-Identifier: MIT
//
// Closed solids made of cubes, whose volumes are known.
#include <terrane/fuzzing/meshes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace terrane::fuzzing {

namespace {

using Cell = std::array<int, 3>;

/// A set of cubes of side 2 in a grid. Their corners are even; solids are shifted by any integers, so that unit cubes
/// tell which space two of them share.
class Cubes {
public:
    explicit Cubes(Bytes& bytes);
    /// A single cube.
    Cubes() : size_(1), filled_(1, true) {}

    [[nodiscard]] bool has(const Cell& c) const {
        for (const int x : c)
            if (x < 0 || x >= size_) return false;
        return filled_[index(c)];
    }
    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(std::count(filled_.begin(), filled_.end(), true));
    }

private:
    [[nodiscard]] std::size_t index(const Cell& c) const {
        const int at = (c[0] * size_ + c[1]) * size_ + c[2];
        return static_cast<std::size_t>(at);
    }
    /// Tells whether shape `how` has the cell.
    [[nodiscard]] bool in_shape(unsigned how, const Cell& c) const {
        int outermost = 0, ends = 0; // the distance from the centre; coordinates at an end
        for (const int x : c) {
            outermost = std::max(outermost, std::abs(2 * x - size_ + 1));
            ends += x == 0 || x == size_ - 1 ? 1 : 0;
        }
        if (how == 1) return (size_ - 1 - outermost) / 2 % 2 == 0; // shells in shells
        if (how == 2) return ends >= 2; // the edges of a cube: holes through it
        if (how == 3) return ends == 1 || ends == 3;
        return true;
    }

    int size_;
    std::vector<bool> filled_;
};

Cubes::Cubes(Bytes& bytes) : size_(1) {
    const unsigned how = bytes.byte();
    size_ = how % 8 < 4 ? 1 + static_cast<int>(how / 8 % 3) : 3 + static_cast<int>(how / 8 % 3);
    const int cells = size_ * size_ * size_;
    filled_.assign(static_cast<std::size_t>(cells), false);
    unsigned bits = 0, left = 0;
    Cell c{};
    for (c[0] = 0; c[0] < size_; ++c[0])
        for (c[1] = 0; c[1] < size_; ++c[1])
            for (c[2] = 0; c[2] < size_; ++c[2]) {
                if (how % 8 < 4 && left == 0) {
                    bits = bytes.byte();
                    left = 8;
                }
                // Bytes fill small grids; larger ones have a shape.
                filled_[index(c)] = how % 8 < 4 ? (bits & 1) != 0 : in_shape(how % 4, c);
                bits >>= 1;
                left = left == 0 ? 0 : left - 1;
            }
    for (unsigned edits = how / 128 * bytes.below(8); edits > 0; --edits) {
        const std::size_t at = bytes.byte() % filled_.size();
        filled_[at] = !filled_[at];
    }
}

/// Lattice points of a solid, each once.
class Corners {
public:
    std::uint32_t index(const Cell& at) {
        const auto [found, is_new] =
            index_.try_emplace(at, static_cast<std::uint32_t>(points.size()));
        if (is_new) points.push_back(at);
        return found->second;
    }
    std::vector<Cell> points;

private:
    std::map<Cell, std::uint32_t> index_;
};

/// Appends the square between the cell and its neighbour along `axis`, up or down, as it is seen from outside.
void add_side(std::vector<Triangle>& triangles, Corners& corners, Cell cell, unsigned axis, bool up,
              bool other) {
    const unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int& x : cell) x *= 2;
    if (up) cell[axis] += 2;
    std::array<std::uint32_t, 4> q{};
    constexpr std::array<std::array<int, 2>, 4> round{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
    for (unsigned i = 0; i < 4; ++i) {
        Cell c = cell;
        c[u] += round[i][0];
        c[v] += round[i][1];
        q[i] = corners.index(c);
    }
    if (!up) std::swap(q[1], q[3]);
    const unsigned k = other ? 1 : 0;
    triangles.push_back({q[k], q[k + 1], q[k + 2]});
    triangles.push_back({q[k], q[k + 2], q[(k + 3) % 4]});
}

/// Calls visit(cell) for all cells of a grid.
template <class Visit>
void for_each_cell(int size, const Visit& visit) {
    for (int x = 0; x < size; ++x)
        for (int y = 0; y < size; ++y)
            for (int z = 0; z < size; ++z) visit(Cell{x, y, z});
}

/// Returns the boundary of the cubes; `place` makes points of lattice points.
template <class Place>
Part boundary(const Cubes& cubes, unsigned diagonals, const Place& place) {
    Part part;
    Corners corners;
    for_each_cell(cubes.size(), [&](const Cell& c) {
        for (unsigned axis = 0; axis < 3; ++axis)
            for (const bool up : {false, true}) {
                Cell next = c;
                next[axis] += up ? 1 : -1;
                const bool other = (diagonals >> (part.triangles.size() / 2 % 8) & 1) != 0;
                if (cubes.has(c) && !cubes.has(next))
                    add_side(part.triangles, corners, c, axis, up, other);
            }
    });
    for (const Cell& c : corners.points) part.points.push_back(place(c));
    return part;
}

/// Returns how many unit cubes two solids share, of which the second is shifted.
double common_volume(const Cubes& a, const Cubes& b, const Cell& shift) {
    double count = 0;
    for_each_cell(2 * a.size(), [&](const Cell& c) {
        const auto half = [](int x) { return x < 0 ? -1 : x / 2; };
        const Cell in_b{half(c[0] - shift[0]), half(c[1] - shift[1]), half(c[2] - shift[2])};
        if (a.has({c[0] / 2, c[1] / 2, c[2] / 2}) && b.has(in_b)) ++count;
    });
    return count;
}

} // namespace

Solids solids(Bytes& bytes, std::size_t most) {
    const Frame frame(bytes);
    const Cell shift{bytes.between(-6, 6), bytes.between(-6, 6), bytes.between(-6, 6)};
    const unsigned how = bytes.byte(), diagonals = bytes.byte();
    Cubes a(bytes), b = how % 8 == 7 ? a : Cubes(bytes);
    const int shear = how / 8 % 4 == 3 ? bytes.between(-2, 2) : 0;
    const auto placed = [&](Cell c, const Cell& by) {
        for (unsigned k = 0; k < 3; ++k) c[k] += by[k];
        // Integers stay integers, planes planes, and volumes as they are.
        const int x = c[0] + shear * c[1], y = c[1] + shear * c[2];
        return frame({double(x), double(y), double(c[2])});
    };
    const auto made = [&](const Cubes& cubes, const Cell& by) {
        return boundary(cubes, diagonals, [&](const Cell& c) { return placed(c, by); });
    };
    Solids result{{made(a, {}), made(b, shift)}, {}, frame.exact(), frame.exponent()};
    if (triangle_count(result.operands) > most) {
        a = b = Cubes();
        result.operands = {made(a, {}), made(b, shift)};
    }
    const double volume_a = 8.0 * static_cast<double>(a.count()),
                 volume_b = 8.0 * static_cast<double>(b.count()),
                 common = common_volume(a, b, shift);
    result.volumes = {volume_a, volume_b,          volume_a + volume_b - common,
                      common,   volume_a - common, volume_a + volume_b - 2 * common};
    return result;
}

} // namespace terrane::fuzzing
