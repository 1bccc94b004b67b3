// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares predicates on input points with CGAL's: random points, which filters decide, and
// coplanar points, which need exact numbers.
#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/predicates.hpp>

namespace {

using terrane::Point3;

constexpr std::size_t count = 4096;

/// Returns random points; coplanar: on z = x + y exactly, on a lattice of 2^-20.
std::vector<Point3> points(bool coplanar) {
    std::mt19937_64 random(3);
    std::vector<Point3> all;
    for (std::size_t i = 0; i < count; ++i) {
        const auto next = [&] { return static_cast<double>(random() >> 44) * 0x1p-20; };
        const double x = next(), y = next(), z = next();
        all.push_back({x, y, coplanar ? x + y : z});
    }
    return all;
}

void orient3d_terrane(benchmark::State& state, bool coplanar) {
    const auto p = points(coplanar);
    const terrane::UpwardRounding guard;
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(terrane::orient3d(p[i], p[i + 1], p[i + 2], p[i + 3]));
        i = (i + 4) % count;
    }
}

void in_circle_terrane(benchmark::State& state, bool coplanar) {
    const auto p = points(coplanar);
    const terrane::UpwardRounding guard;
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            terrane::in_circle(terrane::Axis::z, p[i], p[i + 1], p[i + 2], p[i + 3]));
        i = (i + 4) % count;
    }
}

template <class Kernel>
void orient3d_cgal(benchmark::State& state, bool coplanar) {
    std::vector<typename Kernel::Point_3> p;
    for (const Point3& q : points(coplanar)) p.emplace_back(q.x, q.y, q.z);
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(CGAL::orientation(p[i], p[i + 1], p[i + 2], p[i + 3]));
        i = (i + 4) % count;
    }
}

template <class Kernel>
void in_circle_cgal(benchmark::State& state, bool coplanar) {
    std::vector<typename Kernel::Point_2> p;
    for (const Point3& q : points(coplanar)) p.emplace_back(q.x, q.y);
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(CGAL::side_of_oriented_circle(p[i], p[i + 1], p[i + 2], p[i + 3]));
        i = (i + 4) % count;
    }
}

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;

[[maybe_unused]] const bool registered = [] {
    for (const bool coplanar : {false, true}) {
        const std::string points = coplanar ? "/coplanar" : "/random";
        const auto add = [&](const char* name, auto* work) {
            benchmark::RegisterBenchmark((name + points).c_str(), work, coplanar);
        };
        add("orient3d/terrane", orient3d_terrane);
        add("orient3d/Epick", orient3d_cgal<Epick>);
        add("orient3d/EPECK", orient3d_cgal<Epeck>);
        add("in_circle/terrane", in_circle_terrane);
        add("in_circle/Epick", in_circle_cgal<Epick>);
        add("in_circle/EPECK", in_circle_cgal<Epeck>);
    }
    return true;
}();

} // namespace
