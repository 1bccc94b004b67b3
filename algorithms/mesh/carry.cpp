// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/carry.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/mesh/triangle_table.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/values.hpp>

namespace terrane {
namespace {

/// Corners with smaller weights do not count: rounding gives such weights to those that are opposite.
constexpr double least_weight = 0x1p-40;

/// A place in a triangle whose corners are given vertices; or none.
struct ValuePlace {
    Triangle corners{no_index, no_index, no_index};
    std::array<double, 3> weights{}; ///< >= 0, sum 1
    [[nodiscard]] bool is_none() const { return corners[0] == no_index; }
};

ValuePlace at_vertex(std::uint32_t v) {
    return {{v, v, v}, {1, 0, 0}};
}

std::array<double, 3> difference(const Point3& a, const Point3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

double dot_product(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns the weights of the corners at p, whose projection may be outside. They are measured along the longest
/// edge and across it, so that a linear function has its value at p to rounding also in a thin triangle.
std::array<double, 3> weights_of_corners(const Point3& p, const std::array<Point3, 3>& corners) {
    std::size_t a = 0;
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto edge = difference(corners[(k + 1) % 3], corners[k]);
        if (const double length = dot_product(edge, edge); length > longest) {
            longest = length;
            a = k;
        }
    }
    if (longest == 0) return {1, 0, 0};
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    const auto along = difference(corners[b], corners[a]),
               to_c = difference(corners[c], corners[a]), to_p = difference(p, corners[a]);
    const double s = dot_product(to_c, along) / longest, t = dot_product(to_p, along) / longest;
    std::array<double, 3> up{}, off{}, weights{};
    for (std::size_t k = 0; k < 3; ++k) {
        up[k] = to_c[k] - s * along[k];
        off[k] = to_p[k] - t * along[k];
    }
    const double height = dot_product(up, up);
    weights[c] = height > 0 ? dot_product(off, up) / height : 0;
    weights[b] = t - weights[c] * s;
    weights[a] = 1 - weights[c] - weights[b];
    return weights;
}

/// Returns the weights of the corners at the point of the triangle nearest to p.
std::array<double, 3> weights_at(const Point3& p, const std::array<Point3, 3>& corners) {
    auto weights = weights_of_corners(p, corners);
    if (std::ranges::min(weights) >= 0) return weights;
    weights =
        weights_of_corners(nearest_on_triangle(p, corners[0], corners[1], corners[2]), corners);
    double sum = 0;
    for (double& w : weights) sum += w = std::max(w, 0.0);
    for (double& w : weights) w /= sum;
    return weights;
}

bool fits(const ValueArray& array, const Surface& surface) {
    return array.size() ==
           (array.on_triangles ? surface.triangles.size() : surface.vertices.size());
}

/// Tells whether a surface begins with the triangles of another, at their places.
bool begins_with(const Surface& surface, const Surface& given) {
    if (surface.triangles.size() < given.triangles.size()) return false;
    for (std::size_t t = 0; t < given.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            if (surface.vertices[surface.triangles[t][k]] != given.vertices[given.triangles[t][k]])
                return false;
    return true;
}

/// Finds the places from which the values of one surface come.
class PlaceFinder {
public:
    /// `filled`: the triangles of `parents` before it that are not given fill holes.
    PlaceFinder(const Surface& given, const Surface* parents, std::size_t filled) :
        given_(given), count_(given.triangles.size()), vertices_(given.vertices.size()) {
        if (parents && begins_with(*parents, given)) {
            has_parents_ = true;
            filled_ = std::clamp(filled, count_, parents->triangles.size());
            if (filled_ > count_) base_ = parents;
        }
        for (const Triangle& t : given.triangles)
            for (const std::uint32_t v : t) vertices_.enter(given.vertices, v);
    }

    /// What a parent is.
    enum class Kind { given, filling, other };
    [[nodiscard]] Kind kind_of(std::size_t parent) const {
        if (!has_parents_) return Kind::other;
        return parent < count_ ? Kind::given : parent < filled_ ? Kind::filling : Kind::other;
    }

    [[nodiscard]] std::optional<std::uint32_t> vertex_at(const Point3& p) const {
        const auto found = vertices_.find(given_.vertices, p);
        return found == no_index ? std::nullopt : std::optional(found);
    }

    [[nodiscard]] ValuePlace place_in(std::uint32_t triangle, const Point3& p) const {
        const Triangle& t = given_.triangles[triangle];
        return {t, weights_at(
                       p, {given_.vertices[t[0]], given_.vertices[t[1]], given_.vertices[t[2]]})};
    }

    /// Returns the nearest triangle, or no_index for one that fills a hole.
    std::uint32_t nearest(const Point3& p) {
        const Surface& base = base_ ? *base_ : given_;
        if (!tree_) {
            std::vector<Triangle> triangles = base.triangles;
            if (base_) triangles.resize(filled_);
            numbers_.emplace(triangles.size());
            for (std::uint32_t t = 0; t < triangles.size(); ++t) numbers_->enter(base.triangles, t);
            tree_.emplace(base.vertices, std::move(triangles));
        }
        const auto found = tree_->nearest(p, std::numeric_limits<double>::infinity());
        if (!found) return no_index;
        const auto number = numbers_->find(base.triangles, found->triangle);
        return number < count_ ? number : no_index;
    }

private:
    const Surface& given_;
    std::size_t count_;
    std::size_t filled_ = 0;
    bool has_parents_ = false;
    const Surface* base_ = nullptr; ///< the surface whose fillings are searched, too
    PointTable vertices_;           ///< of given triangles
    std::optional<TriangleTable> numbers_;
    std::optional<TriangleTree> tree_;
};

/// Returns the values of an array on vertices.
ValueArray values_at(const ValueArray& array, std::span<const ValuePlace> places) {
    if (array.is_integer()) {
        std::vector<std::uint32_t> corners;
        for (const ValuePlace& p : places) {
            const auto most = std::ranges::max_element(p.weights) - p.weights.begin();
            corners.push_back(p.is_none() ? no_index : p.corners[static_cast<std::size_t>(most)]);
        }
        return picked(array, corners);
    }
    ValueArray out = without_data(array, places.size());
    const auto& from = std::get<std::vector<double>>(array.numbers);
    auto& to = std::get<std::vector<double>>(out.numbers);
    const std::size_t n = array.components;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const ValuePlace& p = places[i];
        if (p.is_none()) continue;
        if (p.weights[0] == 1) {
            std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(n * p.corners[0]), n,
                        to.begin() + static_cast<std::ptrdiff_t>(n * i));
            continue;
        }
        for (std::size_t c = 0; c < n; ++c) {
            const auto heaviest = std::ranges::max_element(p.weights) - p.weights.begin();
            const double start = from[n * p.corners[static_cast<std::size_t>(heaviest)] + c];
            double value = start, low = start, high = start;
            bool known = true;
            for (std::size_t k = 0; k < 3; ++k) {
                if (p.weights[k] <= least_weight) continue;
                const std::size_t at = n * p.corners[k] + c;
                known = known && !has_no_data(array, at);
                value += p.weights[k] * (from[at] - start);
                low = std::min(low, from[at]);
                high = std::max(high, from[at]);
            }
            if (known) to[n * i + c] = std::clamp(value, low, high);
        }
    }
    return out;
}

/// Carries the values of one surface.
class SurfaceCarrier {
public:
    SurfaceCarrier(const Surface& given, PlaceFinder& finder, const Mesh& mesh,
                   std::vector<std::uint32_t>& numbers) :
        given_(given),
        finder_(finder), mesh_(mesh), numbers_(numbers) {}

