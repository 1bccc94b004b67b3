// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/improve.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/is_external.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/block_volumes.hpp>
#include <terrane/algorithms/quality/detail/constants.hpp>
#include <terrane/algorithms/quality/detail/remesher.hpp>
#include <terrane/algorithms/quality/detail/sizes.hpp>
#include <terrane/algorithms/quality/detail/sorted_mesh.hpp>
#include <terrane/algorithms/quality/detail/thickness.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {
namespace {

using namespace quality::detail;

constexpr double pi = 3.14159265358979323846;
constexpr double attempt_share = 0.7; ///< of the remaining progress, that one attempt stands for

Error wrong(std::string sentence) {
    return {ErrorCode::bad_option, std::move(sentence), ""};
}

bool is_length(double x) {
    return std::isfinite(x) && x >= 0;
}

Status check_options(const Mesh& mesh, const ImproveOptions& o) {
    if (auto flaw = flaw_of_fields(o)) return wrong(*std::move(flaw));
    if (!o.edge_length_of.empty() && o.edge_length_of.size() != mesh.surfaces.size())
        return wrong("edge_length_of needs one length per surface");
    for (const auto& refinement : o.refinements)
        for (const LocalSize& local : refinement)
            if (!is_finite(local.place) || !is_length(local.length) || local.length == 0)
                return wrong("refinements must have finite places and positive lengths");
    for (const double l : o.edge_length_of)
        if (!is_length(l)) return wrong("lengths must be finite and not negative");
    return Done{};
}

Status check_conforming(const Mesh& mesh, const Run& run) {
    std::vector<std::uint32_t> labels;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        labels.push_back(mesh.surfaces_of[t][0]);
    return conforming(mesh.vertices, mesh.triangles, labels, run);
}

/// Tells whether the triangles run round in opposite directions.
bool is_turned(const Triangle& t, const Triangle& other) {
    const auto at =
        static_cast<std::size_t>(std::find(other.begin(), other.end(), t[0]) - other.begin());
    return other[(at + 1) % 3] != t[1];
}

class Improver {
public:
    Improver(const Mesh& original, const ImproveOptions& options, const Run& run) :
        original_(original), sorted_(sort_by_place(original)), input_(sorted_.mesh),
        options_(options), run_(run),
        features_(find_features(
            input_, {options.crease_angle * pi / 180, options.curve_angle * pi / 180}, run)),
        sizes_(find_sizes(input_, features_, options)),
        bound_of_triangles_(
            bounds_by_thickness(input_, features_, sizes_, options.thickness_share, run)),
        reference_(input_.vertices, features_, sizes_.bound_of) {
        for (std::size_t t = 0; t < bound_of_triangles_.size(); ++t)
            report_.thin_triangles +=
                bound_of_triangles_[t] < sizes_.bound_of[features_.sheet_of[t]];
        reference_.limit_bounds(bound_of_triangles_);
        reference_.find_isolated(run);
    }

    Result<Improved> operator()() {
        const double least = *std::min_element(sizes_.bound_of.begin(), sizes_.bound_of.end());
        if (least < reference_.least_bound())
            return wrong(fmt::format(
                "max_deviation is too small for coordinates of this size; the least is {}",
                reference_.least_bound()));
        if (const double count = expected_with_sizes(input_, features_, sizes_);
            count > options_.max_triangles)
            return wrong(fmt::format("about {} triangles are to be expected, more than "
                                     "max_triangles, {}",
                                     figure(count, 3), figure(options_.max_triangles)));
        find_orientations();
        std::optional<Result<Volumes>> volumes;
        Run quiet = run_; // progress may only be reported by the calling thread
        quiet.progress = nullptr;
        both(
            run_,
            [&] { report_.before = measure_quality(input_.vertices, input_.triangles, run_); },
            [&] { volumes = find_volumes(original_, quiet); });
        if (!*volumes) return volumes->error();
        volumes_before_ = std::move(*volumes).value();
        report_.bound_of.assign(input_.surfaces.size(), 0);
        for (std::size_t s = 0; s < sizes_.bound_of.size(); ++s)
            for (const std::uint32_t surface : input_.surfaces_of[features_.first_of[s]])
                report_.bound_of[surface] = std::max(report_.bound_of[surface], sizes_.bound_of[s]);
        remesh();
        if (stopped()) return Error{ErrorCode::interrupted, "stopped on request", ""};
        return assembled();
    }

private:
    [[nodiscard]] bool stopped() const { return run_.stop.stop_requested(); }

