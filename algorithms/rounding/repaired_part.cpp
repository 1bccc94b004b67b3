// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/repaired_part.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <terrane/algorithms/rounding/detail/repair.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>
#include <terrane/algorithms/rounding/detail/tuning.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane {

using namespace rounding::detail;

namespace {

RoundingState state_of(PartOfDoubles& part) {
    RoundingState state;
    state.points = std::move(part.points);
    state.move = std::move(part.moves);
    state.is_dirty.assign(state.points.size(), false);
    for (const std::uint32_t v : part.unclean) state.is_dirty[v] = true;
    state.triangles = std::move(part.triangles);
    state.parents_of = std::move(part.parents_of);
    state.input_vertices = part.input_vertices;
    state.origins.resize(state.triangles.size());
    std::iota(state.origins.begin(), state.origins.end(), 0U);
    state.triangles_elsewhere = part.triangles_elsewhere;
    state.note_move_elsewhere(part.largest_move);
    state.end_round();
    return state;
}

/// Makes boxes larger by what snapping to the coarsest of the fine grids moves, and more, so that they
/// need not be asked for again after a move.
void widen(std::vector<Box>& boxes, const std::array<double, 3>& largest) {
    constexpr int digits = rounding_tuning.fine_digits.back() + 2;
    for (unsigned k = 0; k < 3; ++k) {
        const double room =
            std::ldexp(std::max(largest[k], std::numeric_limits<double>::min()), digits - 52);
        for (Box& box : boxes) {
            box.low[k] -= room;
            box.high[k] += room;
        }
    }
}

} // namespace

RepairedPart repair_part(PartOfDoubles part, const Run& run) {
    const BoxCover covered(std::move(part.covered));
    const double largest_move = part.largest_move;
    RoundingState state = state_of(part);
    const std::size_t all = state.all_triangles();
    const KeptPlanes no_planes;
    RepairTask task{no_planes};
    task.limit = part.limit;
    task.used = part.used;
    task.max_rounds = RoundingOptions{}.max_rounds;
    task.hopeless = hopeless_from(all);
    task.largest = part.largest_elsewhere;
    task.covered = &covered;
    const std::size_t left_from = part.is_moved ? hopeless_from(all) : crowded_from(all);

    RepairedPart out;
    Repair repair(state, task, run);
    if (repair.tidy() && !(state.is_torn && part.is_moved)) {
        auto pairs = repair.contacts();
        auto sampled = contacts_of_sampled(pairs, state.parents_of);
        const bool are_crowded = !part.is_moved && are_sampled_crowded(sampled.size(), all);
        if (are_crowded) pairs = std::move(sampled);
        out.naive_contacts = pairs.size();
        if (repair.missing().empty() && !state.is_torn && !are_crowded &&
            pairs.size() < left_from) {
            if (!pairs.empty()) repair(pairs);
            out.clean = pairs.empty() && repair.missing().empty();
        }
        if (!out.clean && repair.missing().empty())
            out.in_contact = parents_in_contact(pairs, state.parents_of);
    }
    out.missing = repair.missing();
    out.compared = repair.compared();
    if (!out.missing.empty()) {
        auto largest = task.largest;
        for (const Point3& p : state.points)
            largest = {std::max(largest[0], std::fabs(p.x)), std::max(largest[1], std::fabs(p.y)),
                       std::max(largest[2], std::fabs(p.z))};
        widen(out.missing, largest);
        out.missing = united(std::move(out.missing));
    }
    out.rounds = repair.rounds();
    if (!out.clean) return out;
    state.open_closed_parts(deviation_of(state, part.used));
    out.surface_deviation = deviation_of(state, part.used);
    out.max_move = largest_move;
    for (const double m : state.move) out.max_move = std::max(out.max_move, m);
    out.points = std::move(state.points);
    out.moves = std::move(state.move);
    out.triangles = std::move(state.triangles);
    out.parents_of = std::move(state.parents_of);
    out.origins = std::move(state.origins);
    return out;
}

} // namespace terrane
