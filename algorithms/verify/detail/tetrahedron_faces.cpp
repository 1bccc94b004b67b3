// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_faces of tetrahedra.hpp.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/joined_sets.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra.hpp>

namespace terrane::verifier {

namespace {

/// The corners of the faces of a tetrahedron that has a positive volume, counterclockwise as seen
/// from inside.
constexpr std::array<std::array<std::size_t, 3>, 4> seen_from_inside{
    {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};

/// A face of a tetrahedron.
struct CellFace {
    SortedCorners key; ///< places
    std::uint32_t cell = 0;
};

/// A face of the list.
struct Listed {
    std::uint32_t face = 0;
    bool even = true;
};

/// The tetrahedra in front of a face and behind it, or no_number.
using CellsAtFace = std::array<std::uint32_t, 2>;

/// Judges one face after the other.
class FaceJudge {
public:
    FaceJudge(const TetrahedraParts& parts, Violations& found) :
        parts_(parts), claim_(parts.claim), found_(found), faces_of_(parts.mesh.triangles.size()),
        twin_of_(claim_.faces.size(), no_number), on_cut_(parts.nodes.size()),
        corners_(4 * claim_.tetrahedra.size()) {}

    std::vector<Numbers> operator()() {
        take_twins();
        take_list();
        const auto faces = sorted_faces();
        for (std::size_t i = 0; i < faces.size();) {
            std::vector<CellFace> same;
            for (const Triangle key = faces[i].key.corners;
                 i < faces.size() && faces[i].key.corners == key; ++i)
                same.push_back(faces[i]);
            judge(same);
        }
        for (const auto& [key, listed] : list_) // those that no tetrahedron has
            refute(Rule::R42_faces, listed.face, "is no face of a tetrahedron");
        if (!claim_.twins.empty()) check_sharing();
        return std::move(faces_of_);
    }

private:
    void refute(Rule rule, std::uint32_t face, const std::string& what) {
        found_.push_back({rule, {face}, "face " + text(face) + " " + what});
    }
    void refute_cells(Rule rule, const CellsAtFace& cells, const std::string& what) {
        const std::uint32_t cell = std::min(cells[0], cells[1]);
        found_.push_back({rule, {cell}, "a face of tetrahedron " + text(cell) + " " + what});
    }

    // --- Lists ----------------------------------------------------------------------------------

    void take_twins() {
        for (const auto& [front, back] : claim_.twins) {
            const bool match =
                front != back && claim_.triangle_of[front] != no_number &&
                claim_.triangle_of[front] == claim_.triangle_of[back] &&
                parts_.places(claim_.faces[front]) == parts_.places(claim_.faces[back]) &&
                claim_.faces[front] != claim_.faces[back] && twin_of_[front] == no_number &&
                twin_of_[back] == no_number;
            if (!match) {
                refute(Rule::R48_cuts, front, "and its twin do not match");
                continue;
            }
            twin_of_[front] = back;
            twin_of_[back] = front;
            is_behind_.insert(back);
            for (const std::uint32_t place : parts_.places(claim_.faces[front]))
                on_cut_[place] = true;
        }
    }

    void take_list() {
        for (std::uint32_t f = 0; f < claim_.faces.size(); ++f) {
            if (is_behind_.contains(f)) continue;
            const SortedCorners key = sorted_corners(parts_.places(claim_.faces[f]));
            if (!list_.emplace(key.corners, Listed{f, key.even}).second)
                refute(Rule::R42_faces, f, "is listed twice");
            if (const std::uint32_t t = claim_.triangle_of[f]; t != no_number)
                faces_of_[t].push_back(f);
        }
    }

    [[nodiscard]] std::vector<CellFace> sorted_faces() const {
        std::vector<CellFace> faces;
        faces.reserve(4 * claim_.tetrahedra.size());
        for (std::uint32_t t = 0; t < claim_.tetrahedra.size(); ++t) {
            const auto places = parts_.places(claim_.tetrahedra[t]);
            for (const auto& [i, j, k] : seen_from_inside)
                faces.push_back({sorted_corners({places[i], places[j], places[k]}), t});
        }
        std::sort(faces.begin(), faces.end(), [](const CellFace& a, const CellFace& b) {
            return std::tie(a.key.corners, a.cell) < std::tie(b.key.corners, b.cell);
        });
        return faces;
    }

    // --- R42, R46: faces and blocks -------------------------------------------------------------

    void judge(const std::vector<CellFace>& same) {
        const Triangle& key = same[0].key.corners;
        std::optional<Listed> listed;
        if (const auto at = list_.find(key); at != list_.end()) {
            listed = at->second;
            list_.erase(at);
        }
        const bool wound = !listed || listed->even;
        CellsAtFace cells{no_number, no_number};
        for (const CellFace& face : same) {
            std::uint32_t& cell = cells[face.key.even == wound ? 0 : 1];
            if (cell != no_number)
                return refute_cells(Rule::R42_faces, {cell, face.cell},
                                    "has another tetrahedron on the same side");
            cell = face.cell;
        }
        const std::uint32_t triangle = listed ? claim_.triangle_of[listed->face] : no_number;
        if (!listed)
            judge_inner(cells);
        else if (triangle == no_number)
            judge_on_box(listed->face, key, cells);
        else
            judge_on_triangle(listed->face, triangle, cells);
        judge_nodes(listed ? listed->face : no_number, key, cells);
    }

    void judge_inner(const CellsAtFace& cells) {
        if (cells[0] == no_number || cells[1] == no_number)
            return refute_cells(Rule::R42_faces, cells,
                                "has one tetrahedron, and is on no triangle");
        if (block(cells[0]) != block(cells[1]))
            refute_cells(Rule::R46_blocks, cells, "is between two blocks, and on no triangle");
    }

    void judge_on_box(std::uint32_t face, const Triangle& key, const CellsAtFace& cells) {
        const auto all_at = [&](std::size_t i, const mpz_class& coordinate) {
            return std::ranges::all_of(
                key, [&](std::uint32_t v) { return parts_.nodes[v][i] == coordinate; });
        };
        bool on_side = false;
        for (std::size_t i = 0; i < 3; ++i)
            on_side = on_side || all_at(i, parts_.box.low[i]) || all_at(i, parts_.box.high[i]);
        if (!claim_.box || !on_side || cells[0] != no_number || cells[1] == no_number)
            return refute(Rule::R42_faces, face, "is not on the box, wound outward");
        if (block(cells[1]) != 0) refute(Rule::R46_blocks, face, "is on the box, but of a block");
    }

    void judge_on_triangle(std::uint32_t face, std::uint32_t triangle, const CellsAtFace& cells) {
        for (std::size_t side = 0; side < 2; ++side) {
            const std::uint32_t expected = parts_.mesh.sides[triangle][side];
            const std::string where = side == 0 ? "in front of it" : "behind it";
            const bool filled = claim_.box || expected != 0;
            if (filled != (cells[side] != no_number))
                refute(Rule::R42_faces, face,
                       filled ? "has no tetrahedron " + where
                              : "has a tetrahedron " + where + ", where the outside is");
            else if (filled && block(cells[side]) != expected)
                refute(Rule::R46_blocks, face,
                       "has block " + text(block(cells[side])) + " " + where + ", triangle " +
                           text(triangle) + " has block " + text(expected));
        }
    }

    [[nodiscard]] std::uint32_t block(std::uint32_t cell) const { return claim_.block_of[cell]; }

    // --- R48: cuts, by statement (9) -------------------------------------------------------------

    /// Returns which corner of a tetrahedron is at a place.
    [[nodiscard]] std::uint32_t corner_at(std::uint32_t cell, std::uint32_t place) const {
        const auto places = parts_.places(claim_.tetrahedra[cell]);
        return static_cast<std::uint32_t>(std::ranges::find(places, place) - places.begin()) % 4;
    }
    /// Returns the nodes that a tetrahedron has at these places, ascending.
    [[nodiscard]] Triangle nodes_at(std::uint32_t cell, Triangle key) const {
        for (std::uint32_t& place : key) place = claim_.tetrahedra[cell][corner_at(cell, place)];
        std::sort(key.begin(), key.end());
        return key;
    }
    [[nodiscard]] Triangle sorted_face(std::uint32_t face) const {
        Triangle nodes = claim_.faces[face];
        std::sort(nodes.begin(), nodes.end());
        return nodes;
    }

    /// Judges which nodes the tetrahedra at a face have, and joins the corners that must share one.
    void judge_nodes(std::uint32_t face, const Triangle& key, const CellsAtFace& cells) {
        const std::uint32_t single = cells[0] == no_number ? cells[1] : cells[0];
        if (face != no_number && sorted_face(face) != nodes_at(single, key))
            refute(Rule::R48_cuts, face, "does not have the nodes of its tetrahedron");
        const std::uint32_t twin = face == no_number ? no_number : twin_of_[face];
        if (cells[0] == no_number || cells[1] == no_number) {
            if (twin != no_number) refute(Rule::R48_cuts, face, "has a twin, but one tetrahedron");
            return;
        }
        if (twin != no_number) {
            if (sorted_face(twin) != nodes_at(cells[1], key))
                refute(Rule::R48_cuts, twin, "does not have the nodes behind the cut");
            return;
        }
        if (nodes_at(cells[0], key) != nodes_at(cells[1], key))
            refute_cells(Rule::R48_cuts, cells, "does not have the same nodes on both sides");
        for (const std::uint32_t place : key)
            corners_.join(4 * cells[0] + corner_at(cells[0], place),
                          4 * cells[1] + corner_at(cells[1], place));
    }

    /// Checks that tetrahedra share a node at a cut only where they hang together around it.
    void check_sharing() {
        Numbers set_of(claim_.vertices.size(), no_number);
        for (std::uint32_t t = 0; t < claim_.tetrahedra.size(); ++t)
            for (std::uint32_t k = 0; k < 4; ++k) {
                const std::uint32_t node = claim_.tetrahedra[t][k];
                if (!on_cut_[parts_.place_of[node]]) continue;
                const std::uint32_t set = corners_.find(4 * t + k);
                if (set_of[node] == no_number) set_of[node] = set;
                if (set_of[node] != set)
                    found_.push_back(
                        {Rule::R48_cuts, {node}, "node " + text(node) + " is shared across a cut"});
            }
    }

    const TetrahedraParts& parts_;
    const TetrahedraClaim& claim_;
    Violations& found_;
    std::vector<Numbers> faces_of_;
    Numbers twin_of_;                   ///< per face
    std::set<std::uint32_t> is_behind_; ///< the second faces of twins
    std::vector<bool> on_cut_;          ///< per place
    JoinedSets corners_;                ///< corners of tetrahedra that must share a node
    std::map<Triangle, Listed> list_;   ///< by places; those that were not met
};

} // namespace

std::vector<Numbers> check_faces(const TetrahedraParts& parts, Violations& found) {
    return FaceJudge(parts, found)();
}

} // namespace terrane::verifier
