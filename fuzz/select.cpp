// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: Booleans of solids have the exact volumes that inclusion and exclusion say, and contain the points that
// winding numbers say; what is below a sheet is what the solid beneath the sheet has; the parts of a sheet contain the
// points that winding numbers say. Solids are refused only if they are not closed.
#include "property.hpp"

#include <terrane/algorithms/selection/selection.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <utility>

#include "support/solid_beneath.hpp"
#include "support/winding_oracle.hpp"

namespace terrane::fuzz {

namespace {

using test_support::RationalPoint;

void add_solid(Part& part, Points& points, Bytes& bytes) {
    switch (bytes.below(4)) {
    case 0:
        return add_tetrahedron(
            part, {points.next(bytes), points.next(bytes), points.next(bytes), points.next(bytes)});
    case 1:
        return add_double_pyramid(part, {points.next(bytes), points.next(bytes), points.next(bytes),
                                         points.next(bytes), points.next(bytes)});
    default:
        return add_box(part, points, bytes);
    }
}

Part solid(Points& points, Bytes& bytes) {
    Part part;
    add_solid(part, points, bytes);
    if (bytes.below(4) == 0) add_solid(part, points, bytes);
    if (bytes.below(4) == 0)
        for (Triangle& t : part.triangles) std::swap(t[1], t[2]);
    return part;
}

/// Returns a sheet that reaches beyond all points of the lattice.
Part sheet(const Points& points, Bytes& bytes) {
    Part part;
    constexpr unsigned n = 3;
    const auto height = [&] { return double(bytes.below(9)) - 4; };
    for (unsigned i = 0; i <= n; ++i)
        for (unsigned j = 0; j <= n; ++j)
            part.points.push_back(points.placed({i * 64.0 - 96, j * 64.0 - 96, height()}));
    for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) {
            const unsigned a = i * (n + 1) + j, b = a + n + 1;
            part.triangles.push_back({a, b, b + 1});
            part.triangles.push_back({a, b + 1, a + 1});
        }
    return part;
}

/// A selection, or the error.
using Made = Result<Selected>;

Made made_of(std::span<const Surface> surfaces, std::string_view text) {
    return select(surfaces, text, {.fractions = true});
}

bool is_refused(const Made& made) {
    return made.error().code == ErrorCode::not_closed;
}

mpq_class volume(const Made& made) {
    return mpq_class(made->exact_volume);
}

/// Whether as many triangles run along each edge as against it.
bool is_closed(std::span<const Point3> points, std::span<const Triangle> triangles) {
    std::map<std::pair<Point3, Point3>, int> sums;
    for (const Triangle& t : triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const Point3 &p = points[t[i]], &q = points[t[(i + 1) % 3]];
            sums[std::minmax(p, q)] += p < q ? 1 : q < p ? -1 : 0;
        }
    return std::ranges::all_of(sums, [](const auto& s) { return s.second == 0; });
}

/// Random points near triangles, and the farthest that rounding may move surfaces there.
class Places {
public:
    explicit Places(std::span<const Surface> surfaces) : surfaces_(surfaces) {
        for (double Point3::*const k : {&Point3::x, &Point3::y, &Point3::z}) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (const Surface& s : surfaces)
                for (const Point3& p : s.vertices) {
                    low = std::min(low, p.*k);
                    high = std::max(high, p.*k);
                }
            farthest_ = std::max({farthest_, -low, high});
            size_ = std::max(size_, high - low);
        }
    }

    RationalPoint next() {
        RationalPoint sum;
        int weights = 0;
        for (int k = 0; k < 4; ++k) {
            const Surface& s = surfaces_[random_() % surfaces_.size()];
            if (s.vertices.empty()) continue;
            const Point3& p = s.vertices[random_() % s.vertices.size()];
            const int weight = 1 + static_cast<int>(random_() % 997);
            for (unsigned i = 0; i < 3; ++i)
                sum[i] += weight * mpq_class(i == 0 ? p.x : i == 1 ? p.y : p.z);
            weights += weight;
        }
        for (mpq_class& c : sum) c /= std::max(weights, 1);
        return sum;
    }

    /// Whether a place is so near to the plane of a triangle that rounding may have moved this over it.
    [[nodiscard]] bool is_near(const RationalPoint& q) const {
        for (const Surface& s : surfaces_)
            for (const Triangle& t : s.triangles) {
                const auto a = test_support::between(s.vertices[t[0]], q),
                           b = test_support::between(s.vertices[t[1]], q),
                           c = test_support::between(s.vertices[t[2]], q);
                // Six volumes of the tetrahedron are small where its height or its base is.
                const double six = std::abs(test_support::determinant(a, b, c).get_d());
                if (six <= 1e-12 * farthest_ * size_ * size_) return true;
            }
        return false;
    }

private:
    std::span<const Surface> surfaces_;
    std::mt19937_64 random_{1};
    double farthest_ = 0; ///< the largest coordinate
    double size_ = 0;     ///< the longest side of the box around all
};

std::optional<bool> is_inside(const Surface& s, const RationalPoint& q) {
    const auto winding = test_support::winding_around(s.vertices, s.triangles, q);
    return winding ? std::optional(*winding != 0) : std::nullopt;
}

