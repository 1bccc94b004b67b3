// SPDX-License-Identifier: LGPL-3.0-or-later
//
// This file is LGPL, but calls TetGen, which is AGPL: what is linked from both is AGPL as a whole.
#include <terrane/algorithms/tetgen/detail/process.hpp>

#include <algorithm>
#include <cerrno>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#define TETLIBRARY
#include <tetgen.h>

// Of the runtime of AddressSanitizer; null in a program without it.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): their names
namespace __lsan {
void LockAllocator() __attribute__((weak));
void UnlockAllocator() __attribute__((weak));
} // namespace __lsan
namespace __sanitizer {
void StackDepotLockAll() __attribute__((weak));
void StackDepotUnlockAll() __attribute__((weak));
} // namespace __sanitizer
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace terrane {
namespace {

static_assert(sizeof(Point3) == 3 * sizeof(double) && std::is_trivially_copyable_v<Point3>);
static_assert(sizeof(int) == sizeof(std::uint32_t));

/// First bytes of the child's message; the arrays follow if status is 0.
struct Header {
    int status = 0; ///< 0, or the code that TetGen threw
    int points = 0;
    int tetrahedra = 0;
    int faces = 0;
};

// Codes of our own, beside those of TetGen (1 memory, 2 internal, 3 self-intersection, 4 feature
// too small, 5 facets too close, 10 input).
constexpr int unknown_exception = 100;

constexpr int poll_milliseconds = 50; // how soon a stop request is seen

// ---- In the child -----------------------------------------------------------------------------

void write_all(int fd, const void* data, std::size_t size) {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = write(fd, bytes, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) _exit(1); // the parent is gone
        bytes += written;
        size -= static_cast<std::size_t>(written);
    }
}

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

/// Pairs of marker and area.
void set_area_bounds(tetgenio& io, const TetgenInput& input) {
    std::vector<double> list;
    for (std::size_t i = 0; i < input.max_areas.size(); ++i)
        if (std::isfinite(input.max_areas[i]))
            list.insert(list.end(), {static_cast<double>(i + 1), input.max_areas[i]});
    if (list.empty()) return;
    io.numberoffacetconstraints = static_cast<int>(list.size() / 2);
    io.facetconstraintlist = new double[list.size()];
    std::copy(list.begin(), list.end(), io.facetconstraintlist);
}

/// Five numbers each: a point, an attribute (of no use here), the volume.
void set_region_bounds(tetgenio& io, const TetgenInput& input) {
    if (input.regions.empty()) return;
    io.numberofregions = static_cast<int>(input.regions.size());
    io.regionlist = new double[5 * input.regions.size()];
    double* next = io.regionlist;
    for (const auto& [place, max_volume] : input.regions)
        for (const double number : {place.x, place.y, place.z, 0.0, max_volume}) *next++ = number;
}

void fill(tetgenio& io, const TetgenInput& input) {
    io.firstnumber = 0;
    io.numberofpoints = static_cast<int>(input.points.size());
    io.pointlist = new double[3 * input.points.size()];
    double* next = io.pointlist;
    for (const Point3& p : input.points) {
        *next++ = p.x;
        *next++ = p.y;
        *next++ = p.z;
    }
    const std::size_t facets = input.facets.size();
    io.numberoffacets = static_cast<int>(facets);
    io.facetlist = new tetgenio::facet[facets];
    io.facetmarkerlist = new int[facets];
    for (std::size_t i = 0; i < facets; ++i) {
        set_facet(io.facetlist[i], input.facets[i]);
        io.facetmarkerlist[i] = static_cast<int>(i) + 1; // 0 means "no marker" to TetGen
    }
    set_area_bounds(io, input);
    set_region_bounds(io, input);
}

/// p: facets are given. z: count from 0. J: keep all points. M: merge neither coplanar facets (each
/// has its own marker) nor close vertices. Q: quiet. Y: split no facet.
/// O0: leave shapes as they are. b0: insert points as they come.
tetgenbehavior behavior_for(const TetgenInput& input) {
    const bool refine = input.max_volume || !input.regions.empty() || !input.max_areas.empty() ||
                        input.radius_edge_ratio;
    tetgenbehavior behavior;
    std::string switches = "pzJMQ";
    if (input.keep_facets) switches += "Y";
    if (!input.improve) switches += "O0";
    if (!input.sort_points) switches += "b0";
    if (refine) switches += "q";
    if (!input.regions.empty()) switches += "Aa"; // without A 1.5.0 ignores the bounds of regions
    if (input.max_volume) switches += "a1";
    behavior.parse_commandline(switches.data());
    if (input.max_volume) behavior.maxvolume = *input.max_volume; // exact, not through text
    if (input.radius_edge_ratio) behavior.minratio = *input.radius_edge_ratio;
    return behavior;
}

/// Silent, without a core file, first to go when memory runs out, and gone when the parent is.
void become_child(pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    for (const int fatal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTERM})
        std::signal(fatal, SIG_DFL);
    std::signal(SIGINT, SIG_IGN); // the parent decides
    const int score = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (score >= 0) write_all(score, "1000", 4);
    const int null = open("/dev/null", O_WRONLY);
    if (null < 0 || dup2(null, STDOUT_FILENO) < 0 || dup2(null, STDERR_FILENO) < 0) _exit(1);
    std::fesetround(FE_TONEAREST);
    std::srand(1);
}

