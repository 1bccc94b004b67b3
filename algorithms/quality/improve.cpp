// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/improve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <terrane/algorithms/check/conforming.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/operations.hpp>
#include <terrane/algorithms/quality/detail/sizes.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {
namespace {

using namespace quality::detail;

constexpr double pi = 3.14159265358979323846;

Error wrong(std::string sentence) {
    return {ErrorCode::bad_option, std::move(sentence), ""};
}

bool is_length(double x) {
    return std::isfinite(x) && x >= 0;
}

Status check_options(const Mesh& mesh, const ImproveOptions& o) {
    if (!is_length(o.edge_length) || !is_length(o.max_deviation) || !is_length(o.curve_length))
        return wrong("lengths must be finite and not negative");
    if (!o.edge_length_of.empty() && o.edge_length_of.size() != mesh.surfaces.size())
        return wrong("edge_length_of needs one length per surface");
    for (const double l : o.edge_length_of)
        if (!is_length(l)) return wrong("lengths must be finite and not negative");
    if (!(o.turn >= 0 && o.turn <= 180)) return wrong("turn must be in [0, 180] degrees");
    if (!(o.growth > 0 && std::isfinite(o.growth))) return wrong("growth must be positive");
    if (!(o.crease_angle > 0 && o.crease_angle <= 180) ||
        !(o.curve_angle > 0 && o.curve_angle <= 180))
        return wrong("angles of creases and curves must be in (0, 180] degrees");
    if (o.passes < 1 || o.passes > 100) return wrong("passes must be 1 to 100");
    return Done{};
}

Status check_conforming(const Mesh& mesh, const Run& run) {
    std::vector<std::uint32_t> labels;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        labels.push_back(mesh.surfaces_of[t][0]);
    return conforming(mesh.vertices, mesh.triangles, labels, run);
}

/// Computes, for each curve, its tolerance: a share of the least tolerance of the sheets that meet
/// there.
std::vector<double> bounds_of_curves(const WorkMesh& mesh, std::size_t curves,
                                     std::span<const double> bound_of) {
    std::vector<double> bounds(curves, std::numeric_limits<double>::infinity());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t c =
                mesh.curve_at(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]);
            if (c != none)
                bounds[c] =
                    std::min(bounds[c], constants.curve_tolerance * bound_of[mesh.sheet_of[t]]);
        }
    return bounds;
}

class Improver {
public:
    Improver(const Mesh& mesh, const ImproveOptions& options, const Run& run) :
        input_(mesh), options_(options), run_(run),
        features_(find_features(
            mesh, {options.crease_angle * pi / 180, options.curve_angle * pi / 180}, run)),
        sizes_(find_sizes(mesh, features_, options)),
        reference_(mesh.vertices, features_, sizes_.bound_of), mesh_(mesh, features_),
        validator_(mesh_, reference_), context_{mesh_,
                                                validator_,
                                                reference_,
                                                mesh.vertices,
                                                features_.curves,
                                                bounds_of_curves(mesh_, features_.curves.size(),
                                                                 sizes_.bound_of),
                                                run} {
        mesh_.sizes = sizes_.of_vertices;
        reference_.find_isolated(run);
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            mesh_.isolated[t] = static_cast<char>(reference_.is_isolated(t));
    }

    Result<Improved> operator()() {
        const double least = *std::min_element(sizes_.bound_of.begin(), sizes_.bound_of.end());
        if (least < reference_.least_bound())
            return wrong("max_deviation is too small for coordinates of this size");
        report_.bound_of.assign(input_.surfaces.size(), 0);
        for (std::size_t s = 0; s < sizes_.bound_of.size(); ++s)
            for (const std::uint32_t surface : input_.surfaces_of[features_.first_of[s]])
                report_.bound_of[surface] = std::max(report_.bound_of[surface], sizes_.bound_of[s]);
        validator_.group_again(run_);
        for (unsigned pass = 0; pass < options_.passes && !stopped(); ++pass)
            if (!one_pass(pass)) break;
        if (!stopped()) finish();
        if (stopped()) return Error{ErrorCode::interrupted, "stopped on request", ""};
        return assembled();
    }

private:
    [[nodiscard]] bool stopped() const { return run_.stop.stop_requested(); }

