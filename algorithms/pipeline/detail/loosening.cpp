// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/pipeline/detail/loosening.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/quality/sliding_vertices.hpp>
#include <terrane/algorithms/tetrahedra/bad_tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

namespace terrane::pipeline::detail {
namespace {

/// Share of what is left of the resolution by which a vertex may move. The rest is for the insides of
/// triangles, which may be farther from where they were than their corners.
constexpr double first_share = 0.8;
constexpr unsigned attempts = 3;

constexpr std::uint32_t none = UINT32_MAX;

/// A corner of a face of the tetrahedra.
struct FaceCorner {
    std::uint32_t face = none;
    std::uint32_t corner = 0;
};

/// Finds, for each vertex of the mesh, a corner of a face at it. None for vertices at a triangle that
/// is divided, and where faces have other corners.
std::vector<FaceCorner> corners_at(const Mesh& mesh, const TetrahedralMesh& tetrahedra) {
    std::vector<std::uint32_t> face_of(mesh.triangles.size(), none);
    std::vector<bool> stays(mesh.vertices.size());
    const auto keep = [&](std::uint32_t t) {
        for (const std::uint32_t v : mesh.triangles[t]) stays[v] = true;
    };
    for (std::uint32_t f = 0; f < tetrahedra.faces.size(); ++f) {
        const std::uint32_t t = tetrahedra.face_triangle[f];
        if (t == none) continue;
        if (face_of[t] != none) keep(t);
        face_of[t] = f;
    }
    std::vector<FaceCorner> found(mesh.vertices.size());
    for (std::uint32_t t = 0; t < face_of.size(); ++t) {
        if (face_of[t] == none) {
            keep(t);
            continue;
        }
        const Triangle& face = tetrahedra.faces[face_of[t]];
        for (const std::uint32_t v : mesh.triangles[t]) {
            std::uint32_t k = 0;
            while (k < 3 && tetrahedra.vertices[face[k]] != mesh.vertices[v]) ++k;
            if (k < 3)
                found[v] = {face_of[t], k};
            else
                keep(t);
        }
    }
    for (std::uint32_t v = 0; v < found.size(); ++v)
        if (stays[v]) found[v] = {};
    return found;
}

/// The axes along which a vertex may move: on sides of the boundary that are parallel to two axes it
/// stays in them.
struct Freedom {
    std::array<bool, 3> along{true, true, true};
    bool stays = false; ///< on a side of the boundary that is not parallel to two axes
};

std::array<bool, 3> flat_axes(const Mesh& mesh, const Triangle& c) {
    const auto same = [&](double Point3::*axis) {
        const double at = mesh.vertices[c[0]].*axis;
        return mesh.vertices[c[1]].*axis == at && mesh.vertices[c[2]].*axis == at;
    };
    return {same(&Point3::x), same(&Point3::y), same(&Point3::z)};
}

std::vector<Freedom> freedom_by_boundary(const Mesh& mesh) {
    std::vector<Freedom> freedom(mesh.vertices.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto of = mesh.surfaces_of[t];
        if (std::none_of(of.begin(), of.end(),
                         [&](std::uint32_t s) { return mesh.surfaces[s].role == Role::boundary; }))
            continue;
        const auto flat = flat_axes(mesh, mesh.triangles[t]);
        for (const std::uint32_t v : mesh.triangles[t]) {
            Freedom& f = freedom[v];
            f.stays = f.stays || !(flat[0] || flat[1] || flat[2]);
            for (std::size_t k = 0; k < 3; ++k) f.along[k] = f.along[k] && !flat[k];
        }
    }
    return freedom;
}

/// Lists the surfaces at each vertex.
std::vector<std::vector<std::uint32_t>> surfaces_at_vertices(const Mesh& mesh) {
    std::vector<std::vector<std::uint32_t>> at(mesh.vertices.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t v : mesh.triangles[t])
            for (const std::uint32_t s : mesh.surfaces_of[t])
                if (std::find(at[v].begin(), at[v].end(), s) == at[v].end()) at[v].push_back(s);
    return at;
}

/// Where vertices may be, and whether all of the surfaces may be where these have come to.
class Room {
public:
    Room() = default;
    Room(const Room&) = delete;
    Room& operator=(const Room&) = delete;
    virtual ~Room() = default;

