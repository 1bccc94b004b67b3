// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/detail/working_mesh.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/algorithms/core/disjoint_sets.hpp>

namespace terrane::quality::detail {

WorkMesh::WorkMesh(const Mesh& mesh, const Features& features) :
    points(mesh.vertices), sizes(mesh.vertices.size(), 0), kinds(features.kinds),
    curve_of(features.curve_of), place_on(mesh.vertices.size(), 0),
    along(mesh.vertices.size(), {none, none}), triangles(features.triangles),
    sheet_of(features.sheet_of), hint_of(features.triangles.size()),
    isolated(features.triangles.size(), 0), changed_at(features.triangles.size(), 1),
    star(mesh.vertices.size()) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        hint_of[t] = t;
        for (const std::uint32_t v : triangles[t]) star[v].push_back(t);
    }
    for (std::uint32_t c = 0; c < features.curves.size(); ++c) {
        const Curve& curve = features.curves[c];
        for (std::size_t i = 1; i + 1 < curve.vertices.size(); ++i) {
            const std::uint32_t v = curve.vertices[i];
            place_on[v] = curve.at[i];
            along[v] = {curve.vertices[i - 1], curve.vertices[i + 1]};
        }
        if (curve.vertices.size() == 2) set_direct(curve.vertices[0], curve.vertices[1], c);
    }
}

void WorkMesh::add_vertex(const Point3& p, VertexKind kind, double size) {
    points.push_back(p);
    sizes.push_back(size);
    kinds.push_back(kind);
    curve_of.push_back(none);
    place_on.push_back(0);
    along.push_back({none, none});
    star.emplace_back();
}

std::uint32_t WorkMesh::curve_at(std::uint32_t a, std::uint32_t b) const {
    if (kinds[a] == VertexKind::inner || kinds[b] == VertexKind::inner) return none;
    if (kinds[a] == VertexKind::curve)
        return along[a][0] == b || along[a][1] == b ? curve_of[a] : none;
    if (kinds[b] == VertexKind::curve)
        return along[b][0] == a || along[b][1] == a ? curve_of[b] : none;
    const auto found = direct_.find(key(a, b));
    return found == direct_.end() ? none : found->second;
}

double WorkMesh::place_at(const std::vector<Curve>& curves, std::uint32_t curve, std::uint32_t v,
                          std::uint32_t other) const {
    if (kinds[v] == VertexKind::curve) return place_on[v];
    const Curve& c = curves[curve];
    // A corner is at the end of the curve that the other vertex points to.
    const bool at_start =
        kinds[other] == VertexKind::curve ? along[other][0] == v : c.vertices.front() == v;
    return at_start ? 0 : c.at.back();
}

void WorkMesh::set_direct(std::uint32_t a, std::uint32_t b, std::uint32_t curve) {
    direct_[key(a, b)] = curve;
}

void WorkMesh::drop_direct(std::uint32_t a, std::uint32_t b) {
    direct_.erase(key(a, b));
}

void WorkMesh::triangles_at(std::uint32_t a, std::uint32_t b,
                            std::vector<std::uint32_t>& found) const {
    found.clear();
    for (const std::uint32_t t : star[a])
        if (has(triangles[t], b)) found.push_back(t);
}

bool WorkMesh::are_neighbours(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(star[a].begin(), star[a].end(),
                       [&](std::uint32_t t) { return has(triangles[t], b); });
}

void WorkMesh::neighbours(std::uint32_t v, std::vector<std::uint32_t>& found) const {
    found.clear();
    for (const std::uint32_t t : star[v])
        for (const std::uint32_t c : triangles[t])
            if (c != v) found.push_back(c);
    sort_unique(found);
}

void WorkMesh::take_from_star(std::uint32_t v, std::uint32_t t) {
    auto& at = star[v];
    const auto found = std::find(at.begin(), at.end(), t);
    *found = at.back();
    at.pop_back();
}

void WorkMesh::apply(const Change& change, std::span<const std::uint32_t> hints,
                     std::vector<std::uint32_t>& numbers) {
    numbers.clear();
    if (change.in_place) {
        points[change.placed] = change.place;
        for (std::size_t i = 0; i < change.removed.size(); ++i) {
            hint_of[change.removed[i]] = hints[i];
            changed_at[change.removed[i]] = now;
            numbers.push_back(change.removed[i]);
        }
        return;
    }
    if (change.placed != none) add_vertex(change.place, change.kind, change.size);
    std::array<std::uint32_t, 64> on_stack{};
    std::vector<std::uint32_t> on_heap;
    const bool is_short = change.added.size() <= on_stack.size();
    if (!is_short) on_heap.resize(change.added.size());
    std::uint32_t* const sheets = is_short ? on_stack.data() : on_heap.data();
    for (std::size_t i = 0; i < change.added.size(); ++i) sheets[i] = sheet_of[change.from[i]];
    for (const std::uint32_t t : change.removed) {
        for (const std::uint32_t v : triangles[t]) take_from_star(v, t);
        triangles[t][0] = none;
    }
    for (std::size_t i = 0; i < change.added.size(); ++i) {
        std::uint32_t t = none;
        if (i < change.removed.size()) {
            t = change.removed[i];
        } else {
            t = static_cast<std::uint32_t>(triangles.size());
            triangles.emplace_back();
            sheet_of.push_back(0);
            hint_of.push_back(0);
            isolated.push_back(0);
            changed_at.push_back(0);
        }
        triangles[t] = change.added[i];
        sheet_of[t] = sheets[i];
        hint_of[t] = hints[i];
        changed_at[t] = now;
        for (const std::uint32_t v : triangles[t]) star[v].push_back(t);
        numbers.push_back(t);
    }
}

void WorkMesh::compact() {
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (!in_use(t)) continue;
        triangles[count] = triangles[t];
        sheet_of[count] = sheet_of[t];
        hint_of[count] = hint_of[t];
        isolated[count] = isolated[t];
        changed_at[count] = changed_at[t];
        ++count;
    }
    triangles.resize(count);
    sheet_of.resize(count);
    hint_of.resize(count);
    isolated.resize(count);
    changed_at.resize(count);
    for (auto& at : star) at.clear();
    for (std::uint32_t t = 0; t < count; ++t)
        for (const std::uint32_t v : triangles[t]) star[v].push_back(t);
}

double WorkMesh::edge_length(std::uint32_t a, std::uint32_t b) const {
    const Point3 d = minus(points[b], points[a]);
    return std::sqrt(dot(d, d));
}

} // namespace terrane::quality::detail
