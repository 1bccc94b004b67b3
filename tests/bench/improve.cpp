// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Improves a mesh of several surfaces, and compares it with CGAL's isotropic remeshing of each
// surface alone with the curves protected: quality, contacts, deviation, wall-clock and processor
// time. Times are medians of some repeats, taken in turn.
//   terrane_bench_improve [--edge-length L] [--iterations N] [--passes N] [--threads N]
//   [--repeats N] NAME|FILE...
// A NAME is a model of models.hpp. Several FILEs are one model. Build it with NDEBUG, as the preset
// `bench` does: assertions slow CGAL down by up to three times.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/detail/features.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/io/files.hpp>

#include "models.hpp"

namespace {

using namespace terrane;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

struct Settings {
    double edge_length = 0;
    unsigned iterations = 5; ///< of CGAL
    unsigned passes = terrane::ImproveOptions{}.passes;
    unsigned threads = 2; ///< of improve(); CGAL's remeshing has one
    unsigned repeats = 5;
    std::vector<std::string> names;
};

/// Wall-clock and processor time.
struct Seconds {
    double clock = 0, processor = 0;

    static Seconds now() {
        const std::chrono::duration<double> since =
            std::chrono::steady_clock::now().time_since_epoch();
        return {since.count(), static_cast<double>(std::clock()) / CLOCKS_PER_SEC};
    }
    friend Seconds operator-(const Seconds& a, const Seconds& b) {
        return {a.clock - b.clock, a.processor - b.processor};
    }
    Seconds& operator+=(const Seconds& o) {
        clock += o.clock;
        processor += o.processor;
        return *this;
    }
};

/// Returns the median of each of the two times.
Seconds median(std::vector<Seconds> all) {
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    Seconds out;
    for (double Seconds::*const which : {&Seconds::clock, &Seconds::processor}) {
        std::nth_element(all.begin(), middle, all.end(),
                         [&](const Seconds& a, const Seconds& b) { return a.*which < b.*which; });
        out.*which = (*middle).*which;
    }
    return out;
}

/// Splits a mesh into its surfaces, each with its own vertices.
std::vector<Surface> split_by_surface(const Mesh& mesh) {
    std::vector<Surface> all(mesh.surfaces.size());
    std::vector<std::map<std::uint32_t, std::uint32_t>> names(mesh.surfaces.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t s : mesh.surfaces_of[t]) {
            Triangle corners{};
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t v = mesh.triangles[t][i];
                const auto [at, is_new] =
                    names[s].try_emplace(v, static_cast<std::uint32_t>(all[s].vertices.size()));
                if (is_new) all[s].vertices.push_back(mesh.vertices[v]);
                corners[i] = at->second;
            }
            all[s].triangles.push_back(corners);
        }
    return all;
}

double automatic_length(const Surface& s) {
    double area = 0;
    for (const Triangle& t : s.triangles) {
        const Point3 n = cross(minus(s.vertices[t[1]], s.vertices[t[0]]),
                               minus(s.vertices[t[2]], s.vertices[t[0]]));
        area += std::hypot(n.x, n.y, n.z) / 2;
    }
    return std::sqrt(area / static_cast<double>(s.triangles.size()) * 4 / std::sqrt(3.0));
}

/// A curve edge by the positions of its ends, as CGAL numbers vertices anew.
using PlacedEdge = std::array<Point3, 2>;

PlacedEdge placed(const Point3& a, const Point3& b) {
    return a < b ? PlacedEdge{a, b} : PlacedEdge{b, a};
}

struct Remeshed {
    std::vector<Surface> surfaces;
    Seconds seconds;
    std::size_t failed = 0;
};

