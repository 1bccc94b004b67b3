// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/zero_level.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/joining/disk_mesh.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>

namespace terrane::rbf::detail {
namespace {

constexpr std::int64_t most_steps = (1 << 20) - 4; ///< of the lattice along an axis: 20 bits

/// A lattice point, and the cube of which it is the lowest corner.
struct Node {
    std::int64_t i = 0, j = 0, k = 0;

    [[nodiscard]] std::uint64_t key() const {
        return static_cast<std::uint64_t>(i) | static_cast<std::uint64_t>(j) << 20U |
               static_cast<std::uint64_t>(k) << 40U;
    }
    /// Returns corner 0..7 of its cube: bit 0 is a step in i, bit 1 in j, bit 2 in k.
    [[nodiscard]] Node corner(unsigned c) const {
        return {i + (c & 1U), j + (c >> 1U & 1U), k + (c >> 2U & 1U)};
    }
};

using CubeEdge = std::array<std::uint8_t, 2>; ///< two corners of a cube, the lower one first
using CubeTriangle = std::array<CubeEdge, 3>;

/// Returns twice the midpoint of an edge of the cube.
Point3 middle(const CubeEdge& e) {
    const auto bits = [&](unsigned axis) {
        return static_cast<double>((e[0] >> axis & 1) + (e[1] >> axis & 1));
    };
    return {bits(0), bits(1), bits(2)};
}

/// For each tetrahedron along the diagonal of a cube and each set of positive corners: the
/// triangles that separate those from the others, with their front to the positive ones.
class TetrahedronCases {
public:
    TetrahedronCases() {
        constexpr std::array<std::array<std::uint8_t, 4>, 6> paths{
            {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};
        for (std::size_t t = 0; t < 6; ++t)
            for (unsigned set = 1; set < 15; ++set) fill(paths[t], set, cases_[t][set]);
        paths_ = paths;
    }
    [[nodiscard]] const std::vector<CubeTriangle>& at(std::size_t tetrahedron,
                                                      unsigned positive) const {
        return cases_[tetrahedron][positive];
    }
    [[nodiscard]] const std::array<std::uint8_t, 4>& corners(std::size_t tetrahedron) const {
        return paths_[tetrahedron];
    }

private:
    static void fill(const std::array<std::uint8_t, 4>& corners, unsigned set,
                     std::vector<CubeTriangle>& made) {
        std::vector<std::uint8_t> up, down;
        for (unsigned c = 0; c < 4; ++c) ((set >> c & 1U) != 0 ? up : down).push_back(corners[c]);
        const auto edge = [](std::uint8_t a, std::uint8_t b) {
            return a < b ? CubeEdge{a, b} : CubeEdge{b, a};
        };
        if (up.size() == 2) {
            made.push_back({edge(up[0], down[0]), edge(up[0], down[1]), edge(up[1], down[1])});
            made.push_back({edge(up[0], down[0]), edge(up[1], down[1]), edge(up[1], down[0])});
        } else {
            const auto& lone = up.size() == 1 ? up : down;
            const auto& rest = up.size() == 1 ? down : up;
            made.push_back(
                {edge(lone[0], rest[0]), edge(lone[0], rest[1]), edge(lone[0], rest[2])});
        }
        const auto corner = [](std::uint8_t c) { return middle({c, c}); };
        for (CubeTriangle& t : made) { // small integers: exact
            const Point3 a = middle(t[0]), b = middle(t[1]), c = middle(t[2]);
            const Point3 normal = cross(minus(b, a), minus(c, a));
            if (dot(normal, minus(corner(up[0]), a)) < 0) std::swap(t[1], t[2]);
        }
    }

    std::array<std::array<std::vector<CubeTriangle>, 16>, 6> cases_;
    std::array<std::array<std::uint8_t, 4>, 6> paths_{};
};

class Marcher {
public:
    Marcher(const SpaceFunction& function, const ZeroLevelOptions& options, const Run& run) :
        function_(function), options_(options), run_(run) {}

