// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The changes that only certificates of one kind have.
#include <algorithm>
#include <array>
#include <utility>

#include <gmpxx.h>

#include <terrane/algorithms/core/no_index.hpp>

#include "forge_lists.hpp"

namespace terrane::fuzz {

namespace {

/// Exchanges the numbers of two blocks wherever they are.
void exchange_blocks(Certificate& c, const Arguments& n) {
    if (!c.blocks() || c.blocks()->volumes.empty()) return;
    const auto one = static_cast<std::uint32_t>(pick(n.a, c.blocks()->volumes.size()));
    const auto other = static_cast<std::uint32_t>(pick(n.b, c.blocks()->volumes.size()));
    std::swap(c.blocks()->volumes[one], c.blocks()->volumes[other]);
    const auto rename = [&](std::uint32_t& b) {
        if (b == one || b == other) b = b == one ? other : one;
    };
    std::ranges::for_each(c.blocks()->block_of_shell, rename);
    if (c.tetrahedra()) std::ranges::for_each(c.tetrahedra()->block_of, rename);
}

/// Makes two blocks one, with the sum of their volumes; the higher numbers become lower by one.
void merge_blocks(Certificate& c, const Arguments& n) {
    if (!c.blocks() || c.blocks()->volumes.size() < 3) return;
    auto& volumes = c.blocks()->volumes;
    const auto from = static_cast<std::uint32_t>(1 + pick(n.a, volumes.size() - 1));
    const auto to = static_cast<std::uint32_t>(pick(n.b, volumes.size()));
    mpq_class one, other;
    if (from == to || one.set_str(volumes[from], 10) != 0 || other.set_str(volumes[to], 10) != 0)
        return;
    if (to != 0) volumes[to] = mpq_class(one + other).get_str();
    erase_at(volumes, from);
    if (c.blocks()->exact >= from) --c.blocks()->exact;
    const auto rename = [&](std::uint32_t& b) {
        if (b == from) b = to;
        if (b > from) --b;
    };
    std::ranges::for_each(c.blocks()->block_of_shell, rename);
    if (c.tetrahedra()) std::ranges::for_each(c.tetrahedra()->block_of, rename);
}

/// Moves a side from one shell to another one.
void move_side(Certificate& c, const Arguments& n) {
    if (!c.blocks() || c.blocks()->shells.size() == 0) return;
    auto shells = unpacked(c.blocks()->shells);
    Numbers& from = shells[pick(n.a, shells.size())];
    Numbers& to = shells[pick(n.b, shells.size())];
    if (from.empty()) return;
    const std::size_t at = pick(n.c, from.size());
    const std::uint32_t side = from[at];
    erase_at(from, at);
    to.insert(std::ranges::upper_bound(to, side), side);
    c.blocks()->shells = packed(shells);
}

/// Makes two shells one.
void merge_shells(Certificate& c, const Arguments& n) {
    if (!c.blocks() || c.blocks()->shells.size() < 2) return;
    BlocksClaim& b = *c.blocks();
    auto shells = unpacked(b.shells);
    if (b.block_of_shell.size() != shells.size() || b.around.size() != shells.size()) return;
    const std::size_t from = pick(n.a, shells.size()), to = pick(n.b, shells.size());
    if (from == to) return;
    shells[to].insert(shells[to].end(), shells[from].begin(), shells[from].end());
    std::sort(shells[to].begin(), shells[to].end());
    erase_at(shells, from);
    erase_at(b.block_of_shell, from);
    erase_at(b.around, from);
    for (std::uint32_t& a : b.around)
        if (a != no_index && a >= from) a = a == from ? static_cast<std::uint32_t>(to) : a - 1;
    b.shells = packed(shells);
}

void change_exact_count(Certificate& c, const Arguments& n) {
    if (c.blocks()) change_number(c.blocks()->exact, n);
}

// --- Tetrahedra ---

/// Divides a tetrahedron into four at its middle.
void divide_tetrahedron(Certificate& c, const Arguments& n) {
    if (!c.tetrahedra() || c.tetrahedra()->tetrahedra.empty()) return;
    TetrahedraClaim& t = *c.tetrahedra();
    const std::size_t whole = pick(n.a, t.tetrahedra.size());
    if (t.block_of.size() != t.tetrahedra.size()) return;
    const auto corners = t.tetrahedra[whole];
    Point3 middle{};
    for (const std::uint32_t v : corners) {
        if (v >= t.vertices.size()) return;
        const Point3& p = t.vertices[v];
        middle = {middle.x + p.x / 4, middle.y + p.y / 4, middle.z + p.z / 4};
    }
    const auto node = static_cast<std::uint32_t>(t.vertices.size());
    t.vertices.push_back(middle);
    for (std::size_t i = 0; i < 4; ++i) {
        auto part = corners;
        part[i] = node;
        if (i == 0)
            t.tetrahedra[whole] = part;
        else
            t.tetrahedra.push_back(part);
        if (i > 0) t.block_of.push_back(std::uint32_t(t.block_of[whole]));
    }
}

/// Gives all tetrahedra of a block to another one.
void move_tetrahedra(Certificate& c, const Arguments& n) {
    if (!c.tetrahedra()) return;
    for (std::uint32_t& b : c.tetrahedra()->block_of)
        if (b == n.a % 4) b = n.b % 4;
}

/// Drops all tetrahedra of a block.
void drop_tetrahedra(Certificate& c, const Arguments& n) {
    if (!c.tetrahedra() || c.tetrahedra()->block_of.size() != c.tetrahedra()->tetrahedra.size())
        return;
    TetrahedraClaim& t = *c.tetrahedra();
    for (std::size_t i = t.tetrahedra.size(); i-- > 0;)
        if (t.block_of[i] == n.a % 4) {
            erase_at(t.tetrahedra, i);
            erase_at(t.block_of, i);
        }
}

/// Exchanges the inner face of two tetrahedra for three around the line between their other
/// corners.
void flip_faces(Certificate& c, const Arguments& n) {
    if (!c.tetrahedra() || c.tetrahedra()->tetrahedra.empty()) return;
    TetrahedraClaim& t = *c.tetrahedra();
    const std::size_t one = pick(n.a, t.tetrahedra.size());
    if (t.block_of.size() != t.tetrahedra.size()) return;
    const auto a = t.tetrahedra[one];
    for (std::size_t other = 0; other < t.tetrahedra.size(); ++other) {
        const auto& b = t.tetrahedra[other];
        const auto shared = [&](std::uint32_t v) { return std::ranges::count(b, v) > 0; };
        if (other == one || std::ranges::count_if(a, shared) != 3) continue;
        const auto own = static_cast<std::size_t>(std::ranges::find_if_not(a, shared) - a.begin());
        const std::uint32_t top = *std::ranges::find_if(
            b, [&](std::uint32_t v) { return std::ranges::count(a, v) == 0; });
        std::size_t made = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == own) continue;
            auto part = a;
            part[i] = top;
            if (made++ < 2) {
                t.tetrahedra[made == 1 ? one : other] = part;
            } else {
                t.tetrahedra.push_back(part);
                t.block_of.push_back(std::uint32_t(t.block_of[one]));
            }
        }
        return;
    }
}

