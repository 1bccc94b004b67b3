// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/project/detail/kept_results.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/is_external.hpp>
#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/algorithms/project/detail/bytes.hpp>

namespace terrane::project::detail {
namespace {

/// To be raised where the same inputs and options make another result than before.
constexpr std::uint32_t generation = 1;

} // namespace

// Found by the archives, which is why they are not in an anonymous namespace.

static void fields(auto& archive, Is<SurfaceInfo> auto& s) {
    archive(s.name, s.role);
}

static void fields(auto& archive, Is<Mesh> auto& m) {
    archive(m.surfaces, m.vertices, m.triangles, m.surfaces_of, m.regions_of, m.parents_of,
            m.intersection_edges);
}

static void fields(auto& archive, Is<TetrahedralMesh> auto& m) {
    archive(m.surfaces, m.vertices, m.tetrahedra, m.region_of, m.faces, m.face_triangle,
            m.surfaces_of, m.twins, m.region_count, m.mesher, m.failure);
}

static void fields(auto& archive, Is<Volumes> auto& v) {
    archive(v.of_sides, v.measures);
}

static void fields(auto& archive, Is<Spread> auto& s) {
    archive(s.min, s.mean, s.max, s.percentiles);
}

static void fields(auto& archive, Is<QualityReport> auto& q) {
    archive(q.triangles, q.q, q.smallest_angle, q.largest_angle, q.edge_length, q.share_above_08,
            q.histogram, q.worst);
}

static void fields(auto& archive, Is<ImproveReport> auto& r) {
    archive(r.before, r.after, r.bound_of, r.corners, r.curves, r.sheets, r.splits, r.collapses,
            r.swaps, r.moves, r.refused_contact, r.refused_deviation, r.refused_shape,
            r.least_quality, r.attempts, r.is_strict, r.held_blocks, r.thin_triangles, r.passes,
            r.sides_kept, r.worst_cause);
}

static void fields(auto& archive, Is<Deviation> auto& d) {
    archive(d.out, d.back);
}

static void fields(auto& archive, Is<LocalSize> auto& s) {
    archive(s.place, s.length);
}

static void fields(auto& archive, Is<ImproveOptions> auto& o) {
    archive(o.refinements, o.edge_length, o.edge_length_of, o.max_deviation, o.curve_length, o.turn,
            o.layers_in_gaps, o.smallest, o.growth, o.crease_angle, o.curve_angle, o.passes,
            o.thickness_share, o.least_quality, o.max_volume_change, o.max_triangles);
}

static void fields(auto& archive, Is<NamedSize> auto& s) {
    archive(s.of.name, s.edge_length);
}

static void fields(auto& archive, Is<GivenName> auto& n) {
    archive(n.name);
}

static void fields(auto& archive, Is<NamedConstant> auto& c) {
    archive(c.value);
}

namespace {

/// Writes or reads all but the mesh of an improvement.
void rest_of(auto& archive, Is<ImprovedAndMeasured> auto& i) {
    auto& m = i.improved;
    archive(m.volumes, m.volumes_before, m.volume_before, m.near_of, m.report, i.deviations,
            i.bounds_back);
}

bool all_below(const std::vector<std::uint32_t>& numbers, std::size_t limit) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [limit](std::uint32_t number) { return number < limit; });
}

bool belong_to(const Volumes& volumes, const Mesh& mesh) {
    return volumes.of_sides.size() == mesh.triangles.size() && !volumes.measures.empty() &&
           std::all_of(volumes.of_sides.begin(), volumes.of_sides.end(), [&](const auto& sides) {
               return std::max(sides[0], sides[1]) < volumes.measures.size();
           });
}

