// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/arrange_within.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {
namespace {

/// Edge of the cube that is a small volume, in median edge lengths. With a tenth, the fifteen
/// slivers (up to 170 cubic metres) of a model of southern California with triangles of a kilometre
/// are merged, and none of its blocks, the least of which has 0.06 cubic kilometres.
constexpr double small_edge = 0.1;

/// The triangles between two blocks that belong to the same surfaces.
struct SharedFace {
    double area = 0;
    std::vector<std::uint32_t> triangles{};
};

/// Which faces a block has: by neighbour, then by the surfaces.
using Faces = std::map<std::pair<std::uint32_t, std::vector<std::uint32_t>>, SharedFace>;

/// The blocks as a graph, in which small ones are merged.
class BlockGraph {
public:
    BlockGraph(const Arrangement& arrangement, const Volumes& volumes) :
        a_(arrangement), volume_(volumes.measures), boundary_area_(volumes.measures.size(), 0.0),
        faces_(volumes.measures.size()), keep_(arrangement.triangles.size(), true) {
        volume_[0] = std::numeric_limits<double>::infinity();
        for (const PointIndex v : a_.vertices) places_.push_back(a_.state->points.nearest(v));
        for (std::uint32_t t = 0; t < a_.triangles.size(); ++t)
            if (!volumes.dangles(t)) add(t, volumes.of_sides[t]);
    }

    BlockMerge merge_below(double least) {
        BlockMerge report{least, {}, 0};
        std::set<std::pair<double, std::uint32_t>> small;
        for (std::uint32_t b = 1; b < volume_.size(); ++b)
            if (volume_[b] < least) small.emplace(volume_[b], b);
        while (!small.empty()) {
            const std::uint32_t block = small.begin()->second;
            small.erase(small.begin());
            const auto face = largest_face(block);
            if (face == faces_[block].end()) {
                ++report.kept;
                continue;
            }
            const std::uint32_t into = face->first.first;
            report.merged.push_back(merged(block, *face));
            for (const std::uint32_t t : face->second.triangles) keep_[t] = false;
            small.erase({volume_[into], into});
            join(block, into);
            if (volume_[into] < least) small.emplace(volume_[into], into);
        }
        return report;
    }

    /// Per triangle: whether it was not removed.
    [[nodiscard]] const std::vector<bool>& keep() const { return keep_; }

private:
    void add(std::uint32_t t, const std::array<std::uint32_t, 2>& sides) {
        const auto of = a_.surfaces_of[t];
        const std::vector<std::uint32_t> surfaces(of.begin(), of.end());
        const auto& [a, b, c] = a_.triangles[t];
        const double area =
            length(cross(minus(places_[b], places_[a]), minus(places_[c], places_[a]))) / 2;
        for (std::size_t side = 0; side < 2; ++side) {
            boundary_area_[sides[side]] += area;
            SharedFace& face = faces_[sides[side]][{sides[1 - side], surfaces}];
            face.area += area;
            face.triangles.push_back(t);
        }
    }

    [[nodiscard]] bool is_boundary(const std::vector<std::uint32_t>& surfaces) const {
        return std::ranges::any_of(
            surfaces, [&](std::uint32_t s) { return a_.surfaces[s].role == Role::boundary; });
    }

    /// Returns the largest face of a block, the first among equals; one to the outside only if
    /// there is no other, and it is no boundary. Returns the end of its faces if there is none.
    [[nodiscard]] Faces::const_iterator largest_face(std::uint32_t block) const {
        const Faces& faces = faces_[block];
        auto best = faces.end();
        for (auto face = faces.begin(); face != faces.end(); ++face) {
            const auto& [other, surfaces] = face->first;
            if (other == 0 && is_boundary(surfaces)) continue;
            const bool is_first = best == faces.end();
            if (is_first || (best->first.first == 0 && other != 0) ||
                ((other != 0 || best->first.first == 0) && face->second.area > best->second.area))
                best = face;
        }
        return best;
    }

