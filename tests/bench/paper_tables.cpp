// SPDX-License-Identifier: LGPL-3.0-or-later
#include "paper_tables.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <functional>
#include <numeric>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/core/stopwatch.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/regions/regions_over.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/search/methods.hpp>

#include "paper_models.hpp"

namespace terrane::paper {
namespace {

/// Returns the median of several runs, or the time of the first run if it takes a second or more.
template <class Work>
double median_seconds(unsigned repeats, const Work& work) {
    std::vector<double> seconds;
    do {
        Stopwatch watch;
        work();
        seconds.push_back(watch.lap());
    } while (seconds.size() < repeats && seconds.front() < 1);
    const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
    std::nth_element(seconds.begin(), middle, seconds.end());
    return *middle;
}

struct RedAndBlue {
    std::vector<Box> boxes; ///< the red ones, then the blue ones
    std::vector<std::uint32_t> groups;
    std::size_t red = 0;
};

RedAndBlue boxes_of_surfaces(const std::vector<Surface>& surfaces) {
    RedAndBlue all;
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        const auto boxes = boxes_of(surfaces[s].vertices, surfaces[s].triangles);
        all.boxes.insert(all.boxes.end(), boxes.begin(), boxes.end());
        all.groups.resize(all.boxes.size(), s);
    }
    all.red = surfaces.front().triangles.size();
    return all;
}

/// Times AB unbalanced, which may take hours: it stops at the limit, and `share` is the part done
/// by then.
double measure_ab(const RedAndBlue& all, double limit, double& share) {
    Stopwatch watch;
    double seconds = 0;
    const auto over = [&](std::size_t i) {
        if (i % 256 == 0) seconds += watch.lap();
        return seconds > limit;
    };
    search::AbTree tree;
    std::vector<CandidatePair> pairs;
    share = 0;
    for (std::size_t i = 0; i < all.boxes.size(); ++i) {
        share = static_cast<double>(i) / static_cast<double>(all.boxes.size());
        if (over(i)) return not_measured;
        const auto index = static_cast<std::uint32_t>(i);
        if (i < all.red)
            tree.insert(all.boxes[i], index);
        else
            tree.query(all.boxes[i], [&](std::uint32_t r) { pairs.push_back({r, index}); });
    }
    std::sort(pairs.begin(), pairs.end());
    share = 1;
    return seconds + watch.lap();
}

double measure_search(Search method, const RedAndBlue& all, const PaperSettings& settings,
                      PaperRow& row) {
    const auto& skipped = settings.skipped;
    if (std::find(skipped.begin(), skipped.end(), name_of(method)) != skipped.end())
        return not_measured;
    if (method == Search::ab) return measure_ab(all, settings.limit, row.ab_share);
    return median_seconds(settings.repeats, [&] {
        row.pairs = candidate_pairs(all.boxes, all.groups, method).size();
    });
}

/// Counts the red triangles to be tested for each blue one.
void measure_d(const RedAndBlue& all, PaperRow& row) {
    std::vector<std::size_t> count(all.boxes.size() - all.red);
    for (const auto& [red, blue] : candidate_pairs(all.boxes, all.groups, Search::bvh))
        ++count[blue - all.red];
    search::CellGrid grid(std::span(all.boxes).first(all.red));
    std::size_t filled = 0, looking = 0, looked_at = 0;
    for (std::size_t b = 0; b < count.size(); ++b) {
        filled += count[b] > 0 ? 1 : 0;
        row.largest_d = std::max(row.largest_d, count[b]);
        const std::size_t there = grid.looked_at(all.boxes[all.red + b]);
        looking += there > 0 ? 1 : 0;
        looked_at += there;
    }
    const auto mean = [](std::size_t sum, std::size_t n) {
        return n > 0 ? static_cast<double>(sum) / static_cast<double>(n) : 0;
    };
    row.mean_d = mean(row.pairs, filled);
    row.mean_looked_at = mean(looked_at, looking);
}

template <class Tree>
TreeShape shape_of(const RedAndBlue& all) {
    Tree tree(std::span(all.boxes).first(all.red));
    std::size_t looked_at = 0;
    for (std::size_t b = all.red; b < all.boxes.size(); ++b)
        looked_at += tree.looked_at(all.boxes[b]);
    const auto blue = static_cast<double>(all.boxes.size() - all.red);
    return {tree.depth(), static_cast<double>(looked_at) / blue};
}

/// Measures the trees of the methods that were timed.
void measure_trees(const RedAndBlue& all, PaperRow& row) {
    row.least_depth = static_cast<std::size_t>(std::bit_width(all.red));
    for (std::size_t m = 0; m < paper_methods.size(); ++m) {
        if (row.seconds[m] < 0) continue;
        if (paper_methods[m] == Search::ab) row.trees[0] = shape_of<search::AbTree>(all);
        if (paper_methods[m] == Search::ab_balanced)
            row.trees[1] = shape_of<search::BalancedAbTree>(all);
        if (paper_methods[m] == Search::ab_median)
            row.trees[2] = shape_of<search::MedianAbTree>(all);
    }
    row.mixed_share =
        static_cast<double>(search::boxes_in_mixed_cells(all.boxes, all.groups).size()) /
        static_cast<double>(all.boxes.size());
}

/// Times region detection alone, on the mesh of doubles.
double measure_regions(const Mesh& mesh, unsigned repeats) {
    return median_seconds(repeats, [&] {
        const Adjacency adjacency = adjacency_of(group_edges(mesh.triangles, mesh.vertices.size()),
                                                 labels_of(mesh.surfaces_of, mesh.parents_of));
        find_regions(mesh.vertices, mesh.triangles, mesh.surfaces_of, adjacency,
                     mesh.intersection_edges);
    });
}

Status measure_arrange(const std::vector<Surface>& surfaces, const PaperSettings& settings,
                       const Run& run, PaperRow& row) {
    StageTimes times;
    Run timed = run;
    timed.timing = times.observer();
    auto exact = arrange(surfaces, {}, timed);
    if (!exact) return exact.error();
    for (std::size_t i = 0; i < arrange_steps.size(); ++i)
        row.arrange[i] = times.latest(std::string("arrange/") + arrange_steps[i]);
    row.arrange.back() += times.latest("arrange/assemble");
    Stopwatch watch;
    const auto rounded = round_to_doubles(exact.value(), {}, run);
    if (!rounded) return rounded.error();
    row.seconds_round = watch.lap();
    row.clean = rounded.value().report.clean;
    row.seconds_regions = measure_regions(rounded.value().mesh, settings.repeats);
    return Done{};
}

struct PaperModel {
    std::string triangles;
    std::function<std::vector<Surface>()> make;
    MethodTimes paper;
    double paper_regions;
};

/// Returns the paper's times by method. It has one balanced tree.
MethodTimes times_of(double structured, double unbalanced, double balanced, double mixed) {
    return {structured, unbalanced, balanced, balanced, mixed, not_measured};
}

std::vector<PaperModel> models_of(int number, bool large) {
    using namespace models;
    constexpr double none = not_measured;
    if (number == 4)
        return {{"84 000, pair 1", nonuniform_1, times_of(593, none, 27, 14), none},
                {"65 000, pair 2", nonuniform_2, times_of(624, none, 30, 18), none}};
    const bool first = number == 2;
    const auto pair = first ? pair_1 : pair_2;
    const auto made = [pair](const models::Resolution& r) { return [pair, r] { return pair(r); }; };
    std::vector<PaperModel> all;
    if (first) {
        all = {{r7k.name, made(r7k), times_of(2, 3, 2, 2), 1},
               {r68k.name, made(r68k), times_of(8, 121, 45, 13), 2},
               {r680k.name, made(r680k), times_of(30, 35148, 10114, 67), 19}};
    } else {
        all = {{r7k.name, made(r7k), times_of(2, 5, 3, 2), 1},
               {r68k.name, made(r68k), times_of(20, 142, 49, 50), 3},
               {r680k.name, made(r680k), times_of(62, 22753, 791, 172), 23}};
    }
    if (large) all.push_back({r6800k.name, made(r6800k), times_of(none, none, none, none), none});
    return all;
}

} // namespace

double PaperRow::total() const {
    return std::accumulate(arrange.begin(), arrange.end(), seconds_round);
}

Result<PaperTable> measure_table(int number, const PaperSettings& settings, const Run& run) {
    PaperTable table{number, {}};
    for (const PaperModel& model : models_of(number, settings.large)) {
        PaperRow row;
        row.triangles = model.triangles;
        row.paper = model.paper;
        row.paper_regions = model.paper_regions;
        const auto surfaces = model.make();
        {
            const RedAndBlue all = boxes_of_surfaces(surfaces);
            for (std::size_t m = 0; m < paper_methods.size(); ++m)
                row.seconds[m] = measure_search(paper_methods[m], all, settings, row);
            measure_d(all, row);
            measure_trees(all, row);
        }
        const auto arranged = measure_arrange(surfaces, settings, run, row);
        if (!arranged) return arranged.error();
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace terrane::paper
