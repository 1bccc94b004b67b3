// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <numeric>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include <terrane/algorithms/contacts.hpp>
#include <terrane/algorithms/edges.hpp>
#include <terrane/algorithms/parallel.hpp>
#include <terrane/algorithms/soup.hpp>
#include <terrane/algorithms/triangulation.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

class Stopwatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::string place_in(const Surface& s, const char* what, std::size_t k) {
    return "surface " + s.name + ", " + what + " " + std::to_string(k);
}

Status validate(std::span<const Surface> surfaces) {
    std::size_t vertices = 0, triangles = 0;
    for (const Surface& s : surfaces) {
        vertices += s.vertices.size();
        triangles += s.triangles.size();
        for (std::size_t v = 0; v < s.vertices.size(); ++v) {
            const Point3& p = s.vertices[v];
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                return Error{ErrorCode::bad_number, "a coordinate is not finite",
                             place_in(s, "vertex", v)};
        }
        for (std::size_t t = 0; t < s.triangles.size(); ++t)
            for (const std::uint32_t v : s.triangles[t])
                if (v >= s.vertices.size())
                    return Error{ErrorCode::bad_index, "a corner names no vertex",
                                 place_in(s, "triangle", t)};
    }
    if (vertices >= UINT32_MAX / 2 || triangles >= UINT32_MAX / 4)
        return Error{ErrorCode::unsupported, "more than 2^30 triangles or 2^31 vertices", ""};
    return Done{};
}

/// A part of a divided triangle; corners by point.
struct Part {
    std::uint32_t face;
    std::array<PointIndex, 3> corners;
};

struct PartBlock {
    std::vector<Part> parts;
    PredicateCounts predicates;
};

/// Step (e): gathers what each face must contain and triangulates it.
class Divider {
public:
    Divider(const Soup& soup, const Contacts& contacts, const PointOrder& order) :
        soup_(soup), contacts_(contacts), order_(order) {}

    /// One face: its pieces and crossings.
    void operator()(std::span<const FacePiece> pieces, std::uint32_t first_piece,
                    std::span<const FaceCrossing> crossings, std::vector<Part>& out) {
        face_.clear();
        const std::uint32_t f = pieces.front().face;
        const Triangle& t = soup_.triangles[f];
        face_.corners = t;
        face_.axis = projection_axis(soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]]);
        chains_.assign(pieces.size(), {});
        for (const FacePiece& p : pieces)
            for (unsigned e = 0; e < 2; ++e) add_point(p.ends[e], p.place[e]);
        for (const FaceCrossing& c : crossings) {
            const PointIndex p = order_.same_as[c.point];
            face_.inner_points.push_back(p);
            for (const std::uint32_t k : c.pieces) chains_[k - first_piece].push_back(p);
        }
        for (std::size_t k = 0; k < pieces.size(); ++k)
            if (pieces[k].is_inner_segment()) add_chain(pieces[k], chains_[k]);
        finish_points();
        for (const auto& part : triangulate_(contacts_.points, order_.rank, face_))
            out.push_back({f, part});
    }

private:
    bool by_rank(PointIndex a, PointIndex b) const { return order_.rank[a] < order_.rank[b]; }

    void add_point(PointIndex point, Place place) {
        const PointIndex p = order_.same_as[point];
        if (is_edge(place)) face_.edge_points[edge_of(place)].push_back(p);
        if (place == Place::face) face_.inner_points.push_back(p);
    }

    void sort_unique(std::vector<PointIndex>& points) const {
        std::sort(points.begin(), points.end(),
                  [&](PointIndex a, PointIndex b) { return by_rank(a, b); });
        points.erase(std::unique(points.begin(), points.end()), points.end());
    }

    void add_chain(const FacePiece& piece, std::vector<PointIndex>& chain) {
        for (const PointIndex e : piece.ends) chain.push_back(order_.same_as[e]);
        sort_unique(chain);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            face_.segments.push_back({chain[i], chain[i + 1]});
    }

    // Along a line, points are in lexicographic order, forwards or backwards.
    void finish_points() {
        for (unsigned e = 0; e < 3; ++e) {
            sort_unique(face_.edge_points[e]);
            if (by_rank(face_.corners[(e + 1) % 3], face_.corners[e]))
                std::reverse(face_.edge_points[e].begin(), face_.edge_points[e].end());
        }
        sort_unique(face_.inner_points);
        std::sort(face_.segments.begin(), face_.segments.end());
        face_.segments.erase(std::unique(face_.segments.begin(), face_.segments.end()),
                             face_.segments.end());
    }

    const Soup& soup_;
    const Contacts& contacts_;
    const PointOrder& order_;
    FaceInput face_;
    std::vector<std::vector<PointIndex>> chains_;
    FaceTriangulation triangulate_;
};