    void remesh();
    bool is_good_enough(LeastQuality& least);
    [[nodiscard]] BlockVolumes block_volumes() const;
    Result<Improved> assembled();
    Status check(Mesh after, std::span<const std::uint32_t> sheets, Improved& improved);
    [[nodiscard]] Result<bool> sides_kept(std::span<const std::uint32_t> sheets,
                                          Improved& improved) const;
    [[nodiscard]] Mesh output(std::span<const std::uint32_t> used) const;
    void find_orientations();
    void add_intersection_edges(std::span<const std::uint32_t> used,
                                std::span<const std::uint32_t> name_of, Mesh& out) const;

    const Mesh& original_;
    const SortedMesh sorted_;
    const Mesh& input_; ///< original_, sorted
    const ImproveOptions& options_;
    const Run& run_;
    const Features features_;
    const Sizes sizes_;
    std::vector<double> bound_of_triangles_; ///< see bounds_by_thickness()
    ReferenceSurface reference_;
    std::optional<Remesher> remesher_; ///< of the last attempt
    unsigned strict_attempts_ = 0;     ///< attempts after which more triangles became strict
    ImproveReport report_;
    Volumes volumes_before_;
    std::vector<std::uint32_t> first_of_; ///< per sheet: its first triangle in original_
    std::vector<bool> is_turned_;         ///< per sheet: that triangle is oriented otherwise
};

/// Tells whether no triangle is worse than any may be. Otherwise more triangles become strict:
/// those near the bad ones, and at last all.
bool Improver::is_good_enough(LeastQuality& least) {
    if (least.elsewhere == least.wanted) return true; // all were strict
    const WorkMesh& mesh = remesher_->mesh();
    const auto bad = worse_than(mesh, least.wanted);
    if (bad.empty()) return true;
    if (++strict_attempts_ > constants.strict_attempts ||
        constants.strict_part * bad.size() > mesh.triangles.size())
        least = {least.wanted, least.wanted};
    else
        make_strict_near(bad, mesh, input_, least);
    return false;
}

BlockVolumes Improver::block_volumes() const {
    std::vector<std::array<std::uint32_t, 2>> sides;
    for (std::size_t s = 0; s < first_of_.size(); ++s) {
        sides.push_back(volumes_before_.of_sides[first_of_[s]]);
        if (is_turned_[s]) std::swap(sides.back()[0], sides.back()[1]);
    }
    return {input_, features_, std::move(sides), volumes_before_.measures.size()};
}

/// Improves the mesh. Repeats that with more strict triangles as long as a triangle is worse than
/// any may be, and with smaller bounds where volumes change too much.
void Improver::remesh() {
    LeastQuality least;
    least.wanted =
        std::min(report_.before.q.min, options_.least_quality) * (1 - constants.quality_rounding);
    least.elsewhere = std::min(least.wanted, constants.least_quality);
    report_.least_quality = least.wanted;
    BlockVolumes blocks = block_volumes();
    const double share = options_.max_volume_change / 100;
    unsigned volume_attempts = 0;
    double done = 0;
    for (report_.attempts = 1;; ++report_.attempts) {
        const double to = done + attempt_share * (1 - done);
        remesher_.emplace(RemeshInput{input_, features_, sizes_, reference_, options_}, least,
                          run_);
        (*remesher_)(options_.passes, done, to);
        done = to;
        if (stopped()) return;
        const bool is_good = is_good_enough(least);
        const bool is_limited =
            volume_attempts < constants.volume_attempts &&
            blocks.limit_bounds(remesher_->mesh(), share, reference_.least_bound(), sizes_.bound_of,
                                bound_of_triangles_);
        report_.held_blocks = blocks.limited();
        if (is_good && !is_limited) return;
        if (!is_limited) continue;
        ++volume_attempts;
        reference_.limit_bounds(bound_of_triangles_);
    }
}

/// Finds the first original triangle of each sheet, by which the result is oriented.
void Improver::find_orientations() {
    first_of_.assign(features_.first_of.size(), none);
    is_turned_.assign(first_of_.size(), false);
    const auto number = [&](std::uint32_t v) { return sorted_.number_of[v]; };
    for (std::uint32_t t = 0; t < features_.triangles.size(); ++t) {
        const std::uint32_t sheet = features_.sheet_of[t], here = sorted_.triangle_of[t];
        if (here >= first_of_[sheet]) continue;
        first_of_[sheet] = here;
        const Triangle& c = original_.triangles[here];
        is_turned_[sheet] =
            is_turned({number(c[0]), number(c[1]), number(c[2])}, features_.triangles[t]);
    }
}

void Improver::add_intersection_edges(std::span<const std::uint32_t> used,
                                      std::span<const std::uint32_t> name_of, Mesh& out) const {
    const WorkMesh& mesh = remesher_->mesh();
    for (const std::uint32_t t : used)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
            const std::uint32_t c = mesh.curve_at(a, b);
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
    const WorkMesh& mesh = remesher_->mesh();
    Mesh out;
    out.surfaces = input_.surfaces;
    std::vector<std::uint32_t> name_of(mesh.points.size(), none);
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
        if (mesh.star[v].empty()) continue;
        name_of[v] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(mesh.points[v]);
    }
    for (const std::uint32_t t : used) {
        const Triangle& c = mesh.triangles[t];
        out.triangles.push_back({name_of[c[0]], name_of[c[1]], name_of[c[2]]});
        if (is_turned_[mesh.sheet_of[t]])
            std::swap(out.triangles.back()[1], out.triangles.back()[2]);
        const std::uint32_t first = features_.first_of[mesh.sheet_of[t]];
        out.surfaces_of.push_back(input_.surfaces_of[first]);
        if (input_.regions_of.size() > 0) out.regions_of.push_back(input_.regions_of[first]);
    }
    add_intersection_edges(used, name_of, out);
    return out;
}

