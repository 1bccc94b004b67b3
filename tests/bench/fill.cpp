// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures the error of filled holes in known surfaces: kriging and RBF, compared with CGAL's
// fairing and a plain linear patch in the same run.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>
#include <terrane/io/files.hpp>

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

/// Returns the root mean square of the errors expected at the vertices that were joined.
double expected_of(const Filling& filling, const Joined& made) {
    double squares = 0;
    for (const auto v : made.filling_vertices) squares += std::pow(filling.expected_error[v], 2);
    return std::sqrt(squares / double(std::max<std::size_t>(made.filling_vertices.size(), 1)));
}

void print_kriging(const Model& model, const Filling& filling, const char* way, double seconds) {
    const auto filled = joined(model.holed, filling);
    print_misfit(way, misfit(model, filled, model.holed.triangles.size()), seconds);
    std::printf(" (predicted %.3g, left out %.3g)", filling.report.expected_error,
                filling.report.validated_error);
}

void print_rbf(const Model& model, const BorderLoop& loop, const char* way,
               const RbfOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const auto made = fill_and_join_by_rbf(model.holed, loop, options);
    const double seconds = seconds_since(start);
    if (!made) {
        std::printf("  %s: %s", way, made.error().message().c_str());
        return;
    }
    const auto& [filling, joined, report] = made.value();
    print_misfit(way, misfit(model, joined.surface, model.holed.triangles.size()), seconds);
    std::printf(" (predicted %.3g)", expected_of(filling, joined));
}

/// Prints the errors with triangles as large as those round the hole.
void print_at_size_of_border(const Model& model, const BorderLoop& loop) {
    const double size = loop.length / double(loop.vertices.size());
    KrigingOptions options;
    options.mesh_size = size;
    const auto start = std::chrono::steady_clock::now();
    if (const auto filling = fill_by_kriging(model.holed, loop, options))
        print_kriging(model, filling.value(), "kriging, border's size", seconds_since(start));
    print_rbf(model, loop, "rbf, border's size", {.size = size});
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
    if (filling)
        print_kriging(model, filling.value(), "kriging", seconds);
    else
        std::printf("  kriging refuses");
    print_rbf(model, *hole, "rbf", {});
    if (model.smooth) print_at_size_of_border(model, *hole);
    if (!model.smooth) print_rbf(model, *hole, "rbf smoothed", {.smoothing = 0.0});
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

// ---- Real horizons

/// A surface without the triangles at vertices within `radius` of a place.
struct Punched {
    Surface surface;
    std::vector<Point3> removed; ///< vertices of removed triangles only
};

Punched punched(const Surface& s, const Point3& centre, double radius) {
    Punched result;
    result.surface = {s.name, s.role, s.vertices, {}};
    std::vector<bool> kept(s.vertices.size()), had(s.vertices.size());
    for (const Triangle& t : s.triangles) {
        const bool near = std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
            return std::hypot(s.vertices[v].x - centre.x, s.vertices[v].y - centre.y) < radius;
        });
        for (const auto v : t) (near ? had : kept)[v] = true;
        if (!near) result.surface.triangles.push_back(t);
    }
    for (std::size_t v = 0; v < s.vertices.size(); ++v)
        if (had[v] && !kept[v]) result.removed.push_back(s.vertices[v]);
    return result;
}

/// Returns the height over a place of the triangles from `first` on, or NaN.
double height_over(const Surface& s, std::size_t first, const Point3& p) {
    for (auto i = first; i < s.triangles.size(); ++i) {
        const Triangle& t = s.triangles[i];
        const Point3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        const double u = ((b.x - p.x) * (c.y - p.y) - (b.y - p.y) * (c.x - p.x)) / area;
        const double v = ((c.x - p.x) * (a.y - p.y) - (c.y - p.y) * (a.x - p.x)) / area;
        if (u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9)
            return u * a.z + v * b.z + (1 - u - v) * c.z;
    }
    return NAN;
}

