// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/detail/assembly.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/tetgen/detail/facet_nodes.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::tetgen::detail {
namespace {

// --------------------------------

/// A face of a tetrahedron, by its sorted corners.
struct TetFace {
    Triangle key;
    std::uint32_t tetrahedron = 0;
    bool even = false; ///< the sorted corners are an even permutation of the outward order

    friend auto operator<=>(const TetFace&, const TetFace&) = default;
};

/// A face that TetGen reports on a facet.
struct MarkedFace {
    Triangle key;
    std::uint32_t facet = 0;
};

/// Sorts the corners; returns whether that is an even permutation.
bool sort_corners(Triangle& t) {
    bool even = true;
    const auto order = [&](std::size_t i, std::size_t j) {
        if (t[i] <= t[j]) return;
        std::swap(t[i], t[j]);
        even = !even;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return even;
}

/// Union-find over the numbers 0 ... size - 1.
class UnionFind {
public:
    explicit UnionFind(std::size_t size) : parent_(size) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t i, std::uint32_t j) { parent_[find(i)] = find(j); }

private:
    std::vector<std::uint32_t> parent_;
};

/// Checks a mesher's answer and turns it into the result, step by step, without trusting any of it.
class Assembly {
public:
    Assembly(const Mesh& mesh, const TetgenDomain& domain, TetgenOutput output, const char* mesher,
             const std::stop_token& stop) :
        mesh_(mesh),
        domain_(domain), in_(std::move(output)), mesher_(mesher), stop_(stop) {}

    Result<TetrahedralMesh> run() {
        for (const auto step :
             {&Assembly::check_indices, &Assembly::check_points, &Assembly::take_vertices,
              &Assembly::take_tetrahedra, &Assembly::take_faces, &Assembly::match_faces,
              &Assembly::check_volume, &Assembly::number_blocks, &Assembly::check_triangles}) {
            if (stop_.stop_requested()) return stopped();
            if (Status done = (this->*step)(); !done) return done.error();
        }
        return std::move(out_);
    }

private:
    static Error stopped() {
        return {ErrorCode::interrupted, "stopped while tetrahedra were checked", ""};
    }
    /// Tells whether to stop at the i-th tetrahedron; looks only now and then.
    [[nodiscard]] bool stops_at(std::size_t i) const {
        constexpr std::size_t seldom = 1U << 12U;
        return i % seldom == 0 && stop_.stop_requested();
    }
    [[nodiscard]] Error broken(const char* what) const {
        return {ErrorCode::internal, fmt::format("{} {}", mesher_, what), ""};
    }

    Status check_indices() {
        const std::size_t points = in_.points.size();
        const auto in_range = [&](const auto& corners) {
            return std::all_of(corners.begin(), corners.end(),
                               [&](std::uint32_t v) { return v < points; });
        };
        const std::size_t facets = domain_.triangles.size() + 6;
        const bool good = std::all_of(in_.tetrahedra.begin(), in_.tetrahedra.end(), in_range) &&
                          std::all_of(in_.faces.begin(), in_.faces.end(), in_range) &&
                          std::all_of(in_.face_facet.begin(), in_.face_facet.end(),
                                      [&](std::uint32_t facet) { return facet < facets; });
        if (!good || in_.tetrahedra.empty()) return broken("returned indices out of range");
        return Done{};
    }

    Status check_points() {
        if (in_.points.size() < domain_.points.size() ||
            !std::equal(domain_.points.begin(), domain_.points.end(), in_.points.begin()))
            return broken("moved a vertex");
        if (!std::all_of(in_.points.begin(), in_.points.end(), is_finite))
            return broken("added a vertex that is not finite");
        return Done{};
    }

    /// Puts added vertices on a side of the box exactly on it, as TetGen rounds them, and those on
    /// triangles next to these. Other vertices stay: TetGen may take a face inside the box for a part
    /// of its side.
    Status take_vertices() {
        if (!put_on_triangles(domain_, in_)) return broken("put a vertex off its triangle");
        out_.vertices = std::move(in_.points);
        const auto& [low, high] = domain_.box;
        for (std::size_t i = 0; i < in_.faces.size(); ++i) {
            if (!on_box(in_.face_facet[i])) continue;
            for (const std::uint32_t v : in_.faces[i]) {
                if (v < domain_.points.size()) continue;
                Point3& p = out_.vertices[v];
                switch (in_.face_facet[i] - domain_.triangles.size()) {
                case 0:
                    p.x = low.x;
                    break;
                case 1:
                    p.x = high.x;
                    break;
                case 2:
                    p.y = low.y;
                    break;
                case 3:
                    p.y = high.y;
                    break;
                case 4:
                    p.z = low.z;
                    break;
                default:
                    p.z = high.z;
                    break;
                }
            }
        }
        return Done{};
    }