    /// Tells whether vertices may go far from the surfaces.
    [[nodiscard]] virtual bool is_wide() const = 0;
    [[nodiscard]] virtual bool is_free(std::uint32_t v) const = 0;
    [[nodiscard]] virtual std::optional<Point3> place(std::uint32_t v, const Point3& p) const = 0;
    /// Tells whether the mesh may be like this, and adjusts its report; where it may not, there is
    /// less room from then on.
    virtual bool holds(ImprovedAndMeasured& moved) = 0;
    /// Keeps a vertex where it is, in a narrow room. Tells whether it was free.
    virtual bool keep(std::uint32_t /*v*/) { return false; }
    /// Makes room smaller everywhere.
    virtual void shrink() = 0;
};

/// The room that the resolution leaves.
class RoomOfResolution : public Room {
public:
    RoomOfResolution(const LoosenInput& input, const Run& run) :
        simplified_(*input.arranged.simplified), run_(run), mesh_(*input.improved.improved.mesh),
        surfaces_at_(surfaces_at_vertices(mesh_)), freedom_(freedom_by_boundary(mesh_)),
        left_(mesh_.vertices.size(), simplified_.report.resolution),
        share_of_(mesh_.surfaces.size(), first_share) {
        find_distances();
    }

    [[nodiscard]] bool is_wide() const override { return true; }

    [[nodiscard]] bool is_free(std::uint32_t v) const override {
        return !freedom_[v].stays && reach(v) > 0;
    }

    [[nodiscard]] std::optional<Point3> place(std::uint32_t v, const Point3& p) const override {
        const Point3& home = mesh_.vertices[v];
        const auto& along = freedom_[v].along;
        const Point3 way{along[0] ? p.x - home.x : 0, along[1] ? p.y - home.y : 0,
                         along[2] ? p.z - home.z : 0};
        const double size = length(way), most = reach(v), share = size > most ? most / size : 1;
        return Point3{home.x + share * way.x, home.y + share * way.y, home.z + share * way.z};
    }

    bool holds(ImprovedAndMeasured& moved) override {
        const auto beyond = beyond_resolution(simplified_, moved.improved.mesh, run_);
        for (const std::uint32_t s : beyond) share_of_[s] /= 2;
        add_moves(moved);
        return beyond.empty();
    }

    void shrink() override {
        for (double& share : share_of_) share /= 2;
    }

private:
    [[nodiscard]] double reach(std::uint32_t v) const {
        double share = first_share;
        for (const std::uint32_t s : surfaces_at_[v]) share = std::min(share, share_of_[s]);
        return share * left_[v];
    }

    /// Finds how far each vertex is from its surfaces before they were simplified.
    void find_distances() {
        const auto& vanished = simplified_.report.vanished;
        const double most = simplified_.report.resolution;
        std::vector<std::vector<std::uint32_t>> vertices_of(mesh_.surfaces.size());
        for (std::uint32_t v = 0; v < surfaces_at_.size(); ++v)
            for (const std::uint32_t s : surfaces_at_[v]) vertices_of[s].push_back(v);
        for (std::uint32_t s = 0; s < vertices_of.size(); ++s) {
            if (std::find(vanished.begin(), vanished.end(), s) != vanished.end()) continue;
            const Surface old = surface_of_mesh(*simplified_.before, s);
            const TriangleTree tree(old.vertices, old.triangles);
            for (const std::uint32_t v : vertices_of[s])
                left_[v] = std::min(left_[v], most - tree.distance(mesh_.vertices[v], most));
        }
    }

    /// Adds to the bounds of each surface how far its vertices have moved.
    void add_moves(ImprovedAndMeasured& moved) const {
        std::vector<double> farthest(mesh_.surfaces.size());
        const auto& now = moved.improved.mesh->vertices;
        for (std::size_t v = 0; v < now.size(); ++v)
            for (const std::uint32_t s : surfaces_at_[v])
                farthest[s] = std::max(farthest[s], length(minus(now[v], mesh_.vertices[v])));
        const auto above = [](double a, double b) {
            return std::nextafter(a + b * (1 + 0x1p-48), std::numeric_limits<double>::infinity());
        };
        for (std::size_t s = 0; s < farthest.size(); ++s) {
            if (farthest[s] == 0) continue;
            double& out = moved.improved.report.bound_of[s];
            out = above(out, farthest[s]);
            moved.bounds_back[s] = above(moved.bounds_back[s], farthest[s]);
        }
    }

