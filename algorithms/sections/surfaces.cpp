// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces along which models are cut.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

Error refused(std::string sentence) {
    return {ErrorCode::bad_option, std::move(sentence), "section"};
}

struct Extent {
    Point3 low, high;
};

Result<Extent> extent_of(const Mesh& mesh) {
    if (mesh.triangles.empty())
        return Error{ErrorCode::nothing_to_do, "there is no triangle to cut", "section"};
    std::optional<Extent> box;
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) {
            if (v >= mesh.vertices.size())
                return Error{ErrorCode::bad_index, "a triangle names a vertex that is not there",
                             ""};
            const Point3& p = mesh.vertices[v];
            if (!box) box = Extent{p, p};
            box->low = {std::min(box->low.x, p.x), std::min(box->low.y, p.y),
                        std::min(box->low.z, p.z)};
            box->high = {std::max(box->high.x, p.x), std::max(box->high.y, p.y),
                         std::max(box->high.z, p.z)};
        }
    return *box;
}

Point3 scaled(const Point3& p, double by) {
    return {p.x * by, p.y * by, p.z * by};
}
Point3 plus(const Point3& a, const Point3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Point3 unit_of(const Point3& p) {
    const double long_by = length(p);
    return {p.x / long_by, p.y / long_by, p.z / long_by};
}

/// Returns the least power of two not below a positive number.
double power_above(double x) {
    int exponent = 0;
    return std::frexp(x, &exponent) == 0.5 ? x : std::ldexp(1.0, exponent);
}

/// Appends a triangle in the plane through a point that contains a disc with this radius; `right` and `up` are
/// directions of any length. Steps are powers of two times these, so that short numbers stay exact.
Status append_plane(const Point3& point, const Point3& right, const Point3& up, double radius,
                    Surface& surface) {
    const auto too_far = [] {
        return refused(
            "lies so far from the model, or the model is so large, that doubles do not suffice");
    };
    if (!std::isfinite(radius)) return too_far();
    const Point3 along = scaled(right, power_above(radius / length(right)));
    const Point3 across = scaled(up, power_above(radius / length(up)));
    const auto first = static_cast<std::uint32_t>(surface.vertices.size());
    for (const auto& [i, j] : {std::pair{-1.0, -1.0}, {3.0, -1.0}, {-1.0, 3.0}}) {
        surface.vertices.push_back(plus(point, plus(scaled(along, i), scaled(across, j))));
        if (!is_finite(surface.vertices.back())) return too_far();
    }
    surface.triangles.push_back({first, first + 1, first + 2});
    return Done{};
}

/// Returns a bound of the distance from a point to all of a box; not 0.
double reach_of(const Extent& box, const Point3& from) {
    const Point3 low = minus(box.low, from), high = minus(box.high, from);
    const double most = length({std::max(std::abs(low.x), std::abs(high.x)),
                                std::max(std::abs(low.y), std::abs(high.y)),
                                std::max(std::abs(low.z), std::abs(high.z))});
    return most > 0 ? 2 * most : 1;
}

Surface named(const char* name) {
    return {name, Role::unknown, {}, {}};
}

/// Whether two segments in the map have a point in common.
bool touch(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    const Sign abc = orient2d(Axis::z, a, b, c), abd = orient2d(Axis::z, a, b, d),
               cda = orient2d(Axis::z, c, d, a), cdb = orient2d(Axis::z, c, d, b);
    if (abc == Sign::Zero && abd == Sign::Zero)
        return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
    return abc * abd != Sign::Positive && cda * cdb != Sign::Positive;
}

/// Checks that a line in the map meets itself nowhere. Cost: quadratic.
Status check_fence(std::span<const Point3> line) {
    if (line.size() < 2) return refused("a fence needs two corners at least");
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const auto meets_at = [](const Point3& p) {
            return refused("the fence crosses or touches itself near " + place_text({p.x, p.y}));
        };
        if (line[i] == line[i + 1]) return meets_at(line[i]);
        for (std::size_t j = i + 2; j + 1 < line.size(); ++j)
            if (touch(line[i], line[i + 1], line[j], line[j + 1])) return meets_at(line[j]);
        if (i + 2 == line.size()) continue;
        // The next panel may not come back along this one: one of its ends would lie on the other.
        const Point3 &a = line[i], &b = line[i + 1], &c = line[i + 2];
        if (orient2d(Axis::z, a, b, c) == Sign::Zero && (a < b) == (c < b)) return meets_at(b);
    }
    return Done{};
}

