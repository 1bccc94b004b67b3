// SPDX-License-Identifier: MIT
#include <terrane/fuzzing/mutate.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace terrane::fuzzing {

namespace {

using ByteVector = std::vector<std::uint8_t>;

/// SplitMix64: the same numbers everywhere, unlike the distributions of the standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// Returns a number in [0, count); count > 0.
    std::size_t below(std::size_t count) {
        state_ += 0x9e3779b97f4a7c15U;
        std::uint64_t z = state_;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9U;
        z = (z ^ z >> 27) * 0x94d049bb133111ebU;
        return static_cast<std::size_t>((z ^ z >> 31) % count);
    }
    bool one_of(std::size_t count) { return below(count) == 0; }
    template <class List>
    auto& any(List& list) {
        return list[below(list.size())];
    }

private:
    std::uint64_t state_;
};

bool is_finite(const Point& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Returns a + s (b - a) + t (c - a).
Point combined(const Point& a, const Point& b, const Point& c, double s, double t) {
    return {a.x + s * (b.x - a.x) + t * (c.x - a.x), a.y + s * (b.y - a.y) + t * (c.y - a.y),
            a.z + s * (b.z - a.z) + t * (c.z - a.z)};
}

/// Returns p + (to - from), which is `to` for `from` itself.
Point shifted(const Point& p, const Point& from, const Point& to) {
    if (p == from) return to;
    return {p.x + (to.x - from.x), p.y + (to.y - from.y), p.z + (to.z - from.z)};
}

double& coordinate_of(Point& p, std::size_t k) {
    return k == 0 ? p.x : k == 1 ? p.y : p.z;
}

/// One change of a mesh that has triangles.
class Change {
public:
    Change(Soup& soup, Random& random) : soup_(soup), random_(random) {
        for (std::size_t p = 0; p < soup.size(); ++p)
            if (!soup[p].triangles.empty()) filled_.push_back(p);
    }
    [[nodiscard]] bool is_possible() const { return !filled_.empty(); }

    void make() {
        switch (random_.below(12)) {
        case 0:
        case 1:
        case 2:
        case 3:
            return move_vertex();
        case 4:
            return repeat_triangle();
        case 5:
            return remove_triangle();
        case 6:
            return turn_triangle();
        case 7:
            return cut_triangle();
        case 8:
            return tear_off();
        case 9:
            return add_triangle_of_points();
        case 10:
            return shift_part();
        default:
            return change_numbers();
        }
    }

    /// Returns a corner of a triangle.
    Point& corner() {
        Part& in = part();
        return in.points[random_.any(random_.any(in.triangles))];
    }

private:
    Part& part() { return soup_[random_.any(filled_)]; }
    /// Returns where a point may go: where degeneracy is.
    Point place(const Point& from) {
        static constexpr std::array<double, 8> shares{0.5, 0.25, 1.0 / 3, 0.75, 2, -1, 1, 0.125};
        Part& in = part();
        const Triangle& t = random_.any(in.triangles);
        const Point &a = in.points[t[0]], &b = in.points[t[1]], &c = in.points[t[2]];
        switch (random_.below(5)) {
        case 0:
            return corner();
        case 1:
            return combined(a, b, b, random_.any(shares), 0);
        case 2:
            return combined(a, b, c, random_.any(shares), random_.any(shares));
        case 3: {
            Point p = from;
            double& x = coordinate_of(p, random_.below(3));
            if (x == 0 && random_.one_of(2)) { // to -0, or back
                x = -x;
                return p;
            }
            for (std::size_t steps = 1 + random_.below(3); steps > 0; --steps)
                x = std::nextafter(x, random_.one_of(2) ? HUGE_VAL : -HUGE_VAL);
            return p;
        }
        default: {
            Point p = from, other = corner();
            const std::size_t k = random_.below(3);
            coordinate_of(p, k) = coordinate_of(other, k);
            return p;
        }
        }
    }
    /// Moves one vertex, or all at its point.
    void move_vertex() {
        Point& one = corner();
        const Point from = one, to = place(from);
        if (!is_finite(to)) return;
        if (random_.one_of(3)) {
            one = to;
            return;
        }
        for (Part& each : soup_)
            for (Point& p : each.points)
                if (p == from) p = to;
    }
    void repeat_triangle() {
        Part& from = part();
        Triangle t = random_.any(from.triangles);
        std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random_.below(3)), t.end());
        if (random_.one_of(2)) std::swap(t[0], t[1]);
        const std::array<Point, 3> corners{from.points[t[0]], from.points[t[1]], from.points[t[2]]};
        if (random_.one_of(2))
            from.triangles.push_back(t);
        else
            add_triangle(random_.any(soup_), corners);
    }
    void remove_triangle() {
        auto& triangles = part().triangles;
        triangles.erase(triangles.begin() +
                        static_cast<std::ptrdiff_t>(random_.below(triangles.size())));
    }
    void turn_triangle() {
        Triangle& t = random_.any(part().triangles);
        std::swap(t[0], t[1]);
    }
    /// Cuts a triangle in two; that beyond the edge keeps its corners, so that a vertex is on its side.
    void cut_triangle() {
        Part& in = part();
        Triangle& t = random_.any(in.triangles);
        std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random_.below(3)), t.end());
        const Point &a = in.points[t[0]], &b = in.points[t[1]];
        const Point middle = combined(a, b, b, 0.5, 0);
        if (!is_finite(middle)) return;
        const auto m = static_cast<std::uint32_t>(in.points.size());
        const Triangle rest{m, t[1], t[2]};
        t[1] = m;
        in.points.push_back(middle);
        in.triangles.push_back(rest);
    }
    /// Gives a triangle corners of its own, or makes equal points of a part one.
    void tear_off() {
        Part& in = part();
        if (random_.one_of(2)) {
            for (std::uint32_t& v : random_.any(in.triangles)) {
                in.points.push_back(in.points[v]);
                v = static_cast<std::uint32_t>(in.points.size() - 1);
            }
            return;
        }
        for (Triangle& t : in.triangles)
            for (std::uint32_t& v : t)
                v = static_cast<std::uint32_t>(
                    std::find(in.points.begin(), in.points.end(), in.points[v]) -
                    in.points.begin());
    }
    void add_triangle_of_points() {
        const Point a = corner(), b = corner(), c = place(a);
        if (is_finite(c)) add_triangle(random_.any(soup_), {a, b, c});
    }
    /// Moves a part so that a vertex of it comes onto another one.
    void shift_part() {
        Part& moved = part();
        const Point from = moved.points[random_.any(random_.any(moved.triangles))], to = corner();
        std::vector<Point> points = moved.points;
        for (Point& p : points) p = shifted(p, from, to);
        if (std::all_of(points.begin(), points.end(), is_finite)) moved.points = points;
    }
    /// Changes all numbers of the mesh alike.
    void change_numbers() {
        const std::size_t how = random_.below(4);
        Soup changed = soup_;
        for (Part& each : changed)
            for (Point& p : each.points)
                for (std::size_t k = 0; k < 3; ++k) {
                    double& x = coordinate_of(p, k);
                    x = how == 0   ? x / 4
                        : how == 1 ? x * 0.1
                        : how == 2 ? x + 1000000
                                   : std::round(x);
                }
        for (const Part& each : changed)
            if (!std::all_of(each.points.begin(), each.points.end(), is_finite)) return;
        soup_ = changed;
    }

    Soup& soup_;
    Random& random_;
    std::vector<std::size_t> filled_; ///< parts with triangles
};

