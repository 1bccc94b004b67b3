// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/arrangement.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/kernel/fraction.hpp>

namespace terrane {
namespace {

using Hashes = std::vector<Hash>;

Hash tagged(std::string_view tag, Hashes list, std::string_view tail = {}) {
    std::sort(list.begin(), list.end());
    Sha256 state;
    state.feed(tag);
    state.feed(list);
    state.feed(tail);
    return state.finish();
}

class Digest {
public:
    Digest(std::span<const Surface> inputs, const Arrangement& arrangement, const Run& run) :
        arrangement_(arrangement), run_(run) {
        const PointStore& points = arrangement.state->points;
        hash_points(points.size());
        hash_inputs(inputs);
    }

    std::string operator()() {
        add_vertices();
        add_parents();
        for (const auto& [low, high] : arrangement_.intersection_edges)
            records_.push_back(tagged("edge", {point(low), point(high)}));
        for (const std::uint32_t t : arrangement_.degenerate)
            records_.push_back(tagged("degenerate", {inputs_[t]}));
        add_duplicates();
        return "sha256:" + hexadecimal(tagged("terrane-digest 1\n", std::move(records_)));
    }

private:
    [[nodiscard]] const Hash& point(std::uint32_t vertex) const {
        return points_[arrangement_.vertices[vertex]];
    }

    void hash_points(std::size_t count) {
        const auto blocks =
            for_blocks<Hashes>(count, 1024, run_, [&](std::size_t first, std::size_t last) {
                Hashes block;
                for (std::size_t p = first; p < last; ++p) {
                    const auto [x, y, z] =
                        fractions(arrangement_.state->points, static_cast<PointIndex>(p), 16);
                    Sha256 state;
                    state.feed(x);
                    state.feed(" ");
                    state.feed(y);
                    state.feed(" ");
                    state.feed(z);
                    block.push_back(state.finish());
                }
                return block;
            });
        for (const Hashes& b : blocks) points_.insert(points_.end(), b.begin(), b.end());
    }

    void hash_inputs(std::span<const Surface> inputs) {
        std::size_t first = 0;
        for (const Surface& s : inputs) {
            for (const Triangle& t : s.triangles)
                inputs_.push_back(tagged(
                    "input", {points_[first + t[0]], points_[first + t[1]], points_[first + t[2]]},
                    s.name));
            first += s.vertices.size();
        }
    }

    void add_vertices() {
        std::vector<std::array<std::uint32_t, 2>> named; // {vertex, parent}
        for (std::size_t t = 0; t < arrangement_.triangles.size(); ++t)
            for (const std::uint32_t v : arrangement_.triangles[t])
                for (const std::uint32_t p : arrangement_.parents_of[t]) named.push_back({v, p});
        std::sort(named.begin(), named.end());
        named.erase(std::unique(named.begin(), named.end()), named.end());
        for (std::size_t i = 0; i < named.size();) {
            const std::uint32_t v = named[i][0];
            Hashes parents;
            for (; i < named.size() && named[i][0] == v; ++i)
                parents.push_back(inputs_[named[i][1]]);
            std::sort(parents.begin(), parents.end());
            Sha256 state;
            state.feed("vertex");
            state.feed(point(v));
            state.feed(parents);
            records_.push_back(state.finish());
        }
    }

    void add_parents() {
        std::vector<std::size_t> children(inputs_.size(), 0);
        for (const std::uint32_t p : arrangement_.parents_of.values) ++children[p];
        for (std::size_t p = 0; p < children.size(); ++p)
            if (children[p] > 0)
                records_.push_back(tagged("parent", {inputs_[p]}, std::to_string(children[p])));
    }

    void add_duplicates() {
        std::map<std::uint32_t, Hashes> same; // by the first triangle with the same points
        for (const auto& [t, first] : arrangement_.inputs.duplicates) {
            Hashes& all = same[first];
            if (all.empty()) all.push_back(inputs_[first]);
            all.push_back(inputs_[t]);
        }
        for (auto& [first, all] : same) records_.push_back(tagged("duplicates", std::move(all)));
    }

    const Arrangement& arrangement_;
    const Run& run_;
    Hashes points_;  ///< per stored point
    Hashes inputs_;  ///< per input triangle
    Hashes records_; ///< all vertices, parents, edges, degenerate and duplicates
};

} // namespace

std::string canonical_digest(std::span<const Surface> inputs, const Arrangement& arrangement,
                             const Run& run) {
    const StandardArithmetic guard;
    const Run unstoppable{.threads = run.threads}; // hashing takes only a moment
    return Digest(inputs, arrangement, unstoppable)();
}

} // namespace terrane
