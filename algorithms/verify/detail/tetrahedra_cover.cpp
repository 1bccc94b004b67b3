// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_cover and volume_within_reach of tetrahedra.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/box_tree.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra.hpp>

namespace terrane::verifier {

namespace {

// --- Allowances, statements (1), (4) and (5) ----------------------------------------------------

using Vector = std::array<mpq_class, 3>;

constexpr int allowed_spacings = 5;

Vector exact(const Point3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}

/// Returns the distance between doubles in the binade of a number.
mpq_class spacing_at(double number) {
    constexpr int least_exponent = -1074;
    int exponent = least_exponent;
    if (number != 0) std::frexp(number, &exponent); // its size is below 2^exponent
    return mpq_class(std::ldexp(1.0, std::max(exponent - 53, least_exponent)));
}

/// Returns what is allowed in each coordinate on a triangle, or on an edge.
template <std::size_t n>
Vector allowance(const std::array<Point3, n>& corners) {
    const auto in = [&](double Point3::*coordinate) -> mpq_class {
        double largest = 0;
        for (const Point3& p : corners) largest = std::max(largest, std::fabs(p.*coordinate));
        return allowed_spacings * spacing_at(largest);
    };
    return {in(&Point3::x), in(&Point3::y), in(&Point3::z)};
}

/// Tells whether some point of the edge differs from p by no more than the allowance. In each
/// coordinate the parameters of such points are an interval.
bool near_edge(const Point3& point, const Point3& start, const Point3& end) {
    const Vector e = allowance<2>({start, end});
    const Vector p = exact(point), a = exact(start), b = exact(end);
    mpq_class from = 0, to = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        const mpq_class d = b[i] - a[i];
        if (sgn(d) == 0) {
            if (abs(p[i] - a[i]) > e[i]) return false;
            continue;
        }
        const mpq_class middle = (p[i] - a[i]) / d, half = e[i] / abs(d);
        from = std::max(from, mpq_class(middle - half));
        to = std::min(to, mpq_class(middle + half));
    }
    return from <= to;
}

Vector normal(const std::array<Point3, 3>& t) {
    const Vector a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
    Vector n;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
    }
    return n;
}

/// Tells whether some point of the triangle's plane differs from p by no more than the allowance.
bool near_plane(const Point3& point, const std::array<Point3, 3>& triangle) {
    const Vector n = normal(triangle), e = allowance(triangle);
    const Vector p = exact(point), a = exact(triangle[0]);
    mpq_class height = 0, allowed = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        height += n[i] * (p[i] - a[i]);
        allowed += abs(n[i]) * e[i];
    }
    return abs(height) <= allowed;
}

/// Returns a number that is at least the square root, and exceeds it by a part of 2^-60 at most.
mpq_class root_above(const mpq_class& square) {
    if (sgn(square) == 0) return 0;
    mpz_class product = square.get_num() * square.get_den(); // the root is sqrt(product) / den
    const std::size_t bits = mpz_sizeinbase(product.get_mpz_t(), 2);
    const std::size_t shift = bits < 128 ? 64 : 0;
    product <<= 2 * shift;
    mpz_class root = sqrt(product);
    root += 1;
    mpq_class result(root, mpz_class(square.get_den() << shift));
    result.canonicalize();
    return result;
}

// --- Outlines, statement (3) --------------------------------------------------------------------

/// The outline of the faces of a triangle, as places.
struct Outline {
    Numbers nodes;                    ///< all, from the first corner of the triangle on
    std::array<Numbers, 3> inside_of; ///< per edge of the triangle: the nodes between its ends
};

/// Returns the outline if the faces' edges cancel but for one closed polygon that runs from corner
/// to corner.
std::optional<Outline> outline_of(const std::vector<Triangle>& faces, const Triangle& corners) {
    std::set<Edge> steps;
    for (const Triangle& f : faces)
        for (std::size_t i = 0; i < 3; ++i)
            if (!steps.insert({f[i], f[(i + 1) % 3]}).second) return std::nullopt;
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& [from, to] : steps)
        if (!steps.contains({to, from}) && !next.emplace(from, to).second) return std::nullopt;
    Outline outline;
    std::uint32_t at = corners[0];
    for (std::size_t side = 0; side < 3;) {
        const auto step = next.find(at);
        if (step == next.end() || outline.nodes.size() == next.size()) return std::nullopt;
        outline.nodes.push_back(at);
        at = step->second;
        if (at == corners[(side + 1) % 3])
            ++side;
        else
            outline.inside_of[side].push_back(at);
    }
    if (outline.nodes.size() != next.size()) return std::nullopt;
    return outline;
}

