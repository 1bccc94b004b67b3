// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures what the tables of the paper's section 6 list, on the paper's models.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::cli {

/// The columns: the paper's four methods, then ours.
constexpr std::array paper_methods{Search::grid, Search::ab, Search::ab_balanced, Search::mixed,
                                   Search::bvh};

/// Seconds; negative where there is none.
using MethodTimes = std::array<double, paper_methods.size()>;
constexpr double not_measured = -1;

struct PaperSettings {
    bool large = false;               ///< 6 800 000 triangles too
    double limit = 60;                ///< seconds for one search by AB unbalanced
    std::vector<std::string> skipped; ///< names of methods
    unsigned repeats = 5;             ///< of what takes less than a second: the median counts
};

/// One row: a model, what the paper says of it, what is found here.
struct PaperRow {
    std::string triangles;
    MethodTimes paper{};
    double paper_regions = not_measured;

    MethodTimes seconds{}; ///< of the search alone: the red triangles that each blue one may meet
    double ab_share = 1;   ///< of AB unbalanced, how far it came within the limit
    std::size_t pairs = 0; ///< of boxes, red with blue
    double mean_d = 0;     ///< triangles per D_T, over the T that have any
    std::size_t largest_d = 0;
    double mean_looked_at = 0; ///< the same for all triangles in the cells that the grid looks in
    ArrangeStatistics arrange;
    double seconds_regions = 0, seconds_round = 0;
    bool clean = false; ///< the doubles were proven conforming

    [[nodiscard]] double total() const;
};

struct PaperTable {
    int number = 0; ///< in the paper: 2, 3 or 4
    std::vector<PaperRow> rows;
};

/// Table 2, 3 or 4.
Result<PaperTable> measure_table(int number, const PaperSettings& settings, const Run& run);

} // namespace terrane::cli