int call_tetgen(const TetgenInput& input, tetgenio& out) {
    try {
        tetgenio in;
        fill(in, input);
        tetgenbehavior behavior = behavior_for(input);
        tetrahedralize(&behavior, &in, &out);
        return 0;
    } catch (int code) {
        return code;
    } catch (const std::bad_alloc&) {
        return 1;
    } catch (...) {
        return unknown_exception;
    }
}

[[noreturn]] void child(const TetgenInput& input, int fd) {
    tetgenio out;
    Header header;
    header.status = call_tetgen(input, out);
    if (header.status != 0) {
        write_all(fd, &header, sizeof header);
        _exit(0);
    }
    header.points = out.numberofpoints;
    header.tetrahedra = out.numberoftetrahedra;
    header.faces = out.numberoftrifaces;
    const auto size = [](int count, std::size_t each) {
        return static_cast<std::size_t>(count) * each;
    };
    write_all(fd, &header, sizeof header);
    write_all(fd, out.pointlist, size(out.numberofpoints, sizeof(Point3)));
    write_all(fd, out.tetrahedronlist, size(out.numberoftetrahedra, 4 * sizeof(int)));
    write_all(fd, out.trifacelist, size(out.numberoftrifaces, 3 * sizeof(int)));
    write_all(fd, out.trifacemarkerlist, size(out.numberoftrifaces, sizeof(int)));
    _exit(0);
}

// ---- In the parent ----------------------------------------------------------------------------

/// A child may allocate, whatever other threads were at when it was forked: glibc holds the locks
/// of its allocator meanwhile, but AddressSanitizer's allocator (LLVM 14) leaves that to us.
class AllocatorLocks {
public:
    AllocatorLocks() {
        if (__lsan::LockAllocator != nullptr) __lsan::LockAllocator();
        if (__sanitizer::StackDepotLockAll != nullptr) __sanitizer::StackDepotLockAll();
    }
    ~AllocatorLocks() {
        if (__sanitizer::StackDepotUnlockAll != nullptr) __sanitizer::StackDepotUnlockAll();
        if (__lsan::UnlockAllocator != nullptr) __lsan::UnlockAllocator();
    }
    AllocatorLocks(const AllocatorLocks&) = delete;
    AllocatorLocks& operator=(const AllocatorLocks&) = delete;
};

/// fork(), with the locks released in both processes.
pid_t fork_soundly() {
    const AllocatorLocks locks;
    return fork();
}

