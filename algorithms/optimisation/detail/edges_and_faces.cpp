// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <terrane/algorithms/optimisation/detail/changes.hpp>
#include <terrane/algorithms/optimisation/detail/constants.hpp>

namespace terrane::optimisation::detail {

namespace {

unsigned index_of(const Corners& c, std::uint32_t v) {
    return static_cast<unsigned>(std::find(c.begin(), c.end(), v) - c.begin());
}

bool is_even(std::array<unsigned, 4> order) {
    bool even = true;
    for (unsigned a = 0; a < 4; ++a)
        for (unsigned b = a + 1; b < 4; ++b)
            if (order[a] > order[b]) even = !even;
    return even;
}

/// The cells around an edge, in order, and the vertices between them: cell i has vertices i and
/// i + 1, and (low, high, i, i + 1) is positive.
struct Ring {
    std::uint32_t low = none, high = none;
    std::vector<std::uint32_t> cells, vertices;
};

/// Starts a ring at a cell with corners i and j.
Ring ring_from(const Corners& first, unsigned i, unsigned j) {
    std::array<unsigned, 2> others{};
    unsigned count = 0;
    for (unsigned k = 0; k < 4; ++k)
        if (k != i && k != j) others[count++] = k;
    Ring ring{first[i], first[j], {}, {first[others[0]], first[others[1]]}};
    if (!is_even({i, j, others[0], others[1]})) std::swap(ring.low, ring.high);
    return ring;
}

/// Adds the cells behind the last one, up to a wall or the first cell. Returns whether it came back
/// to that; the last vertex is the first one then. None: there are too many.
std::optional<bool> go_round(const Cells& cells, Ring& ring) {
    while (ring.cells.size() <= constants.most_around_edge) {
        const std::uint32_t last = ring.cells.back();
        const std::uint32_t from = ring.vertices[ring.vertices.size() - 2];
        const std::uint32_t next = cells.through(last, index_of(cells.corners(last), from));
        if (next == none) return false;
        if (next == ring.cells.front()) return true;
        const std::uint32_t shared = ring.vertices.back();
        ring.cells.push_back(next);
        for (const std::uint32_t v : cells.corners(next))
            if (v != ring.low && v != ring.high && v != shared) {
                ring.vertices.push_back(v);
                break;
            }
    }
    return std::nullopt;
}

/// Finds the cells around an edge that is on no wall.
std::optional<Ring> ring_around(const Cells& cells, std::uint32_t c, unsigned i, unsigned j) {
    Ring ring = ring_from(cells.corners(c), i, j);
    ring.cells.push_back(c);
    const auto closed = go_round(cells, ring);
    if (!closed || !*closed) return std::nullopt;
    ring.vertices.pop_back();
    return ring;
}

/// Finds the cells at an edge between two walls. There is one more vertex than cells.
std::optional<Ring> fan_at(const Cells& cells, std::uint32_t c, unsigned i, unsigned j) {
    Ring ring = ring_from(cells.corners(c), i, j);
    ring.cells.push_back(c);
    const auto ahead = go_round(cells, ring);
    if (!ahead || *ahead) return std::nullopt;
    // Then from the last cell back to the other wall: the edge is seen from its other end.
    Ring back{ring.high,
              ring.low,
              {ring.cells.back()},
              {ring.vertices.back(), ring.vertices[ring.vertices.size() - 2]}};
    if (const auto behind = go_round(cells, back); !behind || *behind) return std::nullopt;
    return back;
}

/// The triangulations of a ring whose worst tetrahedra are best, for each chain of its vertices.
class RingTriangulation {
public:
    /// Tetrahedra that are no better than `enough` are of no use. Adds those that it measures to
    /// `effort`.
    RingTriangulation(const Cells& cells, const Ring& ring, double enough, std::size_t& effort) :
        cells_(cells), ring_(ring), effort_(effort), enough_(enough), n_(ring.vertices.size()),
        best_(n_ * n_, HUGE_VAL), middle_(n_ * n_) {
        for (std::size_t span = 2; span < n_; ++span)
            for (std::size_t i = 0; i + span < n_; ++i) find(i, i + span);
    }