    /// `triangles`: those of the surface; `first`: the number of its first parent, `end`: that of the next surface.
    SurfaceValues operator()(const std::vector<std::uint32_t>& triangles, std::uint32_t first,
                             std::uint32_t end) {
        number_vertices(triangles);
        sources_.assign(vertices_.size(), no_index);
        searched_.assign(vertices_.size(), false);
        std::vector<std::uint32_t> of_triangles;
        for (const std::uint32_t t : triangles) of_triangles.push_back(source_of(t, first, end));
        std::vector<ValuePlace> places;
        for (std::size_t i = 0; i < vertices_.size(); ++i) places.push_back(place_of(i));
        SurfaceValues values;
        for (const ValueArray& array : given_.arrays) {
            if (!fits(array, given_)) continue;
            values.push_back(array.on_triangles ? picked(array, of_triangles)
                                                : values_at(array, places));
        }
        return values;
    }

private:
    void number_vertices(const std::vector<std::uint32_t>& triangles) {
        for (const std::uint32_t t : triangles)
            vertices_.insert(vertices_.end(), mesh_.triangles[t].begin(), mesh_.triangles[t].end());
        std::ranges::sort(vertices_);
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
        for (std::uint32_t i = 0; i < vertices_.size(); ++i) numbers_[vertices_[i]] = i;
    }