/// Remeshes one surface with CGAL; the edges in `curves` and its borders are constrained.
Surface remesh(const Surface& in, const std::vector<PlacedEdge>& curves, double length,
               unsigned iterations, Seconds& seconds) {
    std::vector<Kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> polygons;
    for (const Point3& p : in.vertices) points.emplace_back(p.x, p.y, p.z);
    for (const Triangle& t : in.triangles) polygons.push_back({t[0], t[1], t[2]});
    pmp::orient_polygon_soup(points, polygons);
    CgalMesh mesh;
    pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
    auto fixed = mesh.add_property_map<CgalMesh::Edge_index, bool>("e:fixed", false).first;
    const auto place = [&](CgalMesh::Vertex_index v) {
        const auto& p = mesh.point(v);
        return Point3{p.x(), p.y(), p.z()};
    };
    for (const auto e : mesh.edges())
        fixed[e] = mesh.is_border(e) ||
                   std::binary_search(curves.begin(), curves.end(),
                                      placed(place(mesh.vertex(e, 0)), place(mesh.vertex(e, 1))));
    const Seconds start = Seconds::now();
    std::vector<CgalMesh::Edge_index> long_ones;
    for (const auto e : mesh.edges())
        if (fixed[e]) long_ones.push_back(e);
    pmp::split_long_edges(long_ones, length, mesh,
                          CGAL::parameters::edge_is_constrained_map(fixed));
    pmp::isotropic_remeshing(faces(mesh), length, mesh,
                             CGAL::parameters::number_of_iterations(iterations)
                                 .protect_constraints(true)
                                 .edge_is_constrained_map(fixed));
    seconds += Seconds::now() - start;
    mesh.collect_garbage();
    Surface out;
    out.name = in.name;
    for (const auto v : mesh.vertices()) out.vertices.push_back(place(v));
    for (const auto f : mesh.faces()) {
        Triangle t{};
        std::size_t i = 0;
        for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
            t[i++] = static_cast<std::uint32_t>(v.idx());
        out.triangles.push_back(t);
    }
    return out;
}

Remeshed by_cgal(const Mesh& mesh, const Settings& settings) {
    const auto features = quality::detail::find_features(
        mesh, {ImproveOptions{}.crease_angle * std::acos(-1.0) / 180,
               ImproveOptions{}.curve_angle * std::acos(-1.0) / 180});
    std::vector<PlacedEdge> curves;
    for (const Edge& e : features.edges)
        curves.push_back(placed(mesh.vertices[e[0]], mesh.vertices[e[1]]));
    std::sort(curves.begin(), curves.end());
    Remeshed out;
    for (const Surface& s : split_by_surface(mesh)) {
        if (s.triangles.empty()) continue;
        const double length = settings.edge_length > 0 ? settings.edge_length : automatic_length(s);
        try {
            out.surfaces.push_back(remesh(s, curves, length, settings.iterations, out.seconds));
        } catch (const std::exception&) {
            ++out.failed;
        }
    }
    return out;
}

Surface joined(const std::vector<Surface>& surfaces) {
    Surface all;
    for (const Surface& s : surfaces) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        all.vertices.insert(all.vertices.end(), s.vertices.begin(), s.vertices.end());
        for (const Triangle& t : s.triangles)
            all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return all;
}

void print_row(const char* name, const QualityReport& q, double seconds, std::size_t contacts,
               double out, double back) {
    std::printf("  %-8s %8zu  q %.4f mean %.5f min  %5.1f %% > 0.8  angles %.4f .. %.2f  ", name,
                q.triangles, q.q.mean, q.q.min, 100 * q.share_above_08, q.smallest_angle.min,
                q.largest_angle.max);
    std::printf("%.2f s  %zu contacts  deviation %.3g, %.3g\n", seconds, contacts, out, back);
}

std::size_t flaws_of(const std::vector<Surface>& surfaces) {
    const auto report = check(surfaces);
    if (!report) return SIZE_MAX;
    return report.value().contacts.size() + report.value().degenerate.size();
}