    [[nodiscard]] double quality() const { return best_[n_ - 1]; }
    /// Returns the quality of the part between two vertices: no limit if they are adjacent, and
    /// `enough` if it can't be better.
    [[nodiscard]] double quality(std::size_t i, std::size_t j) const { return best_[i * n_ + j]; }
    [[nodiscard]] std::vector<Corners> tetrahedra() const {
        std::vector<Corners> all;
        add(0, n_ - 1, all);
        return all;
    }
    /// Adds the tetrahedra of the part between two vertices.
    void add(std::size_t i, std::size_t j, std::vector<Corners>& all) const {
        if (j - i < 2) return;
        const std::size_t k = middle_[i * n_ + j];
        for (const Corners& t : pair(i, k, j)) all.push_back(t);
        add(i, k, all);
        add(k, j, all);
    }

private:
    void find(std::size_t i, std::size_t j) {
        double best = enough_;
        for (std::size_t k = i + 1; k < j; ++k) {
            double here = std::min(best_[i * n_ + k], best_[k * n_ + j]);
            for (const Corners& t : pair(i, k, j))
                if (here > best) here = std::min(here, measured(t));
            if (here <= best) continue;
            best = here;
            middle_[i * n_ + j] = k;
        }
        best_[i * n_ + j] = best;
    }

    [[nodiscard]] double measured(const Corners& c) {
        ++effort_;
        return cells_.quality_of(c);
    }

    [[nodiscard]] std::array<Corners, 2> pair(std::size_t i, std::size_t k, std::size_t j) const {
        const auto& r = ring_.vertices;
        return {{{r[i], r[k], r[j], ring_.high}, {r[i], r[j], r[k], ring_.low}}};
    }

    const Cells& cells_;
    const Ring& ring_;
    std::size_t& effort_;
    double enough_;
    std::size_t n_;
    std::vector<double> best_;
    std::vector<std::size_t> middle_;
};

/// Collects faces that all lie between the same two vertices.
class FacesBetween {
public:
    FacesBetween(const Cells& cells, std::uint32_t low, std::uint32_t high, std::size_t& effort) :
        cells_(cells), low_(low), high_(high), effort_(effort) {}

    /// Adds the two cells at a face (a, b, c) from which `high` is on the positive side, and the
    /// best tetrahedra beyond its edges. Returns the least quality of these.
    double add(std::uint32_t below, std::uint32_t above, const std::array<std::uint32_t, 3>& face) {
        old.push_back(below);
        old.push_back(above);
        double least = HUGE_VAL;
        for (unsigned e = 0; e < 3; ++e)
            least = std::min(least,
                             beyond(below, above, face[e], face[(e + 1) % 3], face[(e + 2) % 3]));
        return least;
    }

    std::vector<std::uint32_t> old;
    std::vector<Corners> added;

private:
    /// Returns the quality of the tetrahedron at an edge of a face whose third corner is `apex`, or
    /// of those beyond the face on its other side, whichever is better.
    double beyond(std::uint32_t below, std::uint32_t above, std::uint32_t a, std::uint32_t b,
                  std::uint32_t apex) {
        const Corners own{low_, high_, a, b};
        ++effort_;
        const double quality = cells_.quality_of(own);
        const std::size_t old_count = old.size(), added_count = added.size();
        const std::uint32_t next_below =
                                cells_.through(below, index_of(cells_.corners(below), apex)),
                            next_above =
                                cells_.through(above, index_of(cells_.corners(above), apex));
        if (next_below != none && next_above != none &&
            std::find(old.begin(), old.end(), next_below) == old.end() &&
            std::find(old.begin(), old.end(), next_above) == old.end()) {
            const std::uint32_t next = fourth(next_below, {low_, a, b});
            const unsigned k = index_of(cells_.corners(next_below), low_);
            if (next == fourth(next_above, {high_, a, b}) && !cells_.is_wall(next_below, k)) {
                old.push_back(next_below);
                old.push_back(next_above);
                double both = beyond(next_below, next_above, a, next, b);
                if (both > quality)
                    both = std::min(both, beyond(next_below, next_above, next, b, a));
                if (both > quality) return both;
                old.resize(old_count);
                added.resize(added_count);
            }
        }
        added.push_back(own);
        return quality;
    }

