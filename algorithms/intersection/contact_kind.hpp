// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The kinds of improper contact: two triangles that share more than a common vertex or edge.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <terrane/kernel/point.hpp>

namespace terrane {

struct Contact;

/// How two triangles meet that should not.
enum class ContactKind : std::uint8_t {
    vertex_on_edge,
    vertex_on_face,
    edges_cross,     ///< in one point, inside both
    edges_overlap,   ///< collinear, along a segment
    edge_on_face,    ///< an edge lies in the other triangle
    crossing,        ///< along a segment through the inside of at least one of them
    coplanar_overlap ///< in an area
};

/// "vertex on edge", ...
std::string_view name_of(ContactKind kind);

/// Two triangles that meet other than in a shared vertex or edge.
struct ImproperContact {
    std::array<std::uint32_t, 2> triangles{}; ///< input triangles, counted through all surfaces
    ContactKind kind{};                       ///< how they meet
    Point3 place;                             ///< a point that both share, to the nearest double
};

/// The kind of a contact, from its points' places alone.
ContactKind kind_of(const Contact& contact);

} // namespace terrane