/// Leaves out points that no triangle has.
void drop_unused_points(Soup& soup) {
    for (Part& part : soup) {
        std::vector<std::uint32_t> index(part.points.size(), UINT32_MAX);
        std::vector<Point> points;
        for (Triangle& t : part.triangles)
            for (std::uint32_t& v : t) {
                if (index[v] == UINT32_MAX) {
                    index[v] = static_cast<std::uint32_t>(points.size());
                    points.push_back(part.points[v]);
                }
                v = index[v];
            }
        part.points = points;
    }
}

/// Changes, inserts or erases some bytes.
std::size_t change_simply(std::uint8_t* data, std::size_t size, std::size_t most, Random& random) {
    ByteVector bytes(data, data + size);
    for (std::size_t left = 1 + random.below(4); left > 0; --left) {
        const auto value = static_cast<std::uint8_t>(random.below(256));
        const auto at =
            static_cast<std::ptrdiff_t>(random.below(std::max<std::size_t>(1, bytes.size())));
        if (random.one_of(3) || bytes.empty())
            bytes.insert(bytes.begin() + at, 1 + random.below(12), value);
        else if (random.one_of(3))
            bytes.erase(bytes.begin() + at);
        else
            bytes[static_cast<std::size_t>(at)] = value;
    }
    bytes.resize(std::min(bytes.size(), most));
    std::copy(bytes.begin(), bytes.end(), data);
    return bytes.size();
}

