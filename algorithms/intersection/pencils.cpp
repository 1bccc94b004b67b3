// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/intersection/pencils.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include <terrane/algorithms/core/progress.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

/// A pencil pays from this many triangles on.
constexpr std::size_t least_triangles = 128;
constexpr unsigned most_failures = 8;      ///< triangles in turn that are in no pencil
constexpr std::size_t partners_tried = 64; ///< others that each of these is compared with
constexpr std::ptrdiff_t few = 4;          ///< of them that must meet it in one line
constexpr unsigned lines_tried = 4;        ///< of those in which it meets partners

/// A line through two constructed points, and two triangles whose planes meet in it.
struct PencilLine {
    std::array<PointIndex, 2> points;
    std::array<std::uint32_t, 2> carriers;
};

class PencilFinder {
public:
    PencilFinder(const TriangleSoup& soup, std::span<const std::uint32_t> busy, const Run& run) :
        soup_(soup), run_(run), rest_(busy.begin(), busy.end()),
        store_(std::vector<Point3>(soup.points.begin(), soup.points.end())) {}

    Pencils operator()() {
        pencils_.of.assign(soup_.triangles.size(), no_group);
        std::uint64_t turn = 0;
        for (unsigned failures = 0;
             failures < most_failures && rest_.size() >= 2 && !run_.stop.stop_requested();) {
            const std::size_t at = (++turn * 0x9e3779b97f4a7c15U >> 20U) % rest_.size();
            const auto line = busy_line(rest_[at]);
            if (!line || !take(*line)) ++failures;
        }
        if (pencils_.list.empty()) pencils_.of.clear();
        return std::move(pencils_);
    }

private:
    [[nodiscard]] bool holds(std::uint32_t t, const PencilLine& line) const {
        const UpwardRounding guard;
        const Triangle& c = soup_.triangles[t];
        const auto is_on = [&](PointIndex p) {
            return store_.side_of_plane(guard, c[0], c[1], c[2], p) == Sign::Zero;
        };
        return t == line.carriers[0] || t == line.carriers[1] ||
               (is_on(line.points[0]) && is_on(line.points[1]));
    }

    /// Returns the line in which two triangles meet, unless they are coplanar or share a point only.
    [[nodiscard]] std::optional<PencilLine> common_line(std::uint32_t f, std::uint32_t g) {
        const auto contact = improper_contact(soup_.points, soup_.triangles[f], soup_.triangles[g]);
        if (!contact || contact->coplanar || contact->point_count < 2) return std::nullopt;
        PencilLine line{{}, {f, g}};
        for (unsigned k = 0; k < 2; ++k) {
            const Construction& how =
                contact->points.at(k == 0 ? 0 : contact->point_count - 1U).how;
            if (how.kind == Construction::Kind::input) {
                line.points.at(k) = how.v[0];
                continue;
            }
            line.points.at(k) = static_cast<PointIndex>(store_.size());
            store_.append(std::span(&how, 1));
        }
        if (store_.equal(line.points[0], line.points[1])) return std::nullopt;
        return line;
    }

    /// Returns a line in which a triangle meets a quarter of the partners that it meets at all.
    [[nodiscard]] std::optional<PencilLine> busy_line(std::uint32_t f) {
        std::vector<std::uint32_t> met;
        std::vector<PencilLine> lines;
        const std::size_t step = std::max<std::size_t>(1, rest_.size() / partners_tried);
        for (std::size_t i = 0; i < rest_.size(); i += step) {
            const std::uint32_t g = rest_[i];
            if (g == f || is_same(f, g)) continue;
            const auto line = common_line(f, g);
            if (!line) continue;
            met.push_back(g);
            lines.push_back(*line);
        }
        for (unsigned k = 0; k < lines_tried && k < lines.size(); ++k) {
            const PencilLine& line = lines[lines.size() * k / lines_tried];
            const auto on_it = std::count_if(met.begin(), met.end(),
                                             [&](std::uint32_t g) { return holds(g, line); });
            if (on_it >= few && 4 * static_cast<std::size_t>(on_it) >= met.size()) return line;
        }
        return std::nullopt;
    }

