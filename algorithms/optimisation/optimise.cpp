// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/optimisation/optimise.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/optimisation/detail/cells.hpp>
#include <terrane/algorithms/optimisation/detail/changes.hpp>
#include <terrane/algorithms/optimisation/detail/constants.hpp>
#include <terrane/algorithms/optimisation/detail/proposals.hpp>
#include <terrane/algorithms/optimisation/detail/remeshing.hpp>
#include <terrane/algorithms/optimisation/detail/work.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

namespace terrane {

using namespace optimisation::detail;

namespace {

/// Passes over the cells. Changes are proposed for many cells at a time, which are only read, and
/// then made one after the other where what they replace is unchanged: so the result does not
/// depend on the number of threads.
class Optimiser {
public:
    Optimiser(Cells& cells, const OptimiseOptions& options, const Run& run) :
        cells_(cells), options_(options), run_(run),
        wanted_(std::sin(options.wanted_angle * std::numbers::pi / 180)) {}

    Status run() {
        report.before = worst();
        floor_ = least_sine();
        const std::size_t most = most_effort();
        budget_ = Budget(most, cells_.size());
        if (options_.angles) {
            if (Status done = improve_passes(most); !done) return done;
            for (unsigned pass = 0; pass < 2; ++pass)
                if (const auto changed = remesh(); !changed) return changed.error();
        } else { // the call before has tried all
            tried_.back().assign(cells_.size(), 0);
            moved_.assign(cells_.points().size(), 0);
        }
        if (Status done = loosen(most); !done) return done;
        if (options_.shapes)
            if (Status done = improve_shapes(); !done) return done;
        report.after = worst();
        report.effort = budget_.spent();
        report.is_cut_short = budget_.is_spent();
        for (const std::uint32_t c : cells_below(wanted_)) {
            ++report.left;
            if (is_news(c, Depth::insertions)) ++report.untried;
        }
        return Done{};
    }

    OptimiseReport report;

private:
    [[nodiscard]] bool is_improved(std::uint32_t c) const {
        return cells_.is_alive(c) && cells_.counts(c);
    }

    [[nodiscard]] std::array<Point3, 4> corners_of(std::uint32_t c) const {
        std::array<Point3, 4> corners;
        for (unsigned k = 0; k < 4; ++k) corners[k] = cells_.points()[cells_.corners(c)[k]];
        return corners;
    }

    [[nodiscard]] WorstShapes worst() const {
        WorstShapes worst{HUGE_VAL, 180, 0};
        for (std::uint32_t c = 0; c < cells_.size(); ++c) {
            if (!is_improved(c)) continue;
            worst.quality = std::min(worst.quality, cells_.quality(c));
            for (const double angle : dihedral_angles(corners_of(c))) {
                worst.least_angle = std::min(worst.least_angle, angle);
                worst.largest_angle = std::max(worst.largest_angle, angle);
            }
        }
        return worst;
    }

    /// Returns the least sine of those that can be trusted.
    [[nodiscard]] double least_sine() const {
        double least = HUGE_VAL;
        for (std::uint32_t c = 0; c < cells_.size(); ++c) {
            if (!is_improved(c)) continue;
            const Quality quality = cells_.measure(cells_.corners(c));
            if (quality.is_trusted) least = std::min(least, quality.sine);
        }
        return least;
    }

    /// Moves vertices on surfaces that are free where cells are bad, and improves what is around them.
    /// That is done with an effort of its own, as hopeless cells may have taken all.
    Status loosen(std::size_t most) {
        if (options_.freedom.is_free.empty()) return Done{};
        budget_.renew(most / constants.loose_part, cells_.size() / constants.loose_part);
        const std::uint32_t before = cells_.time();
        const auto has_bad_angle = [&](std::uint32_t c) {
            return cells_.quality(c) < constants.bad;
        };
        if (Status done = loosen_where(has_bad_angle, constants.bad); !done) return done;
        budget_.renew(most, cells_.size());
        if (report.loosened > 0)
            if (const auto changed = remesh(before); !changed) return changed.error();
        return Done{};
    }

    /// The same for cells of which `is_bad` says so; none of a quality above `most` is asked for.
    template <class IsBad>
    Status loosen_where(const IsBad& is_bad, double most) {
        const bool is_wide = options_.freedom.is_wide;
        const Permission permission{options_.may_grow, floor_, is_wide ? 0 : constants.least_loose,
                                    is_wide ? constants.urgent : 0};
        for (unsigned pass = 0; pass < constants.loosening_passes; ++pass) {
            const auto changed = in_batches(
                Queue(cells_below(most)),
                [&](std::uint32_t c) { return cells_.is_alive(c) && is_bad(c); },
                [&](std::uint32_t c) { return claim_corners(c); },
                [&](std::uint32_t c) { return loosening_at(cells_, c, permission); },
                [](std::uint32_t, std::uint32_t) {});
            if (!changed) return changed.error();
            if (*changed == 0) break;
            if (Status done = improve_at(Depth::insertions); !done) return done;
        }
        return Done{};
    }

