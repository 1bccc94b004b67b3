// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A surface is a chain of triangles. Adding the boundary of a cell to it (modulo 2) moves the part of
// it that bounds the cell to the other side of the cell. This is done for all surfaces of the largest
// interface of a thin cell, which then vanishes, as long as the area of all triangles decreases.
#include <terrane/algorithms/tolerance/detail/thin_cells.hpp>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/tolerance/detail/tuning.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::tolerance::detail {
namespace {

/// A triangle of the boundary of a cell.
struct Face {
    std::uint32_t triangle = 0;
    bool is_front = false; ///< whether its front faces the cell
};

/// Some cells that are one, with their boundary.
struct Cell {
    double volume = 0, area = 0;
    std::vector<Face> faces{};

    [[nodiscard]] bool is_thin(double bound) const { return 2 * volume <= bound * area; }
};

using SurfaceSet = std::vector<std::uint32_t>; ///< ascending

class CellJoining {
public:
    CellJoining(const Arrangement& a, const Volumes& volumes, const std::vector<bool>& closed,
                double bound, const Run& run) :
        a_(a),
        volumes_(volumes), bound_(bound), run_(run), area_(a.triangles.size()) {
        result_.owners.resize(a.triangles.size());
        for (std::uint32_t v = 0; v < a.vertices.size(); ++v)
            places_.push_back(a.nearest(VertexId(v)));
        std::vector<std::uint32_t> corners;
        for (std::uint32_t t = 0; t < a.triangles.size(); ++t) {
            const auto& [p, q, r] = a.triangles[t];
            corners.insert(corners.end(), {p, q, r});
            area_[t] = area_between(places_[p], places_[q], places_[r]);
            set_owners(t, closed);
        }
        at_vertex_ = lists_by_key<std::uint32_t>(a.vertices.size(), corners, [](std::size_t i) {
            return static_cast<std::uint32_t>(i / 3);
        });
    }

    Ownership operator()() {
        std::vector<std::uint32_t> each(volumes_.measures.size());
        std::iota(each.begin(), each.end(), 0U);
        const auto single = thin_cells(each);
        // First cell by cell, then those together that no surface divides any more.
        while (!run_.stop.stop_requested() && (join_all(single) || join_all(joined_cells()))) {
        }
        list_left();
        return std::move(result_);
    }

private:
    // ---- Cells

    void set_owners(std::uint32_t t, const std::vector<bool>& closed) {
        const auto fences = static_cast<std::uint32_t>(a_.surfaces.size() - 1);
        std::map<std::uint32_t, std::vector<std::uint32_t>> parents; // by surface
        for (const std::uint32_t p : a_.parents_of[t])
            parents[a_.inputs.surface_of(InputTriangleId(p))].push_back(p);
        const Point3 front = normal_of_input(a_.parents_of[t][0]);
        for (const auto& [surface, of] : parents)
            if (surface != fences && !(closed[surface] && of.size() % 2 == 0))
                result_.owners[t].push_back({surface, dot(front, normal_of_input(of[0])) < 0});
    }
    [[nodiscard]] Point3 normal_of_input(std::uint32_t triangle) const {
        const auto points = a_.input_vertices();
        const auto& [p, q, r] = a_.input_corners()[triangle];
        return cross(minus(points[q], points[p]), minus(points[r], points[p]));
    }
    /// Returns the thin ones among joined cells, without the outside; `number`: per volume.
    [[nodiscard]] std::vector<Cell> thin_cells(std::span<const std::uint32_t> number) const {
        std::map<std::uint32_t, Cell> cells;
        for (std::uint32_t c = 1; c < number.size(); ++c)
            if (number[c] != number[0]) cells[number[c]].volume += volumes_.measures[c];
        for (std::uint32_t t = 0; t < area_.size(); ++t) {
            const auto& [front, back] = volumes_.of_sides[t];
            if (number[front] == number[back]) continue;
            for (const bool is_front : {true, false})
                if (const auto at = cells.find(number[is_front ? front : back]);
                    at != cells.end()) {
                    at->second.area += area_[t];
                    at->second.faces.push_back({t, is_front});
                }
        }
        std::vector<Cell> thin;
        for (auto& [of, cell] : cells)
            if (cell.is_thin(bound_)) thin.push_back(std::move(cell));
        return thin;
    }
    /// Returns the thin blocks: cells that no surface divides are one.
    [[nodiscard]] std::vector<Cell> joined_cells() const {
        DisjointSets sets(volumes_.measures.size());
        for (std::uint32_t t = 0; t < area_.size(); ++t)
            if (result_.owners[t].empty())
                sets.join(volumes_.of_sides[t][0], volumes_.of_sides[t][1]);
        return thin_cells(sets.flattened());
    }

