// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/detail/sizes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <fmt/format.h>

#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::tetgen::detail {
namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();

Error bad_option(std::string sentence) {
    return {ErrorCode::bad_option, std::move(sentence), ""};
}

/// Checks that the numbers given to `what` are in range and differ, and that their lengths are
/// positive.
class SizeList {
public:
    SizeList(const char* what, std::size_t count) : what_(what), count_(count) {}

    Status add(std::uint32_t number, double length) {
        if (number >= count_) return bad_option(fmt::format("there is no {} {}", what_, number));
        if (!(std::isfinite(length) && length > 0))
            return bad_option(fmt::format("the edge length of {} {} must be a positive number, "
                                          "not {}",
                                          what_, number, length));
        if (!met_.insert(number).second)
            return bad_option(fmt::format("{} {} has two edge lengths", what_, number));
        return Done{};
    }

private:
    const char* what_;
    std::size_t count_;
    std::set<std::uint32_t> met_;
};

Status check_sizes(const Mesh& mesh, const Volumes& volumes, const TetrahedraOptions& options) {
    SizeList blocks("block", volumes.measures.size()), surfaces("surface", mesh.surfaces.size());
    for (const auto& [block, length] : options.block_sizes)
        if (Status good = blocks.add(block, length); !good) return good;
    for (const auto& [surface, length] : options.surface_sizes)
        if (Status good = surfaces.add(surface, length); !good) return good;
    return Done{};
}

/// Returns a point half way from the mesh to the low corner of the box, where there is no triangle.
Point3 outside_point(const Mesh& mesh, const Box3& box) {
    Point3 low = box.high;
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) {
            const Point3& p = mesh.vertices[v];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        }
    const auto middle = [](double a, double b) { return a + (b - a) / 2; };
    return {middle(box.low.x, low.x), middle(box.low.y, low.y), middle(box.low.z, low.z)};
}

} // namespace

double volume_of(double edge_length) {
    return edge_length * edge_length * edge_length / (6 * std::sqrt(2.0));
}

double area_of(double edge_length) {
    return edge_length * edge_length * std::sqrt(3.0) / 4;
}

bool Sizes::any() const {
    return std::any_of(in_volumes.begin(), in_volumes.end(),
                       [](const SizeInVolume& size) { return size.bounded(); }) ||
           std::any_of(on_triangles.begin(), on_triangles.end(),
                       [](double length) { return length < no_bound; });
}

bool Sizes::bound_volumes() const {
    return std::any_of(in_volumes.begin(), in_volumes.end(),
                       [](const SizeInVolume& size) { return size.bounded(); });
}

bool Sizes::same_everywhere() const {
    return std::all_of(in_volumes.begin(), in_volumes.end(),
                       [&](const SizeInVolume& size) { return size == in_volumes[0]; });
}

Result<Sizes> sizes_of(const Mesh& mesh, const Volumes& volumes, const TetrahedraOptions& options) {
    if (Status good = check_sizes(mesh, volumes, options); !good) return good.error();
    Sizes sizes;
    sizes.in_volumes.assign(volumes.measures.size(), {options.edge_length.value_or(no_bound),
                                                      options.max_volume.value_or(no_bound)});
    for (const auto& [block, length] : options.block_sizes)
        sizes.in_volumes[block] = {length, no_bound};
    std::vector<double> of_surface(mesh.surfaces.size(), no_bound);
    for (const auto& [surface, length] : options.surface_sizes) of_surface[surface] = length;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [front, back] = volumes.of_sides[t];
        double length = std::min(sizes.in_volumes[front].length, sizes.in_volumes[back].length);
        for (const std::uint32_t s : mesh.surfaces_of[t]) length = std::min(length, of_surface[s]);
        sizes.on_triangles.push_back(length);
    }
    return sizes;
}

Result<std::vector<BlockPoint>> points_of_bounded(const Mesh& mesh, const Volumes& volumes,
                                                  const Box3& box, const Sizes& sizes,
                                                  const Run& run) {
    auto inside = block_points(mesh, volumes, run);
    if (!inside) return inside.error();
    std::vector<std::optional<Point3>> places(sizes.in_volumes.size());
    for (const auto& [place, block] : inside.value()) places[block] = place;
    places[0] = outside_point(mesh, box);
    std::vector<BlockPoint> points;
    for (std::uint32_t v = 0; v < places.size(); ++v) {
        if (!sizes.in_volumes[v].bounded()) continue;
        if (!places[v])
            return Error{ErrorCode::unsupported,
                         fmt::format("block {} is too thin for a size of its own: no point of "
                                     "doubles was found in it",
                                     v),
                         ""};
        points.push_back({*places[v], BlockId(v)});
    }
    return points;
}

} // namespace terrane::tetgen::detail
