// SPDX-License-Identifier: LGPL-3.0-or-later
//
// This file is LGPL; the library it becomes part of, terrane::tetgen, contains TetGen (AGPL), so
// that the combination is AGPL.
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/is_external.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/tetgen/detail/assembly.hpp>
#include <terrane/algorithms/tetgen/detail/constants.hpp>
#include <terrane/algorithms/tetgen/detail/process.hpp>
#include <terrane/algorithms/tetgen/detail/protocol.hpp>
#include <terrane/algorithms/tetgen/detail/shapes.hpp>
#include <terrane/algorithms/tetgen/detail/sizes.hpp>
#include <terrane/algorithms/tetgen/detail/ways.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/sharpest_angle.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

using namespace tetgen::detail;

namespace {

// ---- 1. Options and mesh are sound ------------------------------------------------------------

Error bad_option(std::string sentence) {
    return {ErrorCode::bad_option, std::move(sentence), ""};
}

Status check_length(const char* name, const std::optional<double>& value) {
    if (value && !(std::isfinite(*value) && *value > 0))
        return bad_option(fmt::format("{} must be a positive number, not {}", name, *value));
    return Done{};
}

/// Tells whether Gmsh can do what is asked for.
bool sizes_for_gmsh(const TetrahedraOptions& options) {
    return options.block_sizes.empty() && options.surface_sizes.empty() && !options.split_surfaces;
}

Status check_options(const TetrahedraOptions& options) {
    if (!options.box)
        if (Status margin = check_length("margin", options.margin); !margin) return margin;
    if (!options.box && options.margin > constants.most_enlargement)
        return bad_option(fmt::format("margin must be at most {}, not {}",
                                      constants.most_enlargement, options.margin));
    if (options.box) {
        const auto& [low, high] = *options.box;
        if (!is_finite(low) || !is_finite(high) || low.x >= high.x || low.y >= high.y ||
            low.z >= high.z)
            return bad_option("box must have finite corners, low < high in each coordinate");
    }
    const auto& ratio = options.radius_edge_ratio;
    if (ratio && !(std::isfinite(*ratio) && *ratio >= constants.least_ratio))
        return bad_option(fmt::format("radius_edge_ratio must be at least {}, not {}",
                                      constants.least_ratio, *ratio));
    if (options.split_surfaces && !ratio && options.mesher != Mesher::gmsh)
        return bad_option("split_surfaces changes nothing without a bound of shapes");
    if (!(options.time_limit > 0)) return bad_option("time_limit must be positive");
    if (options.mesher == Mesher::gmsh && !sizes_for_gmsh(options))
        return bad_option("Gmsh has no sizes of single blocks or surfaces, and divides no surface");
    if (options.mesher == Mesher::gmsh && options.radius_edge_ratio)
        return bad_option("Gmsh has no bound on the ratio of circumradius to shortest edge; it "
                          "makes shapes as good as it can");
    if (Status length = check_length("edge_length", options.edge_length); !length) return length;
    return check_length("max_volume", options.max_volume);
}

// ---- 2. The box -------------------------------------------------------------------------------

bool strictly_inside(const Point3& p, const Box3& box) {
    const auto& [low, high] = box;
    return low.x < p.x && low.y < p.y && low.z < p.z && p.x < high.x && p.y < high.y &&
           p.z < high.z;
}

Box3 bounds_of(std::span<const Point3> points) {
    Box3 box{points[0], points[0]};
    for (const Point3& p : points) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y),
                    std::max(box.high.z, p.z)};
    }
    return box;
}

/// Returns the longest edge.
double length_of(const Box3& box) {
    return std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z});
}

Box3 enlarged_bounds(std::span<const Point3> points, double margin) {
    Box3 box = bounds_of(points);
    const auto largest = [](const Point3& p) {
        return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    };
    const double add =
        std::max(margin * length_of(box),
                 constants.least_margin * std::max(largest(box.low), largest(box.high)));
    const auto below = [&](double x) { return std::min(x - add, std::nextafter(x, -HUGE_VAL)); };
    const auto above = [&](double x) { return std::max(x + add, std::nextafter(x, HUGE_VAL)); };
    box.low = {below(box.low.x), below(box.low.y), below(box.low.z)};
    box.high = {above(box.high.x), above(box.high.y), above(box.high.z)};
    return box;
}

