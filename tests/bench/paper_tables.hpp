// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures the quantities in the tables of the paper's section 6, on the paper's models.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::paper {

/// The columns: the paper's four methods, where Table 1 is read in two ways, then the default of
/// this library.
constexpr std::array paper_methods{Search::grid,      Search::ab,    Search::ab_balanced,
                                   Search::ab_median, Search::mixed, Search::bvh};

/// The alternating trees among them.
constexpr std::array paper_trees{Search::ab, Search::ab_balanced, Search::ab_median};

/// Seconds per method; negative where there is no time.
using MethodTimes = std::array<double, paper_methods.size()>;
constexpr double not_measured = -1;

/// The steps of which the times are measured.
constexpr std::array arrange_steps{"prepare", "search", "intersect", "triangulate", "stitch"};

/// The shape of an alternating tree of the red boxes; zeros if it was not measured.
struct TreeShape {
    std::size_t depth = 0;     ///< levels
    double mean_looked_at = 0; ///< mean number of boxes that the query for a T tests
};

struct PaperSettings {
    bool large = false;               ///< also the model of 6 800 000 triangles
    double limit = 60;                ///< seconds for one search by AB unbalanced
    std::vector<std::string> skipped; ///< names of methods
    unsigned repeats = 5;             ///< runs of anything under a second; the median counts
};

/// One row: a model, the paper's times and those measured here.
struct PaperRow {
    std::string triangles;
    MethodTimes paper{};
    double paper_regions = not_measured;

    MethodTimes seconds{}; ///< search alone: the red triangles that each blue one may meet
    double ab_share = 1;   ///< part of AB unbalanced that was done within the limit
    std::size_t pairs = 0; ///< candidate pairs of a red and a blue box
    double mean_d = 0;     ///< mean number of triangles in the non-empty D_T
    std::size_t largest_d = 0;
    double mean_looked_at = 0;   ///< mean number of triangles in the cells visited for a T
    std::size_t least_depth = 0; ///< levels of the shallowest binary tree of the red triangles
    std::array<TreeShape, paper_trees.size()> trees{};
    double mixed_share = 0; ///< part of all triangles that the reduction of the mixed search leaves
    std::array<double, arrange_steps.size()> arrange{}; ///< seconds of each step
    double seconds_regions = 0, seconds_round = 0;
    bool clean = false; ///< the rounded mesh was proven conforming

    [[nodiscard]] double total() const;
};

struct PaperTable {
    int number = 0; ///< number in the paper: 2, 3 or 4
    std::vector<PaperRow> rows;
};

/// Measures Table 2, 3 or 4. Errors: those of arrange and round_to_doubles.
Result<PaperTable> measure_table(int number, const PaperSettings& settings, const Run& run);

} // namespace terrane::paper
