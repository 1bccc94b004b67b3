// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Prints the table of required speeds: medians from one run, measured in turn, and ratios to the
// yardsticks and to the floor next to the required factors.
//   terrane_bench_table [--repeats N] [--large] [NAME|FILE...]
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/selection/selection.hpp>

#include "floor.hpp"
#include "models.hpp"
#include "yardsticks.hpp"

namespace {

using namespace terrane;
using namespace bench;

struct Series {
    std::vector<double> seconds;

    template <class Work>
    void time(const Work& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        seconds.push_back(taken.count());
    }
    [[nodiscard]] double median() const {
        if (seconds.empty()) return -1;
        auto sorted = seconds;
        std::sort(sorted.begin(), sorted.end());
        return sorted[sorted.size() / 2];
    }
};

/// An input, with the largest ratios to the yardstick and to the floor; 0: not required.
struct Row {
    const char* name;
    double of_yardstick, of_floor;
    bool large = false;
};

constexpr std::array rows{Row{"pair1_68k", 0.5, 8},         Row{"pair1_680k", 0.32, 8},
                          Row{"pair2_68k", 0.2, 10},        Row{"pair2_680k", 0.2, 10},
                          Row{"nonuniform1", 0.5, 8},       Row{"nonuniform2", 0.2, 8},
                          Row{"rectangles_1000", 0.025, 0}, Row{"rectangles_100", 0, 0},
                          Row{"pair1_6800k", 0, 0, true},   Row{"pair2_6800k", 0, 0, true}};

struct Measured {
    Series arrange, round, two_threads, yardstick, floor;
    OutputSize output;
    bool clean = false, yardstick_fails = false;

    [[nodiscard]] double ours() const { return arrange.median() + round.median(); }
};

void time_ours(const Model& m, Measured& out) {
    std::optional<Result<Arrangement>> exact;
    out.arrange.time([&] { exact.emplace(arrange(m.surfaces)); });
    std::optional<Result<RoundedMesh>> rounded;
    out.round.time([&] { rounded.emplace(round_to_doubles(exact->value())); });
    out.clean = rounded->value().report.clean;
    const Mesh& mesh = rounded->value().mesh;
    out.output = {mesh.vertices.size(), mesh.triangles.size()};
}

void time_two_threads(const Model& m, Measured& out) {
    const Run run{.threads = 2};
    std::optional<Result<Arrangement>> exact; // freed outside, as with one thread
    std::optional<Result<RoundedMesh>> rounded;
    out.two_threads.time([&] {
        exact.emplace(arrange(m.surfaces, {}, run));
        rounded.emplace(round_to_doubles(exact->value(), {}, run));
    });
}

template <class Yardstick>
void time_yardstick(Yardstick& yardstick, Measured& out) {
    if (out.yardstick_fails) return;
    yardstick.prepare();
    try {
        out.yardstick.time([&] { yardstick(); });
    } catch (const std::exception&) {
        out.yardstick_fails = true;
    }
}

template <class Yardstick>
Measured measure(const Model& m, unsigned repeats, bool with_yardstick) {
    Measured out;
    std::optional<Yardstick> yardstick;
    if (with_yardstick) yardstick.emplace(m);
    for (unsigned i = 0; i < repeats; ++i) {
        time_ours(m, out);
        time_two_threads(m, out);
        if (yardstick) time_yardstick(*yardstick, out);
        out.floor.time([&] { floor_of_arrange(m, out.output); });
    }
    return out;
}

std::string ratio(double a, double b, double required) {
    if (b <= 0) return "-";
    char text[64];
    if (required > 0)
        std::snprintf(text, sizeof text, "%.3f (%g)%s", a / b, required,
                      a / b <= required ? "" : " !");
    else
        std::snprintf(text, sizeof text, "%.3f", a / b);
    return text;
}

void print(const Row& row, const Measured& m) {
    const double ours = m.ours(), two = m.two_threads.median();
    std::printf("%-16s %9zu %9.4f %9.4f %9.4f %9.4f %9.4f  %-18s %-18s %8.2f  %s\n", row.name,
                m.output.triangles, m.arrange.median(), m.round.median(), ours,
                m.yardstick.median(), m.floor.median(),
                ratio(ours, m.yardstick.median(), row.of_yardstick).c_str(),
                ratio(ours, m.floor.median(), row.of_floor).c_str(), ours / two,
                m.clean ? "clean" : "IMPROPER");
    std::fflush(stdout);
}

struct Options {
    unsigned repeats = 5;
    bool large = false;
    std::vector<std::string> names;