std::vector<Part> divide_faces(const Soup& soup, const Contacts& contacts, const PointOrder& order,
                               const Run& run, ArrangeStatistics& statistics) {
    struct Range {
        std::uint32_t piece, piece_end, crossing, crossing_end;
    };
    std::vector<Range> faces;
    const auto count = [](const auto& v) { return static_cast<std::uint32_t>(v.size()); };
    for (std::uint32_t p = 0, c = 0; p < count(contacts.pieces);) {
        Range r{p, p, c, c};
        const std::uint32_t f = contacts.pieces[p].face;
        while (r.piece_end < count(contacts.pieces) && contacts.pieces[r.piece_end].face == f)
            ++r.piece_end;
        while (r.crossing_end < count(contacts.crossings) &&
               contacts.crossings[r.crossing_end].face == f)
            ++r.crossing_end;
        faces.push_back(r);
        p = r.piece_end;
        c = r.crossing_end;
    }
    statistics.divided = faces.size();
    const std::span pieces(contacts.pieces);
    const std::span crossings(contacts.crossings);
    const auto blocks =
        for_blocks<PartBlock>(faces.size(), 256, run, [&](std::size_t first, std::size_t last) {
            PartBlock block;
            const PredicateCounts before = predicate_counts();
            Divider divide(soup, contacts, order);
            for (std::size_t i = first; i < last; ++i) {
                const Range& r = faces[i];
                divide(pieces.subspan(r.piece, r.piece_end - r.piece), r.piece,
                       crossings.subspan(r.crossing, r.crossing_end - r.crossing), block.parts);
            }
            block.predicates = predicate_counts() - before;
            return block;
        });
    std::vector<Part> parts;
    for (const PartBlock& b : blocks) {
        parts.insert(parts.end(), b.parts.begin(), b.parts.end());
        statistics.predicates += b.predicates;
    }
    return parts;
}

/// Step (f): one list of unique triangles with parents, undivided ones included.
class Stitcher {
public:
    Stitcher(const Soup& soup, const Contacts& contacts, const PointOrder& order,
             const std::vector<Part>& parts, Arrangement& out) :
        soup_(soup), contacts_(contacts), order_(order), parts_(parts), out_(out) {}

    void operator()() {
        collect_repeated();
        index_duplicates();
        for (std::uint32_t f = 0, p = 0; f < soup_.triangles.size(); ++f) {
            const bool divided = p < parts_.size() && parts_[p].face == f;
            if (!divided && !is_divided(f)) add(soup_.triangles[f], {&f, 1});
            for (; p < parts_.size() && parts_[p].face == f; ++p) add_part(p);
        }
        name_vertices();
    }

private:
    using Corners = std::array<PointIndex, 3>;
    struct Hash {
        std::size_t operator()(const Corners& c) const {
            return (c[0] * 0x9e3779b97f4a7c15u ^ c[1]) * 0x9e3779b97f4a7c15u ^ c[2];
        }
    };

    bool is_divided(std::uint32_t f) const { return !divided_.empty() && divided_[f]; }

    static Corners sorted(Corners c) {
        std::sort(c.begin(), c.end());
        return c;
    }

    // Only triangles that some coplanar one overlaps can have a part in common with another.
    void collect_repeated() {
        divided_.assign(soup_.triangles.size(), false);
        for (std::uint32_t p = 0; p < parts_.size(); ++p) {
            divided_[parts_[p].face] = true;
            if (contacts_.overlapped[parts_[p].face])
                faces_of_[sorted(parts_[p].corners)].push_back(parts_[p].face);
        }
    }

