// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Settles the triangles of the result. A part that lies in several faces belongs to the owner of the
// first one; where several tiles may have it, they learn of each other where a hash of its corners
// points.
#include <algorithm>
#include <map>
#include <set>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/triangle_table.hpp>
#include <terrane/algorithms/tiles/detail/edges.hpp>
#include <terrane/algorithms/tiles/detail/hashes.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>

namespace terrane::tiles::detail {

namespace {

/// A part, by its corners in ascending order, and an input triangle that contains it.
struct ContainedPart {
    std::array<std::uint32_t, 3> corners{};
    std::uint32_t parent = 0;
    std::uint32_t first = 0; ///< the first input triangle with the corners of the parent
    Hash hash{};             ///< of the input triangle, if a digest is wanted

    [[nodiscard]] auto key() const { return std::tie(corners, parent); }
};

struct FaceCount {
    std::uint32_t face = 0, count = 0;
};

std::array<std::uint32_t, 3> ascending(std::array<std::uint32_t, 3> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// Appends the input triangles that repeat a face.
void append_repeated(const Tile& b, std::uint32_t face, std::vector<std::uint32_t>& to) {
    auto d = std::lower_bound(b.duplicates.begin(), b.duplicates.end(), face,
                              [](const auto& pair, std::uint32_t f) { return pair[1] < f; });
    for (; d != b.duplicates.end() && (*d)[1] == face; ++d) to.push_back((*d)[0]);
}

const Face& face_with(const Tile& b, std::uint32_t id) {
    return *std::lower_bound(b.faces.begin(), b.faces.end(), id,
                             [](const Face& f, std::uint32_t i) { return f.id < i; });
}

/// Returns the first input triangle that had the same corners as one of an own face, which now has those
/// of `face`.
std::uint32_t first_given(const Tile& b, std::uint32_t triangle, std::uint32_t face) {
    return b.is_moved ? first_in(b.given_repeated, triangle) : face;
}

/// Lists the hashes of own input triangles.
void hash_own_inputs(Tile& b) {
    for (const Face& f : b.faces)
        if (owner_of_face(b, f) == b.index) b.parent_hashes.push_back({f.id, input_hash(b, f)});
    for (const auto& [repeated, first] : b.duplicates) {
        Face f = face_with(b, first);
        f.id = repeated;
        b.parent_hashes.push_back({repeated, input_hash(b, f)});
    }
    std::sort(b.parent_hashes.begin(), b.parent_hashes.end(),
              [](const ParentHash& p, const ParentHash& q) { return p.id < q.id; });
}

const UsedVertex& used_vertex(const Tile& b, std::uint32_t id) {
    return *std::lower_bound(b.used.begin(), b.used.end(), id,
                             [](const UsedVertex& u, std::uint32_t i) { return u.id < i; });
}

const OwnPoint& constructed_point(const Tile& b, std::uint32_t name) {
    return *std::lower_bound(b.points.begin(), b.points.end(), name - b.vertex_total(),
                             [](const OwnPoint& p, std::uint32_t n) { return p.number < n; });
}

/// Makes the triangles of the result that this tile owns.
class Settler {
public:
    using United = std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>>;

    Settler(Tile& b, const United& united) : b_(b), united_(united) {}

    void operator()() {
        std::size_t part = 0;
        for (const Face& f : b_.faces) {
            if (owner_of_face(b_, f) != b_.index) continue;
            if (!std::binary_search(b_.touched.begin(), b_.touched.end(), f.id)) {
                parents_.assign(1, f.id);
                append_repeated(b_, f.id, parents_);
                add(f.id, f.corners);
                continue;
            }
            while (part < b_.parts.size() && b_.parts[part].face < f.id) ++part;
            for (; part < b_.parts.size() && b_.parts[part].face == f.id; ++part) {
                take_parents(part);
                if (parents_.front() == f.id) add(f.id, b_.parts[part].corners);
            }
        }
    }

private:
    void take_parents(std::size_t part) {
        const auto found = united_.find(ascending(b_.parts[part].corners));
        if (found != united_.end()) {
            parents_ = found->second;
        } else {
            parents_.clear();
            for (const std::uint32_t f : b_.own_faces_of[part]) {
                parents_.push_back(f);
                append_repeated(b_, f, parents_);
            }
        }
        sort_unique(parents_);
    }

    void add(std::uint32_t face, const std::array<std::uint32_t, 3>& corners) {
        b_.triangles.push_back(corners);
        b_.face_of.push_back(face);
        b_.parents_of.push_back(parents_);
        surfaces_.clear();
        for (const std::uint32_t p : parents_) surfaces_.push_back(surface_of(b_, p));
        sort_unique(surfaces_);
        b_.surfaces_of.push_back(surfaces_);
    }

    Tile& b_;
    const United& united_;
    std::vector<std::uint32_t> parents_, surfaces_;
};

} // namespace

Point3 doubles_of(const Tile& b, std::uint32_t name) {
    return name < b.vertex_total() ? used_vertex(b, name).at : constructed_point(b, name).nearest;
}

double bound_of(const Tile& b, std::uint32_t name) {
    return name < b.vertex_total() ? 0 : constructed_point(b, name).bound;
}

bool is_shared(const Tile& b, std::uint32_t name) {
    return (name < b.vertex_total() ? used_vertex(b, name).shared
                                    : constructed_point(b, name).shared) != 0;
}

std::uint32_t vertex_number(const Tile& b, std::uint32_t name) {
    const std::uint32_t number = name < b.vertex_total() ? used_vertex(b, name).number
                                                         : b.used_total + (name - b.vertex_total());
    const auto removed = std::lower_bound(b.removed.begin(), b.removed.end(), name);
    return number - static_cast<std::uint32_t>(removed - b.removed.begin());
}

Hash hash_of_point(const Tile& b, std::uint32_t name) {
    return name < b.vertex_total() ? hash_of_input(used_vertex(b, name).at)
                                   : constructed_point(b, name).hash;
}

const Hash& hash_of_parent(const Tile& b, std::uint32_t id) {
    return std::lower_bound(b.parent_hashes.begin(), b.parent_hashes.end(), id,
                            [](const ParentHash& p, std::uint32_t i) { return p.id < i; })
        ->hash;
}

/// Channel 0: ContainedPart, to where a hash of its corners points.
void send_overlapping_parts(Tile& b, Outbox& out) {
    if (b.wants_digest) hash_own_inputs(b);
    std::vector<std::uint32_t> parents;
    for (std::size_t p = 0; p < b.parts.size(); ++p) {
        const auto corners = ascending(b.parts[p].corners);
        const std::size_t to = (hash_of(corners) >> 32) % b.count;
        for (const std::uint32_t f : b.own_faces_of[p]) {
            if (!std::binary_search(b.overlapped.begin(), b.overlapped.end(), f)) continue;
            parents.assign(1, f);
            append_repeated(b, f, parents);
            for (const std::uint32_t parent : parents) {
                ContainedPart record{corners, parent, first_given(b, parent, f), {}};
                if (b.wants_digest) record.hash = hash_of_parent(b, parent);
                out.put(to, 0, record);
            }
        }
    }
}

/// Channel 0: ContainedPart, to all tiles that sent the part, with all parents.
Status unite_parts(Tile&, Inbox& in, Outbox& out) {
    struct Sent {
        ContainedPart part;
        std::uint32_t from;
    };
    std::vector<Sent> all;
    in.take<ContainedPart>(0, [&](std::uint32_t from, const ContainedPart& part) {
        all.push_back({part, from});
    });
    std::sort(all.begin(), all.end(),
              [](const Sent& s, const Sent& t) { return s.part.key() < t.part.key(); });
    for (std::size_t k = 0, end = 0; k < all.size(); k = end) {
        std::set<std::uint32_t> sources;
        while (end < all.size() && all[end].part.corners == all[k].part.corners)
            sources.insert(all[end++].from);
        if (end - k < 2) continue;
        for (const std::uint32_t to : sources)
            for (std::size_t i = k; i < end; ++i) out.put(to, 0, all[i].part);
    }
    return Done{};
}

/// Channel 0: FaceCount, home; channel 1: DoubleFace and channel 2: numbers of divided faces, to the
/// tiles that they overlap; channel 3: records of the digest. In a frame, where nothing is known of the
/// doubles, all triangles are sent.
Status settle(Tile& b, Inbox& in, Outbox& out) {
    Settler::United united;
    in.take<ContainedPart>(0, [&](std::uint32_t, const ContainedPart& part) {
        united[part.corners].push_back(part.parent);
        if (part.parent != part.first) b.repeated.push_back({part.parent, part.first});
        if (b.wants_digest) b.parent_hashes.push_back({part.parent, part.hash});
    });
    std::sort(b.parent_hashes.begin(), b.parent_hashes.end(),
              [](const ParentHash& p, const ParentHash& q) { return p.id < q.id; });
    const auto& repeated = b.is_moved ? b.given_repeated : b.duplicates;
    b.repeated.insert(b.repeated.end(), repeated.begin(), repeated.end());
    sort_unique(b.repeated);
    Settler(b, united)();
    b.work.triangles = b.triangles.size();
    std::map<std::uint32_t, std::uint32_t> count;
    for (const std::uint32_t f : b.touched) count[f] = 0;
    for (std::size_t t = 0; t < b.triangles.size(); ++t) {
        const auto of_face = count.find(b.face_of[t]);
        if (of_face != count.end())
            ++of_face->second;
        else if (!b.is_in_frame)
            continue;
        DoubleFace face;
        face.is_dirty = b.is_in_frame ? 1 : 0;
        for (unsigned i = 0; i < 3; ++i) {
            face.corners[i] = b.triangles[t][i];
            face.at[i] = doubles_of(b, face.corners[i]);
            face.is_dirty |= bound_of(b, face.corners[i]) > 0 ? 1U : 0U;
        }
        const Box box = box_of(face.at);
        for (const std::uint32_t to : b.is_in_frame ? tiles_of(b.given_grid, b.given_splitters, box)
                                                    : tiles_of(b.grid, b.splitters, box))
            out.put(to, 1, face);
    }
    for (const auto& [face, n] : count) {
        out.put(home_of(face, b.triangle_total(), b.count), 0, FaceCount{face, n});
        if (b.is_in_frame) continue; // all triangles have been sent
        for (const std::uint32_t to : tiles_of(b.grid, b.splitters, box_of(face_with(b, face).at)))
            out.put(to, 2, face);
    }
    if (b.wants_digest) add_records_of_parents(b, out, 3);
    return Done{};
}

} // namespace terrane::tiles::detail
