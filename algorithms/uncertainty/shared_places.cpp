// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/shared_places.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/uncertainty/detail/harmonic.hpp>

namespace terrane {
namespace {

using uncertainty::detail::Harmonic;
using PlaceEdge = std::array<std::uint32_t, 2>;

/// Returns per vertex, counted through all surfaces, the number of its place, in the order of first vertices.
std::vector<std::uint32_t> places_of(std::span<const Surface> surfaces, std::size_t& count) {
    std::vector<Point3> points;
    for (const Surface& s : surfaces)
        points.insert(points.end(), s.vertices.begin(), s.vertices.end());
    PointTable table(points.size());
    std::vector<std::uint32_t> place(points.size());
    count = 0;
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        const std::uint32_t first = table.enter(points, v);
        place[v] = first == v ? static_cast<std::uint32_t>(count++) : place[first];
    }
    return place;
}

/// Returns the edges of triangles between places, each with the lower number first, sorted; edges of several
/// triangles are there several times, those of repeated triangles once.
std::vector<PlaceEdge> edges_of(std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) std::sort(t.begin(), t.end());
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    std::vector<PlaceEdge> edges;
    for (const Triangle& t : triangles)
        for (const PlaceEdge e : {PlaceEdge{t[0], t[1]}, {t[0], t[2]}, {t[1], t[2]}})
            if (e[0] != e[1]) edges.push_back(e);
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// Calls visit(a, b, is_border) for each edge.
template <class Visit>
void for_edges(const std::vector<PlaceEdge>& edges, const Visit& visit) {
    for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
        while (next < edges.size() && edges[next] == edges[i]) ++next;
        visit(edges[i][0], edges[i][1], next == i + 1);
    }
}

/// Marks the ends of border edges at which the border turns by 30 degrees or more, or branches.
void mark_corners(const std::vector<Point3>& points, const std::vector<PlaceEdge>& border,
                  std::vector<bool>& marked) {
    constexpr double straight = -0.8660254037844386; // the cosine of 150 degrees
    std::vector<std::vector<std::uint32_t>> next(points.size());
    for (const auto& [a, b] : border) {
        next[a].push_back(b);
        next[b].push_back(a);
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
        if (next[v].empty()) continue;
        if (next[v].size() == 2) {
            const Point3 to = minus(points[next[v][0]], points[v]),
                         from = minus(points[next[v][1]], points[v]);
            if (dot(to, from) < straight * length(to) * length(from)) continue;
        }
        marked[v] = true;
    }
}

/// Returns the motion of a place whose triangles of faults have normals with these squares, for
/// one unit of vertical motion: rule (4).
Point3 rail_of(const Eigen::Matrix3d& squares) {
    constexpr double one_plane = 0.05, level = 0.2; // shares of the largest eigenvalue; cosine
    const Point3 up{0, 0, 1};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares);
    const Eigen::Vector3d& size = solver.eigenvalues(); // ascending
    if (size(2) <= 0) return up;
    if (size(1) < one_plane * size(2)) {
        const Eigen::Vector3d n = solver.eigenvectors().col(2);
        const double steepness = 1 - n(2) * n(2);
        if (steepness < level * level) return up;
        return {-n(2) * n(0) / steepness, -n(2) * n(1) / steepness, 1};
    }
    const Eigen::Vector3d line = solver.eigenvectors().col(0);
    if (std::fabs(line(2)) < level) return up;
    return {line(0) / line(2), line(1) / line(2), 1};
}

Point3 plus(const Point3& a, const Point3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Point3 times(const Point3& a, double factor) {
    return {a.x * factor, a.y * factor, a.z * factor};
}

/// Adds up what leads at a place, and otherwise what does not.
struct Leading {
    Point3 sum{}, ending{};
    double count = 0, ending_count = 0;

    void add(const Point3& motion, bool leads) {
        (leads ? sum : ending) = plus(leads ? sum : ending, motion);
        (leads ? count : ending_count) += 1;
    }
    [[nodiscard]] Point3 mean() const {
        if (count > 0) return times(sum, 1 / count);
        return ending_count > 0 ? times(ending, 1 / ending_count) : Point3{};
    }
};

} // namespace