    void index_duplicates() {
        by_first_ = soup_.duplicates;
        std::sort(by_first_.begin(), by_first_.end(), [](const auto& a, const auto& b) {
            return std::pair{a[1], a[0]} < std::pair{b[1], b[0]};
        });
    }

    void add_part(std::uint32_t p) {
        const Part& part = parts_[p];
        if (!contacts_.overlapped[part.face]) return add(part.corners, {&part.face, 1});
        const auto& faces = faces_of_[sorted(part.corners)];
        if (faces.front() == part.face) add(part.corners, faces);
    }

    void add(const Corners& corners, std::span<const std::uint32_t> faces) {
        out_.triangles.push_back(corners);
        auto& parents = out_.parents_of.values;
        auto& surfaces = out_.surfaces_of.values;
        const std::size_t first_parent = parents.size(), first_surface = surfaces.size();
        for (const std::uint32_t f : faces) {
            add_parent(soup_.input_of[f]);
            surfaces.push_back(soup_.surface_of[f]);
        }
        if (!by_first_.empty())
            for (const std::uint32_t f : faces) add_duplicates(soup_.input_of[f]);
        const auto tidy = [](std::vector<std::uint32_t>& v, std::size_t first) {
            if (v.size() == first + 1) return;
            const auto begin = v.begin() + static_cast<std::ptrdiff_t>(first);
            std::sort(begin, v.end());
            v.erase(std::unique(begin, v.end()), v.end());
        };
        tidy(parents, first_parent);
        tidy(surfaces, first_surface);
        out_.parents_of.close();
        out_.surfaces_of.close();
    }

    void add_parent(std::uint32_t input) { out_.parents_of.values.push_back(input); }

    void add_duplicates(std::uint32_t first) {
        auto it = std::lower_bound(by_first_.begin(), by_first_.end(), first,
                                   [](const auto& d, std::uint32_t f) { return d[1] < f; });
        for (; it != by_first_.end() && (*it)[1] == first; ++it) {
            add_parent((*it)[0]);
            out_.surfaces_of.values.push_back(surface_of_input((*it)[0]));
        }
    }

    std::uint32_t surface_of_input(std::uint32_t input) const {
        const auto& first = soup_.first_input_triangle;
        return static_cast<std::uint32_t>(std::upper_bound(first.begin(), first.end(), input) -
                                          first.begin() - 1);
    }

    // Points in use become vertices: input ones by number, constructed ones by rank.
    void name_vertices() {
        const auto inputs = static_cast<PointIndex>(soup_.points.size());
        std::vector<std::uint32_t> vertex_of(contacts_.points.size(), UINT32_MAX);
        for (const Triangle& t : out_.triangles)
            for (const PointIndex p : t) vertex_of[p] = 0;
        const auto name = [&](PointIndex p) {
            if (vertex_of[p] == UINT32_MAX) return;
            vertex_of[p] = static_cast<std::uint32_t>(out_.vertices.size());
            out_.vertices.push_back(p);
        };
        for (PointIndex p = 0; p < inputs; ++p) name(p);
        for (const PointIndex p : order_.ascending) name(p);
        for (Triangle& t : out_.triangles)
            for (PointIndex& p : t) p = vertex_of[p];
    }

    const Soup& soup_;
    const Contacts& contacts_;
    const PointOrder& order_;
    const std::vector<Part>& parts_;
    Arrangement& out_;
    std::vector<bool> divided_;
    std::unordered_map<Corners, std::vector<std::uint32_t>, Hash> faces_of_;
    std::vector<std::array<std::uint32_t, 2>> by_first_;
};

/// Per triangle and surface, the number of distinct parents: what must agree across an edge that is
/// no intersection.
class Signatures {
public:
    explicit Signatures(const Arrangement& a) : a_(a) {
        for (const auto& d : a.duplicates) first_of_.emplace(d[0], d[1]);
    }

