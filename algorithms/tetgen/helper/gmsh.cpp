// SPDX-License-Identifier: LGPL-3.0-or-later
//
// terrane-gmsh has Gmsh carry out requests of the library.
//
// This file is LGPL. The program made from it is linked with Gmsh, which is GPL-2.0-or-later, so
// that the program as a whole is GPL-3.0-or-later.
#include <cmath>
#include <cstddef>
#include <map>
#include <new>
#include <numeric>
#include <span>
#include <vector>

#include <gmsh.h>

#include <terrane/algorithms/tetgen/helper/helper.hpp>

namespace terrane::tetgen::detail {
namespace {

constexpr auto usage =
    "terrane-gmsh " TERRANE_VERSION "\n"
    "The part of Terrane that makes tetrahedra by Gmsh: reads a request on standard input, writes "
    "a\n"
    "reply on standard output. The library and the program terrane start it; it is of no use by\n"
    "hand. It is linked with Gmsh and is, as a whole, under the GPL-3.0-or-later.\n";

constexpr int triangle_type = 2, tetrahedron_type = 4; // as Gmsh numbers them

/// The result of Gmsh.
struct Made {
    std::vector<Coordinates> points; ///< those of the request first
    std::vector<std::uint32_t> tetrahedra;
};

void set_options(const Request& request) {
    using gmsh::option::setNumber;
    setNumber("General.Terminal", 0);
    setNumber("General.NumThreads", 1); // so that the same request has the same reply
    setNumber("Mesh.RandomSeed", 1);
    // Facets are conforming, however small the angle between them.
    setNumber("Mesh.AngleToleranceFacetOverlap", 1e-30);
    setNumber("Mesh.Algorithm3D", request.has(parallel_delaunay_flag) ? 10 : 1);
    setNumber("Mesh.MeshSizeFromPoints", 0);
    setNumber("Mesh.MeshSizeExtendFromBoundary", request.has(improve_flag) ? 1 : 0);
    setNumber("Mesh.Optimize", request.has(improve_flag) ? 1 : 0);
    if (request.has(max_volume_flag)) // that of a regular tetrahedron
        setNumber("Mesh.MeshSizeMax", std::cbrt(request.header.max_volume * 6 * std::sqrt(2.0)));
}

/// Makes one surface of all facets between the same two blocks, and a volume of each block.
/// Facets with the same block on both sides are embedded in it.
void set_domain(const Request& request) {
    std::map<SidesRecord, std::vector<std::size_t>> corners_between; // node tags
    for (std::size_t i = 0; i < request.sides.size(); ++i) {
        auto sides = request.sides[i];
        if (sides[0] > sides[1]) std::swap(sides[0], sides[1]);
        auto& corners = corners_between[sides];
        const auto first = request.offsets[i], last = request.offsets[i + 1];
        for (auto k = first + 2; k < last; ++k) // facets are convex
            for (const auto corner : {first, k - 1, k})
                corners.push_back(std::size_t{request.corners[corner]} + 1);
    }
    std::map<std::uint32_t, std::vector<int>> around, within; // surfaces per block
    int surface = 0;
    for (const auto& [sides, corners] : corners_between) {
        gmsh::model::addDiscreteEntity(2, ++surface);
        if (sides[0] == sides[1])
            within[sides[0]].push_back(surface);
        else
            for (const std::uint32_t block : sides)
                if (block != no_block) around[block].push_back(surface);
    }
    std::vector<std::size_t> tags(request.points.size());
    std::iota(tags.begin(), tags.end(), 1);
    const std::span coordinates(request.points.front().data(), 3 * request.points.size());
    gmsh::model::mesh::addNodes(2, 1, tags, {coordinates.begin(), coordinates.end()});
    surface = 0;
    for (const auto& [sides, corners] : corners_between)
        gmsh::model::mesh::addElementsByType(++surface, triangle_type, {}, corners);
    // Gmsh meshes no discrete volume, but one of its own kernel that discrete surfaces bound.
    for (const auto& [block, surfaces] : around) {
        const int volume = static_cast<int>(block) + 1;
        gmsh::model::geo::addSurfaceLoop(surfaces, volume);
        gmsh::model::geo::addVolume({volume}, volume);
    }
    gmsh::model::geo::synchronize();
    for (const auto& [block, surfaces] : within)
        gmsh::model::mesh::embed(2, surfaces, 3, static_cast<int>(block) + 1);
}

/// Reads what Gmsh made. The points of the request come first, in their order.
bool take(const Request& request, Made& made) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, unused;
    gmsh::model::mesh::getNodes(tags, coordinates, unused);
    made.points = request.points;
    std::map<std::size_t, std::uint32_t> index_of;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        const double* p = &coordinates[3 * i];
        if (tags[i] >= 1 && tags[i] <= request.points.size()) {
            index_of[tags[i]] = static_cast<std::uint32_t>(tags[i] - 1);
            continue;
        }
        index_of[tags[i]] = static_cast<std::uint32_t>(made.points.size());
        made.points.push_back({p[0], p[1], p[2]});
    }
    std::vector<std::size_t> elements, corners;
    gmsh::model::mesh::getElementsByType(tetrahedron_type, elements, corners);
    for (const std::size_t tag : corners) {
        const auto found = index_of.find(tag);
        if (found == index_of.end()) return false;
        made.tetrahedra.push_back(found->second);
    }
    return !corners.empty();
}

std::int32_t carry_out(Request& request, Made& made) {
    try {
        if (const std::int32_t status = read_request(request); status != done) return status;
        if (request.points.empty() || request.sides.size() + 1 != request.offsets.size())
            return bad_request;
        gmsh::initialize();
        set_options(request);
        gmsh::model::add("terrane");
        set_domain(request);
        gmsh::model::mesh::generate(3);
        return take(request, made) ? done : mesher_failed;
    } catch (const std::bad_alloc&) {
        return tetgen_out_of_memory;
    } catch (...) {
        return mesher_failed;
    }
}

/// Replies with the triangles of the request as faces, each on its facet. The library checks that
/// they are.
void reply(int fd, std::int32_t status, const Request& request, const Made& made) {
    ReplyHeader header;
    header.status = status;
    if (status != done) return write_all(fd, &header, sizeof header);
    std::vector<std::uint32_t> faces, markers;
    for (std::size_t i = 0; i + 1 < request.offsets.size(); ++i) {
        const auto first = request.offsets[i], last = request.offsets[i + 1];
        if (last - first != 3) continue; // a side of the box
        faces.insert(faces.end(), request.corners.begin() + first, request.corners.begin() + last);
        markers.push_back(static_cast<std::uint32_t>(i) + 1);
    }
    header.points = made.points.size();
    header.tetrahedra = made.tetrahedra.size() / 4;
    header.faces = markers.size();
    write_all(fd, &header, sizeof header);
    write_all(fd, made.points.data(), made.points.size() * sizeof(Coordinates));
    write_all(fd, made.tetrahedra.data(), made.tetrahedra.size() * sizeof(std::uint32_t));
    write_all(fd, faces.data(), faces.size() * sizeof(std::uint32_t));
    write_all(fd, markers.data(), markers.size() * sizeof(std::uint32_t));
}

} // namespace
} // namespace terrane::tetgen::detail

int main(int argc, char** argv) {
    using namespace terrane::tetgen::detail;
    return run_helper<Made>(argc, argv, usage, carry_out, reply);
}