Result<Box3> box_around(std::span<const Point3> points, const TetrahedraOptions& options) {
    if (!options.box && points.empty())
        return Error{ErrorCode::nothing_to_do, "no triangle and no box", ""};
    const Box3 box = options.box ? *options.box : enlarged_bounds(points, options.margin);
    if (!is_finite(box.low) || !is_finite(box.high))
        return bad_option("margin makes the box larger than numbers can be");
    for (const Point3& p : points)
        if (!strictly_inside(p, box))
            return bad_option(fmt::format("{} leaves {} on or outside of the box",
                                          options.box ? "box" : "margin", place_text(p)));
    if (!options.box || points.empty()) return box;
    const double times = length_of(box) / length_of(bounds_of(points));
    if (times > constants.most_enlargement)
        return bad_option(fmt::format("box is {} times as long as the surfaces; at most {} "
                                      "can be filled",
                                      figure(times, 3), figure(constants.most_enlargement)));
    return box;
}

// ---- 3. The domain: used vertices, box corners, facets ------------------------------------------

void keep_used_vertices(const Mesh& mesh, TetgenDomain& domain) {
    domain.triangles = mesh.triangles;
    domain.points = Submesh(mesh.vertices).cut(domain.triangles);
}

/// Corner i is high in x, y, z where bit 0, 1, 2 of i is set.
void add_box_corners(TetgenDomain& domain) {
    const auto& [low, high] = domain.box;
    for (unsigned i = 0; i < 8; ++i)
        domain.points.push_back({(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                                 (i & 4U) != 0 ? high.z : low.z});
}

Result<TetgenDomain> make_domain(const Mesh& mesh, const TetrahedraOptions& options) {
    TetgenDomain domain;
    keep_used_vertices(mesh, domain);
    Result<Box3> box = box_around(domain.points, options);
    if (!box) return box.error();
    domain.box = box.value();
    add_box_corners(domain);
    return domain;
}

// ---- 4. The meshers -------------------------------------------------------------------------------

/// Scales coordinates by 2^-exponent, to at most 1, which is exact and keeps TetGen from overflow.
/// If that would lose digits of the smallest coordinates, the exponent is 0.
class Scale {
public:
    explicit Scale(std::span<const Point3> points) {
        double largest = 0;
        for (const Point3& p : points)
            largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        std::frexp(largest, &exponent_);
        const bool exact = std::all_of(points.begin(), points.end(),
                                       [&](const Point3& p) { return up(down(p)) == p; });
        if (!exact) exponent_ = 0;
    }
    [[nodiscard]] Point3 down(const Point3& p) const { return times(p, -exponent_); }
    [[nodiscard]] Point3 up(const Point3& p) const { return times(p, exponent_); }
    /// Scales a length (dimension 1), an area (2) or a volume (3).
    [[nodiscard]] double down(double measure, int dimension) const {
        return std::ldexp(measure, -exponent_ * dimension);
    }

private:
    static Point3 times(const Point3& p, int exponent) {
        return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
    }
    int exponent_ = 0;
};

void add_facets(const TetgenDomain& domain, TetgenInput& input) {
    for (const Triangle& triangle : domain.triangles) input.facets.push_back(triangle);
    using Quad = std::array<std::uint32_t, 4>;
    constexpr std::array<Quad, 6> sides{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    const auto first = static_cast<std::uint32_t>(domain.points.size() - 8);
    for (Quad side : sides) {
        for (std::uint32_t& corner : side) corner += first;
        input.facets.push_back(side);
    }
}

/// Bounds on volumes and areas, scaled for TetGen.
class ScaledSizes {
public:
    ScaledSizes(const Sizes& sizes, const Scale& scale) : sizes_(sizes), scale_(scale) {}

    [[nodiscard]] double volume_in(std::size_t volume) const {
        constexpr double no_bound = 8; // coordinates are at most 1
        const auto& [length, max_volume] = sizes_.in_volumes[volume];
        return std::min({volume_of(scale_.down(length, 1)), scale_.down(max_volume, 3), no_bound});
    }
    [[nodiscard]] double area_for(double length) const { return area_of(scale_.down(length, 1)); }

private:
    const Sizes& sizes_;
    const Scale& scale_;
};

/// Refuses more tetrahedra than TetGen can count or memory can hold before any work is done.
Status check_count(const Volumes& volumes, const Box3& scaled_box, const Sizes& sizes,
                   const ScaledSizes& scaled, const Scale& scale) {
    const auto& [low, high] = scaled_box;
    const double whole = (high.x - low.x) * (high.y - low.y) * (high.z - low.z);
    double count = 0, rest = whole;
    for (std::size_t v = volumes.measures.size(); v-- > 0;) { // the outside last
        const double measure = v == 0 ? rest : std::min(scale.down(volumes.measures[v], 3), rest);
        rest -= measure;
        if (sizes.in_volumes[v].bounded()) count += measure / scaled.volume_in(v);
    }
    if (count <= constants.most_tetrahedra) return Done{};
    return bad_option(fmt::format("the wanted sizes would need more than {} tetrahedra",
                                  constants.most_tetrahedra));
}

/// Turns wanted edge lengths into volumes of regular tetrahedra and areas of their faces.
Status set_sizes(const Mesh& mesh, const Volumes& volumes, const TetgenDomain& domain,
                 const TetrahedraOptions& options, const Scale& scale, const Run& run,
                 TetgenInput& input) {
    const auto sizes = sizes_of(mesh, volumes, options);
    if (!sizes) return sizes.error();
    const ScaledSizes scaled(sizes.value(), scale);
    input.radius_edge_ratio = options.radius_edge_ratio;
    input.keep_facets =
        !sizes.value().any() && !(options.split_surfaces && input.radius_edge_ratio);
    if (!sizes.value().any()) return Done{};
    const Box3 box{scale.down(domain.box.low), scale.down(domain.box.high)};
    if (Status good = check_count(volumes, box, sizes.value(), scaled, scale); !good) return good;
    for (const double length : sizes.value().on_triangles)
        input.max_areas.push_back(scaled.area_for(length));
    input.max_areas.resize(input.facets.size(),
                           scaled.area_for(sizes.value().in_volumes[0].length));
    if (sizes.value().same_everywhere()) {
        if (sizes.value().in_volumes[0].bounded()) input.max_volume = scaled.volume_in(0);
        return Done{};
    }
    const auto points = points_of_bounded(mesh, volumes, domain.box, sizes.value(), run);
    if (!points) return points.error();
    for (const auto& [place, block] : points.value())
        input.blocks.push_back({scale.down(place), scaled.volume_in(block)});
    return Done{};
}

Result<TetgenInput> tetgen_input(const Mesh& mesh, const Volumes& volumes,
                                 const TetgenDomain& domain, const TetrahedraOptions& options,
                                 const Scale& scale, const Run& run) {
    TetgenInput input;
    for (const Point3& p : domain.points) input.points.push_back(scale.down(p));
    input.time_limit = options.time_limit;
    add_facets(domain, input);
    if (Status sizes = set_sizes(mesh, volumes, domain, options, scale, run, input); !sizes)
        return sizes.error();
    return input;
}

/// Adds to a failure what is likely to have caused it, with places.
Error with_causes(Error error, const Mesh& mesh) {
    if (error.code == ErrorCode::timed_out || !error.place.empty()) return error;
    const auto sharp = sharpest_angle(mesh);
    if (!sharp) return error;
    const ShortEdge shortest = shortest_edge(mesh);
    error.code = ErrorCode::unsupported;
    error.sentence += fmt::format(
        "; the sharpest angle between triangles, {} degrees, is here, the shortest "
        "edge, {}, at {}; meshers fail at such places; improved surfaces without "
        "gaps and slivers have fewer of them",
        figure(sharp->degrees, 2), figure(shortest.length, 3), place_text(shortest.place));
    error.place = place_text(sharp->place);
    return error;
}

/// Tells whether the same failure is to be expected in every other way of asking a mesher. An error
/// with a place is about the helper.
bool is_final(const Error& error) {
    return is_external(error.code) || !error.place.empty();
}

const char* name_of(Mesher mesher) {
    return mesher == Mesher::gmsh ? "Gmsh" : "TetGen";
}

/// Asks meshers in different ways until one gives tetrahedra that hold for the checks.
class Attempts {
public:
    Attempts(const Mesh& mesh, const Volumes& volumes, const TetgenDomain& domain,
             TetgenInput& input, const Scale& scale, const Run& run) :
        mesh_(mesh),
        volumes_(volumes), domain_(domain), input_(input), scale_(scale), run_(run) {}

    /// Returns the first result that holds, if there is one. An error ends the work.
    Result<std::optional<TetrahedralMesh>> operator()(const std::vector<Way>& ways,
                                                      const std::filesystem::path& helper) {
        std::optional<Error> first;
        bool endless = false; // with a bound on shapes
        for (const Way& way : ways) {
            if (endless && way.bound_shapes) continue;
            auto result = attempt(way, helper);
            if (result) return std::optional(std::move(result).value());
            if (is_final(result.error())) return result.error();
            if (!first) first = result.error();
            if (is_brief(way) && result.error().code == ErrorCode::timed_out) endless = true;
        }
        if (!failure_) failure_ = Error{first->code, "", ""};
        failure_->sentence += failure_->sentence.empty() ? "" : "; ";
        failure_->sentence += first->sentence;
        if (ways.size() > 1) failure_->sentence += ", in every way in which it was tried";
        return std::optional<TetrahedralMesh>();
    }

    /// Returns why no mesher gave a result.
    [[nodiscard]] Error failure() const { return with_causes(*failure_, mesh_); }

private:
    /// Tells whether a way has a part of the time only, as it may never end.
    [[nodiscard]] bool is_brief(const Way& way) const {
        return way.mesher == Mesher::tetgen && way.keep_facets && way.bound_shapes && ratio_;
    }

    /// Returns the seconds that a way has.
    [[nodiscard]] double limit_of(const Way& way) const {
        if (!is_brief(way)) return time_limit_;
        return std::min(time_limit_, std::max(constants.bounded_share * time_limit_,
                                              constants.bounded_seconds_per_point *
                                                  static_cast<double>(input_.points.size())));
    }

    Result<TetrahedralMesh> attempt(const Way& way, const std::filesystem::path& helper) {
        input_.time_limit = limit_of(way);
        input_.radius_edge_ratio = way.bound_shapes ? ratio_ : std::nullopt;
        input_.mesher = way.mesher;
        input_.keep_facets = way.keep_facets;
        input_.improve = way.improve;
        input_.sort_points = way.sort_points;
        input_.parallel_delaunay = way.parallel_delaunay;
        input_.helper = helper;
        if (way.mesher == Mesher::gmsh) set_sides(way.embed_all);
        Result<TetgenOutput> output = run_mesher(input_, run_.stop);
        if (!output) return output.error();
        for (Point3& p : output.value().points) p = scale_.up(p);
        Result<TetrahedralMesh> result =
            assemble(mesh_, domain_, std::move(output).value(), name_of(way.mesher), run_.stop);
        if (!result) return Error{result.error().code, result.error().sentence, ""};
        if (Status numbered = adopt_volume_numbers(volumes_, result.value()); !numbered)
            return Error{numbered.error().code, numbered.error().sentence, ""};
        result.value().mesher = name_of(way.mesher);
        if (failure_) result.value().failure = failure_->sentence;
        if (!way.bound_shapes)
            result.value().failure =
                "with a bound on the ratio of circumradius to shortest edge it "
                "gave no result in its time, so it was asked without";
        return result;
    }

    /// Sets what Gmsh wants to know of each facet: the blocks on its sides.
    void set_sides(bool embed_all) {
        input_.sides.clear();
        for (const auto& [front, behind] : volumes_.of_sides)
            input_.sides.push_back(embed_all ? BlockSides{0, 0} : BlockSides{front, behind});
        while (input_.sides.size() < input_.facets.size()) input_.sides.push_back({0, no_block});
    }

    const Mesh& mesh_;
    const Volumes& volumes_;
    const TetgenDomain& domain_;
    TetgenInput& input_;
    const Scale& scale_;
    const Run& run_;
    double time_limit_ = input_.time_limit;
    std::optional<double> ratio_ = input_.radius_edge_ratio; ///< the bound on shapes
    std::optional<Error> failure_;
};

Result<TetrahedralMesh> try_in_turn(const Mesh& mesh, const Volumes& volumes,
                                    const TetgenDomain& domain, const TetrahedraOptions& options,
                                    TetgenInput& input, const Scale& scale, const Run& run) {
    Attempts attempt(mesh, volumes, domain, input, scale, run);
    if (options.mesher != Mesher::gmsh) {
        const auto helper = find_tetgen_helper(options.helper);
        if (!helper) return helper.error();
        auto made = attempt(ways_of_tetgen(input), *helper);
        if (!made) return made.error();
        if (*made) return std::move(**made);
        if (options.mesher == Mesher::tetgen || !sizes_for_gmsh(options)) return attempt.failure();
    }
    const auto helper = find_gmsh_helper(options.gmsh_helper);
    if (!helper) return options.mesher == Mesher::gmsh ? helper.error() : attempt.failure();
    auto made = attempt(ways_of_gmsh(volumes), *helper);
    if (!made) return made.error();
    if (*made) return std::move(**made);
    return attempt.failure();
}

// ---- 5. The stage -----------------------------------------------------------------------------

Status proceed(const Run& run, double share) {
    if (run.progress) run.progress("tetrahedralize", share);
    if (run.stop.stop_requested())
        return Error{ErrorCode::interrupted, "stopped while making tetrahedra", ""};
    return Done{};
}

/// Checks that the helper of the mesher that is asked first is there.
Status find_helper(const TetrahedraOptions& options) {
    const auto helper = options.mesher == Mesher::gmsh ? find_gmsh_helper(options.gmsh_helper)
                                                       : find_tetgen_helper(options.helper);
    return helper ? Status(Done{}) : Status(helper.error());
}

Result<TetrahedralMesh> fill(const ConformingMesh& mesh, const Volumes& volumes,
                             const TetrahedraOptions& options, const Run& run) {
    if (Status good = check_options(options); !good) return good.error();
    if (Status valid = validate_mesh(*mesh, run); !valid) return valid.error();
    if (volumes.of_sides.size() != mesh->triangles.size())
        return Error{ErrorCode::bad_index, "the volumes are not those of the mesh", ""};
    if (Status there = find_helper(options); !there) return there.error();
    if (Status go = proceed(run, 0); !go) return go.error();

    const Result<TetgenDomain> domain = make_domain(mesh, options);
    if (!domain) return domain.error();
    if (Status go = proceed(run, 0); !go) return go.error();

    const Scale scale(domain.value().points);
    if (Status go = proceed(run, 0); !go) return go.error(); // nobody knows the mesher's share
    Result<TetgenInput> input = tetgen_input(mesh, volumes, domain.value(), options, scale, run);
    if (!input) return input.error();
    Result<TetrahedralMesh> result =
        try_in_turn(mesh, volumes, domain.value(), options, input.value(), scale, run);
    if (!result) return result;
    const Run quiet{.threads = run.threads, .stop = run.stop};
    if (auto improved = improve_shapes(*result, *mesh, volumes, options, quiet); !improved)
        return improved.error();
    if (Status go = proceed(run, 1); !go) return go.error();
    return result;
}

Result<TetrahedralMesh> prove_and_fill(const Mesh& mesh, const TetrahedraOptions& options,
                                       const Run& run) {
    if (Status good = check_options(options); !good) return good.error();
    const Run quiet{.threads = run.threads, .stop = run.stop};
    if (Status valid = validate_mesh(mesh, quiet); !valid) return valid.error();
    const auto proven = prove_conforming(mesh, quiet);
    if (!proven) return proven.error();
    const auto volumes = find_volumes(proven.value(), quiet);
    if (!volumes) return volumes.error();
    return fill(proven.value(), volumes.value(), options, run);
}

} // namespace

Result<TetrahedralMesh> tetrahedralize(const ConformingMesh& mesh, const Volumes& volumes,
                                       const TetrahedraOptions& options, const Run& run) {
    return guarded("for the tetrahedra", "tetrahedralize",
                   [&] { return fill(mesh, volumes, options, run); });
}

Result<TetrahedralMesh> tetrahedralize(const Mesh& mesh, const TetrahedraOptions& options,
                                       const Run& run) {
    return guarded("for the tetrahedra", "tetrahedralize",
                   [&] { return prove_and_fill(mesh, options, run); });
}

std::vector<NamedConstant> tetrahedra_constants() {
    return tetgen::detail::constants.listed();
}

} // namespace terrane
