// SPDX-License-Identifier: LGPL-3.0-or-later
#include "floor.hpp"

#include <algorithm>
#include <array>

namespace bench {
namespace {

using namespace terrane;

struct Cells {
    std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300}, size{};
    std::array<std::size_t, 3> count{};

    explicit Cells(const std::vector<Box>& boxes) {
        for (const Box& b : boxes)
            for (unsigned k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], b.low[k]);
                high[k] = std::max(high[k], b.high[k]);
                size[k] = std::max(size[k], b.high[k] - b.low[k]);
            }
        for (unsigned k = 0; k < 3; ++k) {
            const auto most = static_cast<double>(boxes.size());
            count[k] = 1 + static_cast<std::size_t>(
                               std::min(most, size[k] > 0 ? (high[k] - low[k]) / size[k] : 0));
        }
        while (count[0] * count[1] * count[2] > 2 * boxes.size() + 8) {
            const auto k =
                static_cast<unsigned>(std::max_element(count.begin(), count.end()) - count.begin());
            count[k] = (count[k] + 1) / 2;
            size[k] *= 2;
        }
    }
    [[nodiscard]] std::size_t at(unsigned k, double x) const {
        if (!(x > low[k]) || size[k] == 0) return 0;
        return std::min(count[k] - 1, static_cast<std::size_t>((x - low[k]) / size[k]));
    }
    [[nodiscard]] std::size_t of(const Box& b) const {
        std::array<std::size_t, 3> c{};
        for (unsigned k = 0; k < 3; ++k) c[k] = at(k, (b.low[k] + b.high[k]) / 2);
        return (c[2] * count[1] + c[1]) * count[0] + c[0];
    }
};

struct Stored {
    std::vector<std::size_t> starts;
    std::vector<std::uint32_t> items;
};

Stored sort_into(const Cells& cells, const std::vector<Box>& boxes, std::size_t red) {
    Stored s;
    s.starts.assign(cells.count[0] * cells.count[1] * cells.count[2] + 2, 0);
    std::vector<std::uint32_t> cell(red);
    for (std::size_t i = 0; i < red; ++i)
        ++s.starts[(cell[i] = static_cast<std::uint32_t>(cells.of(boxes[i]))) + 2];
    for (std::size_t c = 2; c < s.starts.size(); ++c) s.starts[c] += s.starts[c - 1];
    s.items.resize(red);
    for (std::size_t i = 0; i < red; ++i)
        s.items[s.starts[cell[i] + 1]++] = static_cast<std::uint32_t>(i);
    return s;
}

std::size_t query(const Cells& cells, const Stored& s, const std::vector<Box>& boxes,
                  const Box& q) {
    std::array<std::size_t, 3> from{}, to{};
    for (unsigned k = 0; k < 3; ++k) {
        from[k] = cells.at(k, q.low[k] - cells.size[k] / 2);
        to[k] = cells.at(k, q.high[k] + cells.size[k] / 2);
    }
    std::size_t found = 0;
    for (std::size_t z = from[2]; z <= to[2]; ++z)
        for (std::size_t y = from[1]; y <= to[1]; ++y) {
            const std::size_t row = (z * cells.count[1] + y) * cells.count[0];
            for (std::size_t i = s.starts[row + from[0]]; i < s.starts[row + to[0] + 1]; ++i)
                found += boxes[s.items[i]].overlaps(q) ? 1 : 0;
        }
    return found;
}

std::vector<Box> boxes_of_all(const Model& m) {
    std::vector<Box> boxes(m.triangles.size());
    for (std::size_t t = 0; t < boxes.size(); ++t) {
        const Point3 &a = m.points[m.triangles[t][0]], &b = m.points[m.triangles[t][1]],
                     &c = m.points[m.triangles[t][2]];
        boxes[t] = {
            {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
            {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
    }
    return boxes;
}

/// Repeats the elements from the start until there are `size` of them.
template <class T>
std::vector<T> resized(const std::vector<T>& from, std::size_t size) {
    std::vector<T> to;
    to.reserve(size);
    while (to.size() < size) {
        const std::size_t count = std::min(from.size(), size - to.size());
        to.insert(to.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return to;
}

} // namespace

std::size_t floor_of_search(const Model& m) {
    const auto boxes = boxes_of_all(m);
    const std::size_t red = m.surfaces.front().triangles.size();
    const Cells cells(boxes);
    const Stored stored = sort_into(cells, boxes, red);
    std::size_t found = 0;
    for (std::size_t i = red; i < boxes.size(); ++i) found += query(cells, stored, boxes, boxes[i]);
    return found;
}

std::size_t floor_of_arrange(const Model& m, const OutputSize& output) {
    const auto boxes = boxes_of_all(m);
    const Cells cells(boxes);
    const Stored stored = sort_into(cells, boxes, boxes.size());
    const auto points = resized(m.points, output.vertices);
    const auto triangles = resized(m.triangles, output.triangles);
    std::size_t written = points.size() + triangles.size();
    std::array<std::vector<std::uint32_t>, 6> lists; // offsets and values of parents, surfaces and
                                                     // regions
    for (auto& list : lists) {
        list.resize(triangles.size());
        for (std::size_t t = 0; t < list.size(); ++t) list[t] = static_cast<std::uint32_t>(t);
        written += list.back();
    }
    return stored.items.back() + written;
}

} // namespace bench