    [[nodiscard]] bool wants(const Row& row) const {
        if (names.empty()) return large || !row.large;
        return std::find(names.begin(), names.end(), row.name) != names.end();
    }
};

/// Returns more repeats for small inputs, in which one interruption outweighs the work.
unsigned repeats_of(const Options& options, const Model& m) {
    return m.triangles.size() < 100'000 ? 5 * options.repeats : options.repeats;
}

/// Compares the boxes and pairs between two surfaces with the floor and CGAL's sweep.
void print_search(const char* name, const Options& options) {
    const Model& m = model(name);
    const unsigned repeats = repeats_of(options, m);
    BoxIntersection cgal(m);
    Series ours, floor, theirs;
    std::size_t pairs = 0, same = 0;
    for (unsigned i = 0; i < repeats; ++i) {
        ours.time([&] {
            const BoxSource boxes(m.points, m.triangles); // as arrange() makes them
            pairs = candidate_pairs(boxes, m.groups, Search::automatic).size();
        });
        floor.time([&] { same = floor_of_search(m); });
        cgal.prepare();
        theirs.time([&] { cgal(); });
    }
    std::printf("%-16s %9zu %9.4f %9.4f %9.4f  %-18s %.1f (5)%s%s\n", name, pairs, ours.median(),
                floor.median(), theirs.median(), ratio(ours.median(), floor.median(), 2).c_str(),
                theirs.median() / ours.median(), theirs.median() >= 5 * ours.median() ? "" : " !",
                pairs == same ? "" : "  DIFFERENT PAIRS");
    std::fflush(stdout);
}

/// Compares the Booleans of two balls with arranging and rounding them.
void print_selections(const Options& options) {
    const Model& m = model("balls_160k");
    const std::array expressions{"a | b", "a - b", "a & b"};
    Measured arranged;
    std::array<Series, 3> series;
    std::array<std::size_t, 3> triangles{};
    for (unsigned i = 0; i < options.repeats; ++i) {
        time_ours(m, arranged);
        for (std::size_t k = 0; k < series.size(); ++k) {
            std::optional<Result<Selected>> made;
            series[k].time([&] { made.emplace(select(m.surfaces, expressions[k])); });
            triangles[k] = made->value().mesh.triangles.size();
        }
    }
    std::printf("\n%-16s %9s %9s %9s  %s\n", "selection", "out", "ours", "arrange", "ours/arrange");
    for (std::size_t k = 0; k < series.size(); ++k)
        std::printf("%-16s %9zu %9.4f %9.4f  %s\n", expressions[k], triangles[k],
                    series[k].median(), arranged.ours(),
                    ratio(series[k].median(), arranged.ours(), 4.0 / 3).c_str());
    std::fflush(stdout);
}

Options parse(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--large")
            o.large = true;
        else if (word == "--repeats" && i + 1 < argc)
            o.repeats = static_cast<unsigned>(std::max(1, std::atoi(argv[++i])));
        else
            o.names.push_back(word);
    }
    return o;
}

bool is_pair(const Row& row) {
    return std::string(row.name).rfind("rectangles", 0) != 0;
}

/// Measures names that no row has: files of surfaces, which may be coplanar, touch or have slivers.
/// If there are two surfaces, the yardstick is corefine, provided that it accepts them.
void print_files(const Options& options) {
    for (const std::string& name : options.names) {
        if (std::any_of(rows.begin(), rows.end(), [&](const Row& r) { return name == r.name; }))
            continue;
        const Model& input = model(name);
        const bool is_pair = input.surfaces.size() == 2;
        print({name.c_str(), 0, 0}, measure<Corefine>(input, repeats_of(options, input), is_pair));
    }
}

int run(const Options& options) {
    std::puts(
        "seconds, medians; in brackets the most that is allowed; yardstick: CGAL 5.5.1 corefine,\n"
        "for rectangles_1000 autorefine; ours: arrange and round");
    std::printf("%-16s %9s %9s %9s %9s %9s %9s  %-18s %-18s %8s  %s\n", "arrangement", "out",
                "arrange", "round", "ours", "yardstick", "floor", "ours/yardstick", "ours/floor",
                "1 : 2 th", "doubles");
    double rectangles_1000 = 0;
    for (const Row& row : rows) {
        if (!options.wants(row)) continue;
        const bool pair = is_pair(row);
        const Model& input = model(row.name);
        const unsigned repeats = pair ? repeats_of(options, input) : options.repeats;
        const Measured m = pair ? measure<Corefine>(input, repeats, !row.large)
                                : measure<Autorefine>(input, repeats, row.of_yardstick > 0);
        print(row, m);
        const std::string name = row.name;
        if (name == "rectangles_1000") rectangles_1000 = m.ours();
        if (name == "rectangles_100" && rectangles_1000 > 0)
            std::printf("%-16s takes %s times as long as rectangles_1000\n", "",
                        ratio(m.ours(), rectangles_1000, 7).c_str());
    }
    print_files(options);
    std::printf("\n%-16s %9s %9s %9s %9s  %-18s %s\n", "search", "pairs", "ours", "floor", "CGAL",
                "ours/floor", "CGAL/ours (at least)");
    for (const Row& row : rows)
        if (is_pair(row) && options.wants(row)) print_search(row.name, options);
    if (options.names.empty()) print_selections(options);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    keep_freed_memory(); // for the yardsticks as well
    try {
        return run(parse(argc, argv));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 2;
    }
}
