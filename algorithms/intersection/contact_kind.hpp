// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Classifies improper contacts: two triangles that share more than a common vertex or edge.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <terrane/kernel/point.hpp>

namespace terrane {

struct Contact;

/// The kinds of improper contact.
enum class ContactKind : std::uint8_t {
    vertex_on_edge,  ///< a vertex lies inside an edge
    vertex_on_face,  ///< a vertex lies inside a face
    edges_cross,     ///< two edges meet in one point inside both
    edges_overlap,   ///< two collinear edges share a segment
    edge_on_face,    ///< a part of an edge lies in the other triangle's face
    crossing,        ///< the triangles share a segment that lies along no edge of either
    coplanar_overlap ///< coplanar triangles share an area
};

/// Returns the name of a kind in words: "vertex on edge", ...
std::string_view name_of(ContactKind kind);

/// Two triangles that meet other than in a shared vertex or edge.
struct ImproperContact {
    std::array<std::uint32_t, 2> triangles{}; ///< input triangles, counted through all surfaces
    ContactKind kind{};                       ///< how they meet
    Point3 place;                             ///< a common point, rounded to the nearest doubles
};

/// Returns the kind of a contact, derived from the places of its points alone.
ContactKind kind_of(const Contact& contact);

} // namespace terrane
