// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/layered_thickness.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/indices.hpp>

namespace terrane::verifier {

namespace {

/// A triangle over or under another one, or a triangle of its surface.
struct Other {
    const Seen* seen = nullptr;
    const Box* box = nullptr;
};

/// A triangle of a layer, and what decides its height.
struct Column {
    std::uint32_t triangle = 0, layer = 0;
    PlacePolygon places;
    PlanFunction height;
    std::vector<Other> own, above, below; ///< of its surface; of harder layers
};

using Others = std::vector<Other> Column::*;

/// One of the statements (1) to (4). For the sign +, z must not be above x + offset D for some x,
/// except where z is not above y + allowed_offset D for some y; for the sign -, not below.
struct HeightTest {
    int sign;
    Others from;
    int offset;
    Others allowed;
    int allowed_offset;
    Rule rule;
    const char* sentence;
};

constexpr std::array<HeightTest, 4> height_tests{{
    {1, &Column::own, 0, &Column::below, 1, Rule::R63_layer_heights,
     "is above the surface of its layer, and no harder layer below lifts it"},
    {-1, &Column::own, 0, &Column::above, -1, Rule::R63_layer_heights,
     "is below the surface of its layer, and no harder layer above presses it down"},
    {1, &Column::above, -1, &Column::below, 1, Rule::R66_layer_thickness,
     "is nearer to a harder layer above than the thickness, and there is room below"},
    {-1, &Column::below, 1, &Column::above, 0, Rule::R66_layer_thickness,
     "is nearer to a harder layer below than the thickness, and not on one above"},
}};

class ThicknessChecker {
public:
    ThicknessChecker(const LayerSheets& sheets, Violations& found) :
        s_(sheets), claim_(sheets.claim), found_(found) {}

    void check() {
        for (std::uint32_t t = 0; t < claim_.triangles.size(); ++t) {
            check_triangle(t);
            if (found_.size() >= most_contacts_listed) return;
        }
    }

private:
    void report(Rule rule, std::uint32_t t, const std::string& sentence) {
        found_.push_back({rule, {t}, "triangle " + text(t) + " " + sentence});
    }

    void check_triangle(std::uint32_t t) {
        bool on_all = true, same_side = !s_.seen[t];
        for (const std::uint32_t i : claim_.surfaces_of[t]) {
            const auto own = s_.near_one(i, corners_of(t), s_.near_triangles(i, s_.boxes[t]));
            if (own) {
                same_side = same_side || faces_as(t, s_.surfaces[i].triangles[*own]);
            } else if (!is_on_moved(t, i)) {
                on_all = false;
                report(Rule::R63_layer_heights, t,
                       "is neither on the surface of " + s_.name(i) +
                           " nor on a harder one moved by a multiple of the thickness");
            }
            if (s_.seen[t]) check_heights(column_of(t, i, own.has_value()));
        }
        if (on_all && !same_side && !s_.faces_aside(t) && !faces_right(t))
            report(Rule::R65_layer_sides, t, "faces another side than the surface that it is on");
    }

    [[nodiscard]] bool faces_as(std::uint32_t t, const Seen& s) const {
        return s.flipped == s_.seen[t]->flipped;
    }

    // --- Surfaces, moved by multiples of the thickness -------------------------------------------

    [[nodiscard]] std::array<Vector4, 3> corners_of(std::uint32_t t) const {
        const Triangle& c = claim_.triangles[t];
        return {s_.points[c[0]], s_.points[c[1]], s_.points[c[2]]};
    }

    /// Calls visit(s) for triangles s of the surface of a layer, moved by multiples of the
    /// thickness, that a triangle is within d of, until one returns true; tells whether one did. A
    /// layer is moved at most once for each other one.
    template <class Visit>
    bool any_moved(std::uint32_t t, std::uint32_t layer, const Visit& visit) const {
        const int most = static_cast<int>(claim_.order.size());
        const Sheet& sheet = s_.surfaces[layer];
        const Box around = without_height(widened_by(s_.boxes[t], s_.reach));
        for (const std::uint32_t s : sheet.tree.touching(around))
            for (int steps = -most; steps <= most; ++steps) {
                Box box = s_.boxes[t];
                const double by = steps * *claim_.thickness;
                box.low[2] -= by;
                box.high[2] -= by;
                if (!touch(sheet.boxes[s], widened_by(box, s_.reach))) continue;
                auto corners = corners_of(t);
                for (Vector4& corner : corners) corner[2] -= steps * s_.thickness;
                if (s_.near_one(layer, corners, {s}) && visit(sheet.triangles[s])) return true;
            }
        return false;
    }

