// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/holes/detail/shape.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/holes/detail/constants.hpp>

namespace terrane::holes::detail {
namespace {

double length_of(const Point3& v) {
    return std::sqrt(dot(v, v));
}

Point3 plus(const Point3& a, const Point3& b, double times) {
    return {a.x + times * b.x, a.y + times * b.y, a.z + times * b.z};
}

/// Computes the weighted median; 0 if there are no values.
double weighted_median(std::vector<std::array<double, 2>> values) {
    std::sort(values.begin(), values.end());
    double total = 0, sum = 0;
    for (const auto& [value, weight] : values) total += weight;
    for (const auto& [value, weight] : values)
        if ((sum += weight) >= total / 2) return value;
    return 0;
}

struct Flat {
    double u = 0, v = 0;
};

Flat operator-(const Flat& a, const Flat& b) {
    return {a.u - b.u, a.v - b.v};
}
double dot(const Flat& a, const Flat& b) {
    return a.u * b.u + a.v * b.v;
}
double cross(const Flat& a, const Flat& b) {
    return a.u * b.v - a.v * b.u;
}

/// A hole projected along the normal of the surface around it.
class FlatHole {
public:
    FlatHole(const Soup& soup, const TracedLoop& traced) : soup_(soup), loop_(traced) {
        const auto n = loop_.vertices.size();
        normals_.resize(n);
        for (std::size_t i = 0; i < n; ++i) normals_[i] = normal_at(i);
        Point3 sum{};
        for (const Point3& normal : normals_) sum = plus(sum, normal, 1);
        valid_ = length_of(sum) > 0;
        if (valid_) flatten(sum);
    }

    [[nodiscard]] bool valid() const { return valid_; }

    /// The opposite side of the hole, seen from one of its edges.
    struct Facing {
        double weight; ///< length of the edge
        double width;
        double jump; ///< by how much this side is higher when extrapolated to the middle
        Flat direction;
    };

    [[nodiscard]] std::optional<Facing> find_facing(std::size_t i) const {
        const Flat a = flat_[i], b = flat_[next(i)], edge = b - a;
        const double length = std::sqrt(dot(edge, edge));
        if (length == 0) return std::nullopt;
        const Flat from{(a.u + b.u) / 2, (a.v + b.v) / 2};
        const Flat away{edge.v / length, -edge.u / length}; // the hole is on the right
        std::optional<Facing> found;
        for (std::size_t j = 0; j < flat_.size(); ++j)
            if (j != i)
                if (const auto met = meet(from, away, j); met && (!found || met->t < found->width))
                    found = Facing{length, met->t, jump(i, j, *met, away), away};
        return found;
    }

    /// Computes the median distance of a vertex from the midpoint of its neighbours.
    [[nodiscard]] double roughness() const {
        std::vector<std::array<double, 2>> off;
        for (std::size_t i = 0; i < height_.size(); ++i) {
            const double middle = (height_[i] + height_[next(next(i))]) / 2;
            off.push_back({std::abs(height_[next(i)] - middle), 1});
        }
        return weighted_median(std::move(off));
    }

private:
    struct Meeting {
        double t; ///< along the ray
        double s; ///< along the edge, in [0, 1]
    };

    [[nodiscard]] std::size_t next(std::size_t i) const {
        return i + 1 < loop_.vertices.size() ? i + 1 : 0;
    }

    /// Computes the normal of the triangle at edge i, with the orientation of the loop and twice
    /// the area as length.
    [[nodiscard]] Point3 normal_at(std::size_t i) const {
        const Triangle& t = soup_.triangles[loop_.triangles[i]];
        const auto& p = soup_.points;
        const Point3 normal = terrane::cross(minus(p[t[1]], p[t[0]]), minus(p[t[2]], p[t[0]]));
        const bool along = runs_along(t, loop_.vertices[i], loop_.vertices[next(i)]);
        return along ? normal : plus({}, normal, -1);
    }

    void flatten(const Point3& sum) {
        up_ = plus({}, sum, 1 / length_of(sum));
        const Point3 axis = std::abs(up_.x) < 0.6 ? Point3{1, 0, 0} : Point3{0, 1, 0};
        const Point3 side = terrane::cross(axis, up_);
        u_ = plus({}, side, 1 / length_of(side));
        v_ = terrane::cross(up_, u_);
        const Point3& origin = soup_.points[loop_.vertices[0]];
        for (const auto vertex : loop_.vertices) {
            const Point3 p = minus(soup_.points[vertex], origin);
            flat_.push_back({terrane::dot(p, u_), terrane::dot(p, v_)});
            height_.push_back(terrane::dot(p, up_));
        }
    }