    [[nodiscard]] MergedBlock merged(std::uint32_t block, const Faces::value_type& entry) const {
        const auto& [key, face] = entry;
        const auto& [a, b, c] = a_.triangles[face.triangles.front()];
        const auto mean = [](double x, double y, double z) { return x / 3 + y / 3 + z / 3; };
        return {volume_[block],
                2 * volume_[block] / boundary_area_[block],
                volume_[key.first],
                face.area,
                face.triangles.size(),
                key.second,
                {mean(places_[a].x, places_[b].x, places_[c].x),
                 mean(places_[a].y, places_[b].y, places_[c].y),
                 mean(places_[a].z, places_[b].z, places_[c].z)}};
    }

    /// Makes a block part of its neighbour: their other common faces dangle from now on, and what
    /// the block shares with others, the neighbour shares.
    void join(std::uint32_t block, std::uint32_t into) {
        volume_[into] += volume_[block];
        for (auto& [key, face] : faces_[block]) {
            const auto& [other, surfaces] = key;
            faces_[other].erase({block, surfaces});
            boundary_area_[into] += other == into ? -face.area : face.area;
            if (other == into) continue;
            for (const auto& [from, to] : {std::pair(into, other), std::pair(other, into)}) {
                SharedFace& joint = faces_[from][{to, surfaces}];
                joint.area += face.area;
                joint.triangles.insert(joint.triangles.end(), face.triangles.begin(),
                                       face.triangles.end());
            }
        }
        faces_[block].clear();
    }

    const Arrangement& a_;
    std::vector<double> volume_; ///< per block, with those that became part of it
    std::vector<double> boundary_area_;
    std::vector<Faces> faces_;   ///< per block
    std::vector<bool> keep_;     ///< per triangle
    std::vector<Point3> places_; ///< per vertex
};

/// Returns a function that repeats the removal of triangles for an arrangement whose vertices have
/// moved a little: first what `before` removes, then the interfaces of small blocks.
std::function<Result<Arrangement>(Arrangement, const Run&)>
merged_again(std::function<Result<Arrangement>(Arrangement, const Run&)> before, double least) {
    return
        [before = std::move(before), least](Arrangement a, const Run& run) -> Result<Arrangement> {
            if (before) {
                auto restricted_before = before(std::move(a), run);
                if (!restricted_before) return restricted_before;
                a = std::move(*restricted_before);
            }
            auto without = merge_small_blocks(std::move(a), least, run);
            if (!without) return without.error();
            return std::move(without->arrangement);
        };
}

Result<WithoutSmallBlocks> without_blocks_below(Arrangement a, double least, const Run& run) {
    const auto volumes = find_volumes(a, run);
    if (!volumes) return volumes.error();
    BlockGraph graph(a, *volumes);
    WithoutSmallBlocks result;
    result.report = graph.merge_below(least);
    const bool is_repeatable = a.state->whole || a.state->restrict_again;
    auto before = a.state->restrict_again;
    result.arrangement = restricted(std::move(a), graph.keep());
    if (is_repeatable && !result.arrangement.state->whole) {
        ExactState& state = own_state(result.arrangement);
        state.restrict_again = merged_again(std::move(before), least);
        state.measures = true;
    }
    return result;
}

} // namespace

Result<WithoutSmallBlocks> merge_small_blocks(Arrangement arrangement, double least,
                                              const Run& run) {
    return guarded("for merging blocks", "small blocks", [&]() -> Result<WithoutSmallBlocks> {
        if (!(least > 0) || !std::isfinite(least))
            return Error{ErrorCode::bad_option, "the least volume must be positive", "min_volume"};
        const StageTimer timer(run, "small blocks");
        return without_blocks_below(std::move(arrangement), least, timer.inside());
    });
}

double median_edge_length(std::span<const Surface> surfaces) {
    const StandardArithmetic guard;
    std::vector<double> lengths;
    for (const Surface& s : surfaces)
        for (const Triangle& t : s.triangles)
            for (std::size_t k = 0; k < 3; ++k)
                lengths.push_back(length(minus(s.vertices[t[k]], s.vertices[t[(k + 1) % 3]])));
    if (lengths.empty()) return 0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

double small_volume_for(std::span<const Surface> surfaces) {
    const StandardArithmetic guard;
    const double edge = small_edge * median_edge_length(surfaces);
    return edge * edge * edge;
}

std::vector<NamedConstant> small_block_constants() {
    return {{"small_edge", small_edge}};
}

} // namespace terrane