/// Finds the volumes of the improved mesh. Tells whether a renaming of volumes exists by which each
/// sheet has the same volumes on its sides as before.
Result<bool> Improver::sides_kept(std::span<const std::uint32_t> sheets, Improved& improved) const {
    Run quiet = run_; // progress may only be reported by the calling thread
    quiet.progress = nullptr;
    auto found = find_volumes(improved.mesh, quiet);
    if (!found) return found.error();
    improved.volumes_before = volumes_before_;
    improved.volumes = std::move(found).value();
    const Volumes &old = improved.volumes_before, &now = improved.volumes;
    std::vector<std::uint32_t> to(old.measures.size(), none), back(now.measures.size(), none);
    if (to.size() != back.size()) return false;
    to[0] = back[0] = 0;
    for (std::size_t t = 0; t < sheets.size(); ++t)
        for (std::size_t side = 0; side < 2; ++side) {
            const std::uint32_t a = old.of_sides[first_of_[sheets[t]]][side];
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
    proof = prove_conforming(std::move(after), sheets, options_.check, run_);
    if (!*proof && is_external(proof->error().code)) return proof->error();
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
    report_.worst_cause = remesher_->cause_of_worst();
    remesher_->describe(report_);
    const WorkMesh& mesh = remesher_->mesh();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.in_use(t)) used.push_back(t);
    // Sheets follow in the order of the input, so that those of a surface are together.
    std::stable_sort(used.begin(), used.end(), [&](std::uint32_t a, std::uint32_t b) {
        return first_of_[mesh.sheet_of[a]] < first_of_[mesh.sheet_of[b]];
    });
    for (const std::uint32_t t : used) {
        sheets.push_back(mesh.sheet_of[t]);
        improved.near_of.push_back(sorted_.triangle_of[mesh.hint_of[t]]);
    }
    if (auto good = check(output(used), sheets, improved); !good) return good.error();
    report_.is_strict = strict_attempts_ > 0;
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
    case WorstCause::rounds:
        return "limit of changes";
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
    return quality::detail::constants.listed();
}

} // namespace terrane