    const AtResolution& simplified_;
    const Run& run_;
    const Mesh& mesh_;
    std::vector<std::vector<std::uint32_t>> surfaces_at_;
    std::vector<Freedom> freedom_; ///< per vertex
    std::vector<double> left_;     ///< per vertex: how much of the resolution is left
    std::vector<double> share_of_; ///< per surface: of that
};

/// The surfaces themselves.
class RoomOnSurfaces : public Room {
public:
    RoomOnSurfaces(const LoosenInput& input, const Run& run) :
        before_(input.improved.improved), most_change_(input.options.max_volume_change / 100),
        mesh_(*before_.mesh),
        sliding_(*input.arranged.rounded.conforming, input.improved.improved, input.options, run),
        stays_(mesh_.vertices.size()) {}

    [[nodiscard]] bool is_wide() const override { return false; }

    [[nodiscard]] bool is_free(std::uint32_t v) const override {
        return sliding_.is_inner(v) && !stays_[v];
    }

    [[nodiscard]] std::optional<Point3> place(std::uint32_t v, const Point3& p) const override {
        return sliding_.place(v, p);
    }

    bool holds(ImprovedAndMeasured& moved) override {
        const auto open = sliding_.not_shown(moved.improved.mesh->vertices);
        for (const std::uint32_t t : open)
            for (const std::uint32_t v : mesh_.triangles[t]) stays_[v] = true;
        const bool kept = keeps_volumes(moved.improved);
        if (!kept) shrink();
        return open.empty() && kept;
    }

    bool keep(std::uint32_t v) override {
        const bool was_free = is_free(v);
        stays_[v] = true;
        return was_free;
    }

    void shrink() override { stays_.assign(stays_.size(), true); }

private:
    /// Tells whether no block has changed by more than it may, unless it has changed less than
    /// before.
    [[nodiscard]] bool keeps_volumes(const Improved& moved) const {
        for (std::size_t b = 1; b < moved.volumes.measures.size(); ++b) {
            const double given = before_.volumes_before.measures[before_.volume_before[b]];
            const auto change = [&](const Volumes& now) {
                return std::fabs(now.measures[b] - given);
            };
            if (change(moved.volumes) > most_change_ * given &&
                change(moved.volumes) > change(before_.volumes))
                return false;
        }
        return true;
    }

    const Improved& before_;
    double most_change_; ///< share of the volume of a block
    const Mesh& mesh_;
    SlidingVertices sliding_;
    std::vector<bool> stays_; ///< per vertex: it went where it may not be
};

/// Moves vertices within their room.
class Loosener {
public:
    Loosener(const LoosenInput& input, const Run& run) :
        input_(input), run_(run), mesh_(*input.improved.improved.mesh) {
        if (input.arranged.simplified)
            room_ = std::make_unique<RoomOfResolution>(input, run);
        else
            room_ = std::make_unique<RoomOnSurfaces>(input, run);
    }