/// A polygon in the projection along an axis.
class Polygon {
public:
    Polygon(const TetrahedraParts& parts, const Numbers& nodes, std::size_t axis) :
        parts_(parts), nodes_(nodes), axis_(axis) {}

    [[nodiscard]] bool is_simple() const {
        const auto n = static_cast<std::uint32_t>(nodes_.size());
        std::vector<Box> boxes;
        for (std::uint32_t i = 0; i < n; ++i) {
            boxes.push_back(enclose(at(i), 1));
            extend(boxes.back(), enclose(at(i + 1), 1));
            boxes.back().low[axis_] = boxes.back().high[axis_] = 0;
        }
        const BoxTree tree(std::move(boxes));
        for (std::uint32_t i = 0; i + 1 < n; ++i)
            for (const std::uint32_t j : tree.touching_others(i)) {
                if (j <= i) continue;
                const bool meet = j == i + 1         ? folds(i, j)
                                  : (j + 1) % n == i ? folds(j, i)
                                                     : sides_meet(i, j);
                if (meet) return false;
            }
        return true;
    }

private:
    [[nodiscard]] const Vector4& at(std::size_t i) const {
        return parts_.nodes[nodes_[i % nodes_.size()]];
    }
    [[nodiscard]] int turn_at(std::size_t i, const Vector4& p) const {
        return sgn(turn(at(i), at(i + 1), p, axis_));
    }
    /// Tells whether p, on the line of a side, is on the side.
    [[nodiscard]] bool holds(std::size_t i, const Vector4& p) const {
        for (const std::size_t x : {(axis_ + 1) % 3, (axis_ + 2) % 3}) {
            const auto [low, high] = std::minmax(at(i)[x], at(i + 1)[x]);
            if (p[x] < low || high < p[x]) return false;
        }
        return true;
    }
    [[nodiscard]] bool sides_meet(std::size_t i, std::size_t j) const {
        const int a = turn_at(i, at(j)), b = turn_at(i, at(j + 1));
        const int c = turn_at(j, at(i)), d = turn_at(j, at(i + 1));
        if (a * b < 0 && c * d < 0) return true;
        return (a == 0 && holds(i, at(j))) || (b == 0 && holds(i, at(j + 1))) ||
               (c == 0 && holds(j, at(i))) || (d == 0 && holds(j, at(i + 1)));
    }
    /// Tells whether a side and the next one have more in common than their end.
    [[nodiscard]] bool folds(std::size_t i, std::size_t next) const {
        if (turn_at(i, at(next + 1)) != 0) return false;
        return holds(i, at(next + 1)) || holds(next, at(i));
    }

    const TetrahedraParts& parts_;
    const Numbers& nodes_;
    const std::size_t axis_;
};

// --- R45 -----------------------------------------------------------------------------------------

class Cover {
public:
    Cover(const TetrahedraParts& parts, const std::vector<Numbers>& faces_of, Violations& found) :
        parts_(parts), faces_of_(faces_of), found_(found), divided_(faces_of.size()) {}

    std::vector<bool> operator()() {
        for (std::uint32_t t = 0; t < divided_.size(); ++t) judge(t);
        return std::move(divided_);
    }

private:
    void refute(std::uint32_t triangle, const std::string& what) {
        found_.push_back({Rule::R45_cover, {triangle}, "triangle " + text(triangle) + " " + what});
    }

    [[nodiscard]] std::array<Point3, 3> points_of(std::uint32_t triangle) const {
        const auto& [a, b, c] = parts_.mesh.triangles[triangle];
        return {parts_.mesh.vertices[a], parts_.mesh.vertices[b], parts_.mesh.vertices[c]};
    }

    static bool same_cycle(const Triangle& a, const Triangle& b) {
        return a == b || a == Triangle{b[1], b[2], b[0]} || a == Triangle{b[2], b[0], b[1]};
    }