    /// Returns how many tetrahedra may be measured: more where most of them are good, since bad ones
    /// that are many are so because of their surfaces.
    [[nodiscard]] std::size_t most_effort() const {
        if (options_.max_effort > 0) return options_.max_effort;
        std::size_t all = 0;
        for (std::uint32_t c = 0; c < cells_.size(); ++c) all += is_improved(c) ? 1 : 0;
        const std::size_t bad = cells_below(constants.bad).size();
        const std::size_t more_good = all > 2 * bad ? all - 2 * bad : 0;
        return std::max(constants.least_effort, constants.effort_per_good * more_good);
    }

    /// Improves with all that is known, or, where the effort does not suffice for that, with what
    /// takes little first.
    Status improve_passes(std::size_t most) {
        const bool is_short = most < constants.effort_per_bad * cells_below(wanted_).size();
        for (const Depth depth : {Depth::flips, Depth::moves, Depth::insertions})
            if (is_short || depth == Depth::insertions)
                if (Status done = improve_at(depth); !done) return done;
        return Done{};
    }

    /// Raises the mean ratio of needles with good angles, unless improving angles has used up the
    /// effort. It makes no angle that is worse than 10 degrees, or than the worst one before if that
    /// is better.
    Status improve_shapes() {
        if (budget_.is_over()) return Done{};
        std::vector<double> by_angles;
        for (std::uint32_t c = 0; c < cells_.size(); ++c) by_angles.push_back(cells_.quality(c));
        const Measure measure{std::max(report.before.quality, constants.bad)};
        cells_.judge_by(measure);
        auto& tried = tried_[static_cast<std::size_t>(Depth::insertions)];
        tried.resize(cells_.size(), none);
        for (std::uint32_t c = 0; c < cells_.size(); ++c)
            if (cells_.quality(c) < by_angles[c]) tried[c] = none;
        Status done = improve_at(Depth::insertions);
        const auto is_misshapen = [&](std::uint32_t c) {
            return mean_ratio(corners_of(c)) < constants.least_ratio;
        };
        if (done && options_.freedom.is_wide)
            done =
                loosen_where(is_misshapen, quality_of_mean_ratio(constants.least_ratio, measure));
        cells_.judge_by({});
        return done;
    }

    Status improve_at(Depth depth) {
        const Permission permission{options_.may_grow, floor_};
        for (unsigned pass = 0; pass < options_.max_passes; ++pass) {
            auto changed = improve_cells(permission, depth);
            if (!changed) return changed.error();
            if (depth == Depth::insertions) {
                const auto moved = move_vertices(permission);
                if (!moved) return moved.error();
                *changed += *moved;
                if (run_.progress)
                    run_.progress("optimise", static_cast<double>(pass + 1) / options_.max_passes);
            }
            ++report.passes;
            if (*changed == 0 || budget_.is_over()) break;
        }
        return Done{};
    }

    /// Looks for several changes at a time for the cells that are still bad; only for those at which something has
    /// changed since then, if a time is given.
    Result<std::size_t> remesh(std::optional<std::uint32_t> since = {}) {
        const Permission permission{options_.may_grow, floor_};
        const auto is_bad = [&](std::uint32_t c) {
            return cells_.is_alive(c) && cells_.quality(c) < constants.bad &&
                   (!since || cells_.is_touched(c, *since));
        };
        const auto propose = [&](std::uint32_t c) {
            return remeshing_at(cells_, c, permission, wanted_);
        };
        return in_batches(
            Queue(cells_below(constants.bad)), is_bad,
            [&](std::uint32_t c) { return claim_corners(c); }, propose,
            [](std::uint32_t, std::uint32_t) {});
    }

    Result<std::size_t> improve_cells(const Permission& permission, Depth depth) {
        std::vector<std::uint32_t> bad = cells_below(wanted_);
        std::vector<std::uint32_t>& tried = tried_[static_cast<std::size_t>(depth)];
        tried.resize(cells_.size(), none);
        bad.erase(std::remove_if(bad.begin(), bad.end(),
                                 [&](std::uint32_t c) { return !is_news(c, depth); }),
                  bad.end());
        const auto claim = [&](std::uint32_t c) { return claim_corners(c); };
        const auto is_wanted = [&](std::uint32_t c) {
            return cells_.is_alive(c) && cells_.quality(c) < wanted_;
        };
        const auto propose = [&](std::uint32_t c) {
            return change_for_cell(cells_, c, permission, depth);
        };
        return in_batches(Queue(std::move(bad)), is_wanted, claim, propose,
                          [&](std::uint32_t c, std::uint32_t time) {
                              tried.resize(cells_.size(), none);
                              tried[c] = time;
                          });
    }