    Result<std::optional<Loosened>> operator()() {
        const ConformingMesh& before = *input_.arranged.rounded.conforming;
        Loosened still{{}, input_.made, {}, {}};
        OptimiseOptions steps;
        steps.shapes = false;
        auto sound = improve(steps, still);
        if (!sound) return sound.error();
        if (!*sound) return std::optional<Loosened>();
        corners_ = corners_at(mesh_, input_.made);
        vertex_at_ = vertices_at_nodes(still.tetrahedra);
        steps.angles = false;
        steps.shapes = true;
        for (unsigned attempt = 0; attempt < attempts; ++attempt) {
            Loosened loose = still;
            steps.freedom = freedom();
            sound = improve(steps, loose);
            if (!sound) return sound.error();
            if (loose.optimised.loosened == 0) return std::optional(std::move(loose));
            if (keep_at_larger_angles(loose, still)) continue;
            auto points = points_of(loose.tetrahedra);
            loose.moved = compared(points);
            auto improved = with_vertices_at(before, input_.improved, std::move(points),
                                             input_.options.check, run_);
            if (!improved) return improved.error();
            if (!*improved) {
                room_->shrink();
                continue;
            }
            const bool good = room_->holds(**improved);
            if (run_.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
            if (!good) continue;
            loose.improved = std::move(*improved);
            return std::optional(std::move(loose));
        }
        steps.freedom = {};
        sound = improve(steps, still);
        if (!sound) return sound.error();
        return std::optional(std::move(still));
    }

private:
    /// Returns what two runs of optimise() did together.
    [[nodiscard]] static OptimiseReport joined(const OptimiseReport& first,
                                               const OptimiseReport& then) {
        OptimiseReport both = then;
        both.before = first.before;
        both.is_cut_short = first.is_cut_short || then.is_cut_short;
        for (const auto count :
             {&OptimiseReport::passes, &OptimiseReport::removed_edges,
              &OptimiseReport::removed_faces, &OptimiseReport::moved, &OptimiseReport::contracted,
              &OptimiseReport::inserted, &OptimiseReport::remeshed, &OptimiseReport::effort})
            both.*count += first.*count;
        return both;
    }

    /// Improves tetrahedra, and adds what was done to what was before. False: they are not sound.
    Result<bool> improve(const OptimiseOptions& steps, Loosened& of) const {
        const auto report =
            improve_tetrahedra(input_.model, input_.request, steps, of.tetrahedra, run_);
        if (!report) return report.error();
        if (!*report) return false;
        of.optimised = steps.angles ? **report : joined(of.optimised, **report);
        return true;
    }

    /// Tells whether a tetrahedron will be kept: without the outside, if that is not wanted.
    [[nodiscard]] bool is_wanted(const TetrahedralMesh& tetrahedra, std::uint32_t t) const {
        return input_.request.outside || tetrahedra.block_of[t] != 0;
    }

    /// Returns the vertices at the nodes of tetrahedra.
    [[nodiscard]] std::vector<std::uint32_t>
    vertices_at_nodes(const TetrahedralMesh& tetrahedra) const {
        std::vector<std::uint32_t> vertices(tetrahedra.vertices.size(), none);
        for (std::uint32_t v = 0; v < corners_.size(); ++v)
            if (const auto [face, corner] = corners_[v]; face != none)
                vertices[tetrahedra.faces[face][corner]] = v;
        return vertices;
    }

    /// Keeps vertices where they are that are at tetrahedra with an angle larger than all before.
    /// Tells whether there are such.
    bool keep_at_larger_angles(const Loosened& loose, const Loosened& before) {
        const double most = before.optimised.after.largest_angle;
        if (loose.optimised.after.largest_angle <= most) return false;
        const auto vertices = vertices_at_nodes(loose.tetrahedra);
        bool any = false;
        for (std::uint32_t t = 0; t < loose.tetrahedra.tetrahedra.size(); ++t) {
            if (!is_wanted(loose.tetrahedra, t)) continue;
            const auto angles = dihedral_angles(corners_of(loose.tetrahedra, t));
            if (*std::max_element(angles.begin(), angles.end()) <= most) continue;
            for (const std::uint32_t node : loose.tetrahedra.tetrahedra[t])
                if (vertices[node] != none) any = room_->keep(vertices[node]) || any;
        }
        return any;
    }

    /// Returns the freedom of the nodes of the tetrahedra.
    [[nodiscard]] VertexFreedom freedom() const {
        VertexFreedom freedom;
        freedom.is_free.resize(vertex_at_.size());
        for (std::size_t node = 0; node < vertex_at_.size(); ++node)
            freedom.is_free[node] = vertex_at_[node] != none && room_->is_free(vertex_at_[node]);
        freedom.is_wide = room_->is_wide();
        freedom.place = [this](std::uint32_t node, const Point3& p) {
            return room_->place(vertex_at_[node], p);
        };
        return freedom;
    }

    /// Returns where the vertices of the mesh are in tetrahedra.
    [[nodiscard]] std::vector<Point3> points_of(const TetrahedralMesh& tetrahedra) const {
        std::vector<Point3> points = mesh_.vertices;
        for (std::size_t v = 0; v < corners_.size(); ++v)
            if (const auto [face, corner] = corners_[v]; face != none)
                points[v] = tetrahedra.vertices[tetrahedra.faces[face][corner]];
        return points;
    }

    [[nodiscard]] LoosenedVertices compared(std::span<const Point3> points) const {
        LoosenedVertices moved;
        for (std::size_t v = 0; v < points.size(); ++v) {
            if (points[v] == mesh_.vertices[v]) continue;
            ++moved.count;
            moved.farthest = std::max(moved.farthest, length(minus(points[v], mesh_.vertices[v])));
        }
        return moved;
    }

    const LoosenInput& input_;
    const Run& run_;
    const Mesh& mesh_;
    std::vector<FaceCorner> corners_;      ///< per vertex: where it is in the tetrahedra
    std::vector<std::uint32_t> vertex_at_; ///< per node: the vertex at it that may move, or none
    std::unique_ptr<Room> room_;
};

} // namespace

Result<std::optional<Loosened>> loosen(const LoosenInput& input, const Run& run) {
    return Loosener(input, run)();
}

} // namespace terrane::pipeline::detail
