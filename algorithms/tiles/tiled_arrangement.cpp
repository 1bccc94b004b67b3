// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

#include <algorithm>
#include <cstring>
#include <functional>
#include <span>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/algorithms/rounding/moved_input.hpp>
#include <terrane/algorithms/tiles/detail/over_tiles.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>

namespace terrane::tiles {

using namespace detail;

namespace {

using Exchange = Status (*)(Tile&, Inbox&, Outbox&);
using Computation = Status (*)(Tile&, Inbox&, Outbox&, const Run&);

/// A step, with its name and the work next to it.
struct NamedStep {
    std::string_view name;
    Exchange exchange;
    Computation computation = nullptr;
    std::function<void(Tile&, Inbox&, Outbox&)> StepsBeside::*beside = nullptr;
};

constexpr NamedStep sharing_steps[] = {{"share", share_out}, {"name", receive_share}};

constexpr NamedStep arranging_steps[] = {
    {"name", find_first_vertices},
    {"name", ask_for_corners},
    {"name", tell_corners},
    {"decompose", weigh_cells},
    {"decompose", divide_space},
    {"distribute", distribute_faces},
    {"pairs", nullptr, decide_pairs},
    {"divide", nullptr, divide_own_faces},
    {"number", split_points},
    {"number", send_points, nullptr, &StepsBeside::send_points},
    {"number", order_constructed, nullptr, &StepsBeside::order_constructed},
    {"number", number_points, nullptr, &StepsBeside::number_points},
    {"unite", receive_numbers},
    {"unite", unite_parts},
    {"unite", settle},
    {"check", nullptr, check_doubles},
    {"edges", send_shared_edges},
    {"edges", decide_shared_edges},
    {"regions", join_within},
    {"regions", join_across},
    {"regions", number_regions},
    {"regions", receive_regions},
};

Status perform(Supersteps& tiles, std::span<const NamedStep> steps, const StepsBeside& beside,
               const Run& run) {
    for (const NamedStep& s : steps) {
        const auto work = [&](Tile& b, Inbox& in, Outbox& out) -> Status {
            auto done =
                s.exchange != nullptr ? s.exchange(b, in, out) : s.computation(b, in, out, run);
            if (done && s.beside != nullptr && beside.*s.beside) (beside.*s.beside)(b, in, out);
            return done;
        };
        if (auto done = tiles.step(s.name, work); !done) return done;
    }
    return Done{};
}

/// Returns the digest: the hash of the sorted records of all tiles, whose ranges ascend.
Result<std::string> digest_of(Supersteps& tiles) {
    const auto passed = tiles.relay([](Tile& b, Bytes bytes) {
        Sha256 state;
        static_assert(std::is_trivially_copyable_v<Sha256>);
        if (bytes.empty())
            state.feed("terrane-digest 1\n");
        else
            std::memcpy(&state, bytes.data(), sizeof state);
        state.feed(b.records);
        Bytes next;
        append_record(next, state);
        return next;
    });
    if (!passed) return passed.error();
    Sha256 state;
    std::memcpy(&state, passed->data(), sizeof state);
    return "sha256:" + hexadecimal(state.finish());
}

constexpr std::uint64_t Work::*counts[] = {
    &Work::homes,         &Work::faces,      &Work::owned,       &Work::candidates, &Work::improper,
    &Work::divided,       &Work::predicates, &Work::constructed, &Work::triangles,  &Work::messages,
    &Work::rounded_pairs, &Work::near_boxes, &Work::bytes,       &Work::memory};

} // namespace

Result<TiledReport> detail::summary_of(Supersteps& tiles) {
    struct Passed {
        std::uint64_t edges = 0, contacts = 0, triangles = 0, vertices = 0, regions = 0;
        std::uint64_t input_vertices = 0, input_triangles = 0;
        double deviation = 0, largest_coordinate = 0;
    };
    const auto all = over_tiles<Passed>(tiles, [](Tile& b, Passed& sum) {
        sum.edges += b.edges;
        sum.contacts = b.unclean;
        sum.triangles = b.result_triangles;
        sum.vertices =
            std::uint64_t{b.used_total} + b.constructed_total + b.added - b.removed.size();
        sum.regions = b.regions;
        sum.input_vertices = b.vertex_total();
        sum.input_triangles = b.triangle_total();
        sum.deviation = b.deviation;
        sum.largest_coordinate = b.largest;
    });
    if (!all) return all.error();
    TiledReport report;
    report.contacts = all->contacts;
    report.deviation = all->deviation;
    report.limit = default_max_move(all->largest_coordinate);
    report.input_vertices = all->input_vertices;
    report.input_triangles = all->input_triangles;
    report.vertices = all->vertices;
    report.triangles = all->triangles;
    report.intersection_edges = all->edges;
    report.regions = all->regions;
    if (auto counted = count_work(tiles, report); !counted) return counted.error();
    return report;
}

Status count_work(Supersteps& tiles, TiledReport& report) {
    using LargestAndTotal = std::array<Work, 2>;
    const auto all = over_tiles<LargestAndTotal>(tiles, [](Tile& b, LargestAndTotal& sum) {
        for (const auto count : counts) {
            sum[0].*count = std::max(sum[0].*count, b.work.*count);
            sum[1].*count += b.work.*count;
        }
    });
    if (!all) return all.error();
    report.largest = (*all)[0];
    report.total = (*all)[1];
    report.total.memory = report.largest.memory;
    return Done{};
}

Status detail::arrange_moved(Supersteps& tiles, const StepsBeside& beside, const Run& run) {
    return perform(tiles, arranging_steps, beside, run);
}

namespace {

/// Repairs the doubles of an arrangement, or moves the input, where they are not conforming.
Status make_conforming(Supersteps& tiles, TiledReport& report, std::uint64_t most_gathered,
                       const Run& run) {
    if (report.clean || report.deviation > report.limit) return Done{};
    const bool has_triangles = report.triangles > 0;
    const RepairInput input{
        std::max<std::uint64_t>(most_gathered, 2 * report.triangles / tiles.tiles())};
    auto repaired = repair_few(tiles, report, input, run);
    if (!repaired) return repaired.error();
    if (!report.clean && repaired->is_done)
        if (auto done = move_input(tiles, report, std::move(*repaired), input, run); !done)
            return done;
    if (has_triangles && report.triangles == 0) return nothing_left();
    return Done{};
}

} // namespace

Result<TiledReport> arrange_in_tiles(Supersteps& tiles, const FileReader& read,
                                     const TiledOptions& options, const Run& run) {
    const auto reading = [&](Tile& b, Inbox&, Outbox& out) {
        b.wants_digest = options.digest;
        return announce(b, options.files, read, out);
    };
    if (auto done = tiles.step("read", reading); !done) return done.error();
    if (auto done = perform(tiles, sharing_steps, {}, run); !done) return done.error();
    if (auto done = perform(tiles, arranging_steps, {}, run); !done) return done.error();
    auto report = summary_of(tiles);
    if (!report) return report;
    report->clean = report->contacts == 0 && report->deviation <= report->limit;
    if (options.digest) {
        auto digest = digest_of(tiles);
        if (!digest) return digest.error();
        report->digest = std::move(*digest);
    }
    if (auto done = make_conforming(tiles, *report, options.most_gathered, run); !done)
        return done.error();
    return report;
}

TilePiece piece_of(const Tile& b) {
    TilePiece piece;
    for (std::uint32_t s = 0; s < b.entries.size(); ++s)
        piece.mesh.surfaces.push_back(
            {name_of_surface(b, s), static_cast<Role>(b.entries[s].role)});
    std::vector<std::uint32_t> names; // in the order of their numbers
    names.reserve(3 * b.triangles.size());
    for (const Triangle& t : b.triangles) names.insert(names.end(), t.begin(), t.end());
    sort_unique(names);
    for (const std::uint32_t name : names) {
        piece.vertex_ids.push_back(vertex_number(b, name));
        piece.mesh.vertices.push_back(doubles_of(b, name));
    }
    for (Triangle t : b.triangles) {
        for (std::uint32_t& v : t)
            v = static_cast<std::uint32_t>(std::lower_bound(names.begin(), names.end(), v) -
                                           names.begin());
        piece.mesh.triangles.push_back(t);
    }
    piece.triangle_ids = b.ids;
    piece.mesh.parents_of = b.parents_of;
    piece.mesh.surfaces_of = b.surfaces_of;
    piece.mesh.regions_of.offsets = b.surfaces_of.offsets;
    piece.mesh.regions_of.values = b.region_of;
    piece.volumes_of_sides = b.volumes_of_sides;
    return piece;
}

std::vector<bool> shared_vertices(const Tile& b, const TilePiece& piece) {
    std::vector<bool> shared(piece.vertex_ids.size());
    for (std::size_t t = 0; t < b.triangles.size(); ++t)
        for (unsigned i = 0; i < 3; ++i)
            shared[piece.mesh.triangles[t][i]] = is_shared(b, b.triangles[t][i]);
    return shared;
}

} // namespace terrane::tiles
