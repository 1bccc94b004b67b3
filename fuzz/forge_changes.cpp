// SPDX-License-Identifier: LGPL-3.0-or-later
#include "forge_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "forge_lists.hpp"
#include "forge_triangles.hpp"

namespace terrane::fuzz {

namespace {

/// The exact part. A dropped triangle stays dropped when the triangles get other numbers.
class ExactPart {
public:
    explicit ExactPart(Certificate& c) :
        certificate_(c), part{c.exact.triangles, c.exact.parents_of, nullptr,
                              &c.exact.intersection_edges, c.exact.vertices.size()} {
        if (!c.cut) return;
        for (std::uint32_t t = 0; t < c.exact.triangles.size(); ++t)
            is_dropped_.push_back(std::array{std::ranges::count(c.cut->dropped, t) > 0 ? 1U : 0U});
        part.regions_of = &is_dropped_;
    }
    ~ExactPart() {
        if (!certificate_.cut || !changed) return;
        auto& dropped = certificate_.cut->dropped;
        dropped.clear();
        for (std::uint32_t t = 0; t < is_dropped_.size(); ++t)
            if (is_dropped_[t].front() == 1) dropped.push_back(t);
    }
    ExactPart(const ExactPart&) = delete;
    ExactPart& operator=(const ExactPart&) = delete;

private:
    Certificate& certificate_;
    IndexLists<std::uint32_t> is_dropped_; ///< per triangle: 1 or 0

public:
    Part part;
    bool changed = false; ///< to be set where the part is changed
};

Part rounded_part(RoundedClaim& r) {
    return {r.triangles,           r.parents_of,      &r.regions_of,
            &r.intersection_edges, r.vertices.size(), &r.vertices};
}

Part layered_part(LayeredClaim& m) {
    return {m.triangles, m.surfaces_of, nullptr, nullptr, m.vertices.size(), &m.vertices};
}

Part improved_part(ImprovedClaim& m) {
    return {m.triangles,           m.surfaces_of,     &m.regions_of,
            &m.intersection_edges, m.vertices.size(), &m.vertices};
}

/// Tells whether the lists have a common length, and no triangle is without a parent.
bool is_regular(const Part& p) {
    const auto& parents = p.parents_of;
    if (p.triangles.empty() || parents.size() != p.triangles.size()) return false;
    if (p.regions_of != nullptr && p.regions_of->size() != p.triangles.size()) return false;
    for (std::size_t t = 0; t < parents.size(); ++t)
        if (parents[t].empty()) return false;
    return true;
}

// --- Changes of the whole -----------------------------------------------------------------------

bool in_range(const Triangle& t, std::size_t vertices) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return v < vertices; });
}

void change_construction(Certificate& c, const Arguments& n) {
    if (c.exact.vertices.empty()) return;
    Construction& how = c.exact.vertices[pick(n.a, c.exact.vertices.size())];
    if (n.b % 4 == 0)
        how.kind = static_cast<Construction::Kind>(n.c % 4);
    else if (n.b % 4 == 1)
        std::swap(how, c.exact.vertices[pick(n.c, c.exact.vertices.size())]);
    else
        how.v[n.c % 9] = n.d % 64;
}

void move_vertex(Certificate& c, const Arguments& n) {
    auto& vertices = c.rounded->vertices;
    if (vertices.empty()) return;
    Point3& p = vertices[pick(n.a, vertices.size())];
    double& x = n.b % 3 == 0 ? p.x : n.b % 3 == 1 ? p.y : p.z;
    x = moved(x, n.c, n.d);
}

void change_bounds(Certificate& c, const Arguments& n) {
    RoundedClaim& r = *c.rounded;
    const double factor = std::ldexp(1.0, static_cast<int>(n.b) - 64);
    if (n.a % 3 == 0) r.deviation *= factor;
    if (n.a % 3 == 1) r.deviation = r.deviation == 0 ? factor : r.deviation * (1 + factor);
    if (n.a % 3 != 2) return;
    if (r.max_move && n.c % 2 == 0)
        r.max_move.reset();
    else
        r.max_move = r.max_move.value_or(r.deviation) * factor;
}