    Result<Surface> operator()() {
        if (const auto done = lay_lattice(); !done) return done.error();
        if (const auto done = follow(); !done) return done.error();
        if (cubes_.empty())
            return Error{ErrorCode::nothing_to_do, "the function has no zero level near the seeds",
                         ""};
        return triangulate();
    }

private:
    [[nodiscard]] Point3 place(const Node& n) const {
        return {origin_.x + static_cast<double>(n.i) * step_,
                origin_.y + static_cast<double>(n.j) * step_,
                origin_.z + static_cast<double>(n.k) * step_};
    }

    /// Lays the lattice around the seeds, with room on all sides of half the longest side of their
    /// box.
    Status lay_lattice() {
        step_ = constants.lattice_step * options_.size;
        if (!(step_ > 0) || options_.seeds.empty())
            return Error{ErrorCode::bad_option, "the zero level needs an edge length and seeds",
                         ""};
        Point3 low = options_.seeds[0], high = low;
        for (const Point3& p : options_.seeds) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        const double room =
            constants.domain_share * std::max({high.x - low.x, high.y - low.y, high.z - low.z}) +
            constants.domain_steps * step_;
        origin_ = {low.x - room, low.y - room, low.z - room};
        const double most = std::max({high.x - low.x, high.y - low.y, high.z - low.z}) + 2 * room;
        if (!(most / step_ < static_cast<double>(most_steps)))
            return Error{ErrorCode::bad_option, "the edge length is too small for the extent", ""};
        const auto steps = [&](double from, double to) {
            return static_cast<std::int64_t>(std::ceil((to + room - from) / step_));
        };
        last_ = {steps(origin_.x, high.x), steps(origin_.y, high.y), steps(origin_.z, high.z)};
        return Done{};
    }

    [[nodiscard]] bool in_lattice(const Node& n) const {
        return n.i >= 0 && n.j >= 0 && n.k >= 0 && n.i < last_.i && n.j < last_.j && n.k < last_.k;
    }

    /// Evaluates the function at the corners of the cubes that have no value yet.
    void evaluate(std::span<const Node> cubes) {
        std::vector<Node> nodes;
        for (const Node& cube : cubes)
            for (unsigned c = 0; c < 8; ++c)
                if (values_.try_emplace(cube.corner(c).key(), 0.0).second)
                    nodes.push_back(cube.corner(c));
        std::vector<double> values(nodes.size());
        for_blocks<char>(nodes.size(), 256, run_, [&](std::size_t a, std::size_t b) {
            const ToNearest mode;
            for (std::size_t n = a; n < b; ++n) values[n] = function_.value(place(nodes[n]));
            return '\0';
        });
        for (std::size_t n = 0; n < nodes.size(); ++n) values_[nodes[n].key()] = values[n];
    }

    /// Returns the signs of the corners; bit c is set if corner c is positive. 0 counts as
    /// positive, so no corner lies on the level.
    [[nodiscard]] unsigned signs(const Node& cube) const {
        unsigned bits = 0;
        for (unsigned c = 0; c < 8; ++c)
            if (values_.at(cube.corner(c).key()) >= 0) bits |= 1U << c;
        return bits;
    }

    [[nodiscard]] bool left_out(const Node& cube) const {
        const Point3 p = place(cube);
        return options_.leave &&
               options_.leave({p.x + step_ / 2, p.y + step_ / 2, p.z + step_ / 2});
    }