    // ---- CellJoining

    bool join_all(const std::vector<Cell>& cells) {
        std::size_t joined = 0;
        for (const Cell& cell : cells)
            if (!run_.stop.stop_requested() && join(cell)) {
                ++joined;
                result_.volume += cell.volume;
            }
        result_.cells += joined;
        return joined > 0;
    }
    [[nodiscard]] SurfaceSet surfaces_at(std::uint32_t t) const {
        SurfaceSet list;
        for (const Owner& o : result_.owners[t]) list.push_back(o.surface);
        return list;
    }
    [[nodiscard]] bool has(std::uint32_t t, std::uint32_t surface) const {
        return std::ranges::any_of(result_.owners[t],
                                   [&](const Owner& o) { return o.surface == surface; });
    }
    /// Removes an interface of a cell, the largest if it can be.
    bool join(const Cell& cell) {
        std::map<SurfaceSet, double> areas;
        for (const Face& f : cell.faces) areas[surfaces_at(f.triangle)] += area_[f.triangle];
        const double of_none = areas[SurfaceSet{}]; // which will be of these surfaces
        areas.erase(SurfaceSet{});
        std::vector<std::pair<double, SurfaceSet>> order;
        for (const auto& [surfaces, area] : areas)
            if (area > of_none + tuning.least_gain * cell.area) order.emplace_back(area, surfaces);
        std::ranges::sort(order, std::greater{});
        const auto alike = std::ranges::find_if(order, [&](const auto& one) {
            return one.first < order[0].first - tuning.alike * cell.area;
        });
        std::ranges::sort(order.begin(), alike, std::greater{},
                          [](const auto& one) { return one.second; });
        return std::ranges::any_of(order,
                                   [&](const auto& one) { return remove(one.second, cell); });
    }
    [[nodiscard]] Surface part(const std::vector<std::uint32_t>& triangles) const {
        Surface s;
        for (const std::uint32_t t : triangles) {
            const auto first = static_cast<std::uint32_t>(s.vertices.size());
            for (const std::uint32_t v : a_.triangles[t]) s.vertices.push_back(places_[v]);
            s.triangles.push_back({first, first + 1, first + 2});
        }
        return s;
    }
    /// Returns a box with all that is within the bound of a cell.
    [[nodiscard]] Box box_around(const Cell& cell) const {
        Box all = box_of(places_, a_.triangles[cell.faces[0].triangle]);
        for (const Face& f : cell.faces) {
            const Box one = box_of(places_, a_.triangles[f.triangle]);
            for (std::size_t k = 0; k < 3; ++k) {
                all.low[k] = std::min(all.low[k], one.low[k] - bound_);
                all.high[k] = std::max(all.high[k], one.high[k] + bound_);
            }
        }
        return all;
    }
    [[nodiscard]] double moved(std::uint32_t t, std::uint32_t surface) const {
        const auto at = moved_.find({t, surface});
        return at == moved_.end() ? 0 : at->second;
    }
    /// Returns how far a surface will have moved if the boundary of the cell is added to it: infinity if more than it may.
    [[nodiscard]] double move_of(std::uint32_t surface, const Cell& cell,
                                 const std::set<std::uint32_t>& own) const {
        std::vector<std::uint32_t> from, to;
        std::set<std::uint32_t> others; // triangles of the surface next to the cell
        double before = 0;
        for (const Face& f : cell.faces) {
            const bool is_of = has(f.triangle, surface);
            (is_of ? from : to).push_back(f.triangle);
            if (is_of) before = std::max(before, moved(f.triangle, surface));
            for (const std::uint32_t v : a_.triangles[f.triangle])
                for (const std::uint32_t t : at_vertex_[v])
                    if (!own.contains(t) && has(t, surface)) others.insert(t);
        }
        const auto sampled = [&] {
            auto near_from = from, near_to = to;
            near_from.insert(near_from.end(), others.begin(), others.end());
            near_to.insert(near_to.end(), others.begin(), others.end());
            return before + std::max(sampled_distance(part(from), part(near_to), run_),
                                     sampled_distance(part(to), part(near_from), run_));
        };
        const double move = sampled();
        if (move <= bound_) return move;
        // Parts of the surface that are near, but not next to the cell.
        const Box around = box_around(cell);
        for (std::uint32_t t = 0; t < a_.triangles.size(); ++t)
            if (has(t, surface) && !own.contains(t) &&
                box_of(places_, a_.triangles[t]).overlaps(around))
                others.insert(t);
        return sampled();
    }
    /// Adds the boundary of a cell to surfaces, unless one of them would move too far.
    bool remove(const SurfaceSet& surfaces, const Cell& cell) {
        std::set<std::uint32_t> own;
        for (const Face& f : cell.faces) own.insert(f.triangle);
        std::vector<double> moves;
        for (const std::uint32_t surface : surfaces) {
            moves.push_back(move_of(surface, cell, own));
            if (!(moves.back() <= bound_)) return false;
        }
        for (std::size_t i = 0; i < surfaces.size(); ++i) add_boundary(cell, surfaces[i], moves[i]);
        return true;
    }
    void add_boundary(const Cell& cell, std::uint32_t surface, double move) {
        bool faces_cell = false; // whether the front of the surface does
        for (const Face& f : cell.faces)
            for (const Owner& o : result_.owners[f.triangle])
                if (o.surface == surface) faces_cell = f.is_front != o.is_reversed;
        for (const Face& f : cell.faces) {
            auto& owners = result_.owners[f.triangle];
            if (std::erase_if(owners, [&](const Owner& o) { return o.surface == surface; }) > 0)
                continue;
            // Seen from the other side of the cell, the front of the surface is where it was.
            owners.push_back({surface, f.is_front == faces_cell});
            std::ranges::sort(owners, {}, &Owner::surface);
            moved_[{f.triangle, surface}] = move;
        }
    }

