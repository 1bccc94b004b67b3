// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/check_blocks.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/verify/detail/indices.hpp>

namespace terrane::verifier {

namespace {

/// Returns, per shell, the one that bounds its block from the outside, where that is another one.
Numbers bounding_shells(const Blocks& blocks) {
    Numbers around = blocks.nesting.around;
    for (std::uint32_t s = 0; s < around.size(); ++s)
        if (!blocks.nesting.outermost[s]) around[s] = no_number;
    return around;
}

std::vector<mpq_class> volumes_of(const ExactMesh& mesh, const Blocks& blocks,
                                  const Numbers& number) {
    const auto six = six_volumes(mesh, blocks);
    const std::uint32_t count = *std::max_element(number.begin(), number.end()) + 1;
    std::vector<mpq_class> volumes(count);
    const mpz_class below = 6 * mesh.scale * mesh.scale * mesh.scale;
    for (std::uint32_t b = 0; b < six.size(); ++b) {
        mpq_class volume(six[b], below);
        volume.canonicalize();
        volumes[number[b]] = volume;
    }
    return volumes;
}

std::string number_or_none(std::uint32_t number) {
    return number == no_number ? "none" : text(number);
}

bool check_lengths(const NumberedBlocks& truth, const BlocksClaim& claim, Violations& found) {
    const auto wrong = [&](const std::string& what) {
        found.push_back({Rule::R30_block_lists, {}, what});
    };
    const std::size_t shells = claim.shells.size();
    const std::size_t before = found.size();
    if (!well_formed(claim.shells, shells)) wrong("the lists of sides are unsound");
    if (claim.block_of_shell.size() != shells) wrong("there is not one block per shell");
    if (claim.around.size() != shells) wrong("there is not one place per shell");
    if (claim.names.size() != truth.volumes.size()) wrong("there is not one name per block");
    if (shells != truth.shells.size())
        found.push_back(
            {Rule::R31_shells,
             {},
             "there are " + text(truth.shells.size()) + " shells, not " + text(shells)});
    return found.size() == before;
}

void check_shells(const NumberedBlocks& truth, const BlocksClaim& claim, Violations& found) {
    for (std::uint32_t s = 0; s < truth.shells.size(); ++s) {
        if (!std::ranges::equal(claim.shells[s], truth.shells[s]))
            found.push_back(
                {Rule::R31_shells, {s}, "shell " + text(s) + " does not have these sides"});
        if (claim.around[s] != truth.around[s])
            found.push_back({Rule::R32_nesting,
                             {s},
                             "the shell around shell " + text(s) + " is " +
                                 number_or_none(truth.around[s]) + ", not " +
                                 number_or_none(claim.around[s])});
        if (claim.block_of_shell[s] != truth.block_of_shell[s])
            found.push_back({Rule::R33_block_numbers,
                             {s},
                             "shell " + text(s) + " bounds block " + text(truth.block_of_shell[s]) +
                                 ", not " + text(claim.block_of_shell[s])});
    }
}

void check_volumes(const NumberedBlocks& truth, const BlocksClaim& claim, Violations& found) {
    if (claim.volumes.size() != truth.volumes.size()) {
        found.push_back({Rule::R33_block_numbers,
                         {},
                         "there are " + text(truth.volumes.size()) +
                             " volumes with the sum of all, not " + text(claim.volumes.size())});
        return;
    }
    for (std::uint32_t b = 0; b < truth.volumes.size(); ++b)
        if (claim.volumes[b] != truth.volumes[b].get_str())
            found.push_back({Rule::R34_volumes,
                             {b},
                             b == 0 ? "the blocks together have another volume"
                                    : "block " + text(b) + " has another volume"});
}

} // namespace

NumberedBlocks number_blocks(const ExactMesh& exact, const ExactMesh& doubles) {
    const Blocks of_exact = find_blocks(exact);
    const Blocks blocks = find_blocks(doubles);
    const Numbers number = matched_numbers(exact, of_exact, doubles, blocks);
    NumberedBlocks result;
    result.exact = of_exact.count - 1;
    result.filled = blocks.count - 1;
    result.shells = blocks.shells.sides_of;
    result.around = bounding_shells(blocks);
    for (const std::uint32_t b : blocks.of_shell) result.block_of_shell.push_back(number[b]);
    for (std::uint32_t t = 0; t < doubles.triangles.size(); ++t) {
        const auto [front, back] = blocks.of_sides(t);
        result.sides.push_back({number[front], number[back]});
    }
    result.volumes = volumes_of(doubles, blocks, number);
    result.volumes.resize(std::max<std::size_t>(result.volumes.size(), of_exact.count));
    return result;
}

void check_blocks(const NumberedBlocks& truth, const BlocksClaim& claim, Violations& found) {
    if (claim.exact != truth.exact)
        found.push_back({Rule::R33_block_numbers,
                         {},
                         "the exact arrangement has " + text(truth.exact) + " blocks, not " +
                             text(claim.exact)});
    if (!check_lengths(truth, claim, found)) return;
    check_shells(truth, claim, found);
    check_volumes(truth, claim, found);
}

} // namespace terrane::verifier