struct Sum {
    double squares = 0;
    std::size_t count = 0;

    void add(const Surface& filled, std::size_t first, const std::vector<Point3>& removed) {
        for (const Point3& p : removed)
            if (const double z = height_over(filled, first, p); std::isfinite(z)) {
                squares += (z - p.z) * (z - p.z);
                ++count;
            }
    }
    [[nodiscard]] double root() const { return std::sqrt(squares / double(count)); }
};

/// The error of one method over all holes.
struct Way {
    Sum missed;
    double expected = 0; ///< sum of squares over the holes
    std::size_t holes = 0;

    void add(const Surface& filled, std::size_t first, const std::vector<Point3>& removed,
             double foreseen) {
        missed.add(filled, first, removed);
        expected += foreseen * foreseen;
        ++holes;
    }
    void print(const char* name) const {
        std::printf("  %s %.3g", name, missed.root());
        if (expected > 0) std::printf(" (expected %.3g)", std::sqrt(expected / double(holes)));
    }
};

/// Fills nine holes of one size, one at a time, at vertices spread over the list.
void punch(const Surface& s, double radius) {
    Way kriging, rbf, smoothed, fair, linear;
    for (int k = 1; k <= 9; ++k) {
        const Point3& centre = s.vertices[s.vertices.size() * std::size_t(k) / 10];
        const auto p = punched(s, centre, radius);
        const auto loops = find_border_loops(p.surface);
        if (!loops || p.removed.size() < 5) continue;
        const auto hole =
            std::find_if(loops.value().begin(), loops.value().end(), [&](const BorderLoop& l) {
                return l.kind != LoopKind::outer &&
                       std::hypot(l.centre.x - centre.x, l.centre.y - centre.y) < radius;
            });
        if (hole == loops.value().end()) continue; // the hole reached the outer border
        const auto first = p.surface.triangles.size();
        const auto filling = fill_by_kriging(p.surface, *hole);
        if (!filling) continue;
        kriging.add(joined(p.surface, filling.value()), first, p.removed,
                    filling.value().report.expected_error);
        for (Way* way : {&rbf, &smoothed}) {
            RbfOptions options;
            if (way == &smoothed) options.smoothing = 0;
            if (const auto made = fill_and_join_by_rbf(p.surface, *hole, options))
                way->add(made.value().joined.surface, first, p.removed,
                         expected_of(made.value().filling, made.value().joined));
        }
        for (Way* way : {&fair, &linear})
            if (const auto made = filled_by_cgal(p.surface, hole->vertices, way == &fair))
                way->add(*made, first, p.removed, 0);
    }
    std::printf("%-22s radius %-7g %zu holes, %zu points:", s.name.c_str(), radius, kriging.holes,
                kriging.missed.count);
    kriging.print("kriging");
    rbf.print("rbf");
    smoothed.print("rbf smoothed");
    fair.print("fair");
    linear.print("linear");
    std::printf("\n");
}

int punch_file(const char* file, double step) {
    const auto surfaces = read_surfaces(file, std::nullopt, {.depth = true});
    if (!surfaces) {
        std::fprintf(stderr, "%s\n", surfaces.error().message().c_str());
        return 2;
    }
    for (const Surface& s : surfaces.value())
        for (const double cells : {3.0, 6.0, 12.0}) punch(s, cells * step);
    return 0;
}

} // namespace

// terrane_bench_fill [--alone | --folds]   known surfaces, without CGAL; many folds
// terrane_bench_fill FILE STEP             holes of 3, 6 and 12 grid steps in a real horizon
int main(int argc, char** argv) {
    if (argc == 3) return punch_file(argv[1], std::atof(argv[2]));
    const auto asked = [&](const char* what) {
        return argc > 1 && std::strcmp(argv[1], what) == 0;
    };
    std::printf("root mean square and largest error / root mean square at new vertices, seconds\n");
    for (const Model& model : asked("--folds") ? fold_models() : models())
        run(model, !asked("--alone"));
}