    /// Returns the source of a triangle, and notes it for its vertices.
    std::uint32_t source_of(std::uint32_t t, std::uint32_t first, std::uint32_t end) {
        using Kind = PlaceFinder::Kind;
        const Triangle& corners = mesh_.triangles[t];
        Kind kind = Kind::other;
        std::uint32_t source = no_index;
        if (mesh_.parents_of.size() != 0)
            for (const std::uint32_t p : mesh_.parents_of[t])
                if (p >= first && p < end) {
                    kind = finder_.kind_of(p - first);
                    source = p - first;
                    break;
                }
        if (kind == Kind::filling) return no_index;
        if (kind == Kind::other) {
            for (const std::uint32_t v : corners) searched_[numbers_[v]] = true;
            Point3 centre{};
            for (const std::uint32_t v : corners) {
                const Point3& p = mesh_.vertices[v];
                centre = {centre.x + p.x / 3, centre.y + p.y / 3, centre.z + p.z / 3};
            }
            return finder_.nearest(centre);
        }
        for (const std::uint32_t v : corners)
            sources_[numbers_[v]] = std::min(sources_[numbers_[v]], source);
        return source;
    }

    ValuePlace place_of(std::size_t i) {
        const Point3& p = mesh_.vertices[vertices_[i]];
        if (const auto v = finder_.vertex_at(p)) return at_vertex(*v);
        std::uint32_t source = sources_[i];
        if (source == no_index && searched_[i]) source = finder_.nearest(p);
        return source == no_index ? ValuePlace{} : finder_.place_in(source, p);
    }

    const Surface& given_;
    PlaceFinder& finder_;
    const Mesh& mesh_;
    std::vector<std::uint32_t>&
        numbers_; ///< per vertex of the mesh: its index in vertices_, if it is there
    std::vector<std::uint32_t> vertices_; ///< of the surface, ascending
    std::vector<std::uint32_t> sources_;  ///< per vertex of the surface: the first; or no_index
    std::vector<bool> searched_;          ///< per vertex: whether its triangle has no parent
};

} // namespace

bool have_values(std::span<const Surface> surfaces) {
    return std::ranges::any_of(surfaces, [](const Surface& s) { return !s.arrays.empty(); });
}

std::vector<SurfaceValues> carry_values(const ValueSources& sources, const Mesh& mesh) {
    if (!have_values(sources.given)) return {};
    std::vector<SurfaceValues> values(mesh.surfaces.size());
    std::vector<std::vector<std::uint32_t>> triangles(mesh.surfaces.size());
    const auto is_wanted = [&](std::size_t s) {
        return s < sources.given.size() && s < values.size() && !sources.given[s].arrays.empty();
    };
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t s : mesh.surfaces_of[t])
            if (is_wanted(s)) triangles[s].push_back(t);
    std::vector<std::uint32_t> numbers(mesh.vertices.size(), no_index);
    std::uint32_t first = 0;
    for (std::size_t s = 0; s < values.size(); ++s) {
        const Surface* parents = s < sources.parents.size() ? &sources.parents[s] : nullptr;
        const auto end =
            first + static_cast<std::uint32_t>(parents ? parents->triangles.size() : 0);
        if (is_wanted(s)) {
            const std::size_t filled = s < sources.filled.size()
                                           ? sources.filled[s]
                                           : std::numeric_limits<std::size_t>::max();
            PlaceFinder finder(sources.given[s], parents, filled);
            values[s] =
                SurfaceCarrier(sources.given[s], finder, mesh, numbers)(triangles[s], first, end);
        }
        first = end;
    }
    return values;
}

std::vector<SurfaceValues> carry_values(const ValueSources& sources, const Mesh& mesh,
                                        const TetrahedralMesh& tetrahedra) {
    if (!have_values(sources.given)) return {};
    Mesh faces;
    faces.surfaces = tetrahedra.surfaces;
    faces.vertices = tetrahedra.vertices;
    faces.triangles = tetrahedra.faces;
    faces.surfaces_of = tetrahedra.surfaces_of;
    if (mesh.parents_of.size() != 0)
        for (const std::uint32_t t : tetrahedra.face_triangle) {
            if (t == no_index)
                faces.parents_of.close();
            else
                faces.parents_of.push_back(mesh.parents_of[t]);
        }
    return carry_values(sources, faces);
}

std::vector<SurfaceValues> values_of(std::span<const Surface> surfaces) {
    if (!have_values(surfaces)) return {};
    std::vector<SurfaceValues> values;
    for (const Surface& s : surfaces) {
        std::vector<std::uint32_t> used;
        for (const Triangle& t : s.triangles) used.insert(used.end(), t.begin(), t.end());
        std::ranges::sort(used);
        used.erase(std::unique(used.begin(), used.end()), used.end());
        SurfaceValues& of_surface = values.emplace_back();
        for (const ValueArray& array : s.arrays)
            if (fits(array, s))
                of_surface.push_back(array.on_triangles ? array : picked(array, used));
    }
    return values;
}

} // namespace terrane
