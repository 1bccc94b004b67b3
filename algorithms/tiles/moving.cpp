// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Moves the input where its doubles are not conforming, and arranges it again in tiles. All processes know
// the chosen points; the first tile knows the input triangles in contact.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/rounding/moved_input.hpp>
#include <terrane/algorithms/tiles/detail/frames.hpp>
#include <terrane/algorithms/tiles/detail/joints.hpp>
#include <terrane/algorithms/tiles/detail/over_tiles.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>

namespace terrane::tiles {

using namespace detail;

namespace {

/// Notes the input as it is, before it is moved for the first time. Channel 0: duplicates, home.
Status note_input(Tile& b, Inbox&, Outbox& out) {
    b.home_given = b.home_points;
    b.home_given_first = b.home_first;
    b.home_flat = b.home_degenerate;
    for (const auto& repeated : b.duplicates)
        out.put(home_of(repeated[0], b.triangle_total(), b.count), 0, repeated);
    b.given_grid = b.grid;
    b.given_splitters = b.splitters;
    return Done{};
}

Status note_repeated(Tile& b, Inbox& in, Outbox&) {
    b.home_repeated = in.all<std::array<std::uint32_t, 2>>(0);
    sort_unique(b.home_repeated);
    return Done{};
}

/// Makes a tile as it was before its vertices were named, with the input where it lies.
void begin_anew(Tile& b) {
    Tile fresh;
    fresh.index = b.index;
    fresh.count = b.count;
    fresh.work = b.work;
    fresh.entries = std::move(b.entries);
    fresh.names = std::move(b.names);
    fresh.first_vertex = std::move(b.first_vertex);
    fresh.first_triangle = std::move(b.first_triangle);
    fresh.home_points = b.home_given;
    fresh.home_triangles = std::move(b.home_triangles);
    fresh.home_given = std::move(b.home_given);
    fresh.home_given_first = std::move(b.home_given_first);
    fresh.home_flat = std::move(b.home_flat);
    fresh.home_repeated = std::move(b.home_repeated);
    fresh.given_grid = b.given_grid;
    fresh.given_splitters = std::move(b.given_splitters);
    b = std::move(fresh);
}

/// The input of all tiles.
class MovedTiles final : public MovableInput {
public:
    MovedTiles(Supersteps& tiles, TiledReport& report, RepairOfFew first, const RepairInput& input,
               const Run& run) :
        tiles_(tiles),
        report_(report), first_(std::move(first)), input_(input), run_(run) {}

    Status operator()() {
        auto met = find_meetings(tiles_);
        if (!met) return met.error();
        met_ = std::move(*met);
        for (const auto& step : {note_input, note_repeated})
            if (auto done = tiles_.step("move", step); !done) return done;
        if (auto done = find_largest(); !done) return done;
        last_ = first_.in_contact;
        if (const auto any = choose_more(); !any) return any.error();
        const unsigned most = RoundingOptions{}.max_rounds, before = first_.summary.rounds;
        const auto found = attempt_moves(*this, report_.limit, most > before ? most - before : 0);
        if (!found && !is_left_) return found.error();
        if (found && *found) return Done{};
        return tiles_.step("move", [](Tile& b, Inbox&, Outbox&) -> Status {
            begin_anew(b);
            return Done{};
        });
    }

private:
    Result<std::optional<DecimalFrame>> decimal_frame() override;
    Result<std::optional<ClusterFrame>> cluster_frame() override;
    [[nodiscard]] std::optional<SnapGrid> grid(int digits, double limit) const override {
        return grid_of_digits({}, digits, limit, no_planes_, largest_);
    }
    Result<Attempted> attempt(const DecimalFrame& frame) override { return in_frame(frame); }
    Result<Attempted> attempt(const ClusterFrame& frame) override { return in_frame(frame); }
    Result<Attempted> attempt(const SnapGrid& grid) override;
    Result<bool> choose_more() override;

    template <class Frame>
    Result<Attempted> in_frame(const Frame& frame);
    Result<Attempted> attempt(const std::function<void(Tile&)>& move, double farthest,
                              const StepsBeside& beside);
    Result<Attempted> arranged(double farthest);
    Status find_largest();
    [[nodiscard]] std::vector<Point3> directions(double tolerance) const;
    [[nodiscard]] std::vector<Point3> chosen_points() const {
        std::vector<Point3> points;
        for (const GivenCorner& p : chosen_) points.push_back(p.at);
        return points;
    }

