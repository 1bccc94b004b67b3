// SPDX-License-Identifier: LGPL-3.0-or-later
//
// terrane-tetgen has TetGen carry out requests of the library.
//
// This file is LGPL. The program made from it contains TetGen, which is AGPL-3.0-or-later, so that
// the program as a whole is AGPL-3.0-or-later.
#include <algorithm>
#include <cmath>
#include <new>
#include <span>
#include <string>
#include <vector>

#define TETLIBRARY
#include <tetgen.h>

#include <terrane/algorithms/tetgen/helper/helper.hpp>

namespace terrane::tetgen::detail {
namespace {

constexpr auto usage =
    "terrane-tetgen " TERRANE_VERSION "\n"
    "The part of Terrane that makes tetrahedra: reads a request on standard input, writes a reply\n"
    "on standard output. The library and the program terrane start it; it is of no use by hand.\n"
    "It contains TetGen and is, as a whole, under the AGPL-3.0-or-later.\n";

// ---- TetGen -----------------------------------------------------------------------------------

void set_facet(tetgenio::facet& facet, std::span<const std::uint32_t> corners) {
    facet.numberofholes = 0;
    facet.holelist = nullptr;
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::polygon& polygon = facet.polygonlist[0];
    polygon.numberofvertices = static_cast<int>(corners.size());
    polygon.vertexlist = new int[corners.size()];
    std::copy(corners.begin(), corners.end(), polygon.vertexlist);
}

/// Sets the bounds on areas: TetGen takes pairs of a facet's marker and a bound.
void set_area_bounds(const Request& request, tetgenio& io) {
    std::vector<double> list;
    for (std::size_t i = 0; i < request.area_bounds.size(); ++i)
        if (std::isfinite(request.area_bounds[i]))
            list.insert(list.end(), {static_cast<double>(i + 1), request.area_bounds[i]});
    if (list.empty()) return;
    io.numberoffacetconstraints = static_cast<int>(list.size() / 2);
    io.facetconstraintlist = new double[list.size()];
    std::copy(list.begin(), list.end(), io.facetconstraintlist);
}

/// Sets the bounds on volumes: TetGen takes a point, an attribute (not used here) and the bound.
void set_block_bounds(const Request& request, tetgenio& io) {
    if (request.blocks.empty()) return;
    io.numberofregions = static_cast<int>(request.blocks.size());
    io.regionlist = new double[5 * request.blocks.size()];
    double* next = io.regionlist;
    for (const auto& [x, y, z, max_volume] : request.blocks)
        for (const double number : {x, y, z, 0.0, max_volume}) *next++ = number;
}

void fill(const Request& request, tetgenio& io) {
    io.firstnumber = 0;
    io.numberofpoints = static_cast<int>(request.points.size());
    io.pointlist = new double[3 * request.points.size()];
    double* next = io.pointlist;
    for (const Coordinates& p : request.points) next = std::copy(p.begin(), p.end(), next);
    const std::size_t facets = request.offsets.size() - 1;
    io.numberoffacets = static_cast<int>(facets);
    io.facetlist = new tetgenio::facet[facets];
    io.facetmarkerlist = new int[facets];
    for (std::size_t i = 0; i < facets; ++i) {
        const auto first = request.offsets[i];
        set_facet(io.facetlist[i],
                  std::span(request.corners).subspan(first, request.offsets[i + 1] - first));
        io.facetmarkerlist[i] = static_cast<int>(i) + 1; // 0 means "no marker" to TetGen
    }
    set_area_bounds(request, io);
    set_block_bounds(request, io);
}

/// Chooses TetGen's switches. p: facets are given. z: count from 0. J: keep all points. M: merge
/// neither coplanar facets (each has its own marker) nor close vertices. Q: quiet. Y: split no
/// facet. O0: leave shapes alone. b0: insert points in the order of the input.
tetgenbehavior behavior_for(const Request& request) {
    const bool max_volume = request.has(max_volume_flag);
    const bool ratio = request.has(radius_edge_ratio_flag);
    tetgenbehavior behavior;
    std::string switches = "pzJMQ";
    if (request.has(keep_facets_flag)) switches += "Y";
    if (!request.has(improve_flag)) switches += "O0";
    if (!request.has(sort_points_flag)) switches += "b0";
    if (max_volume || ratio || !request.blocks.empty() || !request.area_bounds.empty())
        switches += "q";
    if (!request.blocks.empty()) switches += "Aa"; // without A 1.5.0 ignores bounds of blocks
    if (max_volume) switches += "a1";
    behavior.parse_commandline(switches.data());
    if (max_volume) behavior.maxvolume = request.header.max_volume; // text would round it
    if (ratio) behavior.minratio = request.header.radius_edge_ratio;
    return behavior;
}

bool is_complete(const tetgenio& out) {
    const auto has = [](int count, const void* list) {
        return count == 0 || (count > 0 && list != nullptr);
    };
    return has(out.numberofpoints, out.pointlist) &&
           has(out.numberoftetrahedra, out.tetrahedronlist) && out.numberofcorners == 4 &&
           has(out.numberoftrifaces, out.trifacelist) &&
           has(out.numberoftrifaces, out.trifacemarkerlist);
}

std::int32_t carry_out(Request& request, tetgenio& out) {
    try {
        if (const std::int32_t status = read_request(request); status != done) return status;
        tetgenio in;
        fill(request, in);
        tetgenbehavior behavior = behavior_for(request);
        request = {}; // TetGen needs the memory
        tetrahedralize(&behavior, &in, &out);
        return is_complete(out) ? done : unknown_exception;
    } catch (int code) { // thrown by TetGen
        return code;
    } catch (const std::bad_alloc&) {
        return tetgen_out_of_memory;
    } catch (...) {
        return unknown_exception;
    }
}

void reply(int fd, std::int32_t status, const Request&, const tetgenio& out) {
    ReplyHeader header;
    header.status = status;
    if (status != done) return write_all(fd, &header, sizeof header);
    const auto points = static_cast<std::size_t>(out.numberofpoints);
    const auto tetrahedra = static_cast<std::size_t>(out.numberoftetrahedra);
    const auto faces = static_cast<std::size_t>(out.numberoftrifaces);
    header.points = points;
    header.tetrahedra = tetrahedra;
    header.faces = faces;
    write_all(fd, &header, sizeof header);
    write_all(fd, out.pointlist, points * sizeof(Coordinates));
    write_all(fd, out.tetrahedronlist, tetrahedra * 4 * sizeof(int));
    write_all(fd, out.trifacelist, faces * 3 * sizeof(int));
    write_all(fd, out.trifacemarkerlist, faces * sizeof(int));
}

} // namespace
} // namespace terrane::tetgen::detail

int main(int argc, char** argv) {
    using namespace terrane::tetgen::detail;
    return run_helper<tetgenio>(argc, argv, usage, carry_out, reply);
}