    [[nodiscard]] bool is_on_moved(std::uint32_t t, std::uint32_t i) const {
        for (std::uint32_t j = 0; j < claim_.order.size(); ++j)
            if (s_.is_harder(j, i) && any_moved(t, j, [](const Seen&) { return true; }))
                return true;
        return false;
    }

    [[nodiscard]] bool faces_right(std::uint32_t t) const {
        for (std::uint32_t j = 0; j < claim_.order.size(); ++j)
            if (any_moved(t, j, [&](const Seen& s) { return faces_as(t, s); })) return true;
        return false;
    }

    // --- Heights ---------------------------------------------------------------------------------

    /// Adds the triangles of a sheet that may be over and under a triangle.
    void add_others(const Sheet& sheet, std::uint32_t t, std::vector<Other>& others) const {
        for (const std::uint32_t o : sheet.tree.touching(s_.boxes[t]))
            others.push_back({&sheet.triangles[o], &sheet.boxes[o]});
    }

    /// Finds what decides the height of a triangle of layer i. A triangle that is on its surface is
    /// neither above nor below it.
    [[nodiscard]] Column column_of(std::uint32_t t, std::uint32_t i, bool on_own) const {
        const UpwardCorners& c = s_.seen[t]->corners;
        Column column{
            t,  i, {place_of(*c[0]), place_of(*c[1]), place_of(*c[2])}, height_function(c), {},
            {}, {}};
        if (!on_own) add_others(s_.surfaces[i], t, column.own);
        for (std::uint32_t j = 0; j < claim_.order.size(); ++j)
            if (s_.is_harder(j, i))
                add_others(s_.layers[j], t, j < i ? column.above : column.below);
        return column;
    }

    void check_heights(const Column& column) {
        for (const HeightTest& test : height_tests) {
            const mpq_class slack = s_.deviation;
            bool wrong = false;
            for (const PlacePolygon& part : wrong_parts(column, test, column.places, slack)) {
                const mpq_class steeper = slack * (1 + slope_near(part, column.layer));
                for (const PlacePolygon& rest : wrong_parts(column, test, part, steeper))
                    wrong = wrong || !is_at_borders(rest, column.triangle);
            }
            if (wrong)
                report(test.rule, column.triangle,
                       std::string(test.sentence) + " (" + s_.name(column.layer) + ")");
        }
    }

    /// Returns the height of the plane of a triangle, which many others ask for.
    const PlanFunction& height_of(const Seen& triangle) {
        const auto [at, added] = heights_.try_emplace(&triangle);
        if (added) at->second = height_function(triangle.corners);
        return at->second;
    }

    /// Returns a function that is positive where z is on the wrong side of the height of another
    /// triangle, moved by a multiple of the thickness, by more than the slack.
    [[nodiscard]] PlanFunction wrong_side(const Column& column, const Other& other, int sign,
                                          int offset, const mpq_class& slack) {
        const PlanFunction& height = height_of(*other.seen);
        const mpq_class moved = offset * s_.thickness;
        return {sign * (column.height.x - height.x), sign * (column.height.y - height.y),
                sign * (column.height.one - height.one - moved) - slack};
    }

    /// Tells whether boxes show that z is on the wrong side of another triangle nowhere.
    [[nodiscard]] bool is_clear(const Column& column, const Other& other,
                                const HeightTest& test) const {
        constexpr double endless = std::numeric_limits<double>::infinity();
        const double by = test.offset * *claim_.thickness;
        const Box& own = s_.boxes[column.triangle];
        return test.sign > 0 ? own.high[2] <= std::nextafter(other.box->low[2] + by, -endless)
                             : own.low[2] >= std::nextafter(other.box->high[2] + by, endless);
    }

    /// Returns the parts of a polygon where one of the statements (1) to (4) holds.
    [[nodiscard]] std::vector<PlacePolygon> wrong_parts(const Column& column,
                                                        const HeightTest& test,
                                                        const PlacePolygon& polygon,
                                                        const mpq_class& slack) {
        std::vector<PlacePolygon> wrong;
        for (const Other& other : column.*test.from) {
            if (is_clear(column, other, test) ||
                are_beside(s_.seen[column.triangle]->corners, other.seen->corners))
                continue;
            PlacePolygon first =
                part_where(polygon, wrong_side(column, other, test.sign, test.offset, slack));
            first = common_part(std::move(first), other.seen->corners);
            if (!has_area(first)) continue;
            std::vector<PlacePolygon> parts{std::move(first)};
            for (const Other& allowing : column.*test.allowed) {
                if (parts.empty()) break;
                if (are_beside(s_.seen[column.triangle]->corners, allowing.seen->corners)) continue;
                PlanFunction right =
                    wrong_side(column, allowing, test.sign, test.allowed_offset, slack);
                for (mpq_class* c : {&right.x, &right.y, &right.one}) *c = -*c;
                parts = all_without(std::move(parts), [&](const PlacePolygon& part) {
                    return common_part(part_where(part, right), allowing.seen->corners);
                });
            }
            wrong.insert(wrong.end(), parts.begin(), parts.end());
        }
        return wrong;
    }

