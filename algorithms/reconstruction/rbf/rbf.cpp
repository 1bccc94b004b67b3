// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/holes/expected_points.hpp>
#include <terrane/algorithms/reconstruction/holes/flatness.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/fit.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/zero_level.hpp>

namespace terrane {

using namespace rbf::detail;

namespace {

using rbf::detail::constants;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Computes the least edge length for which equilateral triangles over the hole have no more
/// vertices than allowed.
double least_size(const BorderLoop& loop, const RbfOptions& options) {
    const double per_vertex = std::sqrt(3.0) / 2; // area, in squares of the edge length
    return std::sqrt(loop.area / (per_vertex * static_cast<double>(options.most_vertices)));
}

/// Lists the edges at which the data end, except for the border of the hole, as degenerate
/// triangles.
std::vector<Triangle> rim_of(const RbfData& data) {
    std::vector<Triangle> rim;
    group_edges(data.triangles, data.points.size())
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            const bool of_hole =
                high < data.next.size() && (data.next[low] == high || data.next[high] == low);
            if (sides.size() == 1 && !of_hole) rim.push_back({low, high, high});
        });
    return rim;
}

/// Excludes the region over the surface away from the border and beyond the end of the data.
class DomainMask {
public:
    /// `tree`: of the data's triangles.
    DomainMask(const RbfData& data, const TriangleTree& tree, double size) :
        points_(data.points), size_(size), surface_(tree), rim_(data.points, rim_of(data)),
        border_(data.points, border_edges(data)) {}

    /// Tells whether p is excluded. `ahead` gives the direction that the zero level at p faces. Not
    /// thread-safe: results for one point serve those near it.
    template <class Ahead>
    [[nodiscard]] bool operator()(const Point3& p, const Ahead& ahead) {
        const auto known = inside_.find(cell_of(p));
        if (known != inside_.end() && length(minus(p, known->second.centre)) < known->second.radius)
            return false;
        const double margin = constants.mask_margin * size_, under = constants.mask_under * size_;
        const double border = border_.distance(p, std::numeric_limits<double>::infinity());
        if (border < margin) return false;
        const auto surface = surface_.nearest(p, border);
        const double distance = surface ? surface->distance : border;
        // Beyond the data, the nearest of them is on their rim.
        if (distance >= under) {
            const double rim = rim_.distance(p, std::numeric_limits<double>::infinity());
            // Distances change no faster than p does.
            const double radius =
                constants.mask_sure * std::min(distance - under, (rim - distance) / 2);
            if (radius > 0) inside_.insert_or_assign(cell_of(p), Ball{p, radius});
            if (rim > distance) return false;
        }
        if (!surface) return false;
        // Another limb of a fold may be as near, but it faces the other way.
        return dot(normal_of(surface->triangle), ahead(p)) > 0;
    }

private:
    static std::vector<Triangle> border_edges(const RbfData& data) {
        std::vector<Triangle> edges;
        for (std::uint32_t i = 0; i < data.next.size(); ++i)
            edges.push_back({i, data.next[i], data.next[i]});
        return edges;
    }

    struct Ball {
        Point3 centre{};
        double radius = 0;
    };
    using Cell = std::array<double, 3>; ///< integers

    [[nodiscard]] Cell cell_of(const Point3& p) const {
        const double width = 12 * size_;
        return {std::floor(p.x / width), std::floor(p.y / width), std::floor(p.z / width)};
    }

    [[nodiscard]] Point3 normal_of(const Triangle& t) const {
        return cross(minus(points_[t[1]], points_[t[0]]), minus(points_[t[2]], points_[t[0]]));
    }

    std::span<const Point3> points_;
    double size_;
    const TriangleTree& surface_;
    TriangleTree rim_, border_;
    std::map<Cell, Ball> inside_; ///< per cell: the last ball that contains no excluded point
};

/// Step (5): triangulates the zero level.
Result<Surface> mesh_zero_level(const Implicit& f, const RbfData& data, const TriangleTree& tree,
                                double size, const Run& run) {
    DomainMask outside(data, tree, size);
    ZeroLevelOptions options;
    options.size = size;
    options.seeds = std::span(data.points).first(data.next.size());
    const SpaceFunction function{[&](const Point3& p) { return f(p); },
                                 [&](const Point3& p) { return f.smooth.gradient(p); }};
    options.leave = [&](const Point3& p) { return outside(p, function.gradient); };
    return zero_level(function, options, run);
}

/// The zero level over the hole, and the data it comes from.
struct Level {
    const Implicit& f;
    double precision; ///< root mean square error at data left out; NaN if unknown
    const RbfData& data;
    const TriangleTree& tree; ///< of the data's triangles
};

/// Tells whether the triangles cut corners at the border: whether the zero level there is farther
/// from them than a share of their size.
bool cuts_corners(const Surface& mesh, const Level& level, double size) {
    const TriangleTree tree(mesh.vertices, mesh.triangles);
    const auto border = std::span(level.data.points).first(level.data.next.size());
    return std::any_of(border.begin(), border.end(), [&](const Point3& p) {
        const Point3 g = level.f.smooth.gradient(p);
        const double step = -level.f(p) / dot(g, g);
        const Point3 on{p.x + step * g.x, p.y + step * g.y, p.z + step * g.z};
        return tree.distance(on, size) > constants.cut_corner * size;
    });
}

