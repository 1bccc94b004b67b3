// SPDX-License-Identifier: LGPL-3.0-or-later
//
// fill_box OUT IN...: arranges surfaces and fills a box round them with tetrahedra.
#include <cstdio>
#include <string>
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
    const auto exact = terrane::arrange(surfaces);
    if (!exact) return fail(exact.error());
    const auto rounded = terrane::round_to_doubles(*exact);
    if (!rounded) return fail(rounded.error());
    if (!rounded->report.clean) return 1;
    const terrane::Mesh& mesh = rounded->mesh;

    const auto volumes = terrane::find_volumes(mesh);
    if (!volumes) return fail(volumes.error());
    const terrane::TetrahedraOptions options{
        .margin = 0.2, .time_limit = 60, .helper = TERRANE_TETGEN_HELPER};
    const auto tetrahedra = terrane::tetrahedralize(mesh, options, {});
    if (!tetrahedra) return fail(tetrahedra.error());
    const auto report = terrane::check_tetrahedra(*tetrahedra, mesh, *volumes);
    for (const terrane::TetrahedraViolation& violation : report.violations)
        std::fprintf(stderr, "%s\n", terrane::message(violation).c_str());
    if (!report.violations.empty()) return 1;

    const auto written = terrane::write_tetrahedra(*tetrahedra, argv[1]);
    if (!written) return fail(written.error());
    std::printf("%zu tetrahedra in %u blocks with the outside\n", tetrahedra->tetrahedra.size(),
                tetrahedra->block_count);
    return 0;
}