    /// Triangles with three common corners have no contact to speak of.
    [[nodiscard]] bool is_same(std::uint32_t f, std::uint32_t g) const {
        Triangle a = soup_.triangles[f], b = soup_.triangles[g];
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        return a == b;
    }

    /// Makes a pencil of all triangles that hold the line and are in none yet. Returns false if they
    /// are too few.
    bool take(const PencilLine& line) {
        Pencil pencil;
        pencil.carriers = line.carriers;
        for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t)
            if (pencils_.of[t] == no_group && holds(t, line)) pencil.triangles.push_back(t);
        if (pencil.triangles.size() < least_triangles) return false;
        number_planes(line, pencil);
        const auto number = static_cast<std::uint32_t>(pencils_.list.size());
        for (const std::uint32_t t : pencil.triangles) pencils_.of[t] = number;
        std::erase_if(rest_, [&](std::uint32_t t) { return pencils_.of[t] != no_group; });
        pencils_.list.push_back(std::move(pencil));
        return true;
    }

    /// Sorts the triangles by their angle at the line, from the plane of the first carrier on, and
    /// numbers their planes.
    void number_planes(const PencilLine& line, Pencil& pencil) {
        struct Angle {
            std::size_t place; ///< in the list of triangles
            PointIndex tip;    ///< a corner that is not on the line
            Sign side;         ///< of the tip with respect to the carrier's plane
        };
        const Triangle& carrier = soup_.triangles[line.carriers[0]];
        const auto at = [&](std::uint32_t v) -> const Point3& { return soup_.points[v]; };
        std::vector<Angle> angles;
        pencil.plane_of.assign(pencil.triangles.size(), 0); // that of the carrier
        for (std::size_t k = 0; k < pencil.triangles.size(); ++k)
            for (const std::uint32_t v : soup_.triangles[pencil.triangles[k]]) {
                const Sign s = orient3d(at(carrier[0]), at(carrier[1]), at(carrier[2]), at(v));
                if (s == Sign::Zero) continue;
                angles.push_back({k, v, s});
                break;
            }
        const UpwardRounding guard;
        const auto turn = [&](const Angle& a, const Angle& b) {
            return a.side * b.side *
                   store_.orient3d(guard, line.points[0], line.points[1], a.tip, b.tip);
        };
        std::sort(angles.begin(), angles.end(),
                  [&](const Angle& a, const Angle& b) { return turn(a, b) == Sign::Positive; });
        std::uint32_t plane = 0;
        for (std::size_t i = 0; i < angles.size(); ++i) {
            if (i == 0 || turn(angles[i - 1], angles[i]) != Sign::Zero) ++plane;
            pencil.plane_of[angles[i].place] = plane;
        }
    }

    const TriangleSoup& soup_;
    const Run& run_;
    std::vector<std::uint32_t> rest_; ///< busy triangles in no pencil
    PointStore store_;
    Pencils pencils_;
};

/// The part of a pencil's line in one of its triangles.
struct PartOfLine {
    std::size_t triangle;          ///< in the pencil's list
    std::array<PointIndex, 2> end; ///< equal for a point
    std::array<Simplex, 2> place;
    Simplex inside;                      ///< of the points between the ends
    std::array<std::uint32_t, 2> rank{}; ///< of the ends among all distinct ones on the line
};

Simplex corner_place(unsigned i) {
    return static_cast<Simplex>(i);
}

Simplex edge_place(unsigned i) {
    return static_cast<Simplex>(3 + i);
}

/// Sweeps along the line of a pencil.
class PencilSweep {
public:
    PencilSweep(const TriangleSoup& soup, const Pencil& pencil) :
        soup_(soup), pencil_(pencil),
        store_(std::vector<Point3>(soup.points.begin(), soup.points.end())) {}