    Result<std::size_t> move_vertices(const Permission& permission) {
        moved_.resize(cells_.points().size(), none);
        const auto claim = [&](std::uint32_t v) {
            if (is_claimed(v)) return false;
            for (const std::uint32_t c : cells_.star(v))
                for (const std::uint32_t w : cells_.corners(c)) claimed_[w] = batch_;
            return true;
        };
        const auto propose = [&](std::uint32_t v) {
            return change_for_vertex(cells_, v, permission);
        };
        return in_batches(
            Queue(vertices_to_move()), [](std::uint32_t) { return true; }, claim, propose,
            [&](std::uint32_t v, std::uint32_t time) { moved_[v] = time; });
    }

    /// Returns the vertices around cells that are still far from being good enough, but for those
    /// that did not move and whose neighbours have not changed since; ascending.
    [[nodiscard]] std::vector<std::uint32_t> vertices_to_move() const {
        std::vector<bool> is_corner(cells_.points().size(), false), is_around(is_corner.size());
        for (const std::uint32_t c : cells_below(constants.relaxed * wanted_))
            for (const std::uint32_t v : cells_.corners(c)) is_corner[v] = true;
        for (std::uint32_t d = 0; d < cells_.size(); ++d) {
            if (!cells_.is_alive(d)) continue;
            const Corners& corners = cells_.corners(d);
            if (std::any_of(corners.begin(), corners.end(),
                            [&](std::uint32_t v) { return is_corner[v]; }))
                for (const std::uint32_t w : corners) is_around[w] = true;
        }
        std::vector<std::uint32_t> found;
        for (std::uint32_t v = 0; v < is_around.size(); ++v)
            if (is_around[v] && !cells_.is_fixed(v) &&
                (moved_[v] == none || moved_[v] < cells_.touched(v)))
                found.push_back(v);
        return found;
    }

