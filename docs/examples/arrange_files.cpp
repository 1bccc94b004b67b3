// SPDX-License-Identifier: LGPL-3.0-or-later
//
// arrange_files OUT IN...: arranges the surfaces of all files and writes one conforming mesh.
#include <cstdio>
#include <vector>

#include <terrane/advanced.hpp>

namespace {

int fail(const terrane::Error& error) {
    std::fprintf(stderr, "%s\n", error.message().c_str());
    return 2;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    std::vector<terrane::Surface> surfaces;
    for (int i = 2; i < argc; ++i) {
        const auto read = terrane::read_surfaces(argv[i]);
        if (!read) return fail(read.error());
        surfaces.insert(surfaces.end(), read->begin(), read->end());
    }

    const terrane::Run run{.threads = 2}; // the result does not depend on it
    const auto exact = terrane::arrange(surfaces, {}, run);
    if (!exact) return fail(exact.error());
    const auto rounded = terrane::round_to_doubles(*exact, {}, run);
    if (!rounded) return fail(rounded.error());
    if (!rounded->report.clean) {
        for (const terrane::ImproperContact& c : rounded->report.contacts)
            std::fprintf(stderr, "triangles %u and %u cross near (%g, %g, %g)\n", c.triangles[0],
                         c.triangles[1], c.place.x, c.place.y, c.place.z);
        return 1;
    }

    const terrane::Mesh& mesh = rounded->mesh;
    const auto written = terrane::write_mesh(mesh, argv[1]);
    if (!written) return fail(written.error());
    std::printf("%zu triangles, moved by %.3g at most\n", mesh.triangles.size(),
                rounded->report.max_move);
    for (const terrane::Region& r : rounded->regions)
        std::printf("region of %s: %zu triangles, area %.4g\n", surfaces[r.surface].name.c_str(),
                    r.triangles, r.area);
    return 0;
}