/// The values that all motions share.
struct SharedPlaces::State {
    /// A surface at a place that several share.
    struct Member {
        std::uint32_t surface = 0;
        std::uint32_t at = 0; ///< index into places of the surface
        bool leads = false;   ///< the surfaces of its name go on through the place
    };
    struct OfSurface {
        std::vector<std::uint32_t> place_of;     ///< per vertex: index into places
        std::vector<std::uint32_t> places;       ///< in use: numbers, by their first vertices
        std::vector<std::uint32_t> multiplicity; ///< per place: number of vertices
        std::optional<Harmonic> along_border{};  ///< none: it shares no place
        std::optional<Harmonic> inside{};        ///< likewise
    };

    std::vector<Motion> motions;
    std::vector<OfSurface> surfaces;
    std::vector<std::vector<Member>> shared; ///< per shared place
    std::vector<Point3> rails;               ///< per shared place: rule (4)

    void number(std::span<const Surface> given, const std::vector<std::uint32_t>& place);
    void find_shared(std::span<const Surface> given, std::size_t count,
                     const std::vector<std::vector<PlaceEdge>>& edges);
    void find_rails(std::span<const Surface> given);
    void prepare_fading(std::span<const Surface> given,
                        const std::vector<std::vector<PlaceEdge>>& edges, std::size_t count);
    [[nodiscard]] std::vector<std::vector<PlaceEdge>> edges(std::span<const Surface> given) const;
};

void SharedPlaces::State::number(std::span<const Surface> given,
                                 const std::vector<std::uint32_t>& place) {
    std::size_t first = 0;
    for (const Surface& s : given) {
        OfSurface& own = surfaces.emplace_back();
        std::map<std::uint32_t, std::uint32_t> index;
        for (std::size_t v = 0; v < s.vertices.size(); ++v) {
            const auto [at, is_new] =
                index.emplace(place[first + v], static_cast<std::uint32_t>(own.places.size()));
            if (is_new) {
                own.places.push_back(place[first + v]);
                own.multiplicity.push_back(0);
            }
            ++own.multiplicity[at->second];
            own.place_of.push_back(at->second);
        }
        first += s.vertices.size();
    }
}

std::vector<std::vector<PlaceEdge>>
SharedPlaces::State::edges(std::span<const Surface> given) const {
    std::vector<std::vector<PlaceEdge>> all;
    for (std::size_t s = 0; s < given.size(); ++s) {
        std::vector<Triangle> triangles = given[s].triangles;
        for (Triangle& t : triangles)
            for (std::uint32_t& corner : t)
                corner = surfaces[s].places[surfaces[s].place_of[corner]];
        all.push_back(edges_of(std::move(triangles)));
    }
    return all;
}

void SharedPlaces::State::find_shared(std::span<const Surface> given, std::size_t count,
                                      const std::vector<std::vector<PlaceEdge>>& edges) {
    std::vector<std::uint32_t> uses(count);
    for (const OfSurface& s : surfaces)
        for (const std::uint32_t p : s.places) ++uses[p];
    std::map<std::string, std::vector<std::uint32_t>> named;
    for (std::uint32_t s = 0; s < given.size(); ++s) named[given[s].name].push_back(s);
    std::vector<std::uint32_t> number(count, UINT32_MAX);
    for (const auto& [name, members] : named) {
        std::vector<PlaceEdge> all;
        for (const std::uint32_t s : members)
            all.insert(all.end(), edges[s].begin(), edges[s].end());
        std::sort(all.begin(), all.end());
        std::vector<bool> ends(count);
        for_edges(all, [&](std::uint32_t a, std::uint32_t b, bool is_border) {
            if (is_border) ends[a] = ends[b] = true;
        });
        for (const std::uint32_t s : members)
            for (std::uint32_t i = 0; i < surfaces[s].places.size(); ++i) {
                const std::uint32_t p = surfaces[s].places[i];
                if (uses[p] < 2) continue;
                if (number[p] == UINT32_MAX) {
                    number[p] = static_cast<std::uint32_t>(shared.size());
                    shared.emplace_back();
                }
                shared[number[p]].push_back({s, i, !ends[p]});
            }
    }
}

void SharedPlaces::State::find_rails(std::span<const Surface> given) {
    std::vector<std::vector<Eigen::Matrix3d>> squares(surfaces.size());
    for (std::size_t s = 0; s < given.size(); ++s) {
        if (motions[s] == Motion::vertical) continue;
        squares[s].assign(surfaces[s].places.size(), Eigen::Matrix3d::Zero());
        const auto& points = given[s].vertices;
        for (const Triangle& t : given[s].triangles) {
            const Point3 n =
                cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
            const double size = length(n);
            if (!(size > 0)) continue;
            const Eigen::Vector3d unit(n.x / size, n.y / size, n.z / size);
            for (const std::uint32_t corner : t)
                squares[s][surfaces[s].place_of[corner]] += size * unit * unit.transpose();
        }
    }
    for (const auto& members : shared) {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (const Member& m : members)
            if (motions[m.surface] != Motion::vertical) sum += squares[m.surface][m.at];
        rails.push_back(rail_of(sum));
    }
}

