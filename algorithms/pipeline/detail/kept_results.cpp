// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/pipeline/detail/kept_results.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/is_external.hpp>
#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/algorithms/pipeline/detail/bytes.hpp>

namespace terrane::pipeline::detail {
namespace {

/// To be raised where the same inputs and options make another result than before.
constexpr std::uint32_t generation = 2;

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
    archive(m.surfaces, m.vertices, m.tetrahedra, m.block_of, m.faces, m.face_triangle,
            m.surfaces_of, m.twins, m.block_count, m.mesher, m.failure);
}

/// The sum of all blocks has the place of the outside, since all kept numbers are finite.
static void fields(auto& archive, Is<Volumes> auto& v) {
    std::vector<double> measures = v.measures;
    if (!measures.empty()) measures[0] = v.total;
    archive(v.of_sides, measures);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(v)>>) {
        if (!measures.empty()) v.total = std::exchange(measures[0], Volumes().measures[0]);
        v.measures = std::move(measures);
    }
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
    archive(o.refinements);
    ImproveOptions::describe([&archive](const Field&, auto& value) { archive(value); }, o);
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

/// Writes or reads what is new about an improvement: the surfaces are those of the mesh before, and no
/// triangle has parents.
void parts_of(auto& archive, Is<Mesh> auto& mesh, Is<ImprovedAndMeasured> auto& i) {
    auto& m = i.improved;
    archive(mesh.vertices, mesh.triangles, mesh.surfaces_of, mesh.regions_of,
            mesh.intersection_edges, m.volumes, m.volumes_before, m.volume_before, m.near_of,
            m.report, i.deviations, i.bounds_back);
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

/// Tells whether these may be the edges of a mesh: sorted, unique, and between vertices.
bool are_edges(const std::vector<Edge>& edges, std::size_t vertices) {
    return std::ranges::adjacent_find(edges, std::greater_equal<>()) == edges.end() &&
           std::ranges::all_of(
               edges, [vertices](const Edge& e) { return e[0] < e[1] && e[1] < vertices; });
}

/// Tells whether each triangle has surfaces, and regions that the mesh before has, if any.
bool have_surfaces(const Mesh& mesh, const Mesh& before) {
    const auto& of = mesh.surfaces_of;
    if (of.size() != mesh.triangles.size() || !all_below(of.values, before.surfaces.size()))
        return false;
    for (std::size_t t = 0; t < of.size(); ++t)
        if (of[t].empty() ||
            std::ranges::adjacent_find(of[t], std::greater_equal<>()) != of[t].end())
            return false;
    if (mesh.regions_of.size() == 0) return mesh.regions_of.values.empty();
    const auto& regions = before.regions_of.values;
    const std::size_t count =
        regions.empty() ? 0 : 1 + std::size_t{*std::ranges::max_element(regions)};
    return mesh.regions_of.offsets == of.offsets && all_below(mesh.regions_of.values, count);
}

bool is_triangle_of(std::uint32_t worst, const Mesh& mesh) {
    return worst < mesh.triangles.size() || worst == UINT32_MAX;
}

/// Tells whether an improvement may be one of this mesh: all lists have the right lengths, and all
/// numbers are of something that is there. Corners of triangles are left to the proof.
bool may_come_from(const Mesh& before, const Mesh& mesh, const ImprovedAndMeasured& kept) {
    const Improved& made = kept.improved;
    const ImproveReport& report = made.report;
    const std::size_t surfaces = before.surfaces.size();
    const std::size_t volumes = report.sides_kept ? made.volumes.measures.size() : 0;
    return have_surfaces(mesh, before) &&
           are_edges(mesh.intersection_edges, mesh.vertices.size()) &&
           belong_to(made.volumes, mesh) && belong_to(made.volumes_before, before) &&
           made.volume_before.size() == volumes &&
           all_below(made.volume_before, made.volumes_before.measures.size()) &&
           made.near_of.size() == mesh.triangles.size() &&
           all_below(made.near_of, before.triangles.size()) &&
           is_triangle_of(report.before.worst, before) &&
           is_triangle_of(report.after.worst, mesh) && report.worst_cause <= WorstCause::rounds &&
           report.bound_of.size() == surfaces && kept.deviations.size() == surfaces &&
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
    parts_of(writer, *improved.improved.mesh, improved);
    return std::move(writer.bytes);
}

Result<std::optional<ImprovedAndMeasured>> improved_from(std::string_view bytes,
                                                         const ConformingMesh& before,
                                                         const ImproveOptions& options,
                                                         const Run& run) {
    ByteReader reader(bytes);
    Mesh mesh;
    ImprovedAndMeasured kept;
    parts_of(reader, mesh, kept);
    if (!reader.complete() || !may_come_from(*before, mesh, kept)) return {std::nullopt};
    mesh.surfaces = before->surfaces;
    std::vector<std::uint32_t> labels;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        labels.push_back(mesh.surfaces_of[t][0]);
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
    all(o.time_limit); // which decides who makes them, where another mesher comes next
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

} // namespace terrane::pipeline::detail
