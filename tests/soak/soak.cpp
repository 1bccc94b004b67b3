// SPDX-License-Identifier: LGPL-3.0-or-later
//
// soak [CALLS] [SEED]: calls the stages of the library CALLS times (default 10 000) in one process, on random
// soups in which much coincides, and tells how much memory is in use. It must not grow. Half of the calls have
// one thread: what is in use after the last quarter of them must not exceed what was after the second by more
// than a KiB. The other half has two. The memory that TBB keeps for each thread then varies by some
// KiB with what the threads happen to do, so that the least of the last quarter counts, against the
// most of the second, and 64 KiB are allowed.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <stop_token>
#include <utility>
#include <vector>

#include <malloc.h>
#include <unistd.h>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace {

using terrane::Point3;
using Random = std::mt19937_64;

double pick(Random& random, double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
}

/// Returns a corner on a small lattice, which three of four soups have, or anywhere near it.
Point3 corner(Random& random, bool on_lattice) {
    const auto coordinate = [&] {
        const double x = pick(random, 0, 4);
        return on_lattice ? std::floor(x) : x;
    };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
}

/// Adds a closed one, so that there is a volume, unless its corners are in a plane.
void add_tetrahedron(Random& random, bool on_lattice, terrane::Surface& s) {
    const auto first = static_cast<std::uint32_t>(s.vertices.size());
    for (unsigned i = 0; i < 4; ++i) s.vertices.push_back(corner(random, on_lattice));
    for (const auto& [a, b, c] : {std::array{0U, 2U, 1U}, {0U, 1U, 3U}, {1U, 2U, 3U}, {2U, 0U, 3U}})
        s.triangles.push_back({first + a, first + b, first + c});
}

std::vector<terrane::Surface> soup(Random& random) {
    std::vector<terrane::Surface> surfaces(1 + random() % 3);
    const bool on_lattice = random() % 4 != 0;
    for (terrane::Surface& s : surfaces) {
        const auto count = static_cast<std::uint32_t>(1 + random() % 12);
        for (std::uint32_t t = 0; t < count; ++t) {
            for (unsigned i = 0; i < 3; ++i) s.vertices.push_back(corner(random, on_lattice));
            s.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        }
    }
    if (random() % 2 == 0) add_tetrahedron(random, on_lattice, surfaces[0]);
    return surfaces;
}

/// Results kept until the end, so that the compiler leaves no call out.
std::size_t calls_with_volumes = 0, calls_stopped = 0, errors = 0;

/// Calls the stages once; now and then they are stopped on the way, or refuse a number.
void call(Random& random, unsigned threads, bool is_cut_short) {
    std::vector<terrane::Surface> surfaces = soup(random);
    if (random() % 64 == 0) surfaces[0].vertices[0].x = std::nan("");
    terrane::Run run;
    run.threads = threads;
    std::stop_source stop;
    if (is_cut_short) {
        run.stop = stop.get_token();
        run.progress = [&](std::string_view, double) { stop.request_stop(); };
    }
    const auto exact = terrane::arrange(surfaces, {}, run);
    if (!exact) {
        ++(exact.error().code == terrane::ErrorCode::interrupted ? calls_stopped : errors);
        return;
    }
    const auto rounded = terrane::round_to_doubles(*exact, {}, run);
    if (!rounded) {
        ++(rounded.error().code == terrane::ErrorCode::interrupted ? calls_stopped : errors);
        return;
    }
    if (!rounded->conforming) return;
    const auto volumes = terrane::find_volumes(rounded->mesh, run);
    if (volumes && volumes->block_count() > 0) ++calls_with_volumes;
}

/// Returns the bytes that are allocated, and those of the process that are in memory.
std::pair<double, double> in_use() {
    malloc_trim(0);
    const auto heap = mallinfo2();
    std::ifstream file("/proc/self/statm");
    double pages = 0, resident = 0;
    file >> pages >> resident;
    return {static_cast<double>(heap.uordblks) + static_cast<double>(heap.hblkhd),
            resident * static_cast<double>(sysconf(_SC_PAGESIZE))};
}

/// Returns by how much more memory the last quarter of the calls needs than the second did.
double growth(long calls, unsigned threads, Random& random) {
    double most = 0, least = std::numeric_limits<double>::infinity();
    std::printf("%7s %10s %14s %14s\n", "threads", "calls", "allocated", "in memory");
    for (long n = 1; n <= calls; ++n) {
        call(random, threads, n % 50 == 0);
        if (n % (calls / 20) != 0) continue;
        const auto [allocated, resident] = in_use();
        if (4 * n > calls && 2 * n <= calls) most = std::max(most, allocated);
        if (4 * n > 3 * calls) least = std::min(least, allocated);
        std::printf("%7u %10ld %14.0f %14.0f\n", threads, n, allocated, resident);
        std::fflush(stdout);
    }
    return least - most;
}

} // namespace

int main(int argc, char** argv) {
    const long calls = std::max(100L, argc > 1 ? std::atol(argv[1]) : 10000L);
    Random random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    const double alone = growth(calls / 2, 1, random), together = growth(calls / 2, 2, random);
    // Each kind must have occurred, or little was tried.
    const bool tried = calls_with_volumes > 0 && calls_stopped > 0 && errors > 0;
    std::printf(
        "%.0f bytes more in the last quarter with one thread, %.0f with two; volumes in %zu "
        "calls, %zu stopped, %zu errors\n",
        alone, together, calls_with_volumes, calls_stopped, errors);
    return tried && alone < 1024 && together < 65536 ? EXIT_SUCCESS : EXIT_FAILURE;
}