/// Tells whether an improvement may be one of this mesh: all lists have the right lengths, and all
/// numbers are of something that is there.
bool may_come_from(const Mesh& before, const Mesh& mesh, const ImprovedAndMeasured& kept) {
    const Improved& made = kept.improved;
    const std::size_t triangles = mesh.triangles.size(), surfaces = before.surfaces.size();
    const auto is_list = [&](const IndexLists<std::uint32_t>& lists) {
        return lists.size() == triangles || lists.size() == 0;
    };
    const auto edges_are_good = [&](const Edge& e) {
        return std::max(e[0], e[1]) < mesh.vertices.size();
    };
    const std::size_t worst = made.report.after.worst;
    return mesh.surfaces == before.surfaces && mesh.surfaces_of.size() == triangles &&
           is_list(mesh.regions_of) && is_list(mesh.parents_of) &&
           all_below(mesh.surfaces_of.values, surfaces) &&
           std::all_of(mesh.intersection_edges.begin(), mesh.intersection_edges.end(),
                       edges_are_good) &&
           belong_to(made.volumes, mesh) && belong_to(made.volumes_before, before) &&
           all_below(made.volume_before, made.volumes_before.measures.size()) &&
           (made.volume_before.empty() ||
            made.volume_before.size() == made.volumes.measures.size()) &&
           made.near_of.size() == triangles && all_below(made.near_of, before.triangles.size()) &&
           (worst < triangles || worst == UINT32_MAX) &&
           made.report.worst_cause <= WorstCause::rounds &&
           made.report.bound_of.size() == surfaces && kept.deviations.size() == surfaces &&
           kept.bounds_back.size() == surfaces;
}

std::string key_of(const ByteWriter& all) {
    return hexadecimal(sha256(all.bytes));
}

} // namespace

std::string key_of(const ConformingMesh& mesh, const ImproveOptions& options) {
    ByteWriter all;
    all(generation, *mesh, options, improve_constants());
    return key_of(all);
}

std::string bytes_of(const ImprovedAndMeasured& improved) {
    ByteWriter writer;
    writer(*improved.improved.mesh);
    rest_of(writer, improved);
    return std::move(writer.bytes);
}

Result<std::optional<ImprovedAndMeasured>> improved_from(std::string_view bytes,
                                                         const ConformingMesh& before,
                                                         const ImproveOptions& options,
                                                         const Run& run) {
    ByteReader reader(bytes);
    Mesh mesh;
    ImprovedAndMeasured kept;
    reader(mesh);
    rest_of(reader, kept);
    if (!reader.complete() || !may_come_from(*before, mesh, kept)) return {std::nullopt};
    std::vector<std::uint32_t> labels;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.surfaces_of[t].empty()) return {std::nullopt};
        labels.push_back(mesh.surfaces_of[t][0]);
    }
    auto proven = prove_conforming(std::move(mesh), labels, options.check, run);
    if (!proven) {
        if (is_external(proven.error().code)) return proven.error();
        return {std::nullopt};
    }
    kept.improved.mesh = proven->mesh();
    kept.improved.conforming = std::move(*proven);
    return {std::move(kept)};
}

std::string key_of(const Model& model, const TetrahedraRequest& request) {
    const TetrahedraOptions& o = request.options;
    ByteWriter all;
    all(generation, *model.mesh, model.number_of, request.size_of, request.size_in,
        tetrahedra_constants(), o.mesher, o.margin, o.split_surfaces);
    for (const ModelBlock& block : model.structure.blocks) all(block.name);
    for (const auto& wanted : {o.edge_length, o.radius_edge_ratio, o.max_volume})
        all(wanted.value_or(-1));
    return key_of(all);
}

std::string bytes_of(const TetrahedralMesh& mesh) {
    ByteWriter writer;
    writer(mesh);
    return std::move(writer.bytes);
}

std::optional<TetrahedralMesh> tetrahedra_from(std::string_view bytes) {
    ByteReader reader(bytes);
    TetrahedralMesh mesh;
    reader(mesh);
    if (!reader.complete()) return std::nullopt;
    return mesh;
}

} // namespace terrane::project::detail
