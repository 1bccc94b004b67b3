// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Prints the tables of the paper's section 6 beside the paper's numbers.
//   terrane_bench_paper [--large] [--skip grid|ab|ab-balanced|ab-median|mixed]... [--limit SECONDS] [--threads N]
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "paper_tables.hpp"

namespace terrane::paper {
namespace {

constexpr std::array column_names{"structured",    "AB unbalanced", "AB by Table 1",
                                  "AB by medians", "mixed",         "hierarchy"};
static_assert(column_names.size() == paper_methods.size());

std::string seconds_text(double s) {
    return fmt::format("{:.{}f}", s, s < 10 ? 4 : 1);
}

std::string with_paper(std::string text, double paper) {
    return paper < 0 ? text + " [-]" : fmt::format("{} [{}]", text, paper);
}

std::string cell_text(const PaperRow& row, std::size_t m) {
    const double s = row.seconds[m];
    std::string text = s < 0 ? "-" : seconds_text(s);
    if (s < 0 && paper_methods[m] == Search::ab && row.ab_share < 1)
        text = fmt::format("limit at {:.0f} %", 100 * row.ab_share);
    return paper_methods[m] == Search::bvh ? text : with_paper(text, row.paper[m]);
}

std::string search_table(const PaperTable& table) {
    constexpr std::array titles{"pair 1, localised intersection", "pair 2, widespread intersection",
                                "non-uniform meshes"};
    auto text = fmt::format("Table {}: {}. Seconds for all D_T [the paper's]\n{:<15}", table.number,
                            titles[static_cast<std::size_t>(table.number - 2)], "triangles");
    for (const auto* name : column_names) text += fmt::format("{:>20}", name);
    text += fmt::format("{:>16}\n", "regions");
    for (const PaperRow& row : table.rows) {
        text += fmt::format("{:<15}", row.triangles);
        for (std::size_t m = 0; m < paper_methods.size(); ++m)
            text += fmt::format("{:>20}", cell_text(row, m));
        text += fmt::format("{:>16}\n",
                            with_paper(seconds_text(row.seconds_regions), row.paper_regions));
    }
    return text;
}

std::string size_table(const PaperTable& table) {
    auto text = fmt::format("{:<15}{:>12}{:>12}{:>10}{:>34}\n", "triangles", "box pairs",
                            "mean |D_T|", "largest", "mean in the cells of the grid");
    for (const PaperRow& row : table.rows)
        text += fmt::format("{:<15}{:>12}{:>12.1f}{:>10}{:>34.1f}\n", row.triangles, row.pairs,
                            row.mean_d, row.largest_d, row.mean_looked_at);
    return text;
}

/// Compares the best time of the paper, which covers the whole intersection, with the total of all
/// stages here.
std::string gain_text(const PaperRow& row) {
    double best = -1;
    for (const double p : row.paper)
        if (p >= 0 && (best < 0 || p < best)) best = p;
    return best < 0 ? "-" : fmt::format("{:.0f}x", best / row.total());
}

std::string arrange_table(const PaperTable& table) {
    auto text = fmt::format("{:<15}{:>9}{:>9}{:>11}{:>13}{:>9}{:>9}{:>9}{:>9}{:>26}\n", "arrange",
                            "prepare", "search", "intersect", "triangulate", "stitch", "round",
                            "total", "doubles", "paper's best / total");
    for (const PaperRow& row : table.rows) {
        const auto& a = row.arrange;
        text += fmt::format("{:<15}{:>9.4f}{:>9.4f}{:>11.4f}{:>13.4f}{:>9.4f}{:>9.4f}{:>9.4f}{:>9}"
                            "{:>26}\n",
                            row.triangles, a[0], a[1], a[2], a[3], a[4], row.seconds_round,
                            row.total(), row.clean ? "clean" : "improper", gain_text(row));
    }
    return text;
}

/// Lists the paper's four methods by their times: "structured < mixed < AB by medians".
std::string order_text(const MethodTimes& times) {
    std::vector<std::size_t> order;
    for (std::size_t m = 0; m + 1 < times.size(); ++m)
        if (times[m] >= 0) order.push_back(m);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
    std::string text;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool equal = i > 0 && times[order[i]] == times[order[i - 1]];
        text += fmt::format("{}{}", i == 0 ? "" : equal ? " = " : " < ", column_names[order[i]]);
    }
    return text;
}

/// Tells whether no pair of methods is in the opposite order here; compares only methods that have
/// a time in both.
bool same_order(const PaperRow& row) {
    for (std::size_t a = 0; a < paper_methods.size(); ++a)
        for (std::size_t b = 0; b < paper_methods.size(); ++b)
            if (row.paper[a] >= 0 && row.paper[b] > row.paper[a] && row.seconds[a] >= 0 &&
                row.seconds[b] >= 0 && row.seconds[b] < row.seconds[a])
                return false;
    return true;
}

std::string comparison(const PaperTable& table) {
    std::string text = "Fastest first:\n";
    for (const PaperRow& row : table.rows) {
        text += fmt::format("  {:<15} here  {}\n", row.triangles, order_text(row.seconds));
        const auto paper = order_text(row.paper);
        if (!paper.empty())
            text += fmt::format("  {:<15} paper {}  {}\n", "", paper,
                                same_order(row) ? "(holds)" : "(does not hold)");
    }
    return text;
}

/// Lists, for each tree, its levels and the boxes that a query tests, and its time as a part of
/// that of the unbalanced tree.
std::string tree_table(const PaperTable& table) {
    constexpr std::array names{"AB unbalanced", "AB by Table 1", "AB by medians"};
    auto text = fmt::format("{:<15}{:>8}", "trees", "least");
    for (const auto* name : names) text += fmt::format("{:>30}", name);
    text += fmt::format("{:>26}\n", "left by the mixed search");
    text += fmt::format("{:<15}{:>8}", "", "levels");
    for (std::size_t i = 0; i < names.size(); ++i)
        text += fmt::format("{:>30}", "levels, tests, time [paper]");
    text += "\n";
    const auto seconds_of = [](const MethodTimes& times, Search method) {
        const auto at = std::find(paper_methods.begin(), paper_methods.end(), method);
        return times[static_cast<std::size_t>(at - paper_methods.begin())];
    };
    for (const PaperRow& row : table.rows) {
        text += fmt::format("{:<15}{:>8}", row.triangles, row.least_depth);
        const auto part = [&](const MethodTimes& times, Search method) {
            const double one = seconds_of(times, method), all = seconds_of(times, Search::ab);
            return one < 0 || all <= 0 ? std::string("-") : fmt::format("{:.2f}", one / all);
        };
        for (std::size_t i = 0; i < paper_trees.size(); ++i) {
            const TreeShape& shape = row.trees[i];
            text += fmt::format("{:>30}", shape.depth == 0
                                              ? std::string("-")
                                              : fmt::format("{}, {:.0f}, {} [{}]", shape.depth,
                                                            shape.mean_looked_at,
                                                            part(row.seconds, paper_trees[i]),
                                                            part(row.paper, paper_trees[i])));
        }
        text += fmt::format("{:>24.0f} %\n", 100 * row.mixed_share);
    }
    return text;
}

} // namespace
} // namespace terrane::paper

int main(int argc, char** argv) {
    using namespace terrane::paper;
    PaperSettings settings;
    terrane::Run run;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        const bool has_value = i + 1 < argc;
        if (word == "--large")
            settings.large = true;
        else if (word == "--skip" && has_value)
            settings.skipped.emplace_back(argv[++i]);
        else if (word == "--limit" && has_value)
            settings.limit = std::stod(argv[++i]);
        else if (word == "--threads" && has_value)
            run.threads = static_cast<unsigned>(std::stoul(argv[++i]));
        else
            return std::fprintf(stderr, "there is no option %s\n", argv[i]), 2;
    }
    for (int number = 2; number <= 4; ++number) {
        const auto table = measure_table(number, settings, run);
        if (!table) return std::fprintf(stderr, "%s\n", table.error().message().c_str()), 2;
        fmt::print("{}\n{}\n{}\n{}\n{}\n", search_table(*table), size_table(*table),
                   tree_table(*table), arrange_table(*table), comparison(*table));
    }
}