    Status take_tetrahedra() {
        out_.tetrahedra = std::move(in_.tetrahedra);
        for (std::size_t t = 0; t < out_.tetrahedra.size(); ++t) {
            if (stops_at(t)) return stopped();
            auto& [a, b, c, d] = out_.tetrahedra[t];
            const auto& v = out_.vertices;
            const Sign sign = orient3d(v[a], v[b], v[c], v[d]);
            if (sign == Sign::Zero) return broken("returned a tetrahedron without volume");
            if (sign == Sign::Negative) std::swap(c, d);
        }
        return Done{};
    }

    /// Takes the faces on the mesh's triangles, in the order of the triangles. match_faces() finds
    /// those on the box, as TetGen loses some of them when it improves tetrahedra there.
    Status take_faces() {
        for (std::size_t i = 0; i < in_.faces.size(); ++i) {
            if (on_box(in_.face_facet[i])) continue;
            MarkedFace face{in_.faces[i], in_.face_facet[i]};
            sort_corners(face.key);
            marked_.push_back(face);
        }
        std::sort(marked_.begin(), marked_.end(), [](const MarkedFace& a, const MarkedFace& b) {
            return std::tie(a.facet, a.key) < std::tie(b.facet, b.key);
        });
        for (const MarkedFace& face : marked_) {
            out_.faces.push_back(wound_like_triangle(face));
            out_.face_triangle.push_back(face.facet);
            out_.surfaces_of.push_back(mesh_.surfaces_of[face.facet]);
        }
        out_.surfaces = mesh_.surfaces;
        out_.surfaces.push_back({"box", Role::boundary});
        return Done{};
    }

    Triangle wound_like_triangle(const MarkedFace& face) const {
        const auto& v = out_.vertices;
        const auto& [a, b, c] = domain_.triangles[face.facet];
        Triangle t = face.key;
        const Axis axis = projection_axis(v[a], v[b], v[c]);
        if (orient2d(axis, v[t[0]], v[t[1]], v[t[2]]) != orient2d(axis, v[a], v[b], v[c]))
            std::swap(t[1], t[2]);
        return t;
    }

    /// Checks that each face belongs to two tetrahedra on opposite sides, or to one and lies on the
    /// box. As all volumes are positive, it follows that the tetrahedra cover each point of the box
    /// equally often.
    Status match_faces() {
        const std::vector<TetFace> faces = faces_of_tetrahedra();
        std::vector<Triangle> barriers; // faces on the mesh
        for (const MarkedFace& face : marked_) barriers.push_back(face.key);
        std::sort(barriers.begin(), barriers.end());
        if (std::adjacent_find(barriers.begin(), barriers.end()) != barriers.end())
            return broken("put a face on two triangles");

        UnionFind groups(out_.tetrahedra.size());
        auto barrier = barriers.begin();
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const TetFace& face = faces[i];
            const bool barred = barrier != barriers.end() && *barrier == face.key;
            if (barred) ++barrier;
            if (i + 1 == faces.size() || faces[i + 1].key != face.key) {
                if (barred || !on_side_of_box(face.key)) return broken("left a hole");
                take_box_face(face);
                continue;
            }
            const TetFace& twin = faces[++i];
            if (face.even == twin.even) return broken("returned tetrahedra that overlap");
            if (!barred) groups.join(face.tetrahedron, twin.tetrahedron);
        }
        if (barrier != barriers.end()) return broken("returned a face of no tetrahedron");
        for (std::uint32_t t = 0; t < out_.tetrahedra.size(); ++t)
            group_of_.push_back(groups.find(t));
        return Done{};
    }

    [[nodiscard]] bool on_side_of_box(const Triangle& face) const {
        const auto& [low, high] = domain_.box;
        const auto all_at = [&](double Point3::*coordinate, double value) {
            return std::all_of(face.begin(), face.end(), [&](std::uint32_t v) {
                return out_.vertices[v].*coordinate == value;
            });
        };
        return all_at(&Point3::x, low.x) || all_at(&Point3::x, high.x) ||
               all_at(&Point3::y, low.y) || all_at(&Point3::y, high.y) ||
               all_at(&Point3::z, low.z) || all_at(&Point3::z, high.z);
    }

    void take_box_face(const TetFace& face) {
        Triangle outward = face.key;
        if (!face.even) std::swap(outward[1], outward[2]);
        out_.faces.push_back(outward);
        out_.face_triangle.push_back(no_index);
        out_.surfaces_of.push_back(std::array{static_cast<std::uint32_t>(mesh_.surfaces.size())});
        at_box_.push_back(face.tetrahedron);
    }

    /// Checks that the volumes add up to the box's. With match_faces(), the tetrahedra cover it
    /// exactly once.
    Status check_volume() {
        Exact sum = 0.0;
        for (std::size_t t = 0; t < out_.tetrahedra.size(); ++t) {
            if (stops_at(t)) return stopped();
            const auto& [a, b, c, d] = out_.tetrahedra[t];
            sum += six_volumes(a, b, c, d);
        }
        const Point3 &low = domain_.box.low, &high = domain_.box.high;
        const Exact box =
            (Exact(high.x) - low.x) * (Exact(high.y) - low.y) * (Exact(high.z) - low.z);
        if (sum != box * 6) return broken("made volumes that do not add up to the box");
        return Done{};
    }