    bool agree(std::uint32_t s, std::uint32_t t) const {
        const auto p = a_.parents_of[s], q = a_.parents_of[t];
        if (p.size() == 1 && q.size() == 1) return a_.surfaces_of[s][0] == a_.surfaces_of[t][0];
        return signature(s) == signature(t);
    }

private:
    // Sorted {surface, distinct triangle} with the triangle forgotten.
    std::vector<std::uint32_t> signature(std::uint32_t t) const {
        std::vector<std::array<std::uint32_t, 2>> distinct;
        for (const std::uint32_t p : a_.parents_of[t]) {
            const auto& first = a_.first_input_triangle;
            const auto s = std::upper_bound(first.begin(), first.end(), p) - first.begin() - 1;
            const auto d = first_of_.find(p);
            distinct.push_back({static_cast<std::uint32_t>(s),
                                d == first_of_.end() ? p : d->second});
        }
        std::sort(distinct.begin(), distinct.end());
        distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
        std::vector<std::uint32_t> surfaces;
        for (const auto& d : distinct) surfaces.push_back(d[0]);
        return surfaces;
    }

    const Arrangement& a_;
    std::unordered_map<std::uint32_t, std::uint32_t> first_of_;
};

void find_intersection_edges(Arrangement& a) {
    const Signatures signatures(a);
    const auto is_intersection = [&](std::span<const EdgeSides::Side> sides) {
        if (sides.size() > 2) return true;
        return sides.size() == 2 && !signatures.agree(sides[0].triangle, sides[1].triangle);
    };
    group_edges(a.triangles, a.vertices.size())
        .for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
            if (is_intersection(sides)) a.intersection_edges.push_back({low, high});
        });
}

Error interrupted() { return {ErrorCode::interrupted, "stopped on request", ""}; }

Result<Arrangement> arrange_checked(std::span<const Surface> surfaces,
                                    const ArrangeOptions& options, const Run& run) {
    const auto report = [&](double share) {
        if (run.progress) run.progress("arrange", share);
    };
    Stopwatch watch;
    Arrangement a;
    for (const Surface& s : surfaces) a.surfaces.push_back({s.name, s.role});

    // (a) one soup of distinct points and triangles
    const Soup soup = merge_surfaces(surfaces);
    a.statistics.seconds_prepare = watch.lap();
    report(0.1);

    // (b) candidate pairs
    const auto candidates =
        candidate_pairs(boxes_of(soup.points, soup.triangles), {}, options.search);
    a.statistics.seconds_search = watch.lap();
    report(0.3);
    if (run.stop.stop_requested()) return interrupted();

    // (c) contacts, crossings inside triangles, (d) equal points merged
    Contacts contacts = find_contacts(soup, candidates, run);
    find_crossings(soup, contacts, run);
    if (run.stop.stop_requested()) return interrupted();
    const PointOrder order = order_points(soup, contacts);
    a.statistics.seconds_intersect = watch.lap();
    report(0.6);

    // (e) each triangle that anything touches is triangulated
    const auto parts = divide_faces(soup, contacts, order, run, a.statistics);
    if (run.stop.stop_requested()) return interrupted();
    a.statistics.seconds_triangulate = watch.lap();
    report(0.9);

    // (f) one mesh
    a.first_input_triangle = soup.first_input_triangle;
    a.degenerate = soup.degenerate;
    a.duplicates = soup.duplicates;
    Stitcher(soup, contacts, order, parts, a)();
    find_intersection_edges(a);
    a.statistics.candidates = contacts.candidates;
    a.statistics.improper_contacts = contacts.improper;
    a.statistics.predicates += contacts.predicates;
    a.statistics.constructed_points = order.ascending.size();
    a.points = std::move(contacts.points);
    a.statistics.seconds_stitch = watch.lap();
    report(1);
    return a;
}

} // namespace

Result<Arrangement> arrange(std::span<const Surface> surfaces, const ArrangeOptions& options,
                            const Run& run) {
    if (const auto valid = validate(surfaces); !valid) return valid.error();
    try {
        return arrange_checked(surfaces, options, run);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::out_of_memory, "not enough memory for the arrangement", ""};
    } catch (const std::logic_error& broken) {
        return Error{ErrorCode::internal, broken.what(), "arrange"};
    }
}

} // namespace terrane