/// The axes, that along which most of a surface is seen first.
std::array<Axis, 3> axes_by_area(const Surface& surface) {
    Point3 seen; // areas, seen along each axis
    for (const auto& [i, j, k] : surface.triangles) {
        const Point3& a = surface.vertices[i];
        const Point3 n = cross(minus(surface.vertices[j], a), minus(surface.vertices[k], a));
        seen = {seen.x + std::abs(n.x), seen.y + std::abs(n.y), seen.z + std::abs(n.z)};
    }
    std::array<Axis, 3> axes{Axis::z, Axis::x, Axis::y};
    const std::array area{seen.x, seen.y, seen.z};
    std::stable_sort(axes.begin(), axes.end(), [&](Axis a, Axis b) {
        return area[static_cast<std::size_t>(a)] > area[static_cast<std::size_t>(b)];
    });
    return axes;
}

/// Returns how the triangles of a surface turn, seen along an axis, if no two of them are seen at one place; Zero if
/// that is not shown. Errors: nothing_to_do, those of arrange().
Result<Sign> one_to_one_along(const Surface& surface, Axis axis, const Run& run) {
    Surface turned = surface; // its z is the axis; the exchange of coordinates is a rotation
    for (Point3& p : turned.vertices)
        p = axis == Axis::x ? Point3{p.y, p.z, p.x} : axis == Axis::y ? Point3{p.z, p.x, p.y} : p;
    const auto exact = arrange(std::array{std::move(turned)}, {}, run);
    if (!exact) return exact.error();
    if (exact->triangles.empty())
        return Error{ErrorCode::nothing_to_do, "the surface has no triangle with area",
                     surface.name};
    const InjectivePatches& patches = exact->state->patches;
    const std::uint32_t patch = patches.of[0];
    const bool is_one = patch < patches.axis.size() && patches.axis[patch] == Axis::z &&
                        std::all_of(patches.of.begin(), patches.of.end(),
                                    [&](std::uint32_t p) { return p == patch; });
    return is_one ? patches.turn[patch] : Sign::Zero;
}

} // namespace

Result<SectionSurface> section_plane(const Mesh& mesh, const Point3& point, const Point3& normal) {
    return guarded("for the section", "section_plane", [&]() -> Result<SectionSurface> {
        const auto box = extent_of(mesh);
        if (!box) return box.error();
        if (!is_finite(point) || !is_finite(normal)) return refused("a plane needs finite numbers");
        if (normal == Point3{}) return refused("the normal of a plane is not 0 0 0");
        const bool is_level = normal.x == 0 && normal.y == 0, is_upright = normal.z == 0;
        const Point3 right = is_level ? Point3{1, 0, 0} : Point3{-normal.y, normal.x, 0};
        const Point3 up = is_level     ? Point3{0, normal.z > 0 ? 1.0 : -1.0, 0}
                          : is_upright ? Point3{0, 0, 1}
                                       : cross(normal, right);
        if (length(right) == 0 || length(up) == 0 || !std::isfinite(length(up)))
            return refused("the normal of the plane is too long or too short");
        SectionSurface made{named("plane"), {0}, {{point, unit_of(right), unit_of(up), 0}}};
        if (is_upright) made.sheets[0].origin.z = 0;
        if (is_level) made.sheets[0].origin = {};
        if (const auto done = append_plane(point, right, up, reach_of(*box, point), made.surface);
            !done)
            return done.error();
        return made;
    });
}

