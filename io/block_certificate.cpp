// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/block_certificate.hpp>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/volumes/shells.hpp>
#include <terrane/io/detail/certificate_writer.hpp>

namespace terrane {

using namespace detail;

namespace {

void write_numbers_or_null(CertificateWriter& out, const std::vector<std::uint32_t>& numbers) {
    out.array(numbers, [&](std::uint32_t n) {
        if (n == no_index)
            out.raw("null");
        else
            out.number(n);
    });
}

void write_blocks(CertificateWriter& out, const Mesh& mesh, const CertifiedBlocks& blocks) {
    const Model& model = blocks.model;
    const Shells shells = find_shells(mesh, model.volumes);
    out.raw(",\n\"blocks\":{\"exact\":");
    out.number(model.block_count());
    out.raw(",\n\"shells\":");
    out.lists(shells.sides);
    out.raw(",\n\"block_of_shell\":");
    out.numbers(shells.volume);
    out.raw(",\n\"around\":");
    write_numbers_or_null(out, shells.around);
    out.raw(",\n\"volumes\":");
    ExactVolumes exact = exact_volumes(mesh, model.volumes);
    exact.measures[0] = std::move(exact.total); // the format begins with the sum of all blocks
    out.array(
        exact.measures, [&](const std::string& volume) { out.quote(volume); }, ",\n");
    out.raw(",\n\"names\":");
    out.array(
        model.structure.blocks, [&](const ModelBlock& block) { out.quote(block.name); }, ",\n");
    out.raw("}");
}

void write_tetrahedra(CertificateWriter& out, const TetrahedralMesh& tetrahedra) {
    const auto& triangles = tetrahedra.face_triangle;
    const bool box = std::find(triangles.begin(), triangles.end(), no_index) != triangles.end();
    out.raw(",\n\"tetrahedra\":{\"box\":");
    out.raw(box ? "true" : "false");
    out.raw(",\n\"vertices\":");
    write_points(out, tetrahedra.vertices);
    out.raw(",\n\"tetrahedra\":");
    out.arrays(tetrahedra.tetrahedra);
    out.raw(",\n\"blocks\":");
    out.numbers(tetrahedra.block_of);
    out.raw(",\n\"faces\":");
    out.arrays(tetrahedra.faces);
    out.raw(",\n\"triangles\":");
    write_numbers_or_null(out, triangles);
    out.raw(",\n\"twins\":");
    out.arrays(tetrahedra.twins);
    out.raw("}");
}

std::string text_of(std::string_view kind, const Certified& certified,
                    const CertifiedBlocks& blocks, const TetrahedralMesh* tetrahedra,
                    const Run& run) {
    std::string text;
    CertificateWriter out(text);
    write_head(out, kind, certified);
    write_blocks(out, certified.rounded->mesh, blocks);
    if (tetrahedra != nullptr)
        write_tetrahedra(out, *tetrahedra);
    else
        out.raw(",\n\"model\":" + stated_json(blocks.model.structure, blocks.extras));
    write_arrangement(out, certified, run);
    out.raw("}\n");
    return text;
}

} // namespace

std::string to_certificate(const Certified& certified, const CertifiedBlocks& blocks,
                           const Run& run) {
    const StandardArithmetic guard;
    return text_of("volumes", certified, blocks, nullptr, run);
}

std::string to_certificate(const Certified& certified, const CertifiedBlocks& blocks,
                           const TetrahedralMesh& tetrahedra, const Run& run) {
    const StandardArithmetic guard;
    return text_of("tetrahedra", certified, blocks, &tetrahedra, run);
}

} // namespace terrane
