// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Records of the digest. Each tile keeps those of a range of hashes.
#include <algorithm>
#include <map>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/tiles/detail/hashes.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>

namespace terrane::tiles::detail {

namespace {

/// A parent of the triangles at a vertex.
struct VertexParent {
    std::uint32_t vertex = 0, parent = 0;
    Hash point{}, input{};
};

/// Calls visit(vertex, its parents) for vertices that are shared, or for those that are not.
template <class Visit>
void for_vertices(const Tile& b, bool shared, const Visit& visit) {
    std::vector<std::array<std::uint32_t, 2>> named; // vertex, parent
    for (std::size_t t = 0; t < b.triangles.size(); ++t)
        for (const std::uint32_t v : b.triangles[t])
            for (const std::uint32_t p : b.parents_of[t]) named.push_back({v, p});
    sort_unique(named);
    std::vector<std::uint32_t> parents;
    for (std::size_t i = 0; i < named.size();) {
        const std::uint32_t v = named[i][0];
        parents.clear();
        for (; i < named.size() && named[i][0] == v; ++i) parents.push_back(named[i][1]);
        if (is_shared(b, v) == shared) visit(v, parents);
    }
}

Hash record_of_vertex(const Hash& point, std::vector<Hash> inputs) {
    std::sort(inputs.begin(), inputs.end());
    Sha256 state;
    state.feed("vertex");
    state.feed(point);
    state.feed(inputs);
    return state.finish();
}

} // namespace

void put_record(const Tile& b, const Hash& record, Outbox& out, std::size_t channel) {
    out.put(keeper_of(b, record), channel, record);
}

void keep_records(Tile& b, Inbox& in, std::size_t channel) {
    in.take<Hash>(channel, [&](std::uint32_t, const Hash& h) { b.records.push_back(h); });
}

/// Records of own input triangles: how many triangles name them, repeated and degenerate ones.
void add_records_of_parents(Tile& b, Outbox& out, std::size_t channel) {
    std::map<std::uint32_t, std::size_t> parts; // of touched faces
    for (std::size_t p = 0; p < b.parts.size(); ++p)
        for (const std::uint32_t f : b.own_faces_of[p]) ++parts[f];
    std::map<std::uint32_t, std::vector<Hash>> same;
    const auto put = [&](std::uint32_t id, std::uint32_t face) {
        const auto found = parts.find(face);
        const std::size_t count = found == parts.end() ? 1 : found->second;
        put_record(b, tagged_hash("parent", {hash_of_parent(b, id)}, std::to_string(count)), out,
                   channel);
    };
    for (const Face& f : b.faces)
        if (owner_of_face(b, f) == b.index) put(f.id, f.id);
    for (const auto& [repeated, first] : b.duplicates) {
        put(repeated, first);
        auto& all = same[first];
        if (all.empty()) all.push_back(hash_of_parent(b, first));
        all.push_back(hash_of_parent(b, repeated));
    }
    for (const auto& [first, all] : same)
        put_record(b, tagged_hash("duplicates", all), out, channel);
    for (const Hash& record : b.degenerate_records) put_record(b, record, out, channel);
    release(b.degenerate_records);
}

/// Records of vertices that only this tile uses.
void add_records_of_vertices(Tile& b, Outbox& out, std::size_t channel) {
    for_vertices(b, false, [&](std::uint32_t v, const std::vector<std::uint32_t>& parents) {
        std::vector<Hash> inputs;
        for (const std::uint32_t p : parents) inputs.push_back(hash_of_parent(b, p));
        put_record(b, record_of_vertex(hash_of_point(b, v), std::move(inputs)), out, channel);
    });
}

/// Sends the parents at shared vertices to where a hash of the vertex points.
void send_parents_of_shared(Tile& b, Outbox& out, std::size_t channel) {
    for_vertices(b, true, [&](std::uint32_t v, const std::vector<std::uint32_t>& parents) {
        const Hash point = hash_of_point(b, v);
        for (const std::uint32_t p : parents)
            out.put(v % b.count, channel, VertexParent{v, p, point, hash_of_parent(b, p)});
    });
}

void decide_shared_vertices(Tile& b, Inbox& in, std::size_t from, Outbox& out, std::size_t to) {
    auto all = in.all<VertexParent>(from);
    const auto key = [](const VertexParent& v) { return std::pair(v.vertex, v.parent); };
    std::sort(all.begin(), all.end(),
              [&](const VertexParent& u, const VertexParent& v) { return key(u) < key(v); });
    for (std::size_t k = 0, end = 0; k < all.size(); k = end) {
        std::vector<Hash> inputs;
        for (; end < all.size() && all[end].vertex == all[k].vertex; ++end)
            if (end == k || all[end].parent != all[end - 1].parent)
                inputs.push_back(all[end].input);
        put_record(b, record_of_vertex(all[k].point, std::move(inputs)), out, to);
    }
}

} // namespace terrane::tiles::detail
