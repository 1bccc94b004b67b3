// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of the kinds "volumes" and "tetrahedra": an arrangement, the blocks of its mesh of
// doubles, and tetrahedra that fill them.
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <terrane/algorithms/verify/detail/block_outputs.hpp>
#include <terrane/algorithms/verify/detail/check_blocks.hpp>
#include <terrane/algorithms/verify/detail/cut.hpp>
#include <terrane/algorithms/verify/detail/indices.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>
#include <terrane/algorithms/verify/detail/model_claim.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra.hpp>

namespace terrane::verifier {

namespace {

// --- Reading ------------------------------------------------------------------------------------

/// Reads an index, or null as no_number.
std::uint32_t index_or_null(const Node& node) {
    if (node.is_null()) return no_number;
    const std::uint32_t number = node.index();
    if (number == no_number) node.fail("the number is too large");
    return number;
}

BlocksClaim blocks(const Node& node) {
    node.expect_keys({"exact", "shells", "block_of_shell", "around", "volumes", "names"});
    const auto text = [](const Node& item) { return std::string(item.string()); };
    return {node["exact"].index(),
            lists(node["shells"]),
            each(node["block_of_shell"], index),
            each(node["around"], index_or_null),
            each(node["volumes"], text),
            each(node["names"], text)};
}

TetrahedraClaim tetrahedra(const Node& node) {
    node.expect_keys({"box", "vertices", "tetrahedra", "blocks", "faces", "triangles", "twins"});
    return {node["box"].flag(),
            each(node["vertices"], point),
            each(node["tetrahedra"], indices<4>),
            each(node["blocks"], index),
            each(node["faces"], indices<3>),
            each(node["triangles"], index_or_null),
            each(node["twins"], indices<2>)};
}

void parse_volumes(const Node& node, Certificate& certificate) {
    parse_arrangement_sections(node, certificate);
    parse_cut_sections(node, certificate);
    auto claim = blocks(node["blocks"]);
    claim.model = model_claim(node["model"]);
    certificate.beside = std::move(claim);
}

void parse_tetrahedra(const Node& node, Certificate& certificate) {
    parse_arrangement_sections(node, certificate);
    parse_cut_sections(node, certificate);
    auto claim = blocks(node["blocks"]);
    certificate.beside = FilledBlocksClaim{std::move(claim), tetrahedra(node["tetrahedra"])};
}

// --- Judging ------------------------------------------------------------------------------------

ExactMesh mesh_of_doubles(const RoundedClaim& claim) {
    auto [points, scale] = scale_to_integers(claim.vertices);
    return make_exact_mesh(std::move(points), scale, claim.triangles);
}

/// Judges the arrangement, and the blocks if it is sound. Returns the blocks if they were found.
std::optional<NumberedBlocks> judge_blocks(std::span<const Surface> surfaces,
                                           const Certificate& certificate,
                                           const VerifyOptions& options, Verdict& verdict) {
    judge_surfaces(surfaces, certificate, options, verdict);
    if (!verdict.violations.empty()) return std::nullopt;
    if (!certificate.rounded || !certificate.rounded->clean) {
        verdict.violations.push_back(
            {Rule::R30_block_lists, {}, "blocks need a conforming mesh of doubles"});
        return std::nullopt;
    }
    auto truth = number_blocks(
        exact_mesh_of(surfaces_of_exact(surfaces, certificate), kept_part(certificate)),
        mesh_of_doubles(*certificate.rounded));
    check_blocks(truth, *certificate.blocks(), verdict.violations);
    verdict.blocks = MeasuredBlocks{truth.filled};
    return truth;
}

void judge_volumes(std::span<const Surface> surfaces, const Certificate& certificate,
                   const VerifyOptions& options, Verdict& verdict) {
    if (judge_blocks(surfaces, certificate, options, verdict) && verdict.violations.empty())
        check_folder_files(certificate, verdict.violations);
}

void judge_tetrahedra(std::span<const Surface> surfaces, const Certificate& certificate,
                      const VerifyOptions& options, Verdict& verdict) {
    const auto truth = judge_blocks(surfaces, certificate, options, verdict);
    if (!truth) return;
    const TetrahedraClaim& claim = *certificate.tetrahedra();
    const RoundedClaim& mesh = certificate.rounded.value();
    const auto [divided, difference] = check_tetrahedra(
        claim, {mesh.vertices, mesh.triangles, truth->sides, truth->volumes}, verdict.violations);
    verdict.blocks->tetrahedra = claim.tetrahedra.size();
    verdict.blocks->divided = divided;
    verdict.blocks->volume_difference = nearest_double(difference);
}

} // namespace

const Kind& volumes_kind() {
    static constexpr std::array<std::string_view, 5> keys{"exact", "rounded", "blocks", "model",
                                                          "digest"};
    static constexpr Kind kind{
        CertificateKind::volumes, "volumes", keys, parse_volumes, judge_volumes, rounded_mesh,
        compare_block_file,       true};
    return kind;
}

const Kind& tetrahedra_kind() {
    static constexpr std::array<std::string_view, 5> keys{"exact", "rounded", "blocks",
                                                          "tetrahedra", "digest"};
    static constexpr Kind kind{CertificateKind::tetrahedra,
                               "tetrahedra",
                               keys,
                               parse_tetrahedra,
                               judge_tetrahedra,
                               rounded_mesh,
                               compare_tetrahedra_file,
                               true};
    return kind;
}

} // namespace terrane::verifier