void SharedPlaces::State::prepare_fading(std::span<const Surface> given,
                                         const std::vector<std::vector<PlaceEdge>>& edges,
                                         std::size_t count) {
    std::vector<std::vector<bool>> is_shared(surfaces.size());
    for (std::size_t s = 0; s < surfaces.size(); ++s)
        is_shared[s].resize(surfaces[s].places.size());
    for (const auto& members : shared)
        for (const Member& m : members) is_shared[m.surface][m.at] = true;
    std::vector<std::uint32_t> index(count);
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        auto& known = is_shared[s];
        if (std::none_of(known.begin(), known.end(), [](bool is) { return is; })) continue;
        for (std::uint32_t i = 0; i < surfaces[s].places.size(); ++i)
            index[surfaces[s].places[i]] = i;
        std::vector<PlaceEdge> between, border;
        for_edges(edges[s], [&](std::uint32_t a, std::uint32_t b, bool is_border) {
            between.push_back({index[a], index[b]});
            if (is_border) border.push_back(between.back());
        });
        std::vector<Point3> points(known.size());
        for (std::size_t v = 0; v < given[s].vertices.size(); ++v)
            points[surfaces[s].place_of[v]] = given[s].vertices[v];
        mark_corners(points, border, known);
        surfaces[s].along_border.emplace(known, border);
        for (const auto& [a, b] : border) known[a] = known[b] = true;
        surfaces[s].inside.emplace(known, between);
    }
}

SharedPlaces::SharedPlaces(std::span<const Surface> surfaces, std::vector<Motion> motions) :
    state_(std::make_unique<State>()) {
    state_->motions = std::move(motions);
    std::size_t count = 0;
    const auto place = places_of(surfaces, count);
    state_->number(surfaces, place);
    const auto edges = state_->edges(surfaces);
    state_->find_shared(surfaces, count, edges);
    state_->find_rails(surfaces);
    state_->prepare_fading(surfaces, edges, count);
}
SharedPlaces::~SharedPlaces() = default;
SharedPlaces::SharedPlaces(SharedPlaces&&) noexcept = default;
SharedPlaces& SharedPlaces::operator=(SharedPlaces&&) noexcept = default;

std::size_t SharedPlaces::shared_count() const {
    return state_->shared.size();
}

std::vector<std::vector<Point3>>
SharedPlaces::reconciled(const std::vector<std::vector<Point3>>& own) const {
    const State& state = *state_;
    std::vector<std::vector<Point3>> of_place(own.size()), more(own.size());
    for (std::size_t s = 0; s < own.size(); ++s) {
        const State::OfSurface& surface = state.surfaces[s];
        of_place[s].resize(surface.places.size());
        more[s].resize(surface.places.size());
        for (std::size_t v = 0; v < own[s].size(); ++v) {
            Point3& sum = of_place[s][surface.place_of[v]];
            sum = plus(sum, own[s][v]);
        }
        for (std::size_t i = 0; i < surface.places.size(); ++i)
            if (surface.multiplicity[i] > 1)
                of_place[s][i] = times(of_place[s][i], 1.0 / surface.multiplicity[i]);
    }
    for (std::size_t k = 0; k < state.shared.size(); ++k) {
        Leading vertical, across;
        for (const State::Member& m : state.shared[k]) {
            if (state.motions[m.surface] == Motion::none) continue;
            (state.motions[m.surface] == Motion::vertical ? vertical : across)
                .add(of_place[m.surface][m.at], m.leads);
        }
        const Point3 total = plus(times(state.rails[k], vertical.mean().z), across.mean());
        for (const State::Member& m : state.shared[k])
            more[m.surface][m.at] = minus(total, of_place[m.surface][m.at]);
    }
    std::vector<std::vector<Point3>> result(own.size());
    for (std::size_t s = 0; s < own.size(); ++s) {
        const State::OfSurface& surface = state.surfaces[s];
        if (surface.along_border) {
            surface.along_border->extend(more[s]);
            surface.inside->extend(more[s]);
        }
        result[s].reserve(own[s].size());
        for (const std::uint32_t at : surface.place_of)
            result[s].push_back(plus(of_place[s][at], more[s][at]));
    }
    return result;
}

} // namespace terrane