std::string flaw_of_points(std::span<const Surface> surfaces, const Made& made,
                           bool (*expected)(bool, bool), const char* text) {
    if (!made->rounding.clean) return "";
    Places places(surfaces);
    for (int k = 0; k < 8; ++k) {
        const auto q = places.next();
        const auto a = is_inside(surfaces[0], q), b = is_inside(surfaces[1], q);
        const auto found =
            test_support::winding_around(made->mesh.vertices, made->mesh.triangles, q);
        if (!a || !b || !found || *found == (expected(*a, *b) ? 1 : 0)) continue;
        if (!places.is_near(q)) return std::string("a point in ") + text;
    }
    return "";
}

std::string flaw_of_solids(std::span<const Surface> surfaces) {
    const Made a = made_of(surfaces, "a"), b = made_of(surfaces, "b");
    for (const auto& [made, s] : {std::pair{&a, &surfaces[0]}, std::pair{&b, &surfaces[1]}})
        if (!*made)
            return is_refused(*made) && !is_closed(s->vertices, s->triangles)
                       ? ""
                       : made->error().message();
    const Made both = made_of(surfaces, "a & b"), all = made_of(surfaces, "a | b"),
               rest = made_of(surfaces, "a - b"), other = made_of(surfaces, "b - a"),
               one = made_of(surfaces, "~(~a & ~b) - b & a | a ^ b");
    for (const Made* const made : {&both, &all, &rest, &other, &one}) {
        if (!*made) return made->error().message();
        mpq_class sum;
        for (const SelectedPiece& piece : (*made)->pieces) sum += mpq_class(piece.exact_volume);
        if (sum != volume(*made)) return "pieces do not add up";
        const Mesh& mesh = (*made)->mesh;
        if (!is_closed(mesh.vertices, mesh.triangles)) return "a boundary that is not closed";
    }
    if (volume(all) + volume(both) != volume(a) + volume(b)) return "the volume of a | b";
    if (volume(rest) + volume(both) != volume(a)) return "the volume of a - b";
    if (volume(other) + volume(both) != volume(b)) return "the volume of b - a";
    if (volume(one) != volume(rest) + volume(other)) return "the volume of a ^ b";
    const std::array tests{std::tuple{&both, +[](bool x, bool y) { return x && y; }, "a & b"},
                           std::tuple{&all, +[](bool x, bool y) { return x || y; }, "a | b"},
                           std::tuple{&rest, +[](bool x, bool y) { return x && !y; }, "a - b"},
                           std::tuple{&one, +[](bool x, bool y) { return x != y; }, "a ^ b"}};
    for (const auto& [made, expected, text] : tests)
        if (auto what = flaw_of_points(surfaces, *made, expected, text); !what.empty()) return what;
    return "";
}

/// Whether no point of the sheet's border is above or below the box around a solid.
bool reaches_beyond(const Surface& sheet, const Surface& solid) {
    const auto x = std::ranges::minmax(solid.vertices, {}, &Point3::x);
    const auto y = std::ranges::minmax(solid.vertices, {}, &Point3::y);
    return std::ranges::all_of(test_support::border_of(sheet), [&](const auto& edge) {
        const auto& [p, q] = edge.first;
        return std::max(p.x, q.x) < x.min.x || std::min(p.x, q.x) > x.max.x ||
               std::max(p.y, q.y) < y.min.y || std::min(p.y, q.y) > y.max.y;
    });
}

std::string flaw_of_sheet(std::span<const Surface> surfaces) {
    const Surface& sheet = surfaces[2];
    if (is_closed(sheet.vertices, sheet.triangles) || surfaces[0].vertices.empty() ||
        !test_support::is_turned_alike(sheet) || !reaches_beyond(sheet, surfaces[0]))
        return "";
    std::vector<Surface> with_solid(surfaces.begin(), surfaces.end());
    double bottom = 0;
    for (const Surface& s : surfaces)
        for (const Point3& p : s.vertices) bottom = std::min(bottom, p.z - 1);
    with_solid[2] = test_support::beneath(sheet, bottom, sheet.name);
    for (const auto& [text, other] :
         {std::pair{"a & below(c)", "a & inside(c)"}, std::pair{"a - below(c)", "a - inside(c)"}}) {
        const Made made = made_of(surfaces, text), expected = made_of(with_solid, other);
        if (!made || !expected) continue; // it does not divide
        if (volume(made) != volume(expected)) return std::string("the volume of ") + text;
    }
    return "";
}

} // namespace

Soup input(Bytes& bytes) {
    Points points(bytes);
    Soup soup{solid(points, bytes), solid(points, bytes)};
    if (bytes.flag()) soup.push_back(sheet(points, bytes));
    return soup;
}

std::string flaw(std::span<const Surface> surfaces) {
    if (surfaces.size() < 2) return "";
    auto what = flaw_of_solids(surfaces);
    if (what.empty() && surfaces.size() > 2) what = flaw_of_sheet(surfaces);
    return what;
}

} // namespace terrane::fuzz