/// Exchanges two nodes and their numbers.
void exchange_nodes(Certificate& c, const Arguments& n) {
    if (!c.tetrahedra() || c.tetrahedra()->vertices.empty()) return;
    TetrahedraClaim& t = *c.tetrahedra();
    const auto one = static_cast<std::uint32_t>(pick(n.a, t.vertices.size()));
    const auto other = static_cast<std::uint32_t>(pick(n.b, t.vertices.size()));
    std::swap(t.vertices[one], t.vertices[other]);
    const auto rename = [&](auto& cell) {
        for (std::uint32_t& v : cell)
            if (v == one || v == other) v = v == one ? other : one;
    };
    std::ranges::for_each(t.tetrahedra, rename);
    std::ranges::for_each(t.faces, rename);
}

void box_or_not(Certificate& c, const Arguments&) {
    if (c.tetrahedra()) c.tetrahedra()->box = !c.tetrahedra()->box;
}

/// Gives the face of one triangle to another one.
void rename_faces(Certificate& c, const Arguments& n) {
    if (!c.tetrahedra() || c.tetrahedra()->triangle_of.empty()) return;
    auto& of = c.tetrahedra()->triangle_of;
    of[pick(n.a, of.size())] = of[pick(n.b, of.size())];
}

// --- Filled surfaces ---

/// Adds a new vertex to the last filled surface.
void add_filled_vertex(Certificate& c, const Arguments& n) {
    if (!c.filled() || c.filled()->surfaces.empty() || c.filled()->vertices.empty()) return;
    Point3 p = c.filled()->vertices[pick(n.a, c.filled()->vertices.size())];
    p.z = moved(p.z, n.b, n.c);
    c.filled()->vertices.push_back(p);
    ++c.filled()->surfaces.back().vertices;
}

/// Adds a closed tetrahedron that is connected with nothing to the last filled surface.
void add_filled_body(Certificate& c, const Arguments& n) {
    if (!c.filled() || c.filled()->surfaces.empty()) return;
    FilledClaim& f = *c.filled();
    const auto first = static_cast<std::uint32_t>(f.vertices.size());
    const double x = n.a % 16, y = n.b % 16, z = n.c % 4;
    for (const Point3& p :
         {Point3{x, y, z}, Point3{x + 0.1, y, z}, Point3{x, y + 0.1, z}, Point3{x, y, z + 0.1}})
        f.vertices.push_back(p);
    for (const Triangle& t :
         {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}})
        f.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    f.surfaces.back().vertices += 4;
    f.surfaces.back().triangles += 4;
}

constexpr std::array<Change, 5> block_changes{{
    {"blocks exchanged", exchange_blocks},
    {"blocks merged", merge_blocks},
    {"side in another shell", move_side},
    {"shells merged", merge_shells},
    {"number of exact blocks changed", change_exact_count},
}};

constexpr std::array<Change, 9> tetrahedra_changes{{
    {"tetrahedron divided", divide_tetrahedron},
    {"tetrahedra of a block in another one", move_tetrahedra},
    {"tetrahedra of a block dropped", drop_tetrahedra},
    {"faces flipped", flip_faces},
    {"nodes exchanged, and their numbers", exchange_nodes},
    {"box or not", box_or_not},
    {"face of another triangle", rename_faces},
    {"blocks exchanged", exchange_blocks},
    {"blocks merged", merge_blocks},
}};

constexpr std::array<Change, 2> filled_changes{{
    {"vertex added", add_filled_vertex},
    {"closed body added", add_filled_body},
}};

} // namespace

std::span<const Change> changes_of(CertificateKind kind) {
    switch (kind) {
    case CertificateKind::volumes:
        return block_changes;
    case CertificateKind::tetrahedra:
        return tetrahedra_changes;
    case CertificateKind::filled:
        return filled_changes;
    case CertificateKind::layered:
        return changes_of_layers();
    case CertificateKind::cut:
        return changes_of_cuts();
    case CertificateKind::sealed:
        return changes_of_seals();
    default:
        return {};
    }
}

} // namespace terrane::fuzz