void change_list(Numbers& list, const Arguments& n) {
    if (n.b % 2 == 0 && !list.empty()) {
        erase_at(list, pick(n.c, list.size()));
    } else {
        list.push_back(n.c % 64);
        std::sort(list.begin(), list.end());
    }
}

/// Lists as vanished what no triangle of the doubles names, as far as the bytes allow.
void list_vanished(Certificate& c, const Arguments&) {
    RoundedClaim& r = *c.rounded;
    std::size_t inputs = 0;
    for (const CertifiedInput& input : c.inputs)
        for (const CertifiedSurface& s : input.surfaces) inputs += s.triangles;
    r.vanished.clear();
    for (std::uint32_t t = 0; t < inputs; ++t)
        if (std::ranges::find(r.parents_of.values, t) == r.parents_of.values.end() &&
            !std::ranges::binary_search(c.exact.degenerate, t))
            r.vanished.push_back(t);
}

void drop_unused_vertices(Certificate& c, const Arguments&) {
    RoundedClaim& r = *c.rounded;
    Numbers number(r.vertices.size(), UINT32_MAX);
    for (const Triangle& t : r.triangles)
        for (const auto v : t)
            if (v < number.size()) number[v] = 0;
    std::vector<Point3> kept;
    for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] == 0) {
            number[v] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(r.vertices[v]);
        }
    const auto renamed = [&](std::uint32_t v) { return v < number.size() ? number[v] : v; };
    for (Triangle& t : r.triangles)
        for (auto& v : t) v = renamed(v);
    std::erase_if(r.intersection_edges, [&](const Edge& e) {
        return renamed(e[0]) == UINT32_MAX || renamed(e[1]) == UINT32_MAX;
    });
    for (Edge& e : r.intersection_edges) e = {renamed(e[0]), renamed(e[1])};
    r.vertices = kept;
    r.max_move.reset();
}

void change_regions(Certificate& c, const Arguments& n) {
    auto& values = c.rounded->regions_of.values;
    if (values.empty()) return;
    if (n.b % 2 == 0)
        values[pick(n.a, values.size())] = n.c % 8;
    else
        std::swap(values[pick(n.a, values.size())], values[pick(n.c, values.size())]);
}

/// Adds a vertex to both parts, on a side of a triangle or within it: the exact one is the point of
/// any construction, the rounded one the middle of the side or of the triangle.
void add_vertex(Certificate& c, const Arguments& n) {
    RoundedClaim& r = *c.rounded;
    if (c.exact.triangles.empty() || r.triangles.empty()) return;
    const Triangle& t = r.triangles[pick(n.a, r.triangles.size())];
    if (!in_range(t, r.vertices.size())) return;
    const bool at_side = n.c % 2 == 0;
    const Point3 &u = r.vertices[t[n.b % 3]], &v = r.vertices[t[(n.b + 1) % 3]],
                 &w = r.vertices[t[(n.b + 2) % 3]];
    r.vertices.push_back(
        at_side ? Point3{(u.x + v.x) / 2, (u.y + v.y) / 2, (u.z + v.z) / 2}
                : Point3{(u.x + v.x + w.x) / 3, (u.y + v.y + w.y) / 3, (u.z + v.z + w.z) / 3});
    const auto& known = c.exact.vertices;
    Construction how = known[pick(n.d, known.size())];
    how.kind = static_cast<Construction::Kind>(1 + n.d % 3);
    for (std::size_t i = 0; i < 9; ++i) how.v[i] = (how.v[i] + n.d * static_cast<unsigned>(i)) % 8;
    c.exact.vertices.push_back(how);
    ExactPart exact(c);
    Part rounded = rounded_part(r);
    if (!is_regular(exact.part) || !is_regular(rounded)) return;
    exact.changed = true;
    divide(exact.part, n, static_cast<std::uint32_t>(exact.part.vertices - 1), at_side);
    divide(rounded, n, static_cast<std::uint32_t>(rounded.vertices - 1), at_side);
}