Error from_tetgen(int code) {
    switch (code) {
    case 1:
        return {ErrorCode::out_of_memory, "TetGen ran out of memory", ""};
    case 3:
    case 4:
    case 5: // what is given to TetGen does not cross: this is its tolerance
        return {ErrorCode::unsupported, "the surfaces come too close to each other for TetGen", ""};
    case 10:
        return {ErrorCode::internal, "TetGen did not accept its input", ""};
    default:
        return {ErrorCode::internal, fmt::format("TetGen failed with code {}", code), ""};
    }
}

/// The running child and the end of the pipe that its message comes from.
class ChildProcess {
public:
    explicit ChildProcess(const TetgenInput& input) : time_limit_(input.time_limit) {
        // A child that another thread forks now would keep our pipe open, and hide a crash.
        static std::mutex mutex;
        const std::lock_guard lock(mutex);
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) return;
        const pid_t parent = getpid();
        pid_ = fork_soundly();
        if (pid_ == 0) {
            close(ends[0]);
            become_child(parent);
            child(input, ends[1]);
        }
        close(ends[1]);
        fd_ = ends[0];
    }
    ~ChildProcess() {
        if (fd_ >= 0) close(fd_);
        if (pid_ <= 0) return;
        kill(pid_, SIGKILL);
        wait();
    }
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    [[nodiscard]] bool started() const { return pid_ > 0; }

    /// Fills the memory from the pipe.
    Status read_all(void* data, std::size_t size, const std::stop_token& stop) {
        char* bytes = static_cast<char*>(data);
        while (size > 0) {
            if (stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped while TetGen ran", ""};
            if (seconds_since_start() > time_limit_)
                return Error{ErrorCode::timed_out,
                             fmt::format("TetGen took longer than {} seconds", time_limit_), ""};
            pollfd waiting{fd_, POLLIN, 0};
            if (poll(&waiting, 1, poll_milliseconds) <= 0) continue;
            const ssize_t got = read(fd_, bytes, size);
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) return why_it_ended();
            bytes += got;
            size -= static_cast<std::size_t>(got);
        }
        return Done{};
    }

private:
    int wait() {
        int status = 0;
        while (waitpid(pid_, &status, 0) < 0)
            if (errno != EINTR) return 0; // the program ignores SIGCHLD: nothing left to wait for
        pid_ = -1;
        return status;
    }

    Error why_it_ended() {
        const int status = wait();
        const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        if (signal == SIGKILL)
            return {ErrorCode::out_of_memory, "TetGen was killed, most likely for want of memory",
                    ""};
        return {ErrorCode::internal,
                signal != 0 ? fmt::format("TetGen crashed (signal {})", signal) : "TetGen gave up",
                ""};
    }

    [[nodiscard]] double seconds_since_start() const {
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_;
        return taken.count();
    }

    pid_t pid_ = -1;
    int fd_ = -1;
    double time_limit_; ///< seconds
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

template <class T>
Status read_array(ChildProcess& process, int length, std::vector<T>& array,
                  const std::stop_token& stop) {
    if (length < 0) return Error{ErrorCode::internal, "TetGen returned a negative length", ""};
    array.resize(static_cast<std::size_t>(length));
    return process.read_all(array.data(), array.size() * sizeof(T), stop);
}

} // namespace

Result<TetgenOutput> run_tetgen(const TetgenInput& input, const std::stop_token& stop) {
    constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max()) / 4;
    if (input.points.size() > most || input.facets.size() > most)
        return Error{ErrorCode::unsupported, "too many triangles for TetGen", ""};
    ChildProcess process(input);
    if (!process.started())
        return Error{ErrorCode::out_of_memory, "no process could be started for TetGen", ""};

    Header header;
    if (Status read = process.read_all(&header, sizeof header, stop); !read) return read.error();
    if (header.status != 0) return from_tetgen(header.status);
    TetgenOutput out;
    Status read = read_array(process, header.points, out.points, stop);
    if (read) read = read_array(process, header.tetrahedra, out.tetrahedra, stop);
    if (read) read = read_array(process, header.faces, out.faces, stop);
    if (read) read = read_array(process, header.faces, out.face_facet, stop);
    if (!read) return read.error();
    for (std::uint32_t& facet : out.face_facet) --facet; // markers count from 1
    return out;
}

} // namespace terrane
