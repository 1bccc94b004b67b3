// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Functions that the helper programs share. Each program reads one request (see protocol.hpp) from
// standard input, has a mesher carry it out, and writes one reply to standard output. The library
// starts it as a process of its own, so that the mesher's asserts, crashes and prints cost the
// caller nothing, and so that it can be killed.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <terrane/algorithms/tetgen/detail/protocol.hpp>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TERRANE_HELPER_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TERRANE_HELPER_SANITIZED 1
#endif
#endif

namespace terrane::tetgen::detail {

// ---- Input and output -------------------------------------------------------------------------

/// Fills the memory from standard input; returns false if that ends too early.
inline bool read_all(void* data, std::size_t size) {
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

inline void write_all(int fd, const void* data, std::size_t size) {
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

/// A request of the library; see protocol.hpp.
struct Request {
    RequestHeader header;
    std::vector<Coordinates> points;
    std::vector<std::uint32_t> offsets, corners;
    std::vector<double> area_bounds;
    std::vector<BlockRecord> blocks;
    std::vector<SidesRecord> sides;

    [[nodiscard]] bool has(RequestFlag flag) const { return (header.flags & flag) != 0; }
};

inline bool is_sound(const RequestHeader& header) {
    const auto is_bound = [](double x) { return std::isfinite(x) && x >= 0; };
    return (header.flags & ~all_flags) == 0 && header.points <= most_items &&
           header.facets <= most_items && header.corners <= 4 * most_items &&
           header.blocks <= most_items && (header.sides == 0 || header.sides == header.facets) &&
           (header.area_bounds == 0 || header.area_bounds == header.facets) &&
           ((header.flags & max_volume_flag) == 0 || is_bound(header.max_volume)) &&
           ((header.flags & radius_edge_ratio_flag) == 0 || is_bound(header.radius_edge_ratio));
}

/// Tells whether each facet has at least three points, all of which exist, and all numbers are
/// valid.
inline bool is_sound(const Request& request) {
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
           std::all_of(request.blocks.begin(), request.blocks.end(), finite);
}

inline std::int32_t read_request(Request& request) {
    RequestHeader& header = request.header;
    if (!read_all(&header, sizeof header) || header.mark != request_mark) return bad_request;
    if (header.version != protocol_version) return other_version;
    const bool read = is_sound(header) && read_array(request.points, header.points) &&
                      read_array(request.offsets, header.facets + 1) &&
                      read_array(request.corners, header.corners) &&
                      read_array(request.area_bounds, header.area_bounds) &&
                      read_array(request.blocks, header.blocks) &&
                      read_array(request.sides, header.sides);
    return read && is_sound(request) ? done : bad_request;
}

// ---- The process ------------------------------------------------------------------------------

/// Makes this process end with the caller: by a signal from now on, or at once if the caller has
/// ended.
inline void end_with_caller() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    pollfd output{STDOUT_FILENO, 0, 0};
    if (poll(&output, 1, 0) > 0 && (output.revents & (POLLHUP | POLLERR)) != 0) _exit(EXIT_FAILURE);
}

/// Lets a crash end this process by its signal, even under a sanitizer, and without a core file;
/// and makes it the first process to be killed when the machine runs out of memory.
inline void be_expendable() {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    for (const int fatal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(fatal, SIG_DFL);
    const int score = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (score >= 0) [[maybe_unused]]
        const auto written = write(score, "1000", 4);
}

inline void lower_limit(int resource, rlim_t wanted) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0) return;
    limit.rlim_cur = std::min(limit.rlim_cur, wanted);
    limit.rlim_max = std::min(limit.rlim_max, wanted);
    setrlimit(resource, &limit);
}

/// Takes from this process what no mesher needs, so that neither a flaw of the mesher nor an input
/// made for one reaches far: it writes no file, gains no rights, and gets no more memory than the
/// machine has, so that a size that is too small for the model ends in "out of memory".
inline void be_confined() {
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    lower_limit(RLIMIT_FSIZE, 0);
    std::signal(SIGXFSZ, SIG_IGN); // Gmsh's user interface tries to keep preferences
#ifndef TERRANE_HELPER_SANITIZED   // sanitizers reserve terabytes
    struct sysinfo machine {};
    if (sysinfo(&machine) == 0)
        lower_limit(RLIMIT_AS, (rlim_t{machine.totalram} + machine.totalswap) * machine.mem_unit);
#endif
}

/// Returns a descriptor for the reply, and discards all that the mesher prints.
inline int silence() {
    const int output = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (output < 0 || null < 0 || dup2(null, STDOUT_FILENO) < 0 || dup2(null, STDERR_FILENO) < 0)
        _exit(EXIT_FAILURE);
    return output;
}

/// Answers a program that is called with arguments: says what it is. Returns the exit status.
inline int explain(int argc, char** argv, const char* usage) {
    const bool asked = argc == 2 && (std::string_view(argv[1]) == "--version" ||
                                     std::string_view(argv[1]) == "--help");
    std::fputs(usage, asked ? stdout : stderr);
    return asked ? EXIT_SUCCESS : EXIT_FAILURE;
}

/// Runs a helper program: `carry_out` turns a request into a Made, `reply` writes that to a
/// descriptor. Without arguments it ends without destructors of the mesher's data.
template <class Made, class CarryOut, class Reply>
int run_helper(int argc, char** argv, const char* usage, CarryOut carry_out, Reply reply) {
    if (argc != 1) return explain(argc, argv, usage);
    end_with_caller();
    be_expendable();
    be_confined();
    const int output = silence();
    Request request;
    Made made;
    const std::int32_t status = carry_out(request, made);
    reply(output, status, request, made);
    _exit(EXIT_SUCCESS);
}

} // namespace terrane::tetgen::detail