    PencilContacts operator()() {
        for (std::size_t k = 0; k < pencil_.triangles.size(); ++k) add_interval(k);
        store_.append(constructions_);
        rank_ends();
        count_planes();
        for (const PartOfLine& i : intervals_) draw(i);
        return std::move(found_);
    }

private:
    [[nodiscard]] const Triangle& corners(std::size_t k) const {
        return soup_.triangles[pencil_.triangles[k]];
    }
    /// Returns the carrier that is not coplanar with a triangle.
    [[nodiscard]] std::uint32_t carrier_across(std::size_t k) const {
        return pencil_.carriers.at(pencil_.plane_of[k] == 0 ? 1 : 0);
    }

    void add_interval(std::size_t k) {
        const Triangle& c = corners(k);
        const Triangle& plane = soup_.triangles[carrier_across(k)];
        std::array<Sign, 3> side{};
        for (unsigned i = 0; i < 3; ++i)
            side.at(i) = orient3d(soup_.points[plane[0]], soup_.points[plane[1]],
                                  soup_.points[plane[2]], soup_.points[c[i]]);
        PartOfLine found{k, {}, {}, Simplex::face};
        unsigned count = 0;
        for (unsigned i = 0; i < 3; ++i) {
            const unsigned j = (i + 1) % 3;
            if (side.at(i) == Sign::Zero) {
                found.end.at(count) = c[i];
                found.place.at(count++) = corner_place(i);
                if (side.at(j) == Sign::Zero) found.inside = edge_place(i);
            } else if (side.at(j) == -side.at(i)) {
                found.end.at(count) =
                    static_cast<PointIndex>(store_.input_count() + constructions_.size());
                constructions_.push_back(line_plane({c[i], c[j]}, plane));
                found.place.at(count++) = edge_place(i);
            }
        }
        if (count == 0) return;
        if (count == 1) {
            found.end[1] = found.end[0];
            found.place[1] = found.place[0];
        }
        intervals_.push_back(found);
    }