Result<SectionSurface> section_levels(const Mesh& mesh, std::span<const double> heights) {
    return guarded("for the section", "section_levels", [&]() -> Result<SectionSurface> {
        const auto box = extent_of(mesh);
        if (!box) return box.error();
        if (heights.empty()) return refused("needs a height");
        std::vector<double> levels(heights.begin(), heights.end());
        if (!std::all_of(levels.begin(), levels.end(), [](double z) { return std::isfinite(z); }))
            return refused("heights are finite");
        sort_unique(levels);
        SectionSurface made{named("levels"), {}, {}};
        for (const double z : levels) {
            Extent flat = *box;
            flat.low.z = flat.high.z = z;
            const Point3 middle{box->low.x / 2 + box->high.x / 2, box->low.y / 2 + box->high.y / 2,
                                z};
            made.sheet_of.push_back(static_cast<std::uint32_t>(made.sheets.size()));
            made.sheets.push_back({{}, {1, 0, 0}, {0, 1, 0}, 0});
            if (const auto done = append_plane(middle, {1, 0, 0}, {0, 1, 0}, reach_of(flat, middle),
                                               made.surface);
                !done)
                return done.error();
        }
        return made;
    });
}

Result<SectionSurface> section_fence(const Mesh& mesh,
                                     std::span<const std::array<double, 2>> corners) {
    return guarded("for the section", "section_fence", [&]() -> Result<SectionSurface> {
        const auto box = extent_of(mesh);
        if (!box) return box.error();
        std::vector<Point3> line;
        for (const auto& [x, y] : corners) line.push_back({x, y, 0});
        if (!std::all_of(line.begin(), line.end(), is_finite))
            return refused("corners of a fence are finite");
        if (const auto sound = check_fence(line); !sound) return sound.error();
        const double margin =
            std::max({box->high.z - box->low.z, std::abs(box->low.z), std::abs(box->high.z), 1.0}) /
            64;
        SectionSurface made{named("fence"), {}, {}};
        double start = 0;
        for (std::uint32_t k = 0; k < line.size(); ++k) {
            const Point3& p = line[k];
            made.surface.vertices.push_back({p.x, p.y, box->low.z - margin});
            made.surface.vertices.push_back({p.x, p.y, box->high.z + margin});
            if (k + 1 == line.size()) break;
            const std::uint32_t v = 2 * k;
            made.surface.triangles.push_back({v, v + 2, v + 3});
            made.surface.triangles.push_back({v, v + 3, v + 1});
            made.sheet_of.insert(made.sheet_of.end(), 2, k);
            const Point3 way = minus(line[k + 1], p);
            made.sheets.push_back({p, unit_of(way), {0, 0, 1}, start});
            start += length(way);
        }
        return made;
    });
}

Result<SectionSurface> section_along(const Surface& surface, const Run& run) {
    return guarded("for the section", "section_along", [&]() -> Result<SectionSurface> {
        if (const auto valid = validate(std::array{surface}); !valid) return valid.error();
        for (const Axis axis : axes_by_area(surface)) {
            const auto turn = one_to_one_along(surface, axis, run);
            if (!turn) return turn.error();
            if (*turn == Sign::Zero) continue;
            SectionSurface made{
                surface, std::vector<std::uint32_t>(surface.triangles.size(), 0), {}};
            made.sheets.push_back(axis == Axis::z   ? SectionSheet{{}, {1, 0, 0}, {0, 1, 0}}
                                  : axis == Axis::x ? SectionSheet{{}, {0, 1, 0}, {0, 0, 1}}
                                                    : SectionSheet{{}, {1, 0, 0}, {0, 0, 1}});
            // Seen along y, x and z are clockwise.
            if ((*turn == Sign::Negative) != (axis == Axis::y))
                for (Triangle& t : made.surface.triangles) std::swap(t[1], t[2]);
            return made;
        }
        return refused(
            "the surface folds over, or its triangles face different ways: seen along x, y "
            "or z, each point may lie on one triangle only");
    });
}

} // namespace terrane
