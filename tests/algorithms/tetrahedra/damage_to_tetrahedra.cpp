// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/tetrahedra_damage.hpp"

namespace test_support {
namespace {

using Defect = TetrahedraDefect;

/// Removes the tetrahedra for which this holds.
template <class Which>
void remove(Filled& f, const Which& which) {
    TetrahedralMesh& m = f.tetrahedra;
    std::size_t kept = 0;
    for (std::uint32_t t = 0; t < m.tetrahedra.size(); ++t) {
        if (which(t)) continue;
        m.tetrahedra[kept] = m.tetrahedra[t];
        m.block_of[kept++] = m.block_of[t];
    }
    m.tetrahedra.resize(kept);
    m.block_of.resize(kept);
}

void add(Filled& f, const std::array<std::uint32_t, 4>& corners, std::uint32_t block) {
    f.tetrahedra.tetrahedra.push_back(corners);
    f.tetrahedra.block_of.push_back(block);
}

/// The first tetrahedron in a block without a corner on the box.
std::uint32_t inner(const Filled& f) {
    const auto& block = f.tetrahedra.block_of;
    for (std::uint32_t t = 0; t < block.size(); ++t)
        if (block[t] != 0) return t;
    FAIL("no block");
    return 0;
}

/// Adds a second cover of the whole box, on nodes of its own at the same places.
void cover_twice(Filled& f) {
    TetrahedralMesh& m = f.tetrahedra;
    const auto nodes = static_cast<std::uint32_t>(m.vertices.size());
    const auto vertices = m.vertices;
    m.vertices.insert(m.vertices.end(), vertices.begin(), vertices.end());
    for (std::size_t t = 0, count = m.tetrahedra.size(); t < count; ++t) {
        auto corners = m.tetrahedra[t];
        for (std::uint32_t& v : corners) v += nodes;
        add(f, corners, m.block_of[t]);
    }
    for (std::size_t i = 0, count = m.faces.size(); i < count; ++i) {
        Triangle face = m.faces[i];
        for (std::uint32_t& v : face) v += nodes;
        const std::vector<std::uint32_t> surfaces(m.surfaces_of[i].begin(), m.surfaces_of[i].end());
        m.faces.push_back(face);
        m.face_triangle.push_back(m.face_triangle[i]);
        m.surfaces_of.push_back(surfaces);
    }
}

/// Adds a closed body of two tetrahedra that share all four faces: one of them is inverted.
void add_mirrored_pair(Filled& f) {
    TetrahedralMesh& m = f.tetrahedra;
    const std::uint32_t t = inner(f);
    auto corners = m.tetrahedra[t];
    std::array<std::uint32_t, 4> fresh{};
    for (std::size_t k = 0; k < 4; ++k) {
        fresh[k] = static_cast<std::uint32_t>(m.vertices.size());
        Point3 p = m.vertices[corners[k]];
        p.x += 1e-3 * (m.vertices[corners[0]].x - p.x) + 1e-9;
        m.vertices.push_back(p);
    }
    add(f, fresh, m.block_of[t]);
    std::swap(fresh[0], fresh[1]);
    add(f, fresh, m.block_of[t]);
}

/// Moves a node far away; all tetrahedra are positive afterwards, each face has two, and some
/// overlap.
void move_out_of_star(Filled& f) {
    TetrahedralMesh& m = f.tetrahedra;
    const std::uint32_t node = f.inside.front();
    Point3 low = m.vertices[0], high = low; // of the box
    for (const Point3& p : m.vertices) low = std::min(low, p), high = std::max(high, p);
    m.vertices[node] = {low.x + .77 * (high.x - low.x), low.y + .55 * (high.y - low.y),
                        low.z + .91 * (high.z - low.z)};
    for (auto& corners : m.tetrahedra)
        if (!is_positive(m, corners)) std::swap(corners[0], corners[1]);
}

} // namespace

namespace {

/// Lists damage to one tetrahedron.
std::vector<Damage> damage_to_single_tetrahedra() {
    return {
        {"a tetrahedron removed", Defect::open_face,
         [](Filled& f) { remove(f, [at = inner(f)](std::uint32_t t) { return t == at; }); }},
        {"a tetrahedron of the outside removed", Defect::open_face,
         [](Filled& f) {
             const auto block = f.tetrahedra.block_of;
             const auto at = std::find(block.begin(), block.end(), 0U) - block.begin();
             remove(f, [&](std::uint32_t t) { return t == at; });
         },
         true},
        {"a tetrahedron twice", Defect::crowded_face,
         [](Filled& f) {
             const std::uint32_t t = inner(f);
             add(f, std::array(f.tetrahedra.tetrahedra[t]), f.tetrahedra.block_of[t]);
         }},
        {"a tetrahedron flipped", Defect::no_volume,
         [](Filled& f) {
             auto& corners = f.tetrahedra.tetrahedra[inner(f)];
             std::swap(corners[0], corners[1]);
         }},
        {"all tetrahedra flipped", Defect::no_volume,
         [](Filled& f) {
             for (auto& corners : f.tetrahedra.tetrahedra) std::swap(corners[0], corners[1]);
         }},
        {"a tetrahedron without volume", Defect::no_volume,
         [](Filled& f) {
             auto& corners = f.tetrahedra.tetrahedra[inner(f)];
             corners[3] = corners[2];
         }},
        {"a flat tetrahedron on the box", Defect::no_volume,
         [](Filled& f) {
             const auto& v = f.tetrahedra.vertices;
             const auto low = std::min_element(v.begin(), v.end())->x;
             std::vector<std::uint32_t> side;
             for (std::uint32_t i = 0; i < v.size(); ++i)
                 if (v[i].x == low) side.push_back(i);
             add(f, {side.at(0), side.at(1), side.at(2), side.at(3)}, 0);
         },
         true},
    };
}

/// Lists damage to the tetrahedra around a node, of a block, and of all.
std::vector<Damage> damage_to_many_tetrahedra() {
    return {
        {"a node out of its star, the tetrahedra there turned to have a volume again",
         Defect::crowded_face, move_out_of_star},
        {"a hole: all tetrahedra at a node inside removed", Defect::open_face,
         [](Filled& f) {
             const auto tetrahedra = f.tetrahedra.tetrahedra;
             remove(f, [&](std::uint32_t t) {
                 return has_all(tetrahedra[t], std::array{f.inside.front()});
             });
         }},
        {"all tetrahedra of a block gone", Defect::wrong_volume,
         [](Filled& f) {
             const auto block = f.tetrahedra.block_of;
             remove(f, [&](std::uint32_t t) { return block[t] == 1; });
         }},
        {"no tetrahedra at all", Defect::stray_face,
         [](Filled& f) { remove(f, [](std::uint32_t) { return true; }); }},
        {"the box covered twice", Defect::box_not_filled, cover_twice, true},
        {"overlapping tetrahedra that share all their faces", Defect::no_volume, add_mirrored_pair},
        {"a corner of a tetrahedron replaced by another node", Defect::open_face,
         [](Filled& f) {
             auto& corners = f.tetrahedra.tetrahedra[inner(f)];
             for (const std::uint32_t node : f.inside)
                 if (!has_all(corners, std::array{node})) {
                     corners[0] = node;
                     return;
                 }
         }},
        {"a corner that is no node", Defect::unusable_lists,
         [](Filled& f) {
             f.tetrahedra.tetrahedra[0][2] =
                 static_cast<std::uint32_t>(f.tetrahedra.vertices.size());
         }},
    };
}

} // namespace

std::vector<Damage> damage_to_tetrahedra() {
    return joined(damage_to_single_tetrahedra(), damage_to_many_tetrahedra());
}

} // namespace test_support