/// Adds a vertex to the exact part, where a side of a triangle that runs between two input vertices
/// meets the plane through three more. The doubles stay as they are.
void add_exact_vertex(Certificate& c, const Arguments& n) {
    auto& vertices = c.exact.vertices;
    if (c.exact.triangles.empty() || !c.rounded) return;
    const Triangle& t = c.exact.triangles[pick(n.a, c.exact.triangles.size())];
    if (!in_range(t, vertices.size())) return;
    const Construction &u = vertices[t[n.b % 3]], &v = vertices[t[(n.b + 1) % 3]];
    if (u.kind != Construction::Kind::input || v.kind != Construction::Kind::input) return;
    std::size_t inputs = 0;
    for (const CertifiedInput& input : c.inputs)
        for (const CertifiedSurface& surface : input.surfaces) inputs += surface.vertices;
    const auto input = [&](unsigned k) { return static_cast<std::uint32_t>(pick(k, inputs)); };
    const Construction how{Construction::Kind::line_plane,
                           Axis::x,
                           {u.v[0], v.v[0], input(n.c), input(n.d), input(n.c + n.d + 1)}};
    vertices.push_back(how);
    ExactPart exact(c);
    if (!is_regular(exact.part)) return;
    exact.changed = true;
    divide(exact.part, n, static_cast<std::uint32_t>(exact.part.vertices - 1), true);
    c.rounded->max_move.reset();
}

void change_output(Certificate& c, const Arguments& n) {
    if (c.outputs.empty()) return;
    CertifiedOutput& output = c.outputs[0];
    switch (n.a % 4) {
    case 0:
        output.format = n.b % 2 == 0 ? "msh" : "off";
        break;
    case 1:
        if (!output.surfaces.empty())
            std::swap(output.surfaces[pick(n.b, output.surfaces.size())],
                      output.surfaces[pick(n.c, output.surfaces.size())]);
        break;
    case 2:
        c.outputs.clear();
        break;
    default:
        if (!output.surfaces.empty())
            output.surfaces[pick(n.b, output.surfaces.size())].role = static_cast<Role>(n.c % 4);
    }
}

const std::array<Change, 15> changes_of_arrangements{{
    {"construction changed", change_construction},
    {"vertex moved", move_vertex},
    {"bounds changed", change_bounds},
    {"degenerate changed",
     [](Certificate& c, const Arguments& n) { change_list(c.exact.degenerate, n); }},
    {"vanished changed",
     [](Certificate& c, const Arguments& n) { change_list(c.rounded->vanished, n); }},
    {"what is missing listed as vanished", list_vanished},
    {"unused vertices dropped", drop_unused_vertices},
    {"regions changed", change_regions},
    {"vertex added to both parts", add_vertex},
    {"vertex added to the exact part", add_exact_vertex},
    {"output changed", change_output},
    {"conforming or not",
     [](Certificate& c, const Arguments&) { c.rounded->clean = !c.rounded->clean; }},
    {"doubles dropped", [](Certificate& c, const Arguments&) { c.rounded.reset(); }},
    {"duplicates changed",
     [](Certificate& c, const Arguments& n) {
         auto& list = c.exact.duplicates;
         if (n.a % 2 == 0 && !list.empty())
             erase_at(list, pick(n.b, list.size()));
         else
             list.push_back({n.b % 16, n.c % 16});
         std::sort(list.begin(), list.end());
     }},
    {"vertices exchanged",
     [](Certificate& c, const Arguments& n) {
         auto& list = c.rounded->vertices;
         if (!list.empty()) std::swap(list[pick(n.a, list.size())], list[pick(n.b, list.size())]);
     }},
}};

// --- Changes of parts, by kind -------------------------------------------------------------------

