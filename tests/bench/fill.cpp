// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What filled holes miss of surfaces that are known: kriging and RBF beside CGAL's fairing and a
// plain linear patch, in one run.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include <terrane/algorithms/fill_kriging.hpp>
#include <terrane/algorithms/holes.hpp>
#include <terrane/algorithms/join.hpp>
#include <terrane/algorithms/rbf.hpp>

#include "fill_models.hpp"
#include "fill_yardstick.hpp"

using namespace terrane;
using namespace fill_bench;

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print_misfit(const char* way, const Misfit& m, double seconds) {
    std::printf("  %s %9.3g %9.3g /%9.3g %5.2fs", way, m.rms, m.largest, m.vertex_rms, seconds);
}

void print_yardstick(const Model& model, const BorderLoop& loop, const char* way, bool fair) {
    const auto start = std::chrono::steady_clock::now();
    const auto filled = filled_by_cgal(model.holed, loop.vertices, fair);
    const double seconds = seconds_since(start);
    if (filled)
        print_misfit(way, misfit(model, *filled, model.holed.triangles.size()), seconds);
    else
        std::printf("  %s %10s %10s %6.2fs", way, "-", "-", seconds);
}

void print_rbf(const Model& model, const BorderLoop& loop) {
    const auto start = std::chrono::steady_clock::now();
    const auto filling = fill_by_rbf(model.holed, loop);
    const auto made = filling ? join_filling(model.holed, loop, filling.value().surface)
                              : Result<Joined>(filling.error());
    const double seconds = seconds_since(start);
    if (made)
        print_misfit("rbf", misfit(model, made.value().surface, model.holed.triangles.size()),
                     seconds);
    else
        std::printf("  rbf: %s", made.error().message().c_str());
}

void run(const Model& model, bool yardsticks) {
    const auto loops = find_border_loops(model.holed);
    if (!loops) return;
    const auto hole = std::find_if(loops.value().begin(), loops.value().end(),
                                   [](const BorderLoop& l) { return l.kind != LoopKind::outer; });
    std::printf("%-18s %4.0f%% %4zu %-5s", model.name.c_str(), 100 * model.share,
                hole->vertices.size(), hole->kind == LoopKind::fault_gap ? "gap" : "hole");
    const auto start = std::chrono::steady_clock::now();
    const auto filling = fill_by_kriging(model.holed, *hole);
    const double seconds = seconds_since(start);
    if (filling) {
        const auto filled = joined(model.holed, filling.value());
        const FillReport& r = filling.value().report;
        print_misfit("kriging", misfit(model, filled, model.holed.triangles.size()), seconds);
        std::printf(" (predicted %.3g, left out %.3g)", r.expected_error, r.validated_error);
    } else {
        std::printf("  kriging refuses");
    }
    print_rbf(model, *hole);
    if (yardsticks) {
        print_yardstick(model, *hole, "fair", true);
        print_yardstick(model, *hole, "linear", false);
    }
    std::printf("\n");
    if (filling)
        std::printf("    %s\n", filling.value().report.model.c_str());
    else
        std::printf("    %s\n", filling.error().message().c_str());
}

} // namespace

int main(int argc, char** argv) {
    const bool yardsticks = argc < 2 || std::strcmp(argv[1], "--alone") != 0;
    std::printf("root mean square and largest error / root mean square at new vertices, seconds\n");
    for (const Model& model : models()) run(model, yardsticks);
}
