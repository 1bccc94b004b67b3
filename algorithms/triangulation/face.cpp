// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/triangulation/face.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/triangulation/planar.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

class Face {
public:
    Face(std::span<const Point3> points, std::span<const std::uint32_t> corners) :
        points_(points), corners_(corners) {
        std::array<double, 3> size{};
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
            const Point3 n = cross(minus(at(i), at(0)), minus(at(i + 1), at(0)));
            normal_ = {normal_.x + n.x, normal_.y + n.y, normal_.z + n.z};
            size[0] += std::fabs(n.x); // where the normals of a bow tie cancel, too
            size[1] += std::fabs(n.y);
            size[2] += std::fabs(n.z);
        }
        axis_ = static_cast<Axis>(std::ranges::max_element(size) - size.begin());
    }

    /// Tells whether no triangle round the first corner has area, seen along the axis.
    [[nodiscard]] bool has_no_area() const {
        for (std::size_t i = 1; i + 1 < corners_.size(); ++i)
            if (turn(0, i, i + 1) != Sign::Zero) return false;
        return true;
    }

    /// Tells whether the triangles round the first corner face one side, and go round it no further
    /// than once: the direction to no corner comes back to that of the second one.
    [[nodiscard]] bool is_fan() const {
        bool beyond = false;
        const Sign side = turn(0, 1, 2);
        for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
            if (side == Sign::Zero || turn(0, i, i + 1) != side) return false;
            const bool left = turn(0, 1, i + 1) == side;
            if (beyond && left) return false;
            beyond = !left;
        }
        return true;
    }

    /// Returns the triangles of a face that is no fan; nothing if it crosses itself.
    [[nodiscard]] std::optional<std::vector<Triangle>> triangles() const {
        std::map<Point3, std::uint32_t> number_of;
        std::vector<std::uint32_t> first, numbers; // a corner per point, the points of the corners
        for (const std::uint32_t corner : corners_) {
            const auto next = static_cast<std::uint32_t>(first.size());
            const auto [number, added] = number_of.try_emplace(points_[corner], next);
            if (added) first.push_back(corner);
            numbers.push_back(number->second);
        }
        const std::vector<Polygon> loops = loops_of(numbers, first.size());
        std::vector<Point3> flat;
        for (const std::uint32_t corner : first) flat.push_back(seen(points_[corner]));
        auto inside = triangulate_inside(flat, loops);
        if (!inside || inside->empty()) return std::nullopt;
        const bool turned = is_clockwise(flat, loops);
        for (Triangle& t : *inside) {
            for (std::uint32_t& v : t) v = first[v];
            if (turned) std::swap(t[1], t[2]);
        }
        return *std::move(inside);
    }

    [[nodiscard]] bool is_bent() const {
        if (corners_.size() < 5) return false;
        constexpr double share = 0.01;
        double size = 0, off = 0;
        const double norm = length(normal_);
        for (std::size_t i = 1; i < corners_.size(); ++i) {
            const Point3 d = minus(at(i), at(0));
            size = std::max(size, length(d));
            off = std::max(off, std::fabs(dot(d, normal_)) / norm);
        }
        return off > share * size;
    }

private:
    [[nodiscard]] const Point3& at(std::size_t corner) const { return points_[corners_[corner]]; }
    [[nodiscard]] Sign turn(std::size_t a, std::size_t b, std::size_t c) const {
        return orient2d(axis_, at(a), at(b), at(c));
    }

    /// Returns the point seen along the axis, as one that is seen along z.
    [[nodiscard]] Point3 seen(const Point3& p) const {
        if (axis_ == Axis::x) return {p.y, p.z, 0};
        return axis_ == Axis::y ? Point3{p.z, p.x, 0} : Point3{p.x, p.y, 0};
    }

    /// Returns the border without the ways that it runs both forwards and back.
    static std::vector<Polygon> loops_of(const std::vector<std::uint32_t>& numbers,
                                         std::size_t count) {
        std::map<std::array<std::uint32_t, 2>, std::size_t> times; // that it runs along an edge
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const std::uint32_t from = numbers[i], to = numbers[(i + 1) % numbers.size()];
            const auto back = times.find({to, from});
            if (from == to) continue;
            if (back == times.end())
                ++times[{from, to}];
            else if (--back->second == 0)
                times.erase(back);
        }
        std::vector<std::vector<std::uint32_t>> next(count);
        for (const auto& [edge, n] : times) next[edge[0]].insert(next[edge[0]].end(), n, edge[1]);
        std::vector<Polygon> loops;
        for (std::uint32_t start = 0; start < count; ++start)
            while (!next[start].empty()) {
                Polygon& loop = loops.emplace_back();
                for (std::uint32_t v = start; loop.empty() || v != start;) {
                    loop.push_back(v);
                    const std::uint32_t to = next[v].back();
                    next[v].pop_back();
                    v = to;
                }
            }
        return loops;
    }

    /// Tells whether a border that does not cross itself turns right at its least point.
    static bool is_clockwise(std::span<const Point3> flat, std::span<const Polygon> loops) {
        const Polygon* least = nullptr;
        std::size_t place = 0;
        for (const Polygon& loop : loops)
            for (std::size_t i = 0; i < loop.size(); ++i)
                if (least == nullptr || flat[loop[i]] < flat[(*least)[place]]) {
                    least = &loop;
                    place = i;
                }
        const std::size_t n = least->size();
        return orient2d(Axis::z, flat[(*least)[(place + n - 1) % n]], flat[(*least)[place]],
                        flat[(*least)[(place + 1) % n]]) == Sign::Negative;
    }

    std::span<const Point3> points_;
    std::span<const std::uint32_t> corners_;
    Point3 normal_{0, 0, 0}; ///< its length is twice the area
    Axis axis_{};
};

} // namespace

FaceFlaw append_face(std::span<const Point3> points, std::span<const std::uint32_t> corners,
                     std::vector<Triangle>& triangles) {
    const auto append_fan = [&] {
        for (std::size_t i = 2; i < corners.size(); ++i)
            triangles.push_back({corners[0], corners[i - 1], corners[i]});
    };
    if (corners.size() < 4) {
        append_fan();
        return FaceFlaw::none;
    }
    const Face face(points, corners);
    const FaceFlaw flaw = face.is_bent() ? FaceFlaw::bent : FaceFlaw::none;
    if (face.is_fan() || face.has_no_area()) {
        append_fan();
        return flaw;
    }
    const auto inside = face.triangles();
    if (!inside) {
        append_fan();
        return FaceFlaw::crosses;
    }
    triangles.insert(triangles.end(), inside->begin(), inside->end());
    return flaw;
}

} // namespace terrane
