// SPDX-License-Identifier: LGPL-3.0-or-later
//
// README.md shows the lines between the marks; a test compares them.
#include <cstdio>

#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/io/files.hpp>

namespace {

int fail(const terrane::Error& error) {
    std::fprintf(stderr, "%s\n", error.message().c_str());
    return 2;
}

int arrange_file(const char* in, const char* out) {
    // [readme]
    const auto surfaces = terrane::read_surfaces(in);
    if (!surfaces) return fail(surfaces.error());
    const auto exact = terrane::arrange(surfaces.value(), {}, {.threads = 2});
    if (!exact) return fail(exact.error());
    const auto rounded = terrane::round_to_doubles(exact.value());
    if (!rounded) return fail(rounded.error());
    if (!rounded.value().report.clean) return 1; // report.contacts names the pairs in the way
    const terrane::Mesh& mesh = rounded.value().mesh;
    std::printf("%zu triangles, %zu vertices\n", mesh.triangles.size(), mesh.vertices.size());
    const auto written = terrane::write_mesh(mesh, out);
    // [readme]
    return written ? 0 : fail(written.error());
}

} // namespace

int main(int argc, char** argv) {
    return argc == 3 ? arrange_file(argv[1], argv[2]) : 2;
}