int run_one(const std::string& name, const std::vector<Surface>& surfaces,
            const Settings& settings) {
    const auto exact = arrange(surfaces);
    if (!exact) return 2;
    const auto rounded = round_to_doubles(exact.value());
    if (!rounded || !rounded.value().report.clean) {
        std::printf("%s: no conforming mesh of doubles\n", name.c_str());
        return 1;
    }
    const Mesh& mesh = rounded.value().mesh;
    const Surface before{"", Role::unknown, mesh.vertices, mesh.triangles};
    ImproveOptions options;
    options.edge_length = settings.edge_length;
    options.passes = settings.passes;
    Run run;
    run.threads = settings.threads;
    std::vector<Seconds> all_of_ours, all_of_theirs;
    Result<Improved> improved = Error{};
    Remeshed theirs;
    for (unsigned repeat = 0; repeat < std::max(1U, settings.repeats); ++repeat) {
        const Seconds start = Seconds::now();
        improved = improve(mesh, options, run);
        all_of_ours.push_back(Seconds::now() - start);
        if (!improved) {
            std::printf("%s: %s\n", name.c_str(), improved.error().message().c_str());
            return 1;
        }
        theirs = by_cgal(mesh, settings);
        all_of_theirs.push_back(theirs.seconds);
    }
    const Seconds seconds = median(all_of_ours), seconds_of_theirs = median(all_of_theirs);
    const auto& report = improved.value().report;
    std::printf("%s: %zu surfaces, bound %.3g to %.3g, worst: %s\n", name.c_str(),
                mesh.surfaces.size(),
                *std::min_element(report.bound_of.begin(), report.bound_of.end()),
                *std::max_element(report.bound_of.begin(), report.bound_of.end()),
                std::string(name_of(report.worst_cause)).c_str());
    print_row("before", report.before, 0, 0, 0, 0);
    const auto ours = split_by_surface(improved.value().mesh);
    const Surface all_ours{"", Role::unknown, improved.value().mesh->vertices,
                           improved.value().mesh->triangles};
    print_row("terrane", report.after, seconds.clock, flaws_of(ours),
              sampled_distance(all_ours, before), sampled_distance(before, all_ours));
    const Surface all_theirs = joined(theirs.surfaces);
    print_row("CGAL", measure_quality(all_theirs.vertices, all_theirs.triangles),
              seconds_of_theirs.clock, flaws_of(theirs.surfaces),
              sampled_distance(all_theirs, before), sampled_distance(before, all_theirs));
    if (theirs.failed > 0) std::printf("  CGAL failed on %zu surfaces\n", theirs.failed);
    std::printf("  time of CGAL's: %.2f with threads: %u, %.2f of the processor's\n",
                seconds.clock / seconds_of_theirs.clock, settings.threads,
                seconds.processor / seconds_of_theirs.processor);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    Settings settings;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--edge-length" && i + 1 < argc)
            settings.edge_length = std::atof(argv[++i]);
        else if (word == "--iterations" && i + 1 < argc)
            settings.iterations = static_cast<unsigned>(std::atoi(argv[++i]));
        else if (word == "--passes" && i + 1 < argc)
            settings.passes = static_cast<unsigned>(std::atoi(argv[++i]));
        else if (word == "--threads" && i + 1 < argc)
            settings.threads = static_cast<unsigned>(std::atoi(argv[++i]));
        else if (word == "--repeats" && i + 1 < argc)
            settings.repeats = static_cast<unsigned>(std::atoi(argv[++i]));
        else
            settings.names.push_back(word);
    }
    std::vector<Surface> files;
    int status = 0;
    for (const std::string& name : settings.names) {
        if (!std::filesystem::exists(name)) {
            status = std::max(status, run_one(name, bench::model(name).surfaces, settings));
            continue;
        }
        auto read = read_surfaces(name);
        if (!read) {
            std::printf("%s\n", read.error().message().c_str());
            return 2;
        }
        for (Surface& s : read.value()) files.push_back(std::move(s));
    }
    if (!files.empty()) status = std::max(status, run_one(settings.names.back(), files, settings));
    return status;
}
