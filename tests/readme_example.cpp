// SPDX-License-Identifier: LGPL-3.0-or-later
//
// README.md shows the lines between the marks; a test compares them.
#include <cstdio>

#include <terrane/terrane.hpp>

namespace {

int fail(const terrane::Error& error) {
    std::fprintf(stderr, "%s\n", error.message().c_str());
    return 2;
}

int arrange_file(const char* in, const char* out) {
    // [readme]
    const auto rounded =
        terrane::read_surfaces(in)
            .and_then([](auto&& surfaces) { return terrane::arrange(surfaces); })
            .and_then([](auto&& exact) { return terrane::round_to_doubles(exact); });
    if (!rounded) return fail(rounded.error());
    if (!rounded->report.clean) return 1; // report.contacts names the pairs in the way
    const terrane::Mesh& mesh = rounded->mesh;
    std::printf("%zu triangles, %zu vertices\n", mesh.triangles.size(), mesh.vertices.size());
    const auto written = terrane::write_mesh(mesh, out);
    // [readme]
    return written ? 0 : fail(written.error());
}

} // namespace

int main(int argc, char** argv) {
    return argc == 3 ? arrange_file(argv[1], argv[2]) : 2;
}
