// SPDX-License-Identifier: LGPL-3.0-or-later
//
// terrane-tetgen reads one request (see protocol.hpp) from standard input, has TetGen carry it out
// and writes one reply to standard output. The library starts it as a process of its own, so that
// TetGen's asserts, crashes and prints cost the caller nothing, and so that it can be killed.
//
// This file is LGPL. The program made from it contains TetGen, which is AGPL-3.0-or-later, so that
// the program as a whole is AGPL-3.0-or-later.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#define TETLIBRARY
#include <tetgen.h>

#include <terrane/algorithms/tetgen/detail/protocol.hpp>

namespace terrane::tetgen::detail {
namespace {

constexpr auto usage =
    "terrane-tetgen " TERRANE_VERSION "\n"
    "The part of Terrane that makes tetrahedra: reads a request on standard input, writes a reply\n"
    "on standard output. The library and the program terrane start it; it is of no use by hand.\n"
    "It contains TetGen and is, as a whole, under the AGPL-3.0-or-later.\n";

// ---- Input and output -------------------------------------------------------------------------

/// Fills the memory from standard input; returns false if that ends too early.
bool read_all(void* data, std::size_t size) {
    char* bytes = static_cast<char*>(data);
    while (size > 0) {
        const ssize_t got = read(STDIN_FILENO, bytes, size);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        bytes += got;
        size -= static_cast<std::size_t>(got);
    }
    return true;
}

template <class T>
bool read_array(std::vector<T>& array, std::uint64_t length) {
    array.resize(length);
    return read_all(array.data(), array.size() * sizeof(T));
}

void write_all(int fd, const void* data, std::size_t size) {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = write(fd, bytes, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) _exit(EXIT_FAILURE); // the caller is gone
        bytes += written;
        size -= static_cast<std::size_t>(written);
    }
}

// ---- The request ------------------------------------------------------------------------------

struct Request {
    RequestHeader header;
    std::vector<Coordinates> points;
    std::vector<std::uint32_t> offsets, corners;
    std::vector<double> area_bounds;
    std::vector<RegionRecord> regions;

    [[nodiscard]] bool has(RequestFlag flag) const { return (header.flags & flag) != 0; }
};

bool is_sound(const RequestHeader& header) {
    const auto is_bound = [](double x) { return std::isfinite(x) && x >= 0; };
    return (header.flags & ~all_flags) == 0 && header.points <= most_items &&
           header.facets <= most_items && header.corners <= 4 * most_items &&
           header.regions <= most_items &&
           (header.area_bounds == 0 || header.area_bounds == header.facets) &&
           ((header.flags & max_volume_flag) == 0 || is_bound(header.max_volume)) &&
           ((header.flags & radius_edge_ratio_flag) == 0 || is_bound(header.radius_edge_ratio));
}

/// Tells whether each facet has at least three points, all of which exist, and all numbers are
/// valid.
bool is_sound(const Request& request) {
    const auto finite = [](const auto& numbers) {
        return std::all_of(numbers.begin(), numbers.end(),
                           [](double x) { return std::isfinite(x); });
    };
    const auto& offsets = request.offsets;
    bool sound = offsets.front() == 0 && offsets.back() == request.corners.size();
    for (std::size_t i = 0; sound && i + 1 < offsets.size(); ++i)
        sound = offsets[i] <= offsets[i + 1] && offsets[i + 1] - offsets[i] >= 3;
    return sound &&
           std::all_of(request.corners.begin(), request.corners.end(),
                       [&](std::uint32_t corner) { return corner < request.points.size(); }) &&
           std::all_of(request.points.begin(), request.points.end(), finite) &&
           std::all_of(request.area_bounds.begin(), request.area_bounds.end(),
                       [](double area) { return area >= 0; }) && // infinity: no bound
           std::all_of(request.regions.begin(), request.regions.end(), finite);
}

std::int32_t read_request(Request& request) {
    RequestHeader& header = request.header;
    if (!read_all(&header, sizeof header) || header.mark != request_mark) return bad_request;
    if (header.version != protocol_version) return other_version;
    const bool read = is_sound(header) && read_array(request.points, header.points) &&
                      read_array(request.offsets, header.facets + 1) &&
                      read_array(request.corners, header.corners) &&
                      read_array(request.area_bounds, header.area_bounds) &&
                      read_array(request.regions, header.regions);
    return read && is_sound(request) ? done : bad_request;
}

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
void set_region_bounds(const Request& request, tetgenio& io) {
    if (request.regions.empty()) return;
    io.numberofregions = static_cast<int>(request.regions.size());
    io.regionlist = new double[5 * request.regions.size()];
    double* next = io.regionlist;
    for (const auto& [x, y, z, max_volume] : request.regions)
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
    set_region_bounds(request, io);
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
    if (max_volume || ratio || !request.regions.empty() || !request.area_bounds.empty())
        switches += "q";
    if (!request.regions.empty()) switches += "Aa"; // without A 1.5.0 ignores bounds of regions
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

void reply(int fd, std::int32_t status, const tetgenio& out) {
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

// ---- The process ------------------------------------------------------------------------------

/// Makes this process end with the caller: by a signal from now on, or at once if the caller has
/// ended.
void end_with_caller() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    pollfd output{STDOUT_FILENO, 0, 0};
    if (poll(&output, 1, 0) > 0 && (output.revents & (POLLHUP | POLLERR)) != 0) _exit(EXIT_FAILURE);
}

/// Lets a crash end this process by its signal, even under a sanitizer, and without a core file;
/// and makes it the first process to be killed when the machine runs out of memory.
void be_expendable() {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    for (const int fatal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(fatal, SIG_DFL);
    const int score = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (score >= 0) [[maybe_unused]]
        const auto written = write(score, "1000", 4);
}

/// Returns a descriptor for the reply, and discards all that TetGen prints.
int silence() {
    const int output = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (output < 0 || null < 0 || dup2(null, STDOUT_FILENO) < 0 || dup2(null, STDERR_FILENO) < 0)
        _exit(EXIT_FAILURE);
    return output;
}

} // namespace
} // namespace terrane::tetgen::detail

int main(int argc, char** argv) {
    using namespace terrane::tetgen::detail;
    if (argc != 1) {
        const bool asked =
            std::string_view(argv[1]) == "--version" || std::string_view(argv[1]) == "--help";
        std::fputs(usage, asked ? stdout : stderr);
        return asked ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    end_with_caller();
    be_expendable();
    const int output = silence();
    Request request;
    tetgenio out;
    const std::int32_t status = carry_out(request, out);
    reply(output, status, out);
    _exit(EXIT_SUCCESS); // skips the destructors of TetGen's data
}