    /// Collects the cubes that the level crosses, in the order in which they are reached.
    Status follow() {
        std::unordered_set<std::uint64_t> seen;
        std::vector<Node> front;
        const auto reach = [&](const Node& n) {
            if (in_lattice(n) && seen.insert(n.key()).second) front.push_back(n);
        };
        for (const Point3& p : options_.seeds) {
            const auto at = [&](double x, double from) {
                return static_cast<std::int64_t>(std::floor((x - from) / step_));
            };
            const Node n{at(p.x, origin_.x), at(p.y, origin_.y), at(p.z, origin_.z)};
            for (const std::int64_t i : {-1, 0, 1})
                for (const std::int64_t j : {-1, 0, 1})
                    for (const std::int64_t k : {-1, 0, 1}) reach({n.i + i, n.j + j, n.k + k});
        }
        while (!front.empty()) {
            if (run_.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
            evaluate(front);
            std::vector<Node> here;
            here.swap(front);
            for (const Node& cube : here) {
                const unsigned bits = signs(cube);
                if (bits == 0 || bits == 255 || left_out(cube)) continue;
                cubes_.push_back(cube);
                for (unsigned axis = 0; axis < 3; ++axis) spread(cube, bits, axis, reach);
            }
            if (cubes_.size() > options_.most_cubes)
                return Error{ErrorCode::unsupported,
                             "the zero level is too large for its edge length", ""};
        }
        return Done{};
    }

    /// Reaches the two neighbours along an axis through faces that the level crosses.
    template <class Reach>
    static void spread(const Node& cube, unsigned bits, unsigned axis, const Reach& reach) {
        constexpr std::array<unsigned, 3> high{0b10101010, 0b11001100, 0b11110000};
        const auto mixed = [&](unsigned face) {
            return (bits & face) != 0 && (bits & face) != face;
        };
        const auto moved = [&](std::int64_t by) {
            return Node{cube.i + (axis == 0 ? by : 0), cube.j + (axis == 1 ? by : 0),
                        cube.k + (axis == 2 ? by : 0)};
        };
        if (mixed(high[axis])) reach(moved(1));
        if (mixed(high[axis] ^ 255U)) reach(moved(-1));
    }

    Surface triangulate() {
        const TetrahedronCases cases;
        Surface s;
        std::unordered_map<std::uint64_t, std::uint32_t> known; // by lower corner and direction
        const auto vertex = [&](const Node& cube, const CubeEdge& e) {
            const Node from = cube.corner(e[0]), to = cube.corner(e[1]);
            const std::uint64_t key = from.key() << 3U | static_cast<unsigned>(e[1] - e[0]);
            const auto [at, added] =
                known.try_emplace(key, static_cast<std::uint32_t>(s.vertices.size()));
            if (!added) return at->second;
            const double a = values_.at(from.key()), b = values_.at(to.key());
            const double t = std::clamp(a / (a - b), constants.least_cut, 1 - constants.least_cut);
            const Point3 p = place(from), q = place(to);
            s.vertices.push_back(
                {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)});
            return at->second;
        };
        for (const Node& cube : cubes_) {
            const unsigned bits = signs(cube);
            for (std::size_t t = 0; t < 6; ++t) {
                unsigned positive = 0;
                for (unsigned c = 0; c < 4; ++c)
                    positive |= (bits >> cases.corners(t)[c] & 1U) << c;
                for (const CubeTriangle& made : cases.at(t, positive))
                    s.triangles.push_back(
                        {vertex(cube, made[0]), vertex(cube, made[1]), vertex(cube, made[2])});
            }
        }
        return s;
    }

    const SpaceFunction& function_;
    const ZeroLevelOptions& options_;
    const Run& run_;
    double step_ = 0;
    Point3 origin_;
    Node last_; ///< number of cubes along each axis
    std::unordered_map<std::uint64_t, double> values_;
    std::vector<Node> cubes_;
};

/// Removes vertices that are nearer to a neighbour than `least`. One vertex after the other is
/// kept, and those near it are removed, so that each removed vertex has a kept one near it. Border
/// vertices come first, as they must stay.
class Thinning {
public:
    Thinning(DiskMesh& mesh, double least) :
        mesh_(mesh), least_(least), stays_(mesh.points().size(), false) {}

