// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/simplification/simplify.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/simplification/detail/comparison.hpp>
#include <terrane/algorithms/simplification/detail/glue.hpp>
#include <terrane/algorithms/simplification/detail/pockets.hpp>
#include <terrane/algorithms/simplification/detail/traced_mesh.hpp>
#include <terrane/algorithms/simplification/detail/tuning.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {
namespace {

using simplification::detail::changed_block_contacts;
using simplification::detail::changed_blocks;
using simplification::detail::changed_surface_contacts;
using simplification::detail::Complex;
using simplification::detail::glue;
using simplification::detail::GlueReport;
using simplification::detail::none;
using simplification::detail::thicknesses;
using simplification::detail::Traced;
using simplification::detail::TracedMesh;
using simplification::detail::tuning;

Error bad_resolution(std::string sentence) {
    return {ErrorCode::bad_option, std::move(sentence), "resolution"};
}

Status check_options(const Mesh& mesh, const SimplifyOptions& options) {
    if (!(options.resolution > 0) || !std::isfinite(options.resolution))
        return bad_resolution("must be positive and finite");
    if (!(options.max_move >= 0) || !std::isfinite(options.max_move))
        return Error{ErrorCode::bad_option, "must not be negative, and finite", "max_move"};
    if (mesh.triangles.empty()) return Error{ErrorCode::nothing_to_do, "no triangle", ""};
    Point3 low = mesh.vertices[mesh.triangles[0][0]], high = low;
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) {
            const Point3& p = mesh.vertices[v];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (!(options.resolution < extent))
        return bad_resolution(
            fmt::format("must be less than the extent of the model, {}", figure(extent)));
    return Done{};
}

/// Puts vertices back on those sides of the boundary that were in a plane parallel to two axes: where
/// improve() projects to such a plane, a rounding error may be left, and sides would not be planes.
void put_on_planes(const Mesh& before, Mesh& mesh) {
    for (double Point3::*const axis : {&Point3::x, &Point3::y, &Point3::z}) {
        std::vector<std::optional<double>> plane(before.surfaces.size()); // NaN: none
        for (std::size_t t = 0; t < before.triangles.size(); ++t)
            for (const std::uint32_t s : before.surfaces_of[t])
                for (const std::uint32_t v : before.triangles[t]) {
                    const double at = before.vertices[v].*axis;
                    if (plane[s].value_or(at) != at) // also where it is NaN
                        plane[s] = std::nan("");
                    else
                        plane[s] = at;
                }
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            for (const std::uint32_t s : mesh.surfaces_of[t])
                if (mesh.surfaces[s].role == Role::boundary && plane[s] && !std::isnan(*plane[s]))
                    for (const std::uint32_t v : mesh.triangles[t])
                        mesh.vertices[v].*axis = *plane[s];
    }
}

/// Simplifies one mesh.
class Simplifier {
public:
    Simplifier(const ConformingMesh& mesh, const SimplifyOptions& options, const Run& run) :
        given_(mesh), options_(options), run_(run) {
        if (options_.max_move == 0) options_.max_move = options_.resolution;
    }

    Result<Simplified> operator()() {
        if (auto done = make_regular(); !done) return done.error();
        std::vector<bool> locked(before_.measures.size());
        for (unsigned attempt = 1;; ++attempt) {
            result_ = {};
            if (auto done = attempt_with(locked); !done) return done.error();
            result_.report.attempts = attempt;
            const bool is_last = attempt == tuning.attempts;
            if (is_last || !lock_changed(locked)) break;
        }
        list_kept(locked);
        if (std::find(result_.block_before.begin(), result_.block_before.end(), none) !=
            result_.block_before.end())
            return bad_resolution("joining encloses a block that matches no block of the "
                                  "model for certain; try another one");
        if (auto measured = measure(); !measured) return measured.error();
        if (!result_.report.is_shown)
            return bad_resolution("the surfaces can't be joined so that all of each is shown to "
                                  "stay within the allowed movement; try a smaller one");
        return std::move(result_);
    }

private:
    [[nodiscard]] Status interrupted() const {
        if (!run_.stop.stop_requested()) return Done{};
        return Error{ErrorCode::interrupted, "stopped on request", ""};
    }

