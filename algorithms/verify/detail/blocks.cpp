// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/blocks.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>

namespace terrane::verifier {

namespace {

// --- Numbers ----------------------------------------------------------------------------------

/// Returns the rank of each point in the lexicographic order.
Numbers ranks_of_points(const ExactMesh& mesh) {
    std::vector<Box> boxes;
    boxes.reserve(mesh.points.size());
    for (const Vector4& p : mesh.points) boxes.push_back(enclose(p, mesh.scale));
    Numbers order(mesh.points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Vector4 &p = mesh.points[a], &q = mesh.points[b];
        for (std::size_t i = 0; i < 3; ++i) {
            if (boxes[a].high[i] < boxes[b].low[i]) return true;
            if (boxes[b].high[i] < boxes[a].low[i]) return false;
            if (const int c = cmp(mpz_class(p[i] * q[3]), mpz_class(q[i] * p[3])); c != 0)
                return c < 0;
        }
        return false;
    });
    Numbers rank(order.size());
    for (std::uint32_t r = 0; r < order.size(); ++r) rank[order[r]] = r;
    return rank;
}

/// The points that decide the order of blocks.
struct BlockKey {
    Numbers vertices;                                       ///< ranks, ascending
    SortedCorners least{{no_number, no_number, no_number}}; ///< ranks of a side, as seen from it

    friend auto operator<=>(const BlockKey&, const BlockKey&) = default;
};

/// Returns the key of each block, by the shell that represents it.
std::map<std::uint32_t, BlockKey> keys_of(const ExactMesh& mesh, const Shells& shells,
                                          JoinedSets& joined) {
    const Numbers rank = ranks_of_points(mesh);
    const auto shell_count = static_cast<std::uint32_t>(shells.sides_of.size());
    std::map<std::uint32_t, BlockKey> keys;
    for (std::uint32_t shell = 0; shell < shell_count; ++shell) {
        if (joined.find(shell) == joined.find(shell_count)) continue;
        BlockKey& key = keys[joined.find(shell)];
        for (const std::uint32_t side : shells.sides_of[shell]) {
            const auto& [a, b, c] = mesh.triangles[side / 2];
            key.vertices.insert(key.vertices.end(), {rank[a], rank[b], rank[c]});
            SortedCorners corners = sorted_corners({rank[a], rank[b], rank[c]});
            if (side % 2 == 1) corners.even = !corners.even;
            key.least = std::min(key.least, corners);
        }
    }
    for (auto& [shell, key] : keys) {
        make_set(key.vertices);
    }
    return keys;
}

// --- Matches ----------------------------------------------------------------------------------

/// Returns the point with the nearest doubles, so that 0 and -0 are the same.
Point3 nearest(const Vector4& point, const mpz_class& scale) {
    const auto coordinate = [&](std::size_t i) {
        mpq_class exact(point[i], mpz_class(point[3] * scale));
        exact.canonicalize();
        return nearest_double(exact) + 0.0;
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
}

/// Returns, per vertex of the exact mesh, the vertex of the rounded one at its nearest doubles.
Numbers vertices_in(const ExactMesh& exact, const ExactMesh& rounded) {
    std::map<Point3, std::uint32_t> at;
    for (std::uint32_t v = 0; v < rounded.points.size(); ++v)
        at.emplace(nearest(rounded.points[v], rounded.scale), v);
    Numbers found;
    for (const Vector4& p : exact.points) {
        const auto place = at.find(nearest(p, exact.scale));
        found.push_back(place == at.end() ? no_number : place->second);
    }
    return found;
}

/// Returns the numbers of common sides of {block of the rounded mesh, block of the exact one}.
std::map<Edge, std::size_t> common_sides(const ExactMesh& exact, const Blocks& of_exact,
                                         const ExactMesh& rounded, const Blocks& of_rounded) {
    std::map<Triangle, std::uint32_t> triangle_with;
    for (std::uint32_t t = 0; t < rounded.triangles.size(); ++t)
        triangle_with.emplace(with_least_first(rounded.triangles[t]), t);
    const Numbers vertex = vertices_in(exact, rounded);
    std::map<Edge, std::size_t> sides;
    for (std::uint32_t t = 0; t < exact.triangles.size(); ++t) {
        const auto& [i, j, k] = exact.triangles[t];
        const auto there = of_exact.of_sides(t);
        for (const bool same : {true, false}) {
            const Triangle corners{vertex[i], vertex[same ? j : k], vertex[same ? k : j]};
            const auto found = triangle_with.find(with_least_first(corners));
            if (found == triangle_with.end()) continue;
            const auto here = of_rounded.of_sides(found->second);
            ++sides[{here[0], there[same ? 0 : 1]}];
            ++sides[{here[1], there[same ? 1 : 0]}];
        }
    }
    return sides;
}

} // namespace

Blocks find_blocks(const ExactMesh& mesh) {
    Blocks blocks{find_shells(mesh), {}, {}, 1};
    blocks.nesting = find_nesting(mesh, blocks.shells);
    const auto outside = static_cast<std::uint32_t>(blocks.shells.sides_of.size());
    JoinedSets joined(outside + std::size_t(1));
    for (std::uint32_t s = 0; s < outside; ++s)
        if (blocks.nesting.outermost[s])
            joined.join(s,
                        blocks.nesting.around[s] == no_number ? outside : blocks.nesting.around[s]);
    std::vector<std::pair<BlockKey, std::uint32_t>> order;
    for (auto& [shell, key] : keys_of(mesh, blocks.shells, joined))
        order.emplace_back(std::move(key), shell);
    std::sort(order.begin(), order.end());
    std::map<std::uint32_t, std::uint32_t> number_of{{joined.find(outside), 0}};
    for (const auto& [key, shell] : order) number_of[shell] = blocks.count++;
    for (std::uint32_t s = 0; s < outside; ++s)
        blocks.of_shell.push_back(number_of.at(joined.find(s)));
    return blocks;
}

Numbers matched_numbers(const ExactMesh& exact, const Blocks& of_exact, const ExactMesh& rounded,
                        const Blocks& of_rounded) {
    using Match = std::tuple<std::size_t, Edge>; // common sides; {rounded, exact}
    std::vector<Match> matches;
    for (const auto& [pair, sides] : common_sides(exact, of_exact, rounded, of_rounded))
        if (pair[0] != 0 && pair[1] != 0) matches.emplace_back(sides, pair);
    std::stable_sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
        return std::get<0>(a) > std::get<0>(b); // equals stay in the order of their blocks
    });
    Numbers number(of_rounded.count, no_number);
    std::vector<bool> taken(of_exact.count);
    number[0] = 0;
    for (const auto& [sides, pair] : matches) {
        if (number[pair[0]] != no_number || taken[pair[1]]) continue;
        number[pair[0]] = pair[1];
        taken[pair[1]] = true;
    }
    std::uint32_t next = of_exact.count;
    for (std::uint32_t& n : number)
        if (n == no_number) n = next++;
    return number;
}

