// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures the most memory that arranging and rounding hold besides their input and output, in
// bytes per input triangle. Each model has a process of its own, since a peak never falls.
//   terrane_bench_memory [--threads N] [NAME|FILE...]
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

#include "models.hpp"

namespace {

using namespace terrane;

constexpr double most_allowed = 250;

template <class T>
double bytes_of(const std::vector<T>& values) {
    return static_cast<double>(values.size() * sizeof(T));
}

template <class T>
double bytes_of(const IndexLists<T>& lists) {
    return bytes_of(lists.offsets) + bytes_of(lists.values);
}

double bytes_of(const RoundedMesh& rounded) {
    const Mesh& m = rounded.mesh;
    return bytes_of(m.vertices) + bytes_of(m.triangles) + bytes_of(m.surfaces_of) +
           bytes_of(m.regions_of) + bytes_of(m.parents_of) + bytes_of(m.intersection_edges);
}

/// Returns a size of this process that the system counts ("VmRSS", "VmHWM"), in bytes.
double size_of_process(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.compare(0, key.size() + 1, key + ':') == 0)
            return 1024 * std::strtod(line.c_str() + key.size() + 1, nullptr);
    throw std::runtime_error("/proc/self/status has no " + key);
}

void forget_peak() {
    std::ofstream clear("/proc/self/clear_refs");
    clear << "5\n" << std::flush;
    if (!clear) throw std::runtime_error("can't write /proc/self/clear_refs");
}

void measure(const std::string& name, unsigned threads) {
    keep_freed_memory();
    const bench::Model& input = bench::model(name);
    malloc_trim(0); // returns the memory that making the input has freed
    const Run run{.threads = threads};
    const double before = size_of_process("VmRSS");
    forget_peak();
    const RoundedMesh out =
        round_to_doubles(arrange(input.surfaces, {}, run).value(), {}, run).value();
    const double most = size_of_process("VmHWM") - before, result = bytes_of(out);
    const auto triangles = static_cast<double>(input.triangles.size());
    const double beside = (most - result) / triangles;
    std::printf("%-16s %9zu %9.1f %9.1f   %.0f (%g)%s\n", name.c_str(), input.triangles.size(),
                most / 1e6, result / 1e6, beside, most_allowed, beside <= most_allowed ? "" : " !");
}

/// Measures in a process of its own.
bool measured_apart(const std::string& name, unsigned threads) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("can't start a process");
    if (child == 0) {
        try {
            measure(name, threads);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "%s: %s\n", name.c_str(), e.what());
            std::_Exit(2);
        }
        std::fflush(stdout);
        std::_Exit(0);
    }
    int status = 0;
    return waitpid(child, &status, 0) == child && status == 0;
}

} // namespace

int main(int argc, char** argv) {
    unsigned threads = 1;
    std::vector<std::string> names;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--threads" && i + 1 < argc)
            threads = static_cast<unsigned>(std::atoi(argv[++i]));
        else
            names.push_back(word);
    }
    if (names.empty()) names = {"pair1_680k", "pair2_680k", "pair1_6800k", "pair2_6800k"};
    std::puts("memory: at most, output in MB; beside input and output in bytes per triangle");
    std::printf("%-16s %9s %9s %9s   %s\n", "", "triangles", "at most", "output", "beside");
    int result = 0;
    for (const std::string& name : names)
        if (!measured_apart(name, threads)) result = 2;
    return result;
}