    Supersteps& tiles_;
    TiledReport& report_;
    const RepairOfFew first_;
    const RepairInput& input_;
    const Run& run_;
    const KeptPlanes no_planes_;
    std::array<double, 3> largest_{}; ///< absolute coordinate of all input vertices, per axis
    double largest_of_triangles_ = 0; ///< absolute coordinate of input triangles
    std::vector<GivenCorner> chosen_; ///< ascending
    unsigned attempts_ = 0;
    bool is_left_ = false; ///< to the whole
    Meetings met_;         ///< before the input was moved

    // In the process of the first tile.
    GivenCorners corners_;  ///< of triangles in contact
    ParentsInContact last_; ///< after the last attempt
};

Status MovedTiles::find_largest() {
    struct Largest {
        std::array<double, 3> of_points{};
        double of_triangles = 0;
    };
    const auto largest = over_tiles<Largest>(tiles_, [](Tile& b, Largest& sum) {
        for (const Point3& p : b.home_given)
            sum.of_points = {std::max(sum.of_points[0], std::fabs(p.x)),
                             std::max(sum.of_points[1], std::fabs(p.y)),
                             std::max(sum.of_points[2], std::fabs(p.z))};
        sum.of_triangles = std::max(sum.of_triangles, b.largest);
    });
    if (!largest) return largest.error();
    largest_ = largest->of_points;
    largest_of_triangles_ = largest->of_triangles;
    return Done{};
}

Result<bool> MovedTiles::choose_more() {
    if (auto found = find_corners(tiles_, last_.all, corners_); !found) return found.error();
    const std::size_t before = chosen_.size();
    for (const std::uint32_t t : last_.all)
        for (const GivenCorner& p : corners_.at(t)) chosen_.push_back(p);
    sort_unique(chosen_);
    if (auto told = tell_all(tiles_, chosen_); !told) return told.error();
    return chosen_.size() > before;
}

Result<std::optional<DecimalFrame>> MovedTiles::decimal_frame() {
    auto frame = DecimalFrame::of_chosen(chosen_points());
    if (!frame) return frame;
    using Errors = std::array<double, 3>;
    const auto largest = over_tiles<Errors>(tiles_, [&](Tile& b, Errors& sum) {
        for (const Point3& p : b.home_given) {
            const auto errors = frame->errors_of(p);
            for (unsigned k = 0; k < 3; ++k) sum[k] = std::max(sum[k], errors[k]);
        }
    });
    if (!largest) return largest.error();
    frame->state_largest_errors(*largest);
    return frame;
}

/// Returns the directions of clusters, by numbers that ascend as those of the whole do.
std::vector<Point3> MovedTiles::directions(double tolerance) const {
    std::vector<std::uint32_t> triangles, names;
    for (const auto& [id, corners] : corners_) {
        triangles.push_back(id);
        for (const GivenCorner& p : corners) names.push_back(p.id);
    }
    sort_unique(names);
    const auto place_in = [](const std::vector<std::uint32_t>& all, std::uint32_t id) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(all, id) - all.begin());
    };
    std::vector<Point3> points(names.size());
    std::vector<Triangle> of_triangles;
    for (const auto& [id, corners] : corners_) {
        Triangle& t = of_triangles.emplace_back();
        for (unsigned i = 0; i < 3; ++i) {
            t[i] = place_in(names, corners[i].id);
            points[t[i]] = corners[i].at;
        }
    }
    ParentsInContact in_contact = first_.in_contact;
    for (std::uint32_t& t : in_contact.all) t = place_in(triangles, t);
    for (auto& [p, q] : in_contact.pairs) {
        p = place_in(triangles, p);
        q = place_in(triangles, q);
    }
    return cluster_directions(of_triangles, points, in_contact, tolerance);
}