    [[nodiscard]] Exact six_volumes(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                    std::uint32_t d) const {
        const Point3& origin = out_.vertices[a];
        const auto from_origin = [&](std::uint32_t v) {
            const Point3& p = out_.vertices[v];
            return std::array<Exact, 3>{Exact(p.x) - origin.x, Exact(p.y) - origin.y,
                                        Exact(p.z) - origin.z};
        };
        const auto u = from_origin(b), v = from_origin(c), w = from_origin(d);
        return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
               u[2] * (v[0] * w[1] - v[1] * w[0]);
    }

    [[nodiscard]] std::vector<TetFace> faces_of_tetrahedra() const {
        std::vector<TetFace> faces;
        faces.reserve(4 * out_.tetrahedra.size());
        for (std::uint32_t t = 0; t < out_.tetrahedra.size(); ++t) {
            const auto& [a, b, c, d] = out_.tetrahedra[t];
            for (const Triangle& outward :
                 {Triangle{a, c, b}, Triangle{a, b, d}, Triangle{b, c, d}, Triangle{a, d, c}}) {
                TetFace face{outward, t, false};
                face.even = sort_corners(face.key);
                faces.push_back(face);
            }
        }
        std::sort(faces.begin(), faces.end());
        return faces;
    }

    /// Numbers the blocks: 0 touches the box, the others follow in the order of their lowest
    /// tetrahedra, compared by the positions of the vertices, not by TetGen's numbers.
    /// adopt_volume_numbers() later replaces these numbers by those of the volumes.
    Status number_blocks() {
        using Position = std::array<Point3, 4>;
        const std::size_t count = out_.tetrahedra.size();
        std::vector<std::uint32_t> lowest(count, no_index);
        const auto position = [&](std::uint32_t t) {
            Position p;
            for (std::size_t k = 0; k < 4; ++k) p[k] = out_.vertices[out_.tetrahedra[t][k]];
            std::sort(p.begin(), p.end());
            return p;
        };
        std::vector<Position> lowest_position(count);
        std::vector<std::uint32_t> groups;
        for (std::uint32_t t = 0; t < count; ++t) {
            const std::uint32_t group = group_of_[t];
            const Position here = position(t);
            if (lowest[group] == no_index) groups.push_back(group);
            if (lowest[group] == no_index || here < lowest_position[group]) {
                lowest[group] = t;
                lowest_position[group] = here;
            }
        }
        const std::uint32_t outside = group_of_[at_box_.front()];
        for (const std::uint32_t t : at_box_)
            if (group_of_[t] != outside) return broken("let the outside fall apart");
        std::sort(groups.begin(), groups.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(a != outside, lowest_position[a]) <
                   std::pair(b != outside, lowest_position[b]);
        });
        std::vector<std::uint32_t> block(count, no_index);
        for (std::uint32_t r = 0; r < groups.size(); ++r) block[groups[r]] = r;
        for (const std::uint32_t group : group_of_) out_.block_of.push_back(block[group]);
        out_.block_count = static_cast<std::uint32_t>(groups.size());
        return Done{};
    }

    /// Checks that each triangle has faces, and that each of its corners is a corner of one of
    /// them.
    Status check_triangles() {
        auto face = marked_.begin();
        for (std::uint32_t t = 0; t < domain_.triangles.size(); ++t) {
            Triangle missing = domain_.triangles[t];
            for (; face != marked_.end() && face->facet == t; ++face)
                for (std::uint32_t& corner : missing)
                    if (std::find(face->key.begin(), face->key.end(), corner) != face->key.end())
                        corner = no_index;
            if (missing != Triangle{no_index, no_index, no_index})
                return Error{ErrorCode::internal, fmt::format("{} lost a triangle", mesher_),
                             fmt::format("triangle {}", t)};
        }
        return Done{};
    }

    [[nodiscard]] bool on_box(std::uint32_t facet) const {
        return facet >= domain_.triangles.size();
    }

    const Mesh& mesh_;
    const TetgenDomain& domain_;
    TetgenOutput in_;
    const char* mesher_;
    const std::stop_token& stop_;
    TetrahedralMesh out_;
    std::vector<MarkedFace> marked_;      ///< those on the mesh, parallel to out_.faces
    std::vector<std::uint32_t> at_box_;   ///< tetrahedra with a face on the box
    std::vector<std::uint32_t> group_of_; ///< per tetrahedron: one number for each block
};

} // namespace

Result<TetrahedralMesh> assemble(const Mesh& mesh, const TetgenDomain& domain, TetgenOutput output,
                                 const char* mesher, const std::stop_token& stop) {
    return Assembly(mesh, domain, std::move(output), mesher, stop).run();
}

} // namespace terrane::tetgen::detail