    /// Sorts all ends along the line and names each distinct one: by the input point there, or the
    /// lowest construction.
    void rank_ends() {
        std::vector<PointIndex> ends;
        for (const PartOfLine& i : intervals_) ends.insert(ends.end(), i.end.begin(), i.end.end());
        std::sort(ends.begin(), ends.end());
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
        std::sort(ends.begin(), ends.end(),
                  [&](PointIndex p, PointIndex q) { return store_.compare(p, q) < 0; });
        std::vector<std::uint32_t> rank_of(store_.size(), 0);
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const Construction how = store_.construction(ends[i]);
            if (i == 0 || !store_.equal(ends[i - 1], ends[i]))
                found_.points.push_back(how);
            else
                found_.points.back() = std::min(found_.points.back(), how);
            rank_of[ends[i]] = static_cast<std::uint32_t>(found_.points.size()) - 1;
        }
        for (PartOfLine& i : intervals_) {
            for (unsigned k = 0; k < 2; ++k) i.rank.at(k) = rank_of[i.end.at(k)];
            if (i.rank[0] <= i.rank[1]) continue;
            std::swap(i.rank[0], i.rank[1]);
            std::swap(i.place[0], i.place[1]);
        }
    }

    /// Counts the planes that have a triangle at each place: place 2 r is the end of rank r, and
    /// place 2 r + 1 is between it and the next.
    void count_planes() {
        std::vector<std::size_t> order(intervals_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto plane = [&](std::size_t i) { return pencil_.plane_of[intervals_[i].triangle]; };
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return std::pair{plane(a), intervals_[a].rank[0]} <
                   std::pair{plane(b), intervals_[b].rank[0]};
        });
        planes_at_.assign(2 * found_.points.size() + 1, 0);
        std::size_t free = 0; // the first place behind those of this plane
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (i == 0 || plane(order[i]) != plane(order[i - 1])) free = 0;
            const PartOfLine& in = intervals_[order[i]];
            const std::size_t first = std::max<std::size_t>(free, std::size_t{2} * in.rank[0]);
            const std::size_t end = std::size_t{2} * in.rank[1] + 1;
            if (first >= end) continue;
            ++planes_at_[first];
            --planes_at_[end];
            free = end;
        }
        std::partial_sum(planes_at_.begin(), planes_at_.end(), planes_at_.begin());
        next_shared_.assign(planes_at_.size(), planes_at_.size());
        for (std::size_t p = planes_at_.size(); p-- > 0;)
            next_shared_[p] = planes_at_[p] >= 2          ? p
                              : p + 1 < planes_at_.size() ? next_shared_[p + 1]
                                                          : planes_at_.size();
    }

    /// Adds what a triangle shares with those of other planes.
    void draw(const PartOfLine& i) {
        const std::size_t last = std::size_t{2} * i.rank[1];
        for (std::size_t p = next_shared_[std::size_t{2} * i.rank[0]]; p <= last;
             p = next_shared_[p + 1]) {
            const auto rank = static_cast<std::uint32_t>(p / 2);
            if (p % 2 == 1)
                add_piece(i, rank, rank + 1);
            else if ((p == 0 || p / 2 == i.rank[0] || planes_at_[p - 1] < 2) &&
                     (p == last || planes_at_[p + 1] < 2))
                add_piece(i, rank, rank);
        }
    }

    void add_piece(const PartOfLine& i, std::uint32_t from, std::uint32_t to) {
        const auto place = [&](std::uint32_t rank) {
            return rank == i.rank[0] ? i.place[0] : rank == i.rank[1] ? i.place[1] : i.inside;
        };
        const std::array places{place(from), place(to)};
        if (is_corner(places[0]) && is_corner(places[1]) &&
            (from == to || is_edge(i.inside))) // the triangle has it
            return;
        found_.pieces.push_back(
            {pencil_.triangles[i.triangle], {carrier_across(i.triangle)}, places, {from, to}});
    }

    const TriangleSoup& soup_;
    const Pencil& pencil_;
    PointStore store_;
    std::vector<Construction> constructions_;
    std::vector<PartOfLine> intervals_;
    std::vector<std::uint32_t> planes_at_; ///< per place
    std::vector<std::size_t> next_shared_; ///< per place: the next one, or itself, with two planes
    PencilContacts found_;
};

} // namespace

Pencils find_pencils(const TriangleSoup& soup, std::span<const std::uint32_t> busy,
                     const Run& run) {
    return PencilFinder(soup, busy, run)();
}

std::vector<CandidatePair> coplanar_pairs(const TriangleSoup& soup, const Pencils& pencils,
                                          std::span<const std::uint32_t> groups, const Run& run) {
    const Run quiet = without_progress(run);
    std::vector<CandidatePair> all;
    for (const Pencil& pencil : pencils.list) {
        std::vector<std::size_t> order(pencil.triangles.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return pencil.plane_of[a] < pencil.plane_of[b];
        });
        for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
            const auto plane = [&](std::size_t k) { return pencil.plane_of[order[k]]; };
            while (end < order.size() && plane(end) == plane(i)) ++end;
            std::vector<Box> boxes;
            std::vector<std::uint32_t> triangles, groups_here;
            for (std::size_t k = i; k < end; ++k) {
                triangles.push_back(pencil.triangles[order[k]]);
                boxes.push_back(box_of(soup.points, soup.triangles[triangles.back()]));
                if (!groups.empty()) groups_here.push_back(groups[triangles.back()]);
            }
            for (const CandidatePair& p :
                 candidate_pairs(boxes, groups_here, Search::automatic, quiet))
                all.push_back({triangles[p.first], triangles[p.second]});
        }
    }
    std::sort(all.begin(), all.end());
    return all;
}

PencilContacts contacts_of(const TriangleSoup& soup, const Pencil& pencil) {
    return PencilSweep(soup, pencil)();
}

} // namespace terrane