/// Changes the triangles of filled surfaces, whose numbers are counted again.
bool change_filled(FilledClaim& filled, const PartChange& made, const Arguments& n) {
    std::uint64_t stated = 0; // an earlier change can have stated billions
    for (const auto& s : filled.surfaces) stated += s.triangles;
    if (stated != filled.triangles.size()) return false;
    IndexLists<std::uint32_t> surface_of;
    for (std::uint32_t s = 0; s < filled.surfaces.size(); ++s)
        for (std::uint32_t t = 0; t < filled.surfaces[s].triangles; ++t)
            surface_of.push_back(std::array{s});
    const std::size_t vertices = filled.vertices.size();
    Part p{filled.triangles, surface_of, nullptr, nullptr, vertices, &filled.vertices};
    if (!is_regular(p)) return false;
    made.make(p, n);
    for (auto& s : filled.surfaces) s.triangles = 0;
    std::vector<Triangle> sorted;
    for (std::uint32_t s = 0; s < filled.surfaces.size(); ++s)
        for (std::size_t t = 0; t < filled.triangles.size(); ++t)
            if (!surface_of[t].empty() && surface_of[t].front() == s) {
                sorted.push_back(filled.triangles[t]);
                ++filled.surfaces[s].triangles;
            }
    filled.triangles = sorted;
    filled.surfaces.back().vertices +=
        static_cast<std::uint32_t>(filled.vertices.size() - vertices);
    return true;
}

/// Changes one side of the boundary of a volume of interest.
bool change_side(VolumeClaim& volume, const PartChange& made, const Arguments& n) {
    if (volume.boundary.empty()) return false;
    Surface& side = volume.boundary[pick(n.a, volume.boundary.size())];
    IndexLists<std::uint32_t> parents_of;
    for (std::size_t t = 0; t < side.triangles.size(); ++t) parents_of.push_back(std::array{0U});
    Part p{side.triangles, parents_of, nullptr, nullptr, side.vertices.size(), &side.vertices};
    if (!is_regular(p)) return false;
    made.make(p, n);
    return true;
}

/// Changes the triangles of layers; what the certificate says about their regions and parents, it
/// may leave out.
bool change_layered(LayeredClaim& layered, const PartChange& made, const Arguments& n) {
    Part p = layered_part(layered);
    if (!is_regular(p)) return false;
    made.make(p, n);
    layered.regions_of = layered.parents_of = {};
    return true;
}

std::string change_parts(Certificate& c, unsigned parts, const PartChange& made,
                         const Arguments& n) {
    std::string name = made.name;
    if (c.filled()) return change_filled(*c.filled(), made, n) ? name : "nothing";
    if (c.layered()) return change_layered(*c.layered(), made, n) ? name : "nothing";
    if (c.cut && parts % 5 == 4)
        return change_side(c.cut->volume, made, n) ? name + ", boundary" : "nothing";
    if (c.improved() && parts % 4 == 3) {
        Part p = improved_part(*c.improved());
        if (!is_regular(p)) return "nothing";
        made.make(p, n);
        return name + ", improved";
    }
    if (ExactPart p(c); parts % 3 != 0 && is_regular(p.part)) {
        p.changed = true;
        made.make(p.part, n);
        name += ", exact";
    }
    if (!c.rounded) return name;
    if (Part p = rounded_part(*c.rounded); parts % 3 != 1 && is_regular(p)) {
        made.make(p, n);
        name += ", doubles";
    }
    return name;
}

} // namespace

std::string change(Certificate& certificate, Contents& contents, Bytes& bytes) {
    std::array<unsigned, bytes_of_change> byte{};
    for (unsigned& b : byte) b = bytes.byte();
    const Arguments n{byte[2] | byte[3] << 8U, byte[4], byte[5], byte[6]};
    const auto parts = part_changes();
    const auto of_kind = changes_of(certificate.kind());
    std::size_t kind =
        byte[0] % (parts.size() + changes_of_arrangements.size() + of_kind.size() + 4);
    if (kind < parts.size()) return change_parts(certificate, byte[1], parts[kind], n);
    kind -= parts.size();
    if (kind < changes_of_arrangements.size()) {
        if (!certificate.rounded) return "nothing";
        changes_of_arrangements[kind].make(certificate, n);
        return changes_of_arrangements[kind].name;
    }
    kind -= changes_of_arrangements.size();
    if (kind < of_kind.size()) {
        of_kind[kind].make(certificate, n);
        return of_kind[kind].name;
    }
    if (kind == of_kind.size()) return change_files(certificate, contents, n);
    return change_list(certificate, byte[1], n);
}

} // namespace terrane::fuzz
