// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/long_edges.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>

namespace terrane::rbf::detail {
namespace {

class LongEdges {
public:
    LongEdges(RbfData& data, double limit, double near) : data_(data), limit_(limit), near_(near) {}

    /// Bisects all edges that are currently long. Returns false if there are none.
    bool halve() {
        middles_.clear();
        const std::size_t border = data_.next.size();
        for (std::uint32_t a = 0; a < border; ++a)
            if (is_long(a, data_.next[a])) add_middle(a, data_.next[a], true);
        for (const Triangle& t : data_.triangles)
            for (unsigned k = 0; k < 3; ++k)
                if (is_long(t[k], t[(k + 1) % 3])) add_middle(t[k], t[(k + 1) % 3], false);
        if (middles_.empty()) return false;
        divide_triangles();
        order_border();
        return true;
    }

private:
    [[nodiscard]] bool is_long(std::uint32_t a, std::uint32_t b) const {
        if (data_.distances[a] > near_ || data_.distances[b] > near_) return false;
        const Point3 d = minus(data_.points[a], data_.points[b]);
        return std::hypot(d.x, d.y, d.z) > limit_;
    }

    void add_middle(std::uint32_t a, std::uint32_t b, bool of_border) {
        const auto [at, added] = middles_.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(data_.points.size()));
        if (!added) return;
        const Point3 &p = data_.points[a], &q = data_.points[b];
        data_.points.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2});
        data_.distances.push_back(of_border ? 0 : (data_.distances[a] + data_.distances[b]) / 2);
    }

    [[nodiscard]] std::optional<std::uint32_t> middle(std::uint32_t a, std::uint32_t b) const {
        const auto found = middles_.find(std::minmax(a, b));
        if (found == middles_.end()) return std::nullopt;
        return found->second;
    }

    /// Cuts off a corner between two bisected edges, or bisects the triangle, until none of its
    /// edges has a midpoint. Both triangles of an edge see it bisected, so the mesh stays
    /// conforming.
    void divide_triangles() {
        std::vector<Triangle> open, done;
        open.swap(data_.triangles);
        while (!open.empty()) {
            const Triangle t = open.back();
            open.pop_back();
            std::array<std::optional<std::uint32_t>, 3> m;
            for (unsigned k = 0; k < 3; ++k) m[k] = middle(t[k], t[(k + 1) % 3]);
            const auto first = std::find_if(m.begin(), m.end(), [](auto& x) { return !!x; });
            if (first == m.end()) {
                done.push_back(t);
                continue;
            }
            const auto k = static_cast<unsigned>(first - m.begin());
            const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            open.push_back({a, *m[k], c});
            open.push_back({*m[k], b, c});
        }
        data_.triangles.swap(done);
    }

    /// Moves the points of the border to the front, in order; the others keep theirs.
    void order_border() {
        const std::size_t border = data_.next.size();
        std::vector<std::uint32_t> order, next;
        std::vector<bool> taken(data_.points.size(), false);
        for (std::uint32_t start = 0; start < border; ++start) {
            if (taken[start]) continue;
            const auto first = static_cast<std::uint32_t>(order.size());
            std::uint32_t v = start;
            do {
                order.push_back(v);
                taken[v] = true;
                if (const auto m = middle(v, data_.next[v])) {
                    order.push_back(*m);
                    taken[*m] = true;
                }
                v = data_.next[v];
            } while (v != start);
            while (next.size() < order.size()) next.push_back(std::uint32_t(next.size() + 1));
            next.back() = first;
        }
        for (std::uint32_t v = 0; v < data_.points.size(); ++v)
            if (!taken[v]) order.push_back(v);
        std::vector<std::uint32_t> name(order.size());
        RbfData sorted;
        for (const std::uint32_t v : order) {
            name[v] = static_cast<std::uint32_t>(sorted.points.size());
            sorted.points.push_back(data_.points[v]);
            sorted.distances.push_back(data_.distances[v]);
        }
        for (Triangle& t : data_.triangles) t = {name[t[0]], name[t[1]], name[t[2]]};
        data_.points.swap(sorted.points);
        data_.distances.swap(sorted.distances);
        data_.next.swap(next);
    }

    RbfData& data_;
    double limit_, near_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_; ///< per bisected
                                                                               ///< edge: its
                                                                               ///< midpoint
};

} // namespace

void divide_long_edges(RbfData& data, double limit, double near) {
    LongEdges edges(data, limit, near);
    for (unsigned k = 0; k < constants.long_edge_halvings && edges.halve(); ++k) {
    }
}

} // namespace terrane::rbf::detail
