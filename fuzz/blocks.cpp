// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: an arrangement in blocks of space is that of one process: the same digest, doubles, triangles,
// parents and regions. Where blocks find no conforming mesh, one process finds none either. Volumes in
// blocks, and their names, are those of the joined mesh.
#include "property.hpp"
#include "shapes.hpp"

#include "support/differences.hpp"
#include "support/pieces_joined.hpp"

#include <terrane/algorithms/arrangement/digest.hpp>
#include <terrane/algorithms/distribution/local_supersteps.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/structure/names_in_blocks.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/algorithms/volumes/volumes_in_blocks.hpp>

namespace terrane::fuzz {

namespace {

using namespace distribution;

/// What one process finds.
struct Whole {
    const Arrangement& exact;
    std::string digest;
    Result<RoundedMesh> rounded;

    [[nodiscard]] bool is_clean() const { return rounded && rounded->report.clean; }
};

std::string volumes_flaw(Supersteps& blocks, const DistributedReport& report) {
    const auto measures = find_volumes_in_blocks(blocks);
    if (!measures) return "volumes in blocks: " + measures.error().message();
    const auto names = name_volumes_in_blocks(blocks);
    if (!names) return "names in blocks: " + names.error().message();
    const auto mesh = test_support::pieces_joined(blocks, report);
    if (!mesh) return mesh.error().message();
    const auto expected = find_volumes(*mesh);
    if (!expected) return "volumes: " + expected.error().message();
    if (*measures != expected->measures) return "blocks find other volumes";
    const auto sides_agree = blocks.visit([&](Block& b) -> Status {
        const BlockPiece piece = piece_of(b);
        for (std::size_t t = 0; t < piece.triangle_ids.size(); ++t)
            if (piece.volumes_of_sides[t] != expected->of_sides[piece.triangle_ids[t]])
                return Error{};
        return Done{};
    });
    if (!sides_agree) return "blocks find other volumes beside a triangle";
    const Structure structure = build_structure(*mesh, *expected);
    if (!std::ranges::equal(*names, structure.blocks, {}, {}, &ModelBlock::name))
        return "blocks name the volumes otherwise";
    return "";
}

std::string flaw_of_blocks(std::span<const Surface> surfaces, const Whole& whole,
                           Supersteps& blocks) {
    const std::vector<Surface> files(surfaces.begin(), surfaces.end());
    const auto report =
        arrange_in_blocks(blocks, test_support::reader_of(files), {files.size(), true});
    if (!report) return report.error().message();
    if (report->digest != whole.digest) return "another digest";
    if (report->clean != whole.is_clean())
        return report->clean ? "one process finds no conforming mesh"
                             : "blocks find no conforming mesh";
    if (!report->clean) return "";
    const RoundedMesh& rounded = *whole.rounded;
    const auto mesh = test_support::pieces_joined(blocks, *report);
    if (!mesh) return mesh.error().message();
    if (const auto what = test_support::difference(*mesh, rounded.mesh); !what.empty())
        return "another mesh: " + what;
    if (report->regions != rounded.regions.size()) return "another number of regions";
    if (report->intersection_edges != rounded.mesh->intersection_edges.size())
        return "another number of intersection edges";
    return volumes_flaw(blocks, *report);
}

} // namespace

std::vector<Surface> input(Bytes& bytes) {
    return soup(bytes, 24);
}

std::string flaw(std::span<const Surface> surfaces) {
    constexpr std::size_t most_triangles = 300; // what is larger takes seconds to round
    const auto exact = arrange(surfaces);
    if (!exact) return exact.error().message();
    if (exact->triangles.size() > most_triangles) return "";
    const Whole whole{*exact, canonical_digest(surfaces, *exact), round_to_doubles(*exact)};
    const Run run;
    for (const std::size_t count : {2, 5}) {
        LocalSupersteps blocks({count, {}}, run);
        if (const auto what = flaw_of_blocks(surfaces, whole, blocks); !what.empty())
            return what + ", in " + std::to_string(count) + " blocks";
    }
    return "";
}

} // namespace terrane::fuzz