    /// Removes from each polygon what is removed_from(polygon).
    template <class RemovedFrom>
    static std::vector<PlacePolygon> all_without(std::vector<PlacePolygon> parts,
                                                 const RemovedFrom& removed_from) {
        std::vector<PlacePolygon> left;
        for (PlacePolygon& part : parts) {
            const PlacePolygon removed = removed_from(part);
            if (!has_area(removed)) {
                left.push_back(std::move(part));
                continue;
            }
            auto rest = without(std::move(part), removed);
            left.insert(left.end(), rest.begin(), rest.end());
        }
        return left;
    }

    // --- Slopes and borders ----------------------------------------------------------------------

    [[nodiscard]] Box box_of(const PlacePolygon& polygon) const {
        constexpr double endless = std::numeric_limits<double>::infinity();
        Box box{{endless, endless, -endless}, {-endless, -endless, endless}};
        for (const Place& p : polygon) {
            const std::array<mpq_class, 2> at{p.x / s_.scale, p.y / s_.scale};
            for (std::size_t k = 0; k < 2; ++k) {
                const double near = at[k].get_d(); // truncated; the coordinates are of doubles
                box.low[k] = std::min(box.low[k], std::nextafter(near, -endless));
                box.high[k] = std::max(box.high[k], std::nextafter(near, endless));
            }
        }
        return box;
    }

    /// Returns the largest slope of the surfaces that decide the height of a layer, near a polygon.
    [[nodiscard]] mpq_class slope_near(const PlacePolygon& polygon, std::uint32_t i) {
        const Box box = without_height(widened_by(box_of(polygon), s_.reach));
        mpq_class largest = 0;
        for (std::uint32_t j = 0; j < claim_.order.size(); ++j) {
            if (j != i && !s_.is_harder(j, i)) continue;
            for (const std::uint32_t t : s_.surfaces[j].tree.touching(box)) {
                const PlanFunction& f = height_of(s_.surfaces[j].triangles[t]);
                const mpq_class slope = abs(f.x) + abs(f.y);
                if (slope > largest) largest = slope;
            }
        }
        return largest;
    }

    /// Tells whether a polygon is in the strips as wide as 4 d along borders of surfaces.
    [[nodiscard]] bool is_at_borders(const PlacePolygon& polygon, std::uint32_t t) const {
        std::vector<PlacePolygon> parts{polygon};
        for (const std::uint32_t b : s_.borders_near(s_.boxes[t])) {
            const PlacePolygon strip = strip_along(s_.borders[b]);
            parts = all_without(std::move(parts),
                                [&](const PlacePolygon& part) { return common_part(part, strip); });
        }
        return parts.empty();
    }

    /// Returns the rectangle of the places within 2 d of a segment along and across it, whose
    /// sides' directions are rounded.
    [[nodiscard]] PlacePolygon strip_along(const SegmentInPlan& segment) const {
        const auto& [a, b] = segment;
        const mpq_class dx = (b.x - a.x) / s_.scale, dy = (b.y - a.y) / s_.scale;
        const double length = std::hypot(dx.get_d(), dy.get_d());
        if (!(length > 0) || !std::isfinite(length)) return {};
        const mpq_class u = s_.width * mpq_class(dx.get_d() / length),
                        v = s_.width * mpq_class(dy.get_d() / length);
        return {{a.x - u + v, a.y - v - u},
                {b.x + u + v, b.y + v - u},
                {b.x + u - v, b.y + v + u},
                {a.x - u - v, a.y - v + u}};
    }

    const LayerSheets& s_;
    const LayeredClaim& claim_;
    Violations& found_;
    std::unordered_map<const Seen*, PlanFunction> heights_;
};

} // namespace

void check_thickness(const LayerSheets& sheets, Violations& found) {
    ThicknessChecker(sheets, found).check();
}

} // namespace terrane::verifier
