// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures how the cost of arranging and rounding grows with the result, for inputs in which
// everything coincides. It measures each family at n, 2 n and 4 n, and starts a process for each
// size, because the peak memory of a process never falls. The last row of a family states the
// exponents that fit its three sizes. The size of a result counts its triangles, their parents and
// the neighbours of regions: n coplanar triangles, each in the next, have 2 n - 1 parts with n^2
// parents, and n regions that meet at one edge have n - 1 neighbours each.
//   terrane_bench_degenerate [--exact] [--wall] [FAMILY...]
// --exact: without rounding. Seconds are those of the processor, or with --wall of a clock.
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

#include "degenerate_families.hpp"

namespace {

using namespace terrane;
using namespace bench;

struct Settings {
    bool exact = false, wall = false;
    std::vector<std::string> names;
};

/// The measurements of one process; zeros if it failed.
struct Measured {
    double input = 0, triangles = 0, parents = 0, neighbours = 0; ///< numbers
    double seconds = 0, bytes = 0;

    [[nodiscard]] double size() const { return triangles + parents + neighbours; }
};

constexpr double largest_exponent = 1.2;
constexpr double most_bytes = 1000; ///< per entry of the result

double size_of_process(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.compare(0, key.size() + 1, key + ':') == 0)
            return 1024 * std::strtod(line.c_str() + key.size() + 1, nullptr);
    throw std::runtime_error("/proc/self/status has no " + key);
}

double seconds_now(bool wall) {
    if (!wall) return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Starts the threads and loads the code, which a process pays once, whatever it arranges.
void warm_up() {
    Surface crossing;
    crossing.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {3, 0, 1}};
    crossing.triangles = {{0, 1, 2}, {3, 4, 5}};
    const auto arranged = arrange(std::vector<Surface>(64, crossing));
    if (!arranged || !round_to_doubles(arranged.value()))
        throw std::runtime_error("two triangles can't be arranged");
}

Measured measure(const Family& family, int n, const Settings& settings) {
    keep_freed_memory();
    warm_up();
    const std::vector<Surface> surfaces = family.make(n);
    malloc_trim(0);
    Measured m;
    for (const Surface& s : surfaces) m.input += static_cast<double>(s.triangles.size());
    const double before = size_of_process("VmRSS");
    std::ofstream("/proc/self/clear_refs") << "5\n";
    const double start = seconds_now(settings.wall);
    const auto arranged = arrange(surfaces);
    if (!arranged) throw std::runtime_error(arranged.error().message());
    m.triangles = static_cast<double>(arranged.value().triangles.size());
    m.parents = static_cast<double>(arranged.value().parents_of.values.size());
    if (!settings.exact) {
        const auto rounded = round_to_doubles(arranged.value());
        if (!rounded) throw std::runtime_error(rounded.error().message());
        for (const Region& r : rounded.value().regions)
            m.neighbours += static_cast<double>(r.neighbours.size());
    }
    m.seconds = seconds_now(settings.wall) - start;
    m.bytes = size_of_process("VmHWM") - before;
    return m;
}

/// Measures in a process of its own.
Measured measured_apart(const Family& family, int n, const Settings& settings) {
    std::fflush(stdout);
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("can't make a pipe");
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("can't start a process");
    if (child == 0) {
        try {
            const Measured m = measure(family, n, settings);
            std::_Exit(write(ends[1], &m, sizeof m) == sizeof m ? 0 : 2);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "%s %d: %s\n", family.name, n, e.what());
            std::_Exit(2);
        }
    }
    close(ends[1]);
    Measured m;
    if (read(ends[0], &m, sizeof m) != static_cast<ssize_t>(sizeof m)) m = {};
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    return m;
}

/// Returns the power of the output's growth with which a cost grows; 0 if the output does not.
double exponent(double cost_before, double cost, double size_before, double size) {
    if (cost_before <= 0 || cost <= 0 || size <= size_before) return 0;
    return std::log(cost / cost_before) / std::log(size / size_before);
}

void print_exponents(double time, double memory) {
    std::printf(" %6.2f%c %6.2f%c", time, time > largest_exponent ? '!' : ' ', memory,
                memory > largest_exponent ? '!' : ' ');
}

/// Returns the exponent that fits all sizes best: the slope of a line through the logarithms; 0 if
/// a cost was too small to be measured.
double fitted_exponent(std::span<const Measured> rows, double Measured::*cost) {
    double x_mean = 0, y_mean = 0, above = 0, below = 0;
    const auto count = static_cast<double>(rows.size());
    for (const Measured& m : rows) {
        if (!(m.*cost > 0)) return 0;
        x_mean += std::log(m.size()) / count;
        y_mean += std::log(m.*cost) / count;
    }
    for (const Measured& m : rows) {
        const double x = std::log(m.size()) - x_mean;
        above += x * (std::log(m.*cost) - y_mean);
        below += x * x;
    }
    return below > 0 ? above / below : 0;
}

/// Prints the rows of a family, and what fits them all. Returns whether all are measured.
bool print_family(const Family& family, const Settings& settings) {
    Measured before;
    std::vector<Measured> rows;
    for (const int n : {family.n, 2 * family.n, 4 * family.n}) {
        const Measured m = measured_apart(family, n, settings);
        if (m.size() == 0) return false;
        std::printf("%-16s %6d %8.0f %9.0f %10.0f %10.0f %9.3f %8.1f", family.name, n, m.input,
                    m.triangles, m.parents, m.neighbours, m.seconds, m.bytes / 1e6);
        const double per_entry = m.bytes / m.size();
        if (before.size() > 0) {
            const double time = exponent(before.seconds, m.seconds, before.size(), m.size());
            const double memory = exponent(before.bytes, m.bytes, before.size(), m.size());
            print_exponents(time, memory);
        } else {
            std::printf(" %7s %7s", "", "");
        }
        std::printf(" %8.0f %8.0f%c\n", m.bytes / m.triangles, per_entry,
                    per_entry > most_bytes ? '!' : ' ');
        rows.push_back(m);
        before = m;
    }
    std::printf("%-16s fitted%61s", family.name, "");
    print_exponents(fitted_exponent(rows, &Measured::seconds),
                    fitted_exponent(rows, &Measured::bytes));
    std::printf("\n");
    return true;
}

Settings settings_of(int argc, char** argv) {
    Settings settings;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--exact")
            settings.exact = true;
        else if (word == "--wall")
            settings.wall = true;
        else
            settings.names.push_back(word);
    }
    return settings;
}

} // namespace

int main(int argc, char** argv) {
    const Settings settings = settings_of(argc, argv);
    std::printf("%-16s %6s %8s %9s %10s %10s %9s %8s %7s %7s %8s %9s\n", "degenerate", "n", "input",
                "output", "parents", "neighbours", "seconds", "MB", "time^", "memory^", "B/tri",
                "B/entry");
    int result = 0;
    for (const Family& family : families()) {
        const auto& names = settings.names;
        if (!names.empty() && std::find(names.begin(), names.end(), family.name) == names.end())
            continue;
        if (!print_family(family, settings)) result = 2;
    }
    return result;
}