    /// Gives the surfaces regular triangles, which do not turn over when their corners move a
    /// little. Where improve() can't keep the blocks, the triangles stay as they are.
    Status make_regular() {
        ImproveOptions regular;
        regular.edge_length = options_.edge_length > 0 ? options_.edge_length
                                                       : tuning.edge_length * options_.resolution;
        regular.max_deviation = tuning.regular_share * options_.max_move;
        auto improved = improve(given_, regular, run_);
        if (!improved) return improved.error();
        const bool is_good = improved->report.sides_kept;
        first_ = simplification::detail::traced(is_good ? *improved->mesh : *given_);
        if (is_good)
            for (auto& past : first_.past) past.slack = regular.max_deviation;
        auto volumes = find_volumes(first_.mesh, run_);
        if (!volumes) return volumes.error();
        before_ = is_good ? renumbered(*volumes, improved->volume_before,
                                       improved->volumes_before.measures.size())
                          : std::move(*volumes);
        put_on_planes(*given_, first_.mesh);
        return Done{};
    }

    Status attempt_with(const std::vector<bool>& locked) {
        current_ = first_;
        const bool any = std::find(locked.begin(), locked.end(), true) != locked.end();
        for (unsigned round = 0;; ++round) {
            if (run_.progress) run_.progress("simplify", 0);
            Complex complex(current_.mesh.vertices, current_.past, current_.cells,
                            current_.mesh.surfaces);
            StageTimer timer(run_, "glue");
            GlueReport glued = glue(complex,
                                    {options_.resolution, options_.max_move, before_.of_sides,
                                     any ? locked : std::vector<bool>{}},
                                    run_);
            timer.stop();
            if (auto good = interrupted(); !good) return good;
            add(glued);
            const bool changed = glued.corners + glued.curves + glued.sheets > 0;
            if (round > 0 && !changed) break;
            if (auto done = arrange_again(complex); !done) return done;
            if (++result_.report.rounds == tuning.rounds) break;
        }
        return compare();
    }

    void add(GlueReport& glued) {
        SimplifyReport& r = result_.report;
        r.corners += glued.corners;
        r.curves += glued.curves;
        r.sheets += glued.sheets;
        r.divided += glued.divided;
        r.left = std::move(glued.left);
    }

    /// Arranges and rounds the surfaces of the complex.
    Status arrange_again(const Complex& complex) {
        auto soup = simplification::detail::soup_of(complex, current_.mesh.surfaces);
        auto exact = arrange(soup.surfaces, {}, run_);
        if (!exact) return exact.error();
        auto rounded = round_to_doubles(*exact, options_.rounding, run_);
        if (!rounded) return rounded.error();
        if (!rounded->conforming)
            return Error{ErrorCode::improper_contact,
                         "the simplified surfaces can't be rounded to a conforming mesh; try "
                         "another resolution",
                         ""};
        current_ =
            simplification::detail::traced(*rounded->conforming, soup, rounded->report.max_move);
        result_.surfaces = std::move(soup.surfaces);
        result_.exact = std::move(*exact);
        result_.rounded = std::move(*rounded);
        return Done{};
    }

    /// Returns the blocks after that are to be dissolved: thin parts of blocks, but for the largest
    /// part of each, and thin blocks where that was asked for.
    [[nodiscard]] std::vector<std::uint32_t> to_dissolve(const Volumes& volumes) const {
        const auto thickness = thicknesses(result_.rounded.mesh, volumes);
        std::vector<std::uint32_t> largest(before_.measures.size(), none), blocks;
        for (std::uint32_t v = 1; v < volumes.measures.size(); ++v) {
            const std::uint32_t b = result_.block_before[v];
            if (b != none &&
                (largest[b] == none || volumes.measures[v] > volumes.measures[largest[b]]))
                largest[b] = v;
        }
        for (std::uint32_t v = 1; v < volumes.measures.size(); ++v) {
            const std::uint32_t b = result_.block_before[v];
            const bool is_part = b == none || b == 0 || largest[b] != v;
            const double most = (is_part ? tuning.part_share : 1) * options_.resolution;
            if (thickness[v] < most && (is_part || options_.dissolve)) blocks.push_back(v);
        }
        return blocks;
    }

