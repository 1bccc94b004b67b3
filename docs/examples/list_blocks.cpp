// SPDX-License-Identifier: LGPL-3.0-or-later
//
// list_blocks IN...: cuts the surfaces by a box and lists the blocks in it, with exact volumes.
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volume_of_interest/boundary_surfaces.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/io/files.hpp>

namespace {

int fail(const terrane::Error& error) {
    std::fprintf(stderr, "%s\n", error.message().c_str());
    return 2;
}

} // namespace

int main(int argc, char** argv) {
    std::vector<terrane::Surface> surfaces;
    for (int i = 1; i < argc; ++i) {
        const auto read = terrane::read_surfaces(argv[i]);
        if (!read) return fail(read.error());
        surfaces.insert(surfaces.end(), read->begin(), read->end());
    }
    // The faces of the box are surfaces like others; `boundary` holds their numbers.
    const auto box = terrane::box_boundary({0, 0, -1700}, {2000, 1500, -700});
    if (!box) return fail(box.error());
    std::vector<std::uint32_t> boundary;
    for (const terrane::Surface& face : *box) {
        boundary.push_back(static_cast<std::uint32_t>(surfaces.size()));
        surfaces.push_back(face);
    }

    auto exact = terrane::arrange(surfaces);
    if (!exact) return fail(exact.error());
    const auto inside = terrane::cut_to_volume(*std::move(exact), boundary);
    if (!inside) return fail(inside.error());
    const auto rounded = terrane::round_to_doubles(inside->arrangement);
    if (!rounded) return fail(rounded.error());
    if (!rounded->report.clean) return 1;

    const auto volumes = terrane::find_volumes(rounded->mesh);
    if (!volumes) return fail(volumes.error());
    const terrane::Structure model = build_structure(rounded->mesh, *volumes);
    for (std::size_t b = 1; b < model.blocks.size(); ++b) // 0 is the outside
        std::printf("block %zu, %s: volume %.6g, %zu neighbours\n", b, model.blocks[b].name.c_str(),
                    model.blocks[b].volume, model.blocks[b].neighbours.size());
    return 0;
}