/// Tells whether smaller triangles would bring the filling nearer to the truth.
bool is_too_flat(const Surface& mesh, const Level& level, double size) {
    const RbfFunction& f = level.f.smooth; // patches fade within less than an edge
    std::vector<double> sags;
    for (const auto& [a, b] :
         detail::some_inner_edges(mesh.triangles, mesh.vertices.size(), constants.most_sags)) {
        const Point3 &p = mesh.vertices[a], &q = mesh.vertices[b], m = middle_of(p, q);
        const double over = constants.over_surface * size;
        if (level.tree.distance(m, over) < over) continue; // over the surface
        sags.push_back((f(m) - (f(p) + f(q)) / 2) / length(f.gradient(m)));
    }
    return detail::flatness_outweighs(sags, std::span(&level.precision, 1), size);
}

/// Triangulates the zero level with edges as long as those of the border, or a half or a quarter of
/// that where the surface turns too sharply for them or is known more precisely than they can
/// represent; with no more vertices than allowed.
Result<Surface> mesh_to_size(const Level& level, const BorderLoop& loop, const RbfOptions& options,
                             double& size, const Run& run) {
    const double least = least_size(loop, options);
    size = options.size > 0 ? options.size : std::max(level.data.edge, least);
    auto mesh = mesh_zero_level(level.f, level.data, level.tree, size, run);
    if (options.size > 0) return mesh;
    for (unsigned halvings = 0; halvings < detail::most_halvings && size / 2 >= least; ++halvings) {
        if (!mesh ||
            !(cuts_corners(mesh.value(), level, size) || is_too_flat(mesh.value(), level, size)))
            break;
        auto finer = mesh_zero_level(level.f, level.data, level.tree, size / 2, run);
        // The finer mesh may be too large.
        if (!finer && finer.error().code != ErrorCode::interrupted) break;
        size /= 2;
        mesh = std::move(finer);
    }
    return mesh;
}

std::string describe(const RbfReport& r, const RbfForm& form, bool smoothed) {
    const auto start = fmt::format(
        "degree {}{}, {} of {} data are centres, {} constraints {} off the surface {}; ",
        form.polynomial.degree, form.polynomial.in_space ? " in space" : "", r.centres, r.data,
        r.offsets, figure(r.offset, 4), form.along_axis ? "across the hole" : "along normals");
    return start + fmt::format("{}data missed by {} at most, then by {}",
                               smoothed ? "smoothed; " : "", figure(r.missed, 2),
                               figure(r.largest_error, 2));
}

Error interrupted() {
    return Error{ErrorCode::interrupted, "stopped on request", ""};
}

Result<Filling> fill_valid(const Surface& surface, const BorderLoop& loop,
                           const RbfOptions& options, RbfReport& report, const Run& run) {
    const auto data = collect_data(surface, loop, options.loops,
                                   {options.reach, options.rings, options.long_edges});
    if (!data) return data.error();
    const TriangleTree tree(data.value().points, data.value().triangles);
    report = {};
    const auto choice = choose_form(*data, options, run); // steps (2) to (4)
    if (!choice) return choice.error();
    report.degree = choice->form.polynomial.degree;
    const auto f = fit_hole(*data, tree, choice->form, options, report, run);
    if (run.stop.stop_requested()) return interrupted();
    if (!f) return f.error();
    const Level level{*f, choice->validated, *data, tree};
    auto mesh = mesh_to_size(level, loop, options, report.size, run);
    if (!mesh) return mesh.error();
    Filling filling;
    filling.surface = std::move(mesh).value();
    filling.surface.name = surface.name;
    filling.surface.role = surface.role;
    filling.expected_error.assign(filling.surface.vertices.size(), no_number);
    filling.report.data = report.data;
    filling.report.interpolated = filling.surface.vertices.size();
    filling.report.area = area_of(filling.surface);
    filling.report.expected_error = no_number;
    filling.report.validated_error = choice->validated;
    filling.report.left_out = choice->left_out;
    filling.report.model =
        describe(report, choice->form, choice->form.smoothed || options.smoothing);
    if (options.long_edges) filling.report.model += "; with points on long edges";
    if (run.stop.stop_requested()) return interrupted();
    return filling;
}

} // namespace

Status validate_options(const RbfOptions& o) {
    const auto bad = [](const char* what) { return Error{ErrorCode::bad_option, what, ""}; };
    const auto length_or_zero = [](double x) { return x >= 0 && std::isfinite(x); };
    if (!length_or_zero(o.reach)) return bad("the reach of the data is no number of radii");
    if (o.most_centres < 10 || o.most_centres > 2000) return bad("centres: 10 to 2000");
    if (!length_or_zero(o.size)) return bad("the size is a length");
    if (o.degree > 8) return bad("the degree of the polynomial is 1 to 8, or 0 for the best");
    if (o.smoothing && !length_or_zero(*o.smoothing)) return bad("smoothing is a length");
    if (o.most_vertices < 1) return bad("at least one vertex");
    return Done{};
}

Result<Filling> fill_by_rbf(const Surface& surface, const BorderLoop& loop,
                            const RbfOptions& options, const Run& run, RbfReport* report) {
    return guarded("for the filling", "fill", [&]() -> Result<Filling> {
        RbfReport unused;
        RbfReport& told = report != nullptr ? *report : unused;
        told = {};
        if (const auto good = validate_options(options); !good) return good.error();
        if (auto sound = check_edge_length(loop, options.size); !sound) return sound.error();
        return fill_valid(surface, loop, options, told, run);
    });
}

std::vector<NamedConstant> rbf_constants() {
    return rbf::detail::constants.listed();
}

} // namespace terrane