    /// Computes the slope of the surface at edge i from the triangles at it and at its neighbours.
    [[nodiscard]] Flat slope_at(std::size_t i) const {
        Point3 sum{};
        const auto n = loop_.vertices.size();
        for (const auto k : {(i + n - 1) % n, i, next(i)}) sum = plus(sum, normals_[k], 1);
        const double rise = terrane::dot(sum, up_);
        if (rise * constants.steepest <= length_of(sum)) return {};
        return {-terrane::dot(sum, u_) / rise, -terrane::dot(sum, v_) / rise};
    }

    /// Intersects a ray from within the hole with edge j.
    [[nodiscard]] std::optional<Meeting> meet(Flat from, Flat along, std::size_t j) const {
        const Flat edge = flat_[next(j)] - flat_[j], to = flat_[j] - from;
        const double determinant = cross(along, edge);
        if (determinant >= 0) return std::nullopt; // parallel, or met from outside of the hole
        const double t = cross(to, edge) / determinant, s = cross(to, along) / determinant;
        if (t < 0 || s < 0 || s > 1) return std::nullopt;
        return Meeting{t, s};
    }

    [[nodiscard]] double jump(std::size_t i, std::size_t j, Meeting met, Flat away) const {
        const double here =
            (height_[i] + height_[next(i)]) / 2 + dot(slope_at(i), away) * met.t / 2;
        const double there = (1 - met.s) * height_[j] + met.s * height_[next(j)] -
                             dot(slope_at(j), away) * met.t / 2;
        return here - there;
    }

    const Soup& soup_;
    const TracedLoop& loop_;
    bool valid_ = false;
    Point3 up_, u_, v_;
    std::vector<Point3> normals_; ///< per edge
    std::vector<Flat> flat_;      ///< per vertex
    std::vector<double> height_;  ///< per vertex
};

} // namespace

double diagonal_of(std::span<const Point3> points, std::span<const std::uint32_t> vertices) {
    Point3 low = points[vertices[0]], high = low;
    for (const auto v : vertices) {
        const Point3& p = points[v];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return length_of(minus(high, low));
}

void measure_loop(const Soup& soup, const TracedLoop& traced, BorderLoop& loop) {
    const auto n = traced.vertices.size();
    // Products of very large doubles overflow, and those of very small ones vanish. A power of two changes no digit.
    double largest = 0;
    for (const auto v : traced.vertices)
        for (const double c : {soup.points[v].x, soup.points[v].y, soup.points[v].z})
            largest = std::max(largest, std::fabs(c));
    const int scale = largest > 0 ? std::ilogb(largest) : 0;
    const auto scaled = [](const Point3& p, int by) {
        return Point3{std::ldexp(p.x, by), std::ldexp(p.y, by), std::ldexp(p.z, by)};
    };
    const auto at = [&](std::size_t i) { return scaled(soup.points[traced.vertices[i]], -scale); };
    const Point3 origin = at(0);
    Point3 area{}, centre{};
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Point3 a = minus(at(i), origin), b = minus(at((i + 1) % n), origin);
        const double length = length_of(minus(b, a));
        sum += length;
        area = plus(area, cross(a, b), 0.5);
        centre = plus(plus(centre, a, length / 2), b, length / 2);
    }
    loop.length = std::ldexp(sum, scale);
    loop.area = std::ldexp(length_of(area), 2 * scale);
    loop.centre = scaled(sum > 0 ? plus(origin, centre, 1 / sum) : origin, scale);
}

bool is_fault_gap(const Soup& soup, const TracedLoop& traced, const GapRule& rule,
                  BorderLoop& loop) {
    const FlatHole hole(soup, traced);
    if (!hole.valid()) return false;
    std::vector<FlatHole::Facing> pairs;
    const auto n = traced.vertices.size();
    const auto probes = std::min(n, constants.most_probes);
    for (std::size_t k = 0; k < probes; ++k)
        if (const auto facing = hole.find_facing(k * n / probes)) pairs.push_back(*facing);

    std::vector<std::array<double, 2>> jumps, widths;
    Flat downhill;
    double total = 0, agreed = 0;
    for (const auto& [weight, width, jump, direction] : pairs) {
        jumps.push_back({std::abs(jump), weight});
        widths.push_back({width, weight});
        downhill.u += weight * jump * direction.u;
        downhill.v += weight * jump * direction.v;
    }
    for (const auto& [weight, width, jump, direction] : pairs) {
        total += weight;
        if (jump * dot(downhill, direction) > 0) agreed += weight;
    }
    loop.fault_throw = weighted_median(std::move(jumps));
    loop.width = weighted_median(std::move(widths));
    return total > 0 && agreed >= constants.agreement * total &&
           loop.fault_throw >= rule.slope * loop.width && loop.fault_throw > 0 &&
           loop.fault_throw >= constants.roughness_factor * hole.roughness();
}

} // namespace terrane::holes::detail