/// Returns random bytes of a generator.
ByteVector random_bytes(Random& random, std::size_t most) {
    ByteVector bytes(std::min(most, 1 + random.below(1 + random.below(200))));
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.below(256));
    return bytes;
}

} // namespace

std::size_t mutate(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                   const Generator& generator, ByteMutator change_bytes) {
    Random random(seed);
    const bool literally = is_literal(data, size);
    const auto by_bytes = [&] {
        return change_bytes != nullptr ? change_bytes(data, size, most)
                                       : change_simply(data, size, most, random);
    };
    if (!literally && random.one_of(2)) return by_bytes();
    Soup soup = mesh_of(data, size, generator);
    for (std::size_t left = 1 + random.below(3); left > 0; --left)
        if (Change change(soup, random); change.is_possible()) change.make();
    drop_unused_points(soup);
    ByteVector made = triangle_count(soup) == 0 ? random_bytes(random, most) : literal(soup);
    if (made.size() > most) {
        if (!literally) return by_bytes();
        made.assign(data, data + size);
    }
    std::copy(made.begin(), made.end(), data);
    return made.size();
}

std::size_t cross_over(const ByteVector& a, const ByteVector& b, std::uint8_t* out,
                       std::size_t most, unsigned seed, const Generator& generator) {
    Random random(seed);
    Soup to = mesh_of(a.data(), a.size(), generator), from = mesh_of(b.data(), b.size(), generator);
    for (Soup* each : {&to, &from})
        for (Part& part : *each)
            std::erase_if(part.triangles, [&](const Triangle&) { return random.one_of(3); });
    Change of_to(to, random), of_from(from, random);
    if (of_to.is_possible() && of_from.is_possible() && random.one_of(2)) {
        const Point there = of_to.corner(), here = of_from.corner();
        Soup moved = from;
        bool finite = true;
        for (Part& part : moved)
            for (Point& p : part.points) {
                p = shifted(p, here, there);
                finite = finite && is_finite(p);
            }
        if (finite) from = moved;
    }
    to.resize(std::max(to.size(), from.size()));
    for (std::size_t p = 0; p < from.size(); ++p) {
        const auto first = static_cast<std::uint32_t>(to[p].points.size());
        to[p].points.insert(to[p].points.end(), from[p].points.begin(), from[p].points.end());
        for (const Triangle& t : from[p].triangles)
            to[p].triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    drop_unused_points(to);
    ByteVector made = literal(to);
    while (made.size() > most && triangle_count(to) > 0) {
        for (Part& part : to) part.triangles.resize(part.triangles.size() / 2);
        drop_unused_points(to);
        made = literal(to);
    }
    made.resize(std::min(made.size(), most));
    std::copy(made.begin(), made.end(), out);
    return made.size();
}

std::size_t AflState::next(ByteVector bytes, const ByteVector& others, std::uint8_t** out,
                           std::size_t most, const Generator& generator) {
    ++seed;
    const std::size_t size = bytes.size();
    made.resize(std::max(most, size));
    if (!others.empty() && seed % 4 == 0) {
        made.resize(cross_over(bytes, others, made.data(), most, seed, generator));
    } else {
        std::copy(bytes.begin(), bytes.end(), made.begin());
        made.resize(mutate(made.data(), size, most, seed, generator));
    }
    *out = made.data();
    return made.size();
}

Finding find_flaw(const Generator& generator, const std::function<std::string(const Soup&)>& flaw,
                  std::size_t most, unsigned seed) {
    constexpr std::size_t most_bytes = 4096, most_kept = 64;
    Random random(seed);
    std::vector<ByteVector> kept;
    Finding result;
    while (result.tried < most) {
        ByteVector bytes;
        if (kept.empty() || random.one_of(2)) {
            bytes = random_bytes(random, most_bytes);
        } else {
            bytes = random.any(kept);
            const std::size_t size = bytes.size();
            bytes.resize(most_bytes);
            bytes.resize(mutate(bytes.data(), size, most_bytes,
                                static_cast<unsigned>(random.below(UINT32_MAX)), generator));
        }
        if (kept.size() < most_kept)
            kept.push_back(bytes);
        else
            random.any(kept) = bytes;
        ++result.tried;
        result.soup = mesh_of(bytes.data(), bytes.size(), generator);
        result.flaw = flaw(result.soup);
        if (!result.flaw.empty()) return result;
    }
    result.soup.clear();
    return result;
}

} // namespace terrane::fuzzing