Result<std::optional<ClusterFrame>> MovedTiles::cluster_frame() {
    const double tolerance = cluster_tolerance(largest_of_triangles_);
    std::vector<Point3> normals = directions(tolerance);
    if (auto told = tell_all(tiles_, normals); !told) return told.error();
    auto frame = ClusterFrame::of_chosen(chosen_points(), normals, tolerance);
    if (!frame) return frame;
    const Step send = [&](Tile& b, Inbox&, Outbox& out) -> Status {
        send_places(b, *frame, out);
        return Done{};
    };
    const Step measure = [&](Tile& b, Inbox& in, Outbox&) -> Status {
        b.deviation = largest_error_of_places(*frame, in);
        return Done{};
    };
    for (const Step* step : {&send, &measure})
        if (auto done = tiles_.step("move", *step); !done) return done.error();
    const auto largest =
        over_tiles<double>(tiles_, [](Tile& b, double& sum) { sum = std::max(sum, b.deviation); });
    if (!largest) return largest.error();
    if (!std::isfinite(*largest)) return std::optional<ClusterFrame>();
    frame->state_largest_error(*largest);
    return frame;
}

/// Moves all vertices in the cells of chosen ones.
Result<Attempted> MovedTiles::attempt(const SnapGrid& grid) {
    const SnapCells cells(grid, chosen_points());
    const auto farthest = over_tiles<double>(tiles_, [&](Tile& b, double& sum) {
        for (const Point3& p : b.home_given)
            if (const Point3 q = cells.moved(p); q != p) sum = std::max(sum, move_bound(p, q));
    });
    if (!farthest) return farthest.error();
    const auto move = [&](Tile& b) {
        for (Point3& p : b.home_points) p = cells.moved(p);
    };
    return attempt(move, *farthest, {});
}

/// Statement (4) of docs/explanation/rounding.md has the factor of two.
template <class Frame>
Result<Attempted> MovedTiles::in_frame(const Frame& frame) {
    const auto move = [&](Tile& b) {
        b.is_in_frame = true;
        for (Point3& p : b.home_points) p = frame.into(p);
    };
    return attempt(move, 2 * frame.largest_error(), steps_back(frame));
}

Result<Attempted> MovedTiles::attempt(const std::function<void(Tile&)>& move, double farthest,
                                      const StepsBeside& beside) {
    ++attempts_;
    const Step begin = [&](Tile& b, Inbox&, Outbox& out) -> Status {
        begin_anew(b);
        b.is_moved = true;
        move(b);
        send_home_vertices(b, out);
        return Done{};
    };
    if (auto begun = tiles_.step("move", begin); !begun) return begun.error();
    if (auto done = arrange_moved(tiles_, beside, run_); !done) return done.error();
    return arranged(farthest);
}

/// Repairs what is in the way after the input was moved.
Result<Attempted> MovedTiles::arranged(double farthest) {
    auto after = summary_of(tiles_);
    if (!after) return after.error();
    after->limit = report_.limit;
    after->digest = report_.digest;
    after->clean = after->contacts == 0;
    RepairInTiles how = first_.summary;
    how.surface_deviation =
        farthest == 0 ? after->deviation : (after->deviation + farthest) * (1 + 0x1p-52);
    unsigned rounds = 0;
    last_ = {};
    if (!after->clean) {
        auto repaired = repair_few(tiles_, *after, {input_.most_gathered, true, farthest}, run_);
        if (!repaired) return repaired.error();
        is_left_ = !repaired->is_done;
        if (is_left_) return Error{ErrorCode::unsupported, "", ""};
        last_ = std::move(repaired->in_contact);
        how.surface_deviation = repaired->summary.surface_deviation;
        rounds = repaired->summary.rounds;
    }
    if (!after->clean || how.surface_deviation > report_.limit) return Attempted::in_contact;
    const auto meetings = find_meetings(tiles_);
    if (!meetings) return meetings.error();
    is_left_ = may_be_parted(met_, *meetings, how.surface_deviation);
    if (is_left_) return Error{ErrorCode::unsupported, "", ""};
    how.rounds += attempts_ + rounds;
    how.is_moved = true;
    after->repair = how;
    after->deviation = how.surface_deviation;
    report_ = std::move(*after);
    return Attempted::conforming;
}

} // namespace

Status detail::move_input(Supersteps& tiles, TiledReport& report, RepairOfFew first,
                          const RepairInput& input, const Run& run) {
    return MovedTiles(tiles, report, std::move(first), input, run)();
}

} // namespace terrane::tiles
