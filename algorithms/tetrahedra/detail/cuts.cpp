// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/detail/cuts.hpp>

#include <algorithm>

namespace terrane::tetrahedra::detail {
namespace {

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

} // namespace

CutCheck::CutCheck(const Subject& subject, const Places& places) :
    subject_(subject), places_(places), active_(!subject.made.twins.empty()),
    sets_(active_ ? 4 * subject.made.tetrahedra.size() : 0) {
    if (active_) check_twins();
}

void CutCheck::wrong(std::uint32_t face) {
    subject_.findings.add(TetrahedraDefect::wrong_twins,
                          "face {} does not have the nodes in front of and behind the cut", face);
}

void CutCheck::check_twins() {
    const TetrahedralMesh& made = subject_.made;
    twin_of_.assign(made.faces.size(), none);
    on_cut_.resize(made.vertices.size());
    for (const auto& [front, back] : made.twins) {
        const bool match = made.face_triangle[front] == made.face_triangle[back] &&
                           made.face_triangle[front] != none &&
                           std::ranges::equal(made.surfaces_of[front], made.surfaces_of[back]) &&
                           places_.of(made.faces[front]) == places_.of(made.faces[back]) &&
                           made.faces[front] != made.faces[back] && twin_of_[front] == none;
        if (!match) wrong(front);
        twin_of_[front] = back;
        for (const std::uint32_t place : places_.of(made.faces[front])) on_cut_[place] = true;
    }
}

std::uint32_t CutCheck::corner_at(std::uint32_t tetrahedron, std::uint32_t place) const {
    std::uint32_t corner = 0;
    while (corner < 3 && places_.of_node[subject_.made.tetrahedra[tetrahedron][corner]] != place)
        ++corner;
    return corner;
}

Triangle CutCheck::nodes_at(std::uint32_t tetrahedron, const Triangle& key) const {
    Triangle nodes = key;
    for (std::uint32_t& v : nodes)
        v = subject_.made.tetrahedra[tetrahedron][corner_at(tetrahedron, v)];
    return nodes;
}

void CutCheck::pass(std::uint32_t face, const Triangle& key,
                    const std::array<std::uint32_t, 2>& sides) {
    if (!active_) return;
    const TetrahedralMesh& made = subject_.made;
    const Triangle front = nodes_at(sides[0], key), back = nodes_at(sides[1], key);
    const bool cut = face != none && twin_of_[face] != none;
    if (face != none && sorted(made.faces[face]) != sorted(front)) wrong(face);
    if (cut && sorted(made.faces[twin_of_[face]]) != sorted(back)) wrong(face);
    if (cut) return;
    if (front != back)
        subject_.findings.add(TetrahedraDefect::wrong_twins,
                              "tetrahedra {} and {} do not share the nodes of their face at {}, "
                              "and no cut is there",
                              sides[0], sides[1], place_text(made.vertices[key[0]]));
    for (const std::uint32_t place : key)
        sets_.join(4 * sides[0] + corner_at(sides[0], place),
                   4 * sides[1] + corner_at(sides[1], place));
}

void CutCheck::finish() {
    if (!active_) return;
    const TetrahedralMesh& made = subject_.made;
    std::vector<std::uint32_t> set_of(made.vertices.size(), none);
    for (std::uint32_t t = 0; t < made.tetrahedra.size(); ++t)
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t node = made.tetrahedra[t][k];
            if (!on_cut_[places_.of_node[node]]) continue;
            const std::uint32_t set = sets_.find(4 * t + k);
            if (set_of[node] == none) set_of[node] = set;
            if (set_of[node] != set)
                subject_.findings.add(TetrahedraDefect::wrong_twins,
                                      "node {}, at {}, is shared across a cut", node,
                                      place_text(made.vertices[node]));
        }
}

} // namespace terrane::tetrahedra::detail