    /// Ends early if the run is stopped.
    void operator()(const Run& run) {
        std::vector<std::uint32_t> inner;
        for (std::uint32_t v = 0; v < stays_.size(); ++v)
            if (mesh_.is_at_border(v))
                stays_[v] = true;
            else
                inner.push_back(v);
        for (std::uint32_t v = 0; v < stays_.size(); ++v)
            if (stays_[v] && mesh_.is_alive(v)) clear_round(v);
        for (const std::uint32_t v : inner) {
            if (run.stop.stop_requested()) return;
            if (!mesh_.is_alive(v) || has_near(v)) continue;
            stays_[v] = true;
            clear_round(v);
        }
    }

private:
    [[nodiscard]] bool is_near(std::uint32_t v, std::uint32_t w) const {
        return length(minus(mesh_.points()[v], mesh_.points()[w])) < least_;
    }
    /// Removes v if a kept vertex is near.
    bool has_near(std::uint32_t v) {
        const auto beside = mesh_.neighbours(v);
        return std::any_of(beside.begin(), beside.end(),
                           [&](std::uint32_t w) { return stays_[w] && is_near(v, w); }) &&
               mesh_.remove(v);
    }
    void clear_round(std::uint32_t v) {
        for (bool changed = true; changed;) {
            changed = false;
            for (const std::uint32_t w : mesh_.neighbours(v))
                changed = (!stays_[w] && is_near(v, w) && mesh_.remove(w)) || changed;
        }
    }

    DiskMesh& mesh_;
    double least_;
    std::vector<bool> stays_; ///< per vertex
};

/// Moves a point along the gradient to the level, by at most `most` in a step. All steps use the
/// gradient at the start; two of them leave about the cube of the error.
Point3 onto_level(const SpaceFunction& function, Point3 p, double most, int steps) {
    const Point3 g = function.gradient(p);
    const double square = dot(g, g);
    if (!(square > 0)) return p;
    for (int k = 0; k < steps; ++k) {
        const double f = function.value(p) / square;
        const double size = std::fabs(f) * std::sqrt(square);
        const double share = size > most ? most / size : 1;
        p = {p.x - share * f * g.x, p.y - share * f * g.y, p.z - share * f * g.z};
    }
    return p;
}

/// Moves each inner vertex to the mean of its neighbours and to the level, unless that flips a
/// triangle or makes one much worse. Ends early if the run is stopped.
void smooth(DiskMesh& mesh, const SpaceFunction& function, double size, bool move_to_middle,
            const Run& run) {
    const auto n = static_cast<std::uint32_t>(mesh.points().size());
    for (std::uint32_t v = 0; v < n; ++v) {
        if (run.stop.stop_requested()) return;
        if (!mesh.is_alive(v)) continue;
        Point3 p = mesh.points()[v];
        if (move_to_middle && !mesh.is_at_border(v)) {
            const auto near = mesh.neighbours(v);
            p = {};
            for (const std::uint32_t w : near) {
                const Point3& q = mesh.points()[w];
                p = {p.x + q.x, p.y + q.y, p.z + q.z};
            }
            const auto count = static_cast<double>(near.size());
            p = {p.x / count, p.y / count, p.z / count};
        }
        // The distance from the level matters more than shape; vertices that move on need not be on
        // it yet.
        const int steps = move_to_middle ? 1 : 2;
        mesh.move_if_sound(v, onto_level(function, p, size / constants.level_part, steps),
                           move_to_middle ? constants.least_moved_shape
                                          : constants.least_levelled_shape);
    }
}

/// Copies the mesh without unused vertices.
Surface compact(const DiskMesh& mesh) {
    Surface s;
    std::vector<std::uint32_t> name(mesh.points().size());
    for (std::uint32_t v = 0; v < name.size(); ++v)
        if (mesh.is_alive(v)) {
            name[v] = static_cast<std::uint32_t>(s.vertices.size());
            s.vertices.push_back(mesh.points()[v]);
        }
    for (const Triangle& t : mesh.triangles())
        s.triangles.push_back({name[t[0]], name[t[1]], name[t[2]]});
    return s;
}

} // namespace

Result<Surface> zero_level(const SpaceFunction& function, const ZeroLevelOptions& options,
                           const Run& run) {
    auto marched = Marcher(function, options, run)();
    if (!marched) return marched;
    DiskMesh mesh(std::move(marched.value().vertices), std::move(marched.value().triangles));
    Thinning(mesh, constants.thinning * options.size)(run);
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < mesh.points().size(); ++v)
        if (mesh.is_alive(v)) all.push_back(v);
    for (const bool move : {false, true, true, false}) {
        if (run.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        smooth(mesh, function, options.size, move, run);
        if (!run.stop.stop_requested()) mesh.improve(all);
    }
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    return compact(mesh);
}

} // namespace terrane::rbf::detail