    void regroup_if_needed() {
        if (!stopped() && constants.regroup_part * validator_.ungrouped() > mesh_.triangles.size())
            validator_.group_again(run_);
    }

    /// Removes slivers first, as splitting would only turn them into more slivers.
    void clean_first() {
        collapse_curves(context_);
        regroup_if_needed();
        collapse_edges(context_);
        regroup_if_needed();
        swap_edges(context_);
        regroup_if_needed();
    }

    [[nodiscard]] std::size_t changes() const {
        return context_.splits + context_.collapses + context_.swaps + context_.moves;
    }

    /// Returns whether another pass is worthwhile.
    bool one_pass(unsigned pass) {
        if (run_.progress)
            run_.progress("improve", static_cast<double>(pass) / (options_.passes + 1));
        ++report_.passes;
        const std::size_t before = changes();
        if (pass == 0) clean_first();
        split_curves(context_);
        collapse_curves(context_);
        slide_curves(context_);
        regroup_if_needed();
        split_edges(context_);
        regroup_if_needed();
        collapse_edges(context_);
        regroup_if_needed();
        if (pass < constants.jitter_passes) jitter(context_);
        equalize_valences(context_);
        regroup_if_needed();
        smooth(context_);
        swap_edges(context_);
        regroup_if_needed();
        smooth(context_);
        return constants.pass_part * (changes() - before) > mesh_.triangles.size();
    }

    /// Improves the few remaining bad triangles one by one.
    void finish() {
        if (run_.progress) run_.progress("improve", options_.passes / (options_.passes + 1.0));
        for (unsigned round = 0; round < constants.finish_rounds && !stopped(); ++round) {
            regroup_if_needed();
            const std::size_t before = context_.collapses + context_.swaps;
            collapse_bad(context_, constants.bad_shape);
            swap_edges(context_);
            slide_curves(context_);
            smooth(context_);
            const std::size_t improved = improve_worst(context_, constants.bad_shape);
            if (context_.collapses + context_.swaps == before && improved == 0) break;
        }
    }

    Result<Improved> assembled();
    Status check(Mesh after, std::span<const std::uint32_t> sheets, Improved& improved);
    [[nodiscard]] Result<bool> sides_kept(std::span<const std::uint32_t> sheets,
                                          Improved& improved) const;
    [[nodiscard]] Mesh output(std::span<const std::uint32_t> used) const;
    void add_intersection_edges(std::span<const std::uint32_t> used,
                                std::span<const std::uint32_t> name_of, Mesh& out) const;
    WorstCause cause_of_worst(Triangle t);

    const Mesh& input_;
    const ImproveOptions& options_;
    const Run& run_;
    const Features features_;
    const Sizes sizes_;
    ReferenceSurface reference_;
    WorkMesh mesh_;
    ChangeValidator validator_;
    RemeshContext context_;
    ImproveReport report_;
};

void Improver::add_intersection_edges(std::span<const std::uint32_t> used,
                                      std::span<const std::uint32_t> name_of, Mesh& out) const {
    for (const std::uint32_t t : used)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3];
            const std::uint32_t c = mesh_.curve_at(a, b);
            if (c == none || !features_.curves[c].intersection) continue;
            out.intersection_edges.push_back(
                {std::min(name_of[a], name_of[b]), std::max(name_of[a], name_of[b])});
        }
    std::sort(out.intersection_edges.begin(), out.intersection_edges.end());
    out.intersection_edges.erase(
        std::unique(out.intersection_edges.begin(), out.intersection_edges.end()),
        out.intersection_edges.end());
}