    void list_left() {
        for (const Cell& cell : joined_cells()) {
            ThinCell& left = result_.left.emplace_back();
            left.thickness = 2 * cell.volume / cell.area;
            left.volume = cell.volume;
            std::uint32_t largest = cell.faces[0].triangle;
            for (const Face& f : cell.faces) {
                for (const Owner& o : result_.owners[f.triangle])
                    left.surfaces.push_back(o.surface);
                if (area_[f.triangle] > area_[largest]) largest = f.triangle;
            }
            sort_unique(left.surfaces);
            const auto& [p, q, r] = a_.triangles[largest];
            left.place = centre_of(places_[p], places_[q], places_[r]);
        }
        std::ranges::stable_sort(result_.left, std::greater{}, &ThinCell::volume);
    }

    const Arrangement& a_;
    const Volumes& volumes_;
    const double bound_;
    const Run& run_;
    Ownership result_;
    std::vector<double> area_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double>
        moved_; ///< how far a surface moved to a triangle, where it did
    std::vector<Point3> places_;
    IndexLists<std::uint32_t> at_vertex_; ///< triangles
};

} // namespace

Result<Ownership> join_thin_cells(const Arrangement& arrangement, const std::vector<bool>& closed,
                                  double bound, const Run& run) {
    const auto volumes = find_volumes(arrangement, run);
    if (!volumes) return volumes.error();
    return CellJoining(arrangement, *volumes, closed, bound, run)();
}

} // namespace terrane::tolerance::detail
