// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/intersection/contact_kind.hpp>

#include <terrane/algorithms/intersection/intersection.hpp>

namespace terrane {
namespace {

bool along_an_edge(Simplex p, Simplex q) {
    for (unsigned e = 0; e < 3; ++e)
        if (on_closed_edge(p, e) && on_closed_edge(q, e)) return true;
    return false;
}

ContactKind kind_of_point(const ContactPoint& p) {
    if (is_edge(p.place[0]) && is_edge(p.place[1])) return ContactKind::edges_cross;
    const bool face = p.place[0] == Simplex::face || p.place[1] == Simplex::face;
    return face ? ContactKind::vertex_on_face : ContactKind::vertex_on_edge;
}

} // namespace

std::string_view name_of(ContactKind kind) {
    switch (kind) {
    case ContactKind::vertex_on_edge:
        return "vertex on edge";
    case ContactKind::vertex_on_face:
        return "vertex on face";
    case ContactKind::edges_cross:
        return "edges cross";
    case ContactKind::edges_overlap:
        return "edges overlap";
    case ContactKind::edge_on_face:
        return "edge on face";
    case ContactKind::crossing:
        return "crossing";
    default:
        return "coplanar overlap";
    }
}

ContactKind kind_of(const Contact& contact) {
    if (contact.overlap) return ContactKind::coplanar_overlap;
    const ContactPoint& first = contact.points[0];
    if (contact.point_count == 1) return kind_of_point(first);
    const ContactPoint& last = contact.points[contact.point_count - 1u];
    const bool along0 = along_an_edge(first.place[0], last.place[0]);
    const bool along1 = along_an_edge(first.place[1], last.place[1]);
    if (along0 && along1) return ContactKind::edges_overlap;
    return along0 || along1 ? ContactKind::edge_on_face : ContactKind::crossing;
}

} // namespace terrane
