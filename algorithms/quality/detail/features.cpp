// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/features.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::quality::detail {
namespace {

double angle_between(const Point3& a, const Point3& b) {
    const Point3 n = cross(a, b);
    return std::atan2(std::hypot(n.x, n.y, n.z), dot(a, b));
}

template <class T>
bool same_list(const IndexLists<T>& lists, std::uint32_t i, std::uint32_t j) {
    return std::equal(lists[i].begin(), lists[i].end(), lists[j].begin(), lists[j].end());
}

class Finder {
public:
    Finder(const Mesh& mesh, const FeatureAngles& angles, const Run& run) :
        mesh_(mesh), angles_(angles), run_(run),
        sides_(group_edges(mesh.triangles, mesh.vertices.size(), run)) {}

    Features operator()() {
        out_.triangles = mesh_.triangles;
        out_.across.assign(mesh_.triangles.size(), {none, none, none});
        find_curve_edges();
        find_sheets();
        orient_consistently();
        find_corners();
        trace_curves();
        return std::move(out_);
    }

private:
    /// Returns the corner of triangle t at which its edge (a, b) starts, in either direction.
    [[nodiscard]] std::size_t edge_place(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
        const Triangle& c = out_.triangles[t];
        for (std::size_t i = 0; i < 3; ++i)
            if ((c[i] == a && c[(i + 1) % 3] == b) || (c[i] == b && c[(i + 1) % 3] == a)) return i;
        return 0;
    }

    [[nodiscard]] bool is_crease(std::uint32_t low, std::uint32_t high, std::uint32_t t,
                                 std::uint32_t u) const {
        const auto& points = mesh_.vertices;
        const auto normal = [&](std::uint32_t k) {
            const Triangle& c = mesh_.triangles[k];
            return cross(minus(points[c[1]], points[c[0]]), minus(points[c[2]], points[c[0]]));
        };
        const bool alike =
            runs_along(mesh_.triangles[t], low, high) != runs_along(mesh_.triangles[u], low, high);
        const Point3 a = normal(t), b = normal(u);
        return angle_between(a, alike ? b : Point3{-b.x, -b.y, -b.z}) > angles_.crease;
    }

    [[nodiscard]] bool is_curve_edge(std::uint32_t low, std::uint32_t high,
                                     std::span<const EdgeSides::Side> sides) const {
        if (sides.size() != 2) return true;
        const std::uint32_t t = sides[0].triangle, u = sides[1].triangle;
        if (!same_list(mesh_.surfaces_of, t, u)) return true;
        if (mesh_.regions_of.size() > 0 && !same_list(mesh_.regions_of, t, u)) return true;
        if (std::binary_search(mesh_.intersection_edges.begin(), mesh_.intersection_edges.end(),
                               Edge{low, high}))
            return true;
        return is_crease(low, high, t, u);
    }