    /// Finds what changed in blocks and contacts, and dissolves parts of blocks.
    Status compare() {
        for (unsigned round = 0;; ++round) {
            auto volumes = find_volumes(result_.rounded.mesh, run_);
            if (!volumes) return volumes.error();
            const Traced after{result_.rounded.mesh, current_.cells, *volumes};
            result_.block_before = simplification::detail::matched_blocks(before_, after);
            const auto blocks = to_dissolve(*volumes);
            if (round < tuning.rounds && !blocks.empty() &&
                simplification::detail::dissolve(after.mesh, *volumes, blocks, result_.block_before,
                                                 current_.cells) > 0) {
                const Complex complex(current_.mesh.vertices, current_.past, current_.cells,
                                      current_.mesh.surfaces);
                if (auto done = arrange_again(complex); !done) return done;
                continue;
            }
            SimplifyReport& r = result_.report;
            r.blocks = changed_blocks(before_, after, result_.block_before);
            r.block_contacts = changed_block_contacts(before_, after, result_.block_before);
            r.surface_contacts = changed_surface_contacts(first_.mesh, after.mesh);
            return Done{};
        }
    }

    /// Lists the blocks that were left alone, and those thinner than the resolution that are there
    /// still.
    void list_kept(const std::vector<bool>& locked) {
        const auto thickness = thicknesses(first_.mesh, before_);
        const auto& now = result_.block_before;
        for (std::uint32_t b = 0; b < locked.size(); ++b) {
            const bool is_thin = b > 0 && thickness[b] < options_.resolution &&
                                 std::find(now.begin(), now.end(), b) != now.end();
            if (locked[b] || is_thin) result_.report.kept.push_back(b);
        }
    }

    /// Locks the blocks that may not change and did. Tells whether there are such.
    bool lock_changed(std::vector<bool>& locked) const {
        bool any = false;
        for (const ChangedBlock& change : result_.report.blocks) {
            if (change.parts == 0 && options_.dissolve) continue;
            if (change.block == 0) continue; // nearly all surfaces may be at it
            any = any || !locked[change.block];
            locked[change.block] = true;
        }
        return any;
    }

    Status measure() {
        const StageTimer timer(run_, "measure");
        SimplifyReport& r = result_.report;
        r.resolution = options_.resolution;
        r.max_move = options_.max_move;
        const Mesh& after = result_.rounded.mesh;
        std::vector<bool> has_before(given_->surfaces.size()), has_after = has_before;
        for (const std::uint32_t s : given_->surfaces_of.values) has_before[s] = true;
        for (const std::uint32_t s : after.surfaces_of.values) has_after[s] = true;
        r.is_shown = true;
        for (std::uint32_t s = 0; s < has_before.size(); ++s) {
            if (has_before[s] && !has_after[s]) r.vanished.push_back(s);
            if (!has_before[s] || !has_after[s]) continue;
            const Surface old = surface_of_mesh(given_, s), now = surface_of_mesh(after, s);
            r.is_shown = r.is_shown && is_within(now, old, options_.max_move, run_) &&
                         is_within(old, now, options_.max_move, run_);
            if (auto good = interrupted(); !good) return good;
        }
        r.deviations = deviations_of(given_, after, run_);
        std::stable_sort(r.left.begin(), r.left.end(), [](const LeftAlone& a, const LeftAlone& b) {
            return a.distance < b.distance;
        });
        return interrupted();
    }

    const ConformingMesh& given_;
    TracedMesh first_; ///< with regular triangles, numbered by place
    SimplifyOptions options_;
    const Run& run_;
    Volumes before_; ///< of first_, with the numbers of the given mesh
    TracedMesh current_;
    Simplified result_;
};

} // namespace

std::string_view name_of(LeftReason reason) {
    switch (reason) {
    case LeftReason::move:
        return "would move too far";
    case LeftReason::boundary:
        return "would leave the boundary";
    case LeftReason::fold:
        return "would fold";
    case LeftReason::block:
        return "would change a block";
    case LeftReason::limit:
        return "limit of passes";
    }
    return "";
}

Result<Simplified> simplify(const ConformingMesh& mesh, const SimplifyOptions& options,
                            const Run& run) {
    return guarded("to simplify the mesh", "simplify", [&]() -> Result<Simplified> {
        if (auto good = check_options(mesh, options); !good) return good.error();
        const StageTimer timer(run, "simplify");
        const Run inside = timer.inside();
        return Simplifier(mesh, options, inside)();
    });
}

std::vector<NamedConstant> simplify_constants() {
    return tuning.listed();
}

} // namespace terrane
