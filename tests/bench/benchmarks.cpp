// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Benchmarks of the single parts. Filter them with --benchmark_filter; see scripts/bench.sh.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/process_memory.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/triangulation/triangulation.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/predicates.hpp>

#include "floor.hpp"
#include "models.hpp"
#include "yardsticks.hpp"

namespace {

using namespace terrane;
using namespace bench;

constexpr std::array names{"pair1_68k",  "pair1_680k",  "pair2_68k",
                           "pair2_680k", "nonuniform1", "nonuniform2"};

const Model& model_of(const benchmark::State& state) {
    return model(names[static_cast<std::size_t>(state.range(0))]);
}

void label(benchmark::State& state) {
    state.SetLabel(names[static_cast<std::size_t>(state.range(0))]);
}

void search_two(benchmark::State& state, Search method) {
    const Model& m = model_of(state);
    for (auto _ : state) {
        const auto boxes = boxes_of(m.points, m.triangles);
        benchmark::DoNotOptimize(candidate_pairs(boxes, m.groups, method));
    }
    label(state);
}

void search_all(benchmark::State& state, Search method) {
    const Model& m = model_of(state);
    for (auto _ : state) benchmark::DoNotOptimize(candidate_pairs(m.boxes, {}, method));
    label(state);
}

void search_floor(benchmark::State& state) {
    const Model& m = model_of(state);
    for (auto _ : state) benchmark::DoNotOptimize(floor_of_search(m));
    label(state);
}

void search_cgal(benchmark::State& state) {
    BoxIntersection cgal(model_of(state));
    for (auto _ : state) {
        state.PauseTiming();
        cgal.prepare();
        state.ResumeTiming();
        benchmark::DoNotOptimize(cgal());
    }
    label(state);
}

void whole(benchmark::State& state) {
    const Model& m = model_of(state);
    for (auto _ : state) benchmark::DoNotOptimize(round_to_doubles(arrange(m.surfaces).value()));
    label(state);
}

void whole_floor(benchmark::State& state) {
    const Model& m = model_of(state);
    const auto rounded = round_to_doubles(arrange(m.surfaces).value());
    const Mesh& mesh = rounded.value().mesh;
    const OutputSize output{mesh.vertices.size(), mesh.triangles.size()};
    for (auto _ : state) benchmark::DoNotOptimize(floor_of_arrange(m, output));
    label(state);
}

void whole_corefine(benchmark::State& state) {
    Corefine cgal(model_of(state));
    for (auto _ : state) {
        state.PauseTiming();
        cgal.prepare();
        state.ResumeTiming();
        benchmark::DoNotOptimize(cgal());
    }
    label(state);
}

/// Finds the contacts of all pairs whose boxes overlap; the time is per pair.
void triangle_triangle(benchmark::State& state, bool two_surfaces) {
    const Model& m = model("pair2_68k");
    const auto pairs = candidate_pairs(
        m.boxes, two_surfaces ? m.groups : std::vector<std::uint32_t>{}, Search::automatic);
    const UpwardRounding guard;
    std::size_t contacts = 0;
    for (auto _ : state)
        for (const auto& [i, j] : pairs)
            contacts += improper_contact(m.points, m.triangles[i], m.triangles[j]) ? 1 : 0;
    benchmark::DoNotOptimize(contacts);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs.size()));
}

/// Triangulates a triangle with `n` points inside and a segment between every other pair of
/// neighbours in x.
void triangulate_one(benchmark::State& state) {
    const auto n = static_cast<PointIndex>(state.range(0));
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> place(0.01, 0.48);
    std::vector<Point3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (PointIndex i = 0; i < n; ++i) points.push_back({place(random), place(random), 0});
    std::sort(points.begin() + 3, points.end());
    const PointStore store(points);
    std::vector<std::uint32_t> order(points.size()), rank(points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return points[a] < points[b]; });
    for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
    FaceInput face;
    face.corners = {0, 1, 2};
    for (PointIndex i = 3; i < points.size(); ++i) face.inner_points.push_back(i);
    for (PointIndex i = 3; i + 1 < points.size(); i += 2) face.segments.push_back({i, i + 1});
    const UpwardRounding guard;
    FaceTriangulation triangulation(guard);
    for (auto _ : state) benchmark::DoNotOptimize(triangulation(store, rank, face));
}

void register_searches() {
    for (const Search method : {Search::automatic, Search::grid, Search::ab_balanced,
                                Search::ab_median, Search::mixed, Search::bvh}) {
        const std::string name(name_of(method));
        benchmark::RegisterBenchmark(("search_two/" + name).c_str(), search_two, method)
            ->DenseRange(0, names.size() - 1)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("search_all/" + name).c_str(), search_all, method)
            ->DenseRange(0, 2, 2)
            ->Unit(benchmark::kMillisecond);
    }
    benchmark::RegisterBenchmark("search_two/ab", search_two, Search::ab)
        ->Arg(0)
        ->Arg(2)
        ->Unit(benchmark::kMillisecond);
    using Work = void (*)(benchmark::State&);
    const std::array<std::pair<const char*, Work>, 5> others{
        {{"search_two/floor", search_floor},
         {"search_two/CGAL", search_cgal},
         {"whole/terrane", whole},
         {"whole/floor", whole_floor},
         {"whole/CGAL_corefine", whole_corefine}}};
    for (const auto& [name, work] : others)
        benchmark::RegisterBenchmark(name, work)
            ->DenseRange(0, names.size() - 1)
            ->Unit(benchmark::kMillisecond);
}

} // namespace

int main(int argc, char** argv) {
    keep_freed_memory(); // for the yardsticks as well
    register_searches();
    benchmark::RegisterBenchmark("triangle_triangle/two_surfaces", triangle_triangle, true);
    benchmark::RegisterBenchmark("triangle_triangle/neighbours", triangle_triangle, false);
    benchmark::RegisterBenchmark("triangulate_one", triangulate_one)
        ->RangeMultiplier(8)
        ->Range(2, 1024);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
