// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/optimisation/detail/cells.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::optimisation::detail {

std::array<std::uint32_t, 3> face_opposite(const Corners& cell, unsigned k) {
    constexpr std::array<std::array<unsigned, 3>, 4> faces{
        {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
    return {cell[faces[k][0]], cell[faces[k][1]], cell[faces[k][2]]};
}

namespace {

Point3 times(const Point3& p, int exponent) {
    return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
}

/// Returns the exponent of a power of two by which all points can be divided exactly, and are at
/// most 1 then: products of lengths neither overflow nor, but for tiny tetrahedra, underflow.
int exponent_for(std::span<const Point3> points) {
    double largest = 0;
    for (const Point3& p : points)
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    int exponent = 0;
    std::frexp(largest, &exponent);
    const bool exact = std::all_of(points.begin(), points.end(), [&](const Point3& p) {
        return times(times(p, -exponent), exponent) == p;
    });
    return exact ? exponent : 0;
}

} // namespace

/// A face with sorted corners, and whose it is.
struct Cells::Face {
    std::array<std::uint32_t, 3> corners{};
    std::uint32_t cell = none;
    unsigned k = 0;

    bool operator<(const Face& other) const { return corners < other.corners; }
};

Cells::Face Cells::face_of(const Corners& c, std::uint32_t cell, unsigned k) {
    Face face{face_opposite(c, k), cell, k};
    std::sort(face.corners.begin(), face.corners.end());
    return face;
}

Cells::Cells(const TetrahedralMesh& mesh, bool outside) :
    outside_(outside), exponent_(exponent_for(mesh.vertices)),
    is_fixed_(mesh.vertices.size(), false), cell_of_(mesh.vertices.size(), none),
    cells_(mesh.tetrahedra.begin(), mesh.tetrahedra.end()),
    beside_(cells_.size(), {none, none, none, none}), walls_(cells_.size(), 0),
    block_(mesh.block_of), changed_(cells_.size(), 0), touched_(mesh.vertices.size(), 0) {
    for (const Point3& p : mesh.vertices) points_.push_back(times(p, -exponent_));
    for (const Triangle& face : mesh.faces)
        for (const std::uint32_t v : face) is_fixed_[v] = true;
    for (std::uint32_t c = 0; c < cells_.size(); ++c)
        for (const std::uint32_t v : cells_[c]) cell_of_[v] = c;
    judge_by({});
    match_all();
    std::vector<std::array<std::uint32_t, 3>> walls;
    for (Triangle face : mesh.faces) {
        std::sort(face.begin(), face.end());
        walls.push_back({face[0], face[1], face[2]});
    }
    std::sort(walls.begin(), walls.end());
    for (std::uint32_t c = 0; c < cells_.size(); ++c)
        for (unsigned k = 0; k < 4; ++k)
            if (beside_[c][k] == none ||
                std::binary_search(walls.begin(), walls.end(), face_of(cells_[c], c, k).corners))
                walls_[c] = static_cast<std::uint8_t>(walls_[c] | 1U << k);
}

std::optional<Point3> Cells::free_place(std::uint32_t v, const Point3& p) const {
    const auto found = freedom_.place(v, times(p, exponent_));
    if (!found) return std::nullopt;
    return times(*found, -exponent_);
}

void Cells::judge_by(const Measure& by) {
    measure_ = by;
    quality_.resize(cells_.size());
    for (std::uint32_t c = 0; c < cells_.size(); ++c) {
        if (!is_alive(c)) continue;
        const Quality quality = measure(cells_[c]);
        quality_[c] = counts(c) && quality.is_trusted ? quality.value : HUGE_VAL;
    }
}

void Cells::match_all() {
    std::vector<Face> faces;
    faces.reserve(4 * cells_.size());
    for (std::uint32_t c = 0; c < cells_.size(); ++c)
        for (unsigned k = 0; k < 4; ++k) faces.push_back(face_of(cells_[c], c, k));
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 1; i < faces.size(); ++i)
        if (faces[i - 1].corners == faces[i].corners) connect(faces[i - 1], faces[i]);
}

void Cells::connect(const Face& one, const Face& other) {
    beside_[one.cell][one.k] = other.cell;
    beside_[other.cell][other.k] = one.cell;
}

bool Cells::is_positive(const Corners& c) const {
    return orient3d(points_[c[0]], points_[c[1]], points_[c[2]], points_[c[3]]) == Sign::Positive;
}

bool Cells::meets(const Corners& c, const Demand& demand) const {
    const Quality quality = measure(c);
    return quality.is_trusted && quality.value > demand.quality && quality.sine >= demand.sine &&
           is_positive(c);
}

double Cells::volume_of(const Corners& c) const {
    const Point3 &a = points_[c[0]], &b = points_[c[1]], &d = points_[c[2]], &e = points_[c[3]];
    return dot(minus(b, a), cross(minus(d, a), minus(e, a)));
}

std::vector<std::uint32_t> Cells::star(std::uint32_t v) const {
    std::vector<std::uint32_t> found{cell_of_[v]};
    found.reserve(32);
    std::array<std::uint64_t, 4> seen{}; // by the last eight bits: most are known not to be there
    const auto add = [&](std::uint32_t c) {
        std::uint64_t& word = seen[c >> 6 & 3];
        const std::uint64_t bit = std::uint64_t{1} << (c & 63);
        if ((word & bit) != 0 && std::find(found.begin(), found.end(), c) != found.end()) return;
        word |= bit;
        found.push_back(c);
    };
    seen[found[0] >> 6 & 3] = std::uint64_t{1} << (found[0] & 63);
    for (std::size_t next = 0; next < found.size();) { // more are found on the way
        const std::uint32_t c = found[next++];
        for (unsigned k = 0; k < 4; ++k)
            if (cells_[c][k] != v && beside_[c][k] != none) add(beside_[c][k]);
    }
    return found;
}

Point3 Cells::place(std::uint32_t v) const {
    return times(points_[v], exponent_);
}

Point3 Cells::representable(const Point3& p) const {
    return times(times(p, exponent_), -exponent_);
}

std::uint32_t Cells::add_vertex(const Point3& p) {
    points_.push_back(p);
    is_fixed_.push_back(false);
    cell_of_.push_back(none);
    touched_.push_back(0);
    return static_cast<std::uint32_t>(points_.size() - 1);
}

void Cells::remove_last_vertex() {
    points_.pop_back();
    is_fixed_.pop_back();
    cell_of_.pop_back();
    touched_.pop_back();
}

void Cells::add_cell() {
    cells_.push_back({none, none, none, none});
    beside_.push_back({none, none, none, none});
    walls_.push_back(0);
    block_.push_back(0);
    quality_.push_back(0);
    changed_.push_back(0);
}

void Cells::set_wall(const Face& face) {
    walls_[face.cell] = static_cast<std::uint8_t>(walls_[face.cell] | 1U << face.k);
}

void Cells::store(std::uint32_t c, const Corners& corners, std::uint32_t block) {
    cells_[c] = corners;
    beside_[c] = {none, none, none, none};
    walls_[c] = 0;
    block_[c] = block;
    quality_[c] = counts(c) ? quality_of(corners) : HUGE_VAL;
    for (const std::uint32_t v : corners) cell_of_[v] = c;
    touch(c);
}

void Cells::touch(std::uint32_t c) {
    changed_[c] = time_;
    for (const std::uint32_t v : cells_[c]) touched_[v] = time_;
}

/// How new cells fit into the hole that old ones leave.
struct Cells::Fit {
    /// A face of the hole's hull, as seen from an old cell.
    struct Outer {
        Face face;
        std::uint32_t behind = none; ///< the cell behind it
        unsigned back = 0;           ///< its corner that is opposite
        bool is_wall = false;

        bool operator<(const Outer& other) const { return face < other.face; }
    };
    /// Two new cells that share a face.
    struct Inner {
        std::size_t one = 0, other = 0; ///< indices into `faces`
        bool is_wall = false;
    };

    std::vector<Outer> outer;                        ///< sorted
    std::vector<std::array<std::uint32_t, 3>> walls; ///< between two old cells: sorted, each twice
    std::vector<Face> faces; ///< of the new cells, which count as cells 0, 1, ...; sorted
    std::vector<Inner> inner;
    std::vector<std::array<std::size_t, 2>> shell; ///< face and outer one
};

void Cells::collect_old(std::span<const std::uint32_t> old, Fit& fit) const {
    for (const std::uint32_t c : old)
        for (unsigned k = 0; k < 4; ++k) {
            const std::uint32_t next = beside_[c][k];
            const Face face = face_of(cells_[c], c, k);
            if (next != none && std::find(old.begin(), old.end(), next) != old.end()) {
                if (is_wall(c, k)) fit.walls.push_back(face.corners);
                continue;
            }
            unsigned back = 0;
            while (next != none && face_of(cells_[next], next, back).corners != face.corners)
                ++back;
            fit.outer.push_back({face, next, back, is_wall(c, k)});
        }
    std::sort(fit.outer.begin(), fit.outer.end());
    std::sort(fit.walls.begin(), fit.walls.end());
}

std::optional<Cells::Fit> Cells::fit(std::span<const std::uint32_t> old,
                                     std::span<const Corners> added) const {
    Fit fit;
    collect_old(old, fit);
    auto& faces = fit.faces;
    for (std::uint32_t i = 0; i < added.size(); ++i)
        for (unsigned k = 0; k < 4; ++k) faces.push_back(face_of(added[i], i, k));
    std::sort(faces.begin(), faces.end());
    std::size_t walls = 0;
    for (std::size_t i = 0; i < faces.size();) {
        std::size_t end = i + 1;
        while (end < faces.size() && faces[end].corners == faces[i].corners) ++end;
        const auto at = std::lower_bound(fit.outer.begin(), fit.outer.end(), Fit::Outer{faces[i]});
        const bool on_shell = at != fit.outer.end() && at->face.corners == faces[i].corners;
        if (end - i != (on_shell ? 1U : 2U)) return std::nullopt;
        if (on_shell) {
            fit.shell.push_back({i, static_cast<std::size_t>(at - fit.outer.begin())});
        } else {
            const bool is_wall =
                std::binary_search(fit.walls.begin(), fit.walls.end(), faces[i].corners);
            fit.inner.push_back({i, i + 1, is_wall});
            walls += is_wall ? 2 : 0;
        }
        i = end;
    }
    if (fit.shell.size() != fit.outer.size() || walls != fit.walls.size()) return std::nullopt;
    return fit;
}

std::vector<std::uint32_t> Cells::renew(std::span<const std::uint32_t> old, std::size_t count) {
    std::vector<std::uint32_t> numbers(old.begin(), old.end());
    for (const std::uint32_t c : old) {
        touch(c);
        cells_[c] = {none, none, none, none};
    }
    while (numbers.size() > count) {
        free_.push_back(numbers.back());
        numbers.pop_back();
    }
    while (numbers.size() < count) {
        if (free_.empty()) {
            free_.push_back(static_cast<std::uint32_t>(cells_.size()));
            add_cell();
        }
        numbers.push_back(free_.back());
        free_.pop_back();
    }
    return numbers;
}

bool Cells::replace(std::span<const std::uint32_t> old, std::span<const Corners> added,
                    const Demand& demand) {
    for (const Corners& c : added)
        if (!meets(c, demand)) return false;
    auto fitting = fit(old, added);
    if (!fitting) return false;
    const std::uint32_t block = block_[old[0]];
    ++time_;
    const auto numbers = renew(old, added.size());
    for (std::size_t i = 0; i < added.size(); ++i) store(numbers[i], added[i], block);
    for (Face& f : fitting->faces) f.cell = numbers[f.cell];
    for (const auto& [one, other, is_wall] : fitting->inner) {
        connect(fitting->faces[one], fitting->faces[other]);
        if (!is_wall) continue;
        set_wall(fitting->faces[one]);
        set_wall(fitting->faces[other]);
    }
    for (const auto& [f, o] : fitting->shell) {
        const Face& face = fitting->faces[f];
        const auto& outer = fitting->outer[o];
        if (outer.is_wall) set_wall(face);
        beside_[face.cell][face.k] = outer.behind;
        if (outer.behind != none) beside_[outer.behind][outer.back] = face.cell;
    }
    return true;
}

bool Cells::move(std::uint32_t v, const Point3& to, const Demand& demand) {
    const auto around = star(v);
    const Point3 from = points_[v];
    points_[v] = to;
    for (const std::uint32_t c : around)
        if (!(counts(c) ? meets(cells_[c], demand) : is_positive(cells_[c]))) {
            points_[v] = from;
            return false;
        }
    ++time_;
    for (const std::uint32_t c : around) {
        if (counts(c)) quality_[c] = quality_of(cells_[c]);
        touch(c);
    }
    return true;
}

void Cells::write(TetrahedralMesh& mesh) const {
    std::vector<bool> used(points_.size(), false);
    for (std::size_t v = 0; v < points_.size(); ++v) used[v] = is_fixed_[v];
    for (const Corners& c : cells_)
        if (c[0] != none)
            for (const std::uint32_t v : c) used[v] = true;
    std::vector<std::uint32_t> name(points_.size(), none);
    mesh.vertices.clear();
    for (std::size_t v = 0; v < points_.size(); ++v)
        if (used[v]) {
            name[v] = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back(place(static_cast<std::uint32_t>(v)));
        }
    mesh.tetrahedra.clear();
    mesh.block_of.clear();
    for (std::uint32_t c = 0; c < cells_.size(); ++c) {
        if (cells_[c][0] == none) continue;
        auto& t = mesh.tetrahedra.emplace_back();
        for (unsigned k = 0; k < 4; ++k) t[k] = name[cells_[c][k]];
        mesh.block_of.push_back(block_[c]);
    }
    for (Triangle& face : mesh.faces)
        for (std::uint32_t& v : face) v = name[v];
}

} // namespace terrane::optimisation::detail
