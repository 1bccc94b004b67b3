// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/detail/matching.hpp>

#include <cmath>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>

namespace terrane::judging {

double difference(const Point3& p, const Point3& q) {
    return std::max({std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)});
}

OutputMesh::OutputMesh(Soup merged, double bound) : soup(std::move(merged)) {
    const auto used = used_vertices(soup.points.size(), soup.triangles);
    for (std::uint32_t v = 0; v < used.size(); ++v)
        if (used[v]) vertices.push_back(v);
    soup.edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
        if (sides.size() == 1) borders.push_back({low, high});
    });
    if (bound > 0) join_near(bound);
}

void OutputMesh::join_near(double bound) {
    const PointGrid grid(soup.points, vertices, bound);
    DisjointSets sets(soup.points.size());
    bool any = false;
    for (const std::uint32_t v : vertices)
        grid.for_near(soup.points[v], [&](std::uint32_t w) {
            any = any || v != w;
            sets.join(v, w);
        });
    if (!any) return;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        Triangle k = soup.triangles[t];
        for (std::uint32_t& v : k) v = sets.find(v);
        if (k[0] == k[1] || k[1] == k[2] || k[2] == k[0]) continue;
        soup.triangles[kept] = k;
        soup.input_of[kept++] = soup.input_of[t];
    }
    soup.triangles.resize(kept);
    soup.input_of.resize(kept);
    soup.edges = group_edges(soup.triangles, soup.points.size());
    for (Edge& e : borders) {
        for (std::uint32_t& v : e) v = sets.find(v);
        if (e[0] > e[1]) std::swap(e[0], e[1]);
    }
    std::erase_if(borders, [](const Edge& e) { return e[0] == e[1]; });
    std::erase_if(vertices, [&](std::uint32_t v) { return sets.find(v) != v; });
}

std::size_t OutputMesh::triangles_at(std::uint32_t u, std::uint32_t w) const {
    const auto [low, high] = std::minmax(u, w);
    const auto sides =
        std::span(soup.edges.sides)
            .subspan(soup.edges.starts[low], soup.edges.starts[low + 1] - soup.edges.starts[low]);
    const auto first = std::ranges::lower_bound(sides, high, {}, &EdgeSides::Side::high);
    const auto last = std::ranges::upper_bound(sides, high, {}, &EdgeSides::Side::high);
    return static_cast<std::size_t>(last - first);
}

PointGrid::PointGrid(std::span<const Point3> points, std::span<const std::uint32_t> members,
                     double reach) :
    points_(points),
    reach_(reach), size_(4 * reach) {
    entries_.reserve(members.size());
    for (const std::uint32_t v : members) entries_.push_back({hash(key(points[v])), v});
    std::ranges::sort(entries_, [](const Entry& a, const Entry& b) {
        return std::pair(a.hash, a.point) < std::pair(b.hash, b.point);
    });
}

PointGrid::Key PointGrid::key(const Point3& p) const {
    constexpr double most = 0x1p62; // what is farther away shares the outermost cells
    const auto number = [&](double x) {
        return static_cast<std::int64_t>(std::clamp(std::floor(x / size_), -most, most));
    };
    return {number(p.x), number(p.y), number(p.z)};
}

std::uint64_t PointGrid::hash(const Key& key) {
    std::uint64_t h = 0;
    for (const std::int64_t k : key) {
        h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15U;
        h ^= h >> 29U;
    }
    return h;
}

bool PointGrid::is_near(const Point3& p, const Point3& q) const {
    return difference(p, q) <= reach_;
}

namespace {

class Matcher {
public:
    Matcher(const Target& target, const Cells& cells, const OutputMesh& output, double bound) :
        target_(target), cells_(cells), output_(output),
        grid_(output.soup.points, output.vertices, bound) {
        matching_.image.assign(target.exact.vertices.size(), no_index);
    }

    Matching operator()() {
        std::vector<std::uint32_t> vertices;
        for (const Triangle& t : target_.triangles)
            vertices.insert(vertices.end(), t.begin(), t.end());
        sort_unique(vertices);
        for (const std::uint32_t x : vertices) match(x);
        settle();
        note_moves(vertices);
        return std::move(matching_);
    }

private:
    [[nodiscard]] const Point3& nearest(std::uint32_t x) const {
        return target_.exact.nearest(VertexId(x));
    }

    void match(std::uint32_t x) {
        std::vector<std::uint32_t> near;
        grid_.for_near(nearest(x), [&](std::uint32_t v) { near.push_back(v); });
        if (near.empty()) return;
        const auto& points = output_.soup.points;
        matching_.image[x] = *std::ranges::min_element(near, {}, [&](std::uint32_t v) {
            return std::pair(difference(points[v], nearest(x)), v);
        });
        if (near.size() == 1) return;
        doubtful_.push_back(x);
        candidates_.push_back(near);
    }

    /// Chooses among several candidates by the edges that the choice makes edges of the mesh.
    void settle() {
        if (doubtful_.empty()) return;
        std::vector<std::array<std::uint32_t, 2>> ends; // {doubtful point, neighbour}
        for (const auto& [low, high] : cells_.edges)
            for (const auto& [x, y] : {Edge{low, high}, Edge{high, low}})
                if (std::ranges::binary_search(doubtful_, x)) ends.push_back({x, y});
        sort_unique(ends);
        constexpr int rounds = 3; // chains of neighbours in doubt longer than that are not known
        for (int round = 0; round < rounds; ++round)
            for (std::size_t i = 0; i < doubtful_.size(); ++i) choose(i, ends);
    }

    void choose(std::size_t i, const std::vector<std::array<std::uint32_t, 2>>& ends) {
        const std::uint32_t x = doubtful_[i];
        const auto point_of = [](const std::array<std::uint32_t, 2>& end) { return end[0]; };
        const auto first = std::ranges::lower_bound(ends, x, {}, point_of);
        const auto last = std::ranges::upper_bound(ends, x, {}, point_of);
        const auto edges_of = [&](std::uint32_t v) {
            return std::count_if(first, last, [&](const std::array<std::uint32_t, 2>& end) {
                const std::uint32_t w = matching_.image[end[1]];
                return w != no_index && w != v && output_.has_edge(v, w);
            });
        };
        auto& image = matching_.image[x];
        auto best = edges_of(image);
        for (const std::uint32_t v : candidates_[i])
            if (const auto edges = edges_of(v); edges > best) {
                best = edges;
                image = v;
            }
    }

    void note_moves(const std::vector<std::uint32_t>& vertices) {
        std::vector<std::uint32_t> images, exact;
        for (const std::uint32_t x : vertices) {
            const std::uint32_t v = matching_.image[x];
            if (v == no_index) continue;
            images.push_back(v);
            exact.push_back(x);
            const double move = difference(nearest(x), output_.soup.points[v]);
            if (move <= matching_.largest_move) continue;
            matching_.largest_move = move;
            matching_.largest_place = output_.soup.points[v];
        }
        matching_.preimages = lists_by_key<std::uint32_t>(output_.soup.points.size(), images,
                                                          [&](std::size_t i) { return exact[i]; });
    }

    const Target& target_;
    const Cells& cells_;
    const OutputMesh& output_;
    PointGrid grid_;
    std::vector<std::uint32_t> doubtful_; ///< exact points with several candidates; ascending
    std::vector<std::vector<std::uint32_t>> candidates_; ///< of these
    Matching matching_;
};

} // namespace

Matching match_vertices(const Target& target, const Cells& cells, const OutputMesh& output,
                        double bound) {
    return Matcher(target, cells, output, bound)();
}

} // namespace terrane::judging