    /// Proposes changes for many items at a time, and makes them in order. Tells `failed` of those
    /// without one, with the time of the proposal. Returns the number of changes.
    template <class Wanted, class Claim, class Propose, class Failed>
    Result<std::size_t> in_batches(Queue queue, const Wanted& is_wanted, const Claim& claim,
                                   const Propose& propose, const Failed& failed) {
        std::size_t changes = 0;
        while (true) {
            if (run_.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped while improving tetrahedra", ""};
            if (queue.is_empty() || budget_.is_over()) break;
            ++batch_;
            claimed_.resize(cells_.points().size(), 0);
            const auto batch =
                queue.next([&](std::uint32_t item) { return !is_wanted(item) || claim(item); });
            const std::uint32_t time = cells_.time();
            std::vector<Proposal> proposed(batch.size());
            const auto one = [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    if (is_wanted(batch[i])) proposed[i] = propose(batch[i]);
            };
            for_ranges(batch.size(), run_, one, 8, 1);
            for (std::size_t i = 0; i < batch.size(); ++i) {
                budget_.spend(proposed[i].effort);
                if (!is_wanted(batch[i])) continue;
                auto& change = proposed[i].change;
                if (change && !is_unchanged(*change, time)) {
                    queue.again(batch[i]);
                } else if (change && make_and_count(*change)) {
                    ++changes;
                    budget_.reward();
                } else {
                    failed(batch[i], time);
                }
            }
        }
        return changes;
    }

    /// Returns the cells that are worse than that, the worst first.
    [[nodiscard]] std::vector<std::uint32_t> cells_below(double quality) const {
        std::vector<std::pair<double, std::uint32_t>> bad;
        for (std::uint32_t c = 0; c < cells_.size(); ++c)
            if (is_improved(c) && cells_.quality(c) < quality)
                bad.emplace_back(cells_.quality(c), c);
        std::sort(bad.begin(), bad.end());
        std::vector<std::uint32_t> numbers;
        for (const auto& [at, c] : bad) numbers.push_back(c);
        return numbers;
    }

    /// Tells whether anything at a cell has changed since no change was found for it.
    [[nodiscard]] bool is_news(std::uint32_t c, Depth depth) const {
        const auto& tried = tried_[static_cast<std::size_t>(depth)];
        return c >= tried.size() || tried[c] == none || cells_.is_touched(c, tried[c]);
    }

    [[nodiscard]] bool is_claimed(std::uint32_t v) const { return claimed_[v] == batch_; }

    /// Claims the corners of a cell for the batch, unless one of them is claimed.
    bool claim_corners(std::uint32_t c) {
        const Corners& corners = cells_.corners(c);
        if (std::any_of(corners.begin(), corners.end(),
                        [&](std::uint32_t v) { return is_claimed(v); }))
            return false;
        for (const std::uint32_t v : corners) claimed_[v] = batch_;
        return true;
    }

    /// Tells whether what a change replaces is what it was.
    [[nodiscard]] bool is_unchanged(const Change& change, std::uint32_t since) const {
        return std::all_of(change.old.begin(), change.old.end(),
                           [&](std::uint32_t c) { return cells_.changed(c) <= since; });
    }

    bool make_and_count(Change& change) {
        if (!make(cells_, change, {cells_.least_quality(change.old), floor_})) return false;
        count(change.kind);
        if (change.kind == Change::Kind::move && cells_.is_fixed(change.vertex)) ++report.loosened;
        return true;
    }

    void count(Change::Kind kind) {
        switch (kind) {
        case Change::Kind::edge:
            ++report.removed_edges;
            break;
        case Change::Kind::face:
            ++report.removed_faces;
            break;
        case Change::Kind::move:
            ++report.moved;
            break;
        case Change::Kind::contraction:
            ++report.contracted;
            break;
        case Change::Kind::insertion:
            ++report.inserted;
            break;
        case Change::Kind::remeshing:
            ++report.remeshed;
            break;
        }
    }

    Cells& cells_;
    const OptimiseOptions& options_;
    const Run& run_;
    double wanted_;
    Budget budget_;
    double floor_ = 0; ///< least sine of all cells before
    /// Per depth and cell: when no change was found for it; or none.
    std::array<std::vector<std::uint32_t>, 3> tried_;
    std::vector<std::uint32_t> moved_;   ///< per vertex: when no better place was found; or none
    std::vector<std::uint32_t> claimed_; ///< per vertex: the last batch with a cell at it
    std::uint32_t batch_ = 0;
};

/// Refuses lists that do not belong together.
Status check_lists(const TetrahedralMesh& mesh) {
    const std::size_t count = mesh.vertices.size();
    const auto are_vertices = [&](const auto& corners) {
        return std::all_of(corners.begin(), corners.end(),
                           [&](std::uint32_t v) { return v < count; });
    };
    if (mesh.block_of.size() == mesh.tetrahedra.size() &&
        std::all_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(), are_vertices) &&
        std::all_of(mesh.faces.begin(), mesh.faces.end(), are_vertices))
        return Done{};
    return Error{ErrorCode::bad_index, "the lists of the tetrahedra do not fit each other", ""};
}

Status check_freedom(const TetrahedralMesh& mesh, const VertexFreedom& freedom) {
    if (freedom.is_free.empty() ||
        (freedom.is_free.size() == mesh.vertices.size() && freedom.place))
        return Done{};
    return Error{ErrorCode::bad_option, "the freedom of vertices is that of all or of none", ""};
}

Result<OptimiseReport> optimise_valid(TetrahedralMesh& mesh, const OptimiseOptions& options,
                                      const Run& run) {
    if (!(options.wanted_angle > 0 && options.wanted_angle < 60))
        return Error{ErrorCode::bad_option, "the wanted angle is between 0 and 60 degrees", ""};
    if (!mesh.twins.empty())
        return Error{ErrorCode::bad_option, "tetrahedra with split nodes can't be improved", ""};
    if (Status sound = check_lists(mesh); !sound) return sound.error();
    if (Status sound = check_freedom(mesh, options.freedom); !sound) return sound.error();
    Cells cells(mesh, options.outside);
    cells.set_free(options.freedom);
    Optimiser optimiser(cells, options, run);
    Status done = Done{};
    with_threads(run, [&] { done = optimiser.run(); });
    if (!done) return done.error();
    cells.write(mesh);
    return optimiser.report;
}

} // namespace

Result<OptimiseReport> optimise(TetrahedralMesh& mesh, const OptimiseOptions& options,
                                const Run& run) {
    const StandardArithmetic guard;
    const StageTimer timer(run, "optimise");
    return guarded("for the shapes of tetrahedra", "optimise",
                   [&] { return optimise_valid(mesh, options, timer.inside()); });
}

std::vector<NamedConstant> optimise_constants() {
    return constants.listed();
}

} // namespace terrane