Mesh Improver::output(std::span<const std::uint32_t> used) const {
    Mesh out;
    out.surfaces = input_.surfaces;
    std::vector<std::uint32_t> name_of(mesh_.points.size(), none);
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
        if (mesh_.star[v].empty()) continue;
        name_of[v] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(mesh_.points[v]);
    }
    for (const std::uint32_t t : used) {
        const Triangle& c = mesh_.triangles[t];
        out.triangles.push_back({name_of[c[0]], name_of[c[1]], name_of[c[2]]});
        const std::uint32_t first = features_.first_of[mesh_.sheet_of[t]];
        out.surfaces_of.push_back(input_.surfaces_of[first]);
        if (input_.regions_of.size() > 0) out.regions_of.push_back(input_.regions_of[first]);
    }
    add_intersection_edges(used, name_of, out);
    return out;
}

/// Finds the reason why a triangle can't be improved: its own shape, or what rejects all changes to
/// it.
WorstCause Improver::cause_of_worst(Triangle t) {
    std::array<double, 3> lengths{};
    std::array<std::uint32_t, 3> curves{};
    bool all_on_curves = true;
    for (std::size_t i = 0; i < 3; ++i) {
        lengths[i] = mesh_.edge_length(t[i], t[(i + 1) % 3]);
        curves[i] = mesh_.curve_at(t[i], t[(i + 1) % 3]);
        all_on_curves = all_on_curves && mesh_.kinds[t[i]] != VertexKind::inner;
    }
    const auto shortest = static_cast<std::size_t>(
        std::min_element(lengths.begin(), lengths.end()) - lengths.begin());
    // The smallest angle is opposite to the shortest edge, between the other two.
    if (curves[(shortest + 1) % 3] != none && curves[(shortest + 2) % 3] != none)
        return WorstCause::corner_angle;
    if (curves[shortest] != none && mesh_.kinds[t[shortest]] == VertexKind::corner &&
        mesh_.kinds[t[(shortest + 1) % 3]] == VertexKind::corner)
        return WorstCause::short_curve;
    if (all_on_curves) return WorstCause::close_curves;
    const Refusals before = validator_.refusals();
    const double below = shape_of(mesh_, t) * (1 + 1e-9);
    context_.improved_at.clear(); // repeats changes that were rejected before, to count the reasons
    improve_worst(context_, below);
    collapse_bad(context_, below);
    const Refusals& after = validator_.refusals();
    const std::size_t deviation = after.deviation - before.deviation;
    const std::size_t contact = after.contact - before.contact;
    if (deviation == 0 && contact == 0) return WorstCause::shape;
    return deviation >= contact ? WorstCause::deviation : WorstCause::contact;
}

/// Finds the volumes of the improved mesh. Tells whether a renaming of volumes exists by which each
/// sheet has the same volumes on its sides as before.
Result<bool> Improver::sides_kept(std::span<const std::uint32_t> sheets, Improved& improved) const {
    std::optional<Result<Volumes>> found_old, found_now;
    Run quiet = run_; // progress may only be reported by the calling thread
    quiet.progress = nullptr;
    both(
        run_, [&] { found_old = find_volumes(input_, quiet); },
        [&] { found_now = find_volumes(improved.mesh, quiet); });
    if (!*found_old) return found_old->error();
    if (!*found_now) return found_now->error();
    improved.volumes_before = std::move(*found_old).value();
    improved.volumes = std::move(*found_now).value();
    const Volumes &old = improved.volumes_before, &now = improved.volumes;
    std::vector<std::uint32_t> to(old.measures.size(), none), back(now.measures.size(), none);
    if (to.size() != back.size()) return false;
    to[0] = back[0] = 0;
    for (std::size_t t = 0; t < sheets.size(); ++t)
        for (std::size_t side = 0; side < 2; ++side) {
            const std::uint32_t a = old.of_sides[features_.first_of[sheets[t]]][side];
            const std::uint32_t b = now.of_sides[t][side];
            if (to[a] == none && back[b] == none) {
                to[a] = b;
                back[b] = a;
            }
            if (to[a] != b || back[b] != a) return false;
        }
    improved.volume_before = std::move(back);
    return true;
}