    [[nodiscard]] std::uint32_t fourth(std::uint32_t c, std::array<std::uint32_t, 3> face) const {
        for (const std::uint32_t v : cells_.corners(c))
            if (std::find(face.begin(), face.end(), v) == face.end()) return v;
        return none;
    }

    const Cells& cells_;
    std::uint32_t low_, high_;
    std::size_t& effort_;
};

} // namespace

std::optional<Change> without_edge(const Cells& cells, std::uint32_t c, unsigned i, unsigned j,
                                   double gain, std::size_t& effort) {
    auto ring = ring_around(cells, c, i, j);
    if (ring) effort += ring->cells.size();
    if (!ring || ring->cells.size() < 3) return std::nullopt;
    const double enough = cells.enough_for(ring->cells, gain);
    const RingTriangulation triangulation(cells, *ring, enough, effort);
    if (!(triangulation.quality() > enough)) return std::nullopt;
    return Change{
        Change::Kind::edge,     std::move(ring->cells), triangulation.tetrahedra(), none, {},
        triangulation.quality()};
}

std::optional<Change> with_fewer_faces(const Cells& cells, std::uint32_t c, unsigned i, unsigned j,
                                       double gain, std::size_t& effort) {
    auto fan = fan_at(cells, c, i, j);
    if (fan) effort += fan->cells.size();
    if (!fan || fan->cells.size() < 2) return std::nullopt;
    const double enough = cells.enough_for(fan->cells, gain);
    const RingTriangulation beyond(cells, *fan, enough, effort);
    const std::size_t n = fan->vertices.size();
    std::vector<double> best(n, enough);   // with a face at the vertex, of all up to it
    std::vector<std::size_t> before(n, 0); // the vertex with the face before that
    best[0] = HUGE_VAL;
    const auto between = [&](std::size_t from, std::size_t to) {
        return Corners{fan->low, fan->high, fan->vertices[from], fan->vertices[to]};
    };
    for (std::size_t to = 1; to < n; ++to)
        for (std::size_t from = 0; from < to; ++from) {
            double here = std::min(best[from], beyond.quality(from, to));
            if (!(here > best[to])) continue;
            ++effort;
            here = std::min(here, cells.quality_of(between(from, to)));
            if (!(here > best[to])) continue;
            best[to] = here;
            before[to] = from;
        }
    if (!(best[n - 1] > enough)) return std::nullopt;
    Change change{Change::Kind::face, std::move(fan->cells), {}, none, {}, best[n - 1]};
    for (std::size_t to = n - 1; to > 0; to = before[to]) {
        change.added.push_back(between(before[to], to));
        beyond.add(before[to], to, change.added);
    }
    return change;
}

std::optional<Change> without_face(const Cells& cells, std::uint32_t c, unsigned k, double gain,
                                   std::size_t& effort) {
    const std::uint32_t other = cells.through(c, k);
    if (other == none) return std::nullopt;
    const auto face = face_opposite(cells.corners(c), k); // corner k is above it
    std::uint32_t low = none;
    for (const std::uint32_t v : cells.corners(other))
        if (std::find(face.begin(), face.end(), v) == face.end()) low = v;
    FacesBetween faces(cells, low, cells.corners(c)[k], effort);
    const double quality = faces.add(other, c, face);
    if (!(quality > cells.enough_for(faces.old, gain))) return std::nullopt;
    return Change{
        Change::Kind::face, std::move(faces.old), std::move(faces.added), none, {}, quality};
}

std::optional<Change> contracted(const Cells& cells, std::uint32_t gone,
                                 const std::vector<std::uint32_t>& star, std::uint32_t kept,
                                 double gain, std::size_t& effort) {
    const double enough = cells.enough_for(star, gain);
    Change change{Change::Kind::contraction, {}, {}, none, {}, HUGE_VAL};
    for (const std::uint32_t at : star) {
        Corners corners = cells.corners(at);
        if (std::find(corners.begin(), corners.end(), kept) != corners.end()) continue;
        corners[index_of(corners, gone)] = kept;
        ++effort;
        change.quality = std::min(change.quality, cells.quality_of(corners));
        if (!(change.quality > enough)) return std::nullopt;
        change.added.push_back(corners);
    }
    change.old = star;
    return change;
}

} // namespace terrane::optimisation::detail