    void judge(std::uint32_t t) {
        std::vector<Triangle> faces;
        for (const std::uint32_t f : faces_of_[t])
            faces.push_back(parts_.places(parts_.claim.faces[f]));
        if (faces.empty()) {
            if (parts_.needs_faces(t)) refute(t, "has no face");
            return;
        }
        Triangle corners = parts_.mesh.triangles[t];
        for (std::uint32_t& v : corners) v = parts_.place_of_vertex[v];
        if (std::ranges::count(corners, no_number) > 0) return; // by R44
        if (faces.size() == 1 && same_cycle(faces[0], corners)) return take_edges(t, corners, {});
        divided_[t] = true;
        const auto outline = outline_of(faces, corners);
        if (!outline) return refute(t, "has faces whose outline does not follow its sides");
        take_edges(t, corners, *outline);
        judge_nodes(t, faces, *outline);
        judge_projection(t, faces, *outline);
    }

    /// Compares with how other triangles divide the same edges.
    void take_edges(std::uint32_t t, const Triangle& corners, const Outline& outline) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
            Numbers inside = outline.inside_of[i];
            if (from > to) std::reverse(inside.begin(), inside.end());
            const auto [at, added] =
                inside_of_.try_emplace(Edge{std::min(from, to), std::max(from, to)}, inside);
            if (!added && at->second != inside)
                refute(t, "has other nodes on an edge than another triangle there");
        }
    }

    void judge_nodes(std::uint32_t t, const std::vector<Triangle>& faces, const Outline& outline) {
        const auto corners = points_of(t);
        const auto& nodes = parts_.claim.vertices;
        for (std::size_t i = 0; i < 3; ++i)
            for (const std::uint32_t node : outline.inside_of[i])
                if (!near_edge(nodes[node], corners[i], corners[(i + 1) % 3]))
                    refute(t, "has node " + text(node) + " too far from its edge");
        std::set<std::uint32_t> others;
        for (const Triangle& face : faces) others.insert(face.begin(), face.end());
        for (const std::uint32_t node : outline.nodes) others.erase(node);
        for (const std::uint32_t node : others)
            if (!near_plane(nodes[node], corners))
                refute(t, "has node " + text(node) + " too far from its plane");
    }

    void judge_projection(std::uint32_t t, const std::vector<Triangle>& faces,
                          const Outline& outline) {
        const std::size_t axis = longest_axis(normal(points_of(t)));
        const auto& [a, b, c] = parts_.mesh.triangles[t];
        const int winding = sgn(turn(parts_.points[a], parts_.points[b], parts_.points[c], axis));
        for (const auto& [i, j, k] : faces)
            if (sgn(turn(parts_.nodes[i], parts_.nodes[j], parts_.nodes[k], axis)) != winding)
                refute(t, "has a face that is folded over, or flat in the projection");
        if (!Polygon(parts_, outline.nodes, axis).is_simple())
            refute(t, "has faces whose outline meets itself");
    }

    const TetrahedraParts& parts_;
    const std::vector<Numbers>& faces_of_;
    Violations& found_;
    std::vector<bool> divided_;
    std::map<Edge, Numbers> inside_of_; ///< per edge, from its lower end to its higher one
};

} // namespace

std::vector<bool> check_cover(const TetrahedraParts& parts, const std::vector<Numbers>& faces_of,
                              Violations& found) {
    return Cover(parts, faces_of, found)();
}

mpq_class volume_within_reach(const std::array<Point3, 3>& triangle) {
    const mpq_class pi_above(22, 7);
    const Vector n = normal(triangle), e = allowance(triangle);
    const std::size_t w = longest_axis(n), u = (w + 1) % 3, v = (w + 2) % 3;
    const mpq_class along = e[w] + 2 * e[u] + 2 * e[v];
    const mpq_class reach = root_above(e[u] * e[u] + e[v] * e[v] + along * along);
    const mpq_class area = root_above(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    mpq_class border = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector a = exact(triangle[i]), b = exact(triangle[(i + 1) % 3]);
        mpq_class square = 0;
        for (std::size_t k = 0; k < 3; ++k) square += (b[k] - a[k]) * (b[k] - a[k]);
        border += root_above(square);
    }
    return 2 * reach * area + pi_above / 2 * reach * reach * border +
           pi_above * 4 / 3 * reach * reach * reach;
}

} // namespace terrane::verifier