/// Proves that the improved mesh is conforming, finds its volumes, and measures the quality before
/// and after.
Status Improver::check(Mesh after, std::span<const std::uint32_t> sheets, Improved& improved) {
    std::optional<Result<ConformingMesh>> proof;
    std::optional<Result<bool>> kept;
    both(
        run_, [&] { report_.before = measure_quality(input_.vertices, input_.triangles, run_); },
        [&] { proof = prove_conforming(std::move(after), sheets, options_.check, run_); });
    if (!*proof && proof->error().code == ErrorCode::interrupted) return proof->error();
    if (!*proof)
        return Error{ErrorCode::internal,
                     "the improved mesh is not conforming: " + proof->error().message(), ""};
    improved.conforming = std::move(*proof).value();
    improved.mesh = improved.conforming->mesh();
    const Mesh& mesh = improved.mesh;
    both(
        run_, [&] { report_.after = measure_quality(mesh.vertices, mesh.triangles, run_); },
        [&] { kept = sides_kept(sheets, improved); });
    if (!*kept) return kept->error();
    report_.sides_kept = kept->value();
    return Done{};
}

Result<Improved> Improver::assembled() {
    std::vector<std::uint32_t> used, sheets;
    Improved improved;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        if (!mesh_.in_use(t)) continue;
        used.push_back(t);
        sheets.push_back(mesh_.sheet_of[t]);
        improved.near_of.push_back(mesh_.hint_of[t]);
    }
    report_.splits = context_.splits;
    report_.collapses = context_.collapses;
    report_.swaps = context_.swaps;
    report_.moves = context_.moves;
    report_.refused_contact = validator_.refusals().contact;
    report_.refused_deviation = validator_.refusals().deviation;
    report_.refused_shape = validator_.refusals().shape;
    if (auto good = check(output(used), sheets, improved); !good) return good.error();
    report_.worst_cause = cause_of_worst(mesh_.triangles[used[report_.after.worst]]);
    report_.sheets = features_.first_of.size();
    report_.curves = features_.curves.size();
    report_.corners = static_cast<std::size_t>(
        std::count(features_.kinds.begin(), features_.kinds.end(), VertexKind::corner));
    improved.report = report_;
    return improved;
}

Status check_input(const Mesh& mesh, const ImproveOptions& options, const Run& run) {
    if (auto good = check_options(mesh, options); !good) return good;
    if (mesh.triangles.empty()) return Error{ErrorCode::nothing_to_do, "no triangle", ""};
    return validate_mesh(mesh, run);
}

Result<Improved> improve_unproven(const Mesh& mesh, const ImproveOptions& options, const Run& run) {
    if (auto good = check_input(mesh, options, run); !good) return good.error();
    std::optional<Status> good;
    std::optional<Improver> improver;
    both(
        run, [&] { good = check_conforming(mesh, run); },
        [&] { improver.emplace(mesh, options, run); });
    if (!*good) return good->error();
    return (*improver)();
}

Result<Improved> improve_proven(const ConformingMesh& mesh, const ImproveOptions& options,
                                const Run& run) {
    if (auto good = check_input(mesh, options, run); !good) return good.error();
    return Improver(mesh, options, run)();
}

} // namespace

std::string_view name_of(WorstCause cause) {
    switch (cause) {
    case WorstCause::none:
        return "none";
    case WorstCause::corner_angle:
        return "fixed corner angle";
    case WorstCause::short_curve:
        return "short curve";
    case WorstCause::close_curves:
        return "curves close together";
    case WorstCause::deviation:
        return "deviation bound";
    case WorstCause::contact:
        return "other triangles too near";
    case WorstCause::shape:
        return "no operation helps";
    }
    return "";
}

Result<Improved> improve(const Mesh& mesh, const ImproveOptions& options, const Run& run) {
    const StageTimer timer(run, "improve");
    return guarded("to improve the mesh", "improve",
                   [&] { return improve_unproven(mesh, options, timer.inside()); });
}

Result<Improved> improve(const ConformingMesh& mesh, const ImproveOptions& options,
                         const Run& run) {
    const StageTimer timer(run, "improve");
    return guarded("to improve the mesh", "improve",
                   [&] { return improve_proven(mesh, options, timer.inside()); });
}

std::vector<NamedConstant> improve_constants() {
    return quality::detail::named_constants();
}

} // namespace terrane
