// SPDX-License-Identifier: LGPL-3.0-or-later
//
// CGAL's Booleans and autorefinement for the score card:
//
//     cgal METHOD OPERATION OUTPUT.off INPUT.off INPUT.off ...
//
// It prints the processor seconds without those of files.
//
// METHOD is corefine (numbers of EPICK, which rounds what it constructs), corefine-exact (of EPECK; rounded when it is
// written), clip, nef or autorefine. More than two operands are taken one after the other.
#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>

namespace pmp = CGAL::Polygon_mesh_processing;
using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
template <class Kernel>
using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;

namespace {

struct Refused {
    const char* why;
};

std::clock_t of_files = 0;

/// Counts the time of its scope as that of files.
struct Files {
    std::clock_t begin = std::clock();
    ~Files() { of_files += std::clock() - begin; }
};

template <class Kernel>
Mesh<Kernel> read(const char* path) {
    const Files files;
    std::ifstream in(path);
    Mesh<Kernel> mesh;
    if (!CGAL::IO::read_OFF(in, mesh)) throw Refused{"an input is no manifold"};
    return mesh;
}

/// Points that are equal doubles become one, and with `once` triangles that repeat others.
template <class Kernel>
void write(const char* path, const Mesh<Kernel>& mesh, bool once = false) {
    const Files files;
    std::map<std::array<double, 3>, std::size_t> numbers;
    std::vector<std::array<double, 3>> points;
    std::set<std::array<std::size_t, 3>> written;
    std::ostringstream faces;
    std::size_t count = 0;
    for (const auto f : mesh.faces()) {
        std::vector<std::size_t> corners;
        for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
            const auto& p = mesh.point(v);
            const std::array place{CGAL::to_double(p.x()) + 0, CGAL::to_double(p.y()) + 0,
                                   CGAL::to_double(p.z()) + 0};
            const auto [at, is_new] = numbers.emplace(place, points.size());
            if (is_new) points.push_back(place);
            corners.push_back(at->second);
        }
        std::array sorted{corners[0], corners[1], corners[2]};
        std::sort(sorted.begin(), sorted.end());
        if (once && !written.insert(sorted).second) continue;
        faces << "3 " << corners[0] << ' ' << corners[1] << ' ' << corners[2] << '\n';
        ++count;
    }
    std::ofstream out(path);
    out.precision(17);
    out << "OFF\n" << points.size() << ' ' << count << " 0\n";
    for (const auto& p : points) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    out << faces.str();
}

template <class Kernel>
Mesh<Kernel> corefined(Mesh<Kernel> a, Mesh<Kernel> b, const std::string& operation) {
    Mesh<Kernel> result;
    const bool made = operation == "union" ? pmp::corefine_and_compute_union(a, b, result)
                      : operation == "intersection"
                          ? pmp::corefine_and_compute_intersection(a, b, result)
                          : pmp::corefine_and_compute_difference(a, b, result);
    if (!made) throw Refused{"the result is no manifold"};
    result.collect_garbage();
    return result;
}

using Nef = CGAL::Nef_polyhedron_3<Exact>;

Nef combined(const Nef& a, const Nef& b, const std::string& operation) {
    return operation == "union" ? a + b : operation == "intersection" ? a * b : a - b;
}

template <class Kernel>
void corefine(const std::string& operation, char** files, int count) {
    auto result = read<Kernel>(files[1]);
    for (int i = 2; i < count; ++i)
        result = corefined<Kernel>(result, read<Kernel>(files[i]), operation);
    write<Kernel>(files[0], result);
}

void nef(const std::string& operation, char** files, int count) {
    Nef result(read<Exact>(files[1]));
    for (int i = 2; i < count; ++i)
        result = combined(result, Nef(read<Exact>(files[i])), operation);
    Mesh<Exact> mesh;
    CGAL::convert_nef_polyhedron_to_polygon_mesh(result, mesh, true);
    write<Exact>(files[0], mesh);
}

void clip(char** files, int count) {
    auto a = read<Inexact>(files[1]);
    for (int i = 2; i < count; ++i) {
        auto b = read<Inexact>(files[i]);
        if (!pmp::clip(a, b, CGAL::parameters::clip_volume(true)))
            throw Refused{"the result is no manifold"};
    }
    a.collect_garbage();
    write<Inexact>(files[0], a);
}

void autorefine(char** files, int count) {
    Mesh<Exact> all;
    for (int i = 1; i < count; ++i) CGAL::copy_face_graph(read<Exact>(files[i]), all);
    pmp::experimental::autorefine(all);
    all.collect_garbage();
    write<Exact>(files[0], all, true);
}

} // namespace

int main(int argc, char** argv) {
    const std::string method = argv[1], operation = argv[2];
    char** files = argv + 3;
    const int count = argc - 3;
    try {
        if (method == "corefine")
            corefine<Inexact>(operation, files, count);
        else if (method == "corefine-exact")
            corefine<Exact>(operation, files, count);
        else if (method == "nef")
            nef(operation, files, count);
        else if (method == "clip")
            clip(files, count);
        else
            autorefine(files, count);
        std::cout << "operation: " << double(std::clock() - of_files) / CLOCKS_PER_SEC << " s\n";
    } catch (const Refused& refused) {
        std::cerr << refused.why << '\n';
        return 1;
    } catch (const std::exception& failed) {
        std::cerr << failed.what() << '\n';
        return 1;
    }
}
