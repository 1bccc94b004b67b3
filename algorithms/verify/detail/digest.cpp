// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/digest.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/rational.hpp>
#include <terrane/algorithms/verify/detail/sha256.hpp>
#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

namespace {

std::string number(const mpz_class& numerator, const mpz_class& denominator) {
    const mpz_class factor = gcd(numerator, denominator);
    const mpz_class below = denominator / factor;
    std::string text = mpz_class(numerator / factor).get_str(16);
    if (below != 1) text += "/" + below.get_str(16);
    return text;
}

Digest hash_of_point(const Vector4& point, const mpz_class& scale) {
    const mpz_class denominator = point[3] * scale;
    return hash_of(number(point[0], denominator) + " " + number(point[1], denominator) + " " +
                   number(point[2], denominator));
}

template <std::size_t n>
void feed_sorted(Hasher& state, std::array<Digest, n> hashes) {
    std::sort(hashes.begin(), hashes.end());
    state.add(hashes);
}

/// The hashes of the inputs of a claim.
struct HashedInputs {
    std::vector<Vector4> points;
    mpz_class scale = 1;
    std::vector<Digest> triangles;
};

HashedInputs hash_inputs(std::span<const Surface> surfaces) {
    std::vector<Point3> all;
    for (const Surface& s : surfaces) all.insert(all.end(), s.vertices.begin(), s.vertices.end());
    HashedInputs inputs;
    auto scaled = scale_to_integers(all);
    inputs.points = std::move(scaled.points);
    inputs.scale = std::move(scaled.scale);
    std::size_t offset = 0;
    for (const Surface& s : surfaces) {
        std::vector<Digest> hashes;
        for (std::size_t v = 0; v < s.vertices.size(); ++v)
            hashes.push_back(hash_of_point(inputs.points[offset + v], inputs.scale));
        offset += s.vertices.size();
        for (const Triangle& t : s.triangles) {
            Hasher state;
            state.add("input");
            feed_sorted(state, std::array{hashes[t[0]], hashes[t[1]], hashes[t[2]]});
            state.add(s.name);
            inputs.triangles.push_back(state.take());
        }
    }
    return inputs;
}

std::optional<std::vector<Digest>> hash_vertices(const HashedInputs& inputs,
                                                 const ArrangementClaim& claim) {
    std::vector<Digest> hashes;
    for (const Construction& how : claim.vertices) {
        const auto point = construct(how, inputs.points);
        if (!point) return std::nullopt;
        hashes.push_back(hash_of_point(*point, inputs.scale));
    }
    return hashes;
}

/// Hashes each vertex together with the parents of the triangles at it.
std::vector<Digest> hash_corners(const ArrangementClaim& claim, const HashedInputs& inputs,
                                 const std::vector<Digest>& vertices) {
    std::vector<std::set<std::uint32_t>> parents_at(vertices.size());
    for (std::size_t t = 0; t < claim.triangles.size(); ++t) {
        look_for_stop();
        for (const std::uint32_t v : claim.triangles[t])
            parents_at[v].insert(claim.parents_of[t].begin(), claim.parents_of[t].end());
    }
    std::vector<Digest> hashes;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        if (parents_at[v].empty()) continue;
        std::multiset<Digest> sorted;
        for (const std::uint32_t parent : parents_at[v]) sorted.insert(inputs.triangles[parent]);
        Hasher state;
        state.add("vertex");
        state.add(vertices[v]);
        for (const Digest& parent : sorted) state.add(parent);
        hashes.push_back(state.take());
    }
    return hashes;
}

/// Hashes each parent together with the number of its triangles.
std::vector<Digest> hash_parents(const ArrangementClaim& claim, const HashedInputs& inputs) {
    std::map<std::uint32_t, std::size_t> children;
    for (const std::uint32_t parent : claim.parents_of.values) ++children[parent];
    std::vector<Digest> hashes;
    for (const auto& [parent, count] : children) {
        Hasher state;
        state.add("parent");
        state.add(inputs.triangles[parent]);
        state.add(std::to_string(count));
        hashes.push_back(state.take());
    }
    return hashes;
}

std::vector<Digest> hash_duplicates(const ArrangementClaim& claim, const HashedInputs& inputs) {
    std::map<std::uint32_t, std::multiset<Digest>> classes;
    for (const auto& [triangle, first] : claim.duplicates)
        classes[first].insert(inputs.triangles[triangle]);
    std::vector<Digest> hashes;
    for (auto& [first, members] : classes) {
        members.insert(inputs.triangles[first]);
        Hasher state;
        state.add("duplicates");
        for (const Digest& member : members) state.add(member);
        hashes.push_back(state.take());
    }
    return hashes;
}

} // namespace

std::optional<std::string> digest_of(std::span<const Surface> surfaces,
                                     const ArrangementClaim& claim) {
    const HashedInputs inputs = hash_inputs(surfaces);
    const auto vertices = hash_vertices(inputs, claim);
    if (!vertices) return std::nullopt;
    std::vector<Digest> all = hash_duplicates(claim, inputs);
    const auto corners = hash_corners(claim, inputs, *vertices);
    const auto parents = hash_parents(claim, inputs);
    all.insert(all.end(), corners.begin(), corners.end());
    all.insert(all.end(), parents.begin(), parents.end());
    Hasher state;
    for (const Edge& edge : claim.intersection_edges) {
        state.add("edge");
        feed_sorted(state, std::array{(*vertices)[edge[0]], (*vertices)[edge[1]]});
        all.push_back(state.take());
    }
    for (const std::uint32_t triangle : claim.degenerate) {
        state.add("degenerate");
        state.add(inputs.triangles[triangle]);
        all.push_back(state.take());
    }
    std::sort(all.begin(), all.end());
    state.add("terrane-digest 1\n");
    state.add(all);
    return "sha256:" + in_hexadecimal(state.take());
}

} // namespace terrane::verifier