std::vector<mpz_class> six_volumes(const ExactMesh& mesh, const Blocks& blocks) {
    std::vector<mpz_class> sums(blocks.count);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [front, back] = blocks.of_sides(t);
        if (front == back) continue;
        const auto& [i, j, k] = mesh.triangles[t];
        const mpz_class part = determinant(mesh.points[i], mesh.points[j], mesh.points[k]);
        sums[back] += part;
        sums[front] -= part;
    }
    sums[0] = -sums[0]; // what is around the blocks lacks them
    return sums;
}

double nearest_double(const mpq_class& number) {
    constexpr double largest = std::numeric_limits<double>::max();
    const mpq_class size = abs(number);
    const double sign = sgn(number) < 0 ? -1 : 1;
    if (size > largest) {
        // From half a step above the largest double on, infinity is nearer.
        const mpq_class half_step =
            (mpq_class(largest) - mpq_class(std::nextafter(largest, 0.0))) / 2;
        return sign * (size < largest + half_step ? largest : infinity);
    }
    const double low = size.get_d(); // truncated
    const double high = std::nextafter(low, infinity);
    if (high == infinity) return sign * low;
    const mpq_class below = size - low, above = mpq_class(high) - size;
    if (below != above) return sign * (below < above ? low : high);
    return sign * (std::bit_cast<std::uint64_t>(low) % 2 == 0 ? low : high);
}

} // namespace terrane::verifier