    void find_curve_edges() {
        sides_.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (is_curve_edge(low, high, sides)) {
                out_.edges.push_back({low, high});
                return;
            }
            const std::uint32_t t = sides[0].triangle, u = sides[1].triangle;
            out_.across[t][edge_place(t, low, high)] = u;
            out_.across[u][edge_place(u, low, high)] = t;
        });
    }

    void find_sheets() {
        DisjointSets sets(mesh_.triangles.size());
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            for (const std::uint32_t u : out_.across[t])
                if (u != none) sets.join(t, u);
        out_.sheet_of.resize(mesh_.triangles.size());
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const std::uint32_t root = sets.find(t);
            if (root == t) out_.first_of.push_back(t);
            out_.sheet_of[t] = root == t ? static_cast<std::uint32_t>(out_.first_of.size() - 1)
                                         : out_.sheet_of[root];
        }
    }

    /// Orients all triangles of each sheet like its first one; an edge across which that is
    /// impossible becomes a curve edge. The nearest triangles come first, so that such edges form a
    /// short curve, however the triangles are numbered.
    void orient_consistently() {
        std::vector<bool> seen(mesh_.triangles.size(), false);
        std::vector<std::uint32_t> front;
        bool cut = false;
        for (const std::uint32_t first : out_.first_of) {
            front.assign(1, first);
            seen[first] = true;
            for (std::size_t k = 0; k < front.size(); ++k)
                for (std::size_t i = 0; i < 3; ++i) cut = spread(front[k], i, seen, front) || cut;
        }
        if (cut) std::sort(out_.edges.begin(), out_.edges.end());
    }

    /// Orients the neighbour across edge i. Returns whether the edge had to be cut.
    bool spread(std::uint32_t t, std::size_t i, std::vector<bool>& seen,
                std::vector<std::uint32_t>& front) {
        const std::uint32_t u = out_.across[t][i];
        if (u == none) return false;
        const std::uint32_t a = out_.triangles[t][i], b = out_.triangles[t][(i + 1) % 3];
        const bool alike = runs_along(out_.triangles[u], b, a);
        if (!seen[u]) {
            seen[u] = true;
            front.push_back(u);
            if (!alike) {
                std::swap(out_.triangles[u][1], out_.triangles[u][2]);
                std::swap(out_.across[u][0], out_.across[u][2]);
            }
            return false;
        }
        if (alike) return false;
        out_.across[u][edge_place(u, a, b)] = none;
        out_.across[t][i] = none;
        out_.edges.push_back({std::min(a, b), std::max(a, b)});
        return true;
    }

    // ---- Vertices

    void find_corners() {
        const std::size_t count = mesh_.vertices.size();
        curve_edges_at_.assign(count, {});
        for (const Edge& e : out_.edges) {
            curve_edges_at_[e[0]].push_back(e[1]);
            curve_edges_at_[e[1]].push_back(e[0]);
        }
        std::vector<std::vector<std::uint32_t>> star(count);
        for (std::uint32_t t = 0; t < out_.triangles.size(); ++t)
            for (const std::uint32_t v : out_.triangles[t]) star[v].push_back(t);
        out_.kinds.assign(count, VertexKind::unused);
        for_ranges(count, run_, [&](std::size_t first, std::size_t last) {
            for (auto v = static_cast<std::uint32_t>(first); v < last; ++v)
                if (!star[v].empty()) out_.kinds[v] = kind_of_vertex(v, star[v]);
        });
    }

    [[nodiscard]] VertexKind kind_of_vertex(std::uint32_t v,
                                            const std::vector<std::uint32_t>& star) const {
        const auto& ends = curve_edges_at_[v];
        if (!ends.empty() && ends.size() != 2) return VertexKind::corner;
        if (!fans_are_plain(v, star)) return VertexKind::corner;
        if (ends.empty()) return VertexKind::inner;
        const Point3 &p = mesh_.vertices[v], &a = mesh_.vertices[ends[0]],
                     &b = mesh_.vertices[ends[1]];
        const bool sharp = angle_between(minus(p, a), minus(b, p)) > angles_.curve;
        const bool mixed = is_intersection(v, ends[0]) != is_intersection(v, ends[1]);
        return sharp || mixed ? VertexKind::corner : VertexKind::curve;
    }

    [[nodiscard]] bool is_intersection(std::uint32_t a, std::uint32_t b) const {
        return std::binary_search(mesh_.intersection_edges.begin(), mesh_.intersection_edges.end(),
                                  Edge{std::min(a, b), std::max(a, b)});
    }

    /// Tells whether the triangles at v form one closed fan or, on a curve, fans that each run from
    /// one curve edge to the other.
    [[nodiscard]] bool fans_are_plain(std::uint32_t v,
                                      const std::vector<std::uint32_t>& star) const {
        DisjointSets fans(star.size());
        const auto index = [&](std::uint32_t t) {
            return static_cast<std::uint32_t>(std::find(star.begin(), star.end(), t) -
                                              star.begin());
        };
        std::vector<std::array<unsigned, 2>> ends(star.size(), {0, 0});
        for (std::uint32_t k = 0; k < star.size(); ++k)
            for (std::size_t i = 0; i < 3; ++i) {
                const Triangle& c = out_.triangles[star[k]];
                const std::uint32_t a = c[i], b = c[(i + 1) % 3];
                if (a != v && b != v) continue;
                const std::uint32_t u = out_.across[star[k]][i];
                if (u != none)
                    fans.join(k, index(u));
                else
                    ++ends[k]
                          [curve_edges_at_[v].empty() || (a == v ? b : a) == curve_edges_at_[v][0]
                               ? 0
                               : 1];
            }
        std::vector<std::array<unsigned, 2>> of_fan(star.size(), {0, 0});
        unsigned count = 0;
        for (std::uint32_t k = 0; k < star.size(); ++k) {
            const std::uint32_t root = fans.find(k);
            count += root == k;
            for (unsigned e = 0; e < 2; ++e) of_fan[root][e] += ends[k][e];
        }
        if (curve_edges_at_[v].empty()) return count == 1;
        for (std::uint32_t k = 0; k < star.size(); ++k)
            if (fans.find(k) == k && of_fan[k] != std::array<unsigned, 2>{1, 1}) return false;
        return true;
    }

    // ---- Curves

    void trace_curves() {
        out_.curve_of.assign(mesh_.vertices.size(), none);
        out_.place_of.assign(mesh_.vertices.size(), none);
        for (std::uint32_t v = 0; v < out_.kinds.size(); ++v)
            if (out_.kinds[v] == VertexKind::corner) trace_from(v);
        for (std::uint32_t v = 0; v < out_.kinds.size(); ++v) { // closed curves remain
            if (out_.kinds[v] != VertexKind::curve || out_.curve_of[v] != none) continue;
            out_.kinds[v] = VertexKind::corner;
            trace_from(v);
        }
    }

    void trace_from(std::uint32_t corner) {
        for (const std::uint32_t next : curve_edges_at_[corner]) {
            const bool taken = out_.kinds[next] == VertexKind::corner ? next < corner
                                                                      : out_.curve_of[next] != none;
            if (!taken) trace(corner, next);
        }
    }

    void trace(std::uint32_t corner, std::uint32_t next) {
        Curve curve;
        curve.intersection = is_intersection(corner, next);
        const auto number = static_cast<std::uint32_t>(out_.curves.size());
        const auto add = [&](std::uint32_t v) {
            double at = 0;
            if (!curve.vertices.empty()) {
                const Point3 d = minus(mesh_.vertices[v], mesh_.vertices[curve.vertices.back()]);
                at = curve.at.back() + std::hypot(d.x, d.y, d.z);
            }
            curve.vertices.push_back(v);
            curve.at.push_back(at);
        };
        add(corner);
        std::uint32_t last = corner;
        while (out_.kinds[next] == VertexKind::curve) {
            out_.curve_of[next] = number;
            out_.place_of[next] = static_cast<std::uint32_t>(curve.vertices.size());
            add(next);
            const auto& ends = curve_edges_at_[next];
            last = std::exchange(next, ends[0] == last ? ends[1] : ends[0]);
        }
        add(next);
        out_.curves.push_back(std::move(curve));
    }

    const Mesh& mesh_;
    const FeatureAngles& angles_;
    const Run& run_;
    const EdgeSides sides_;
    std::vector<std::vector<std::uint32_t>> curve_edges_at_; ///< per vertex: the other ends of its
                                                             ///< curve edges
    Features out_;
};

} // namespace

Features find_features(const Mesh& mesh, const FeatureAngles& angles, const Run& run) {
    return Finder(mesh, angles, run)();
}

} // namespace terrane::quality::detail
