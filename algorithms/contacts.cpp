// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/contacts.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include <terrane/algorithms/construction_table.hpp>
#include <terrane/algorithms/parallel.hpp>
#include <terrane/kernel/quick_triangle.hpp>

namespace terrane {
namespace {

struct PairContact {
    CandidatePair pair;
    Contact contact;
};

struct PairBlock {
    std::vector<PairContact> contacts;
    std::vector<CandidatePair> near;
    PredicateCounts predicates;
};

bool have_common_vertex(const Triangle& t, const Triangle& u) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return v == u[0] || v == u[1] || v == u[2]; });
}

PairBlock test_pairs(const TriangleSoup& soup, std::span<const CandidatePair> pairs) {
    PairBlock block;
    const PredicateCounts before = predicate_counts();
    const auto at = [&](std::uint32_t t, unsigned i) -> const Point3& {
        return soup.points[soup.triangles[t][i]];
    };
    std::uint32_t last = UINT32_MAX;
    std::optional<QuickTriangle> first; // pairs come sorted by it
    for (const CandidatePair& p : pairs) {
        const auto [f, g] = p;
        if (f != last) first.emplace(at(f, 0), at(f, 1), at(f, 2));
        last = f;
        const bool joined = have_common_vertex(soup.triangles[f], soup.triangles[g]);
        if (!joined) {
            if (first->is_beside(at(g, 0), at(g, 1), at(g, 2))) continue;
            const QuickTriangle second(at(g, 0), at(g, 1), at(g, 2));
            if (second.is_beside(at(f, 0), at(f, 1), at(f, 2)) ||
                first->is_beyond(at(g, 0), at(g, 1), at(g, 2)) ||
                second.is_beyond(at(f, 0), at(f, 1), at(f, 2)))
                continue;
        }
        block.near.push_back(p);
        const auto contact = improper_contact(soup.points, soup.triangles[f], soup.triangles[g],
                                              joined ? Filters::all : Filters::none);
        if (contact) block.contacts.push_back({p, *contact});
    }
    block.predicates = predicate_counts() - before;
    return block;
}

bool has_lower_face(const FacePiece& a, const FacePiece& b) {
    return a.face < b.face;
}

/// By face, those of equal faces in the order of pairs: where a face is the second of a pair before
/// those where it is the first. These are sorted as they come.
std::vector<FacePiece> by_face(std::vector<FacePiece> of_first, std::vector<FacePiece> of_second) {
    std::stable_sort(of_second.begin(), of_second.end(), has_lower_face);
    std::vector<FacePiece> all(of_first.size() + of_second.size());
    std::merge(of_second.begin(), of_second.end(), of_first.begin(), of_first.end(), all.begin(),
               has_lower_face);
    return all;
}

class Collector {
public:
    Collector(const TriangleSoup& soup, Contacts& contacts) :
        table_(static_cast<PointIndex>(soup.points.size())), contacts_(contacts) {}

    void add(const PairContact& found) {
        const Contact& c = found.contact;
        for (unsigned i = 0; i < c.point_count; ++i) index_[i] = table_.enter(c.points[i].how);
        const std::array faces{found.pair.first, found.pair.second};
        for (unsigned k = 0; k < 2; ++k) {
            if (c.overlap) contacts_.overlapped[faces[k]] = true;
            for (unsigned n = 0; n < c.piece_count[k]; ++n)
                add_piece(c, k, c.pieces[k][n], faces[k], faces[1 - k]);
        }
    }

    std::span<const Construction> constructions() const { return table_.constructions(); }
    std::vector<FacePiece> pieces() && {
        return by_face(std::move(pieces_[0]), std::move(pieces_[1]));
    }

private:
    void add_piece(const Contact& c, unsigned k, const ContactPiece& piece, std::uint32_t face,
                   std::uint32_t other) {
        const auto place = [&](unsigned e) { return c.points[piece.ends[e]].place[k]; };
        pieces_[k].push_back({face,
                              {other, piece.support},
                              {place(0), place(1)},
                              {index_[piece.ends[0]], index_[piece.ends[1]]}});
    }

    ConstructionTable table_;
    Contacts& contacts_;
    std::array<std::vector<FacePiece>, 2> pieces_; ///< of first and of second faces of pairs
    std::array<PointIndex, 9> index_{};
};

bool on_closed_edge(Place p, unsigned e) {
    if (is_edge(p)) return edge_of(p) == e;
    return is_corner(p) && (corner_of(p) == e || corner_of(p) == (e + 1) % 3);
}

} // namespace

bool FacePiece::is_inner_segment() const {
    if (ends[0] == ends[1]) return false;
    for (unsigned e = 0; e < 3; ++e)
        if (on_closed_edge(place[0], e) && on_closed_edge(place[1], e)) return false;
    return true;
}

Contacts find_contacts(const TriangleSoup& soup, std::vector<Point3> points,
                       std::span<const CandidatePair> candidates, const Run& run) {
    const auto blocks =
        for_blocks<PairBlock>(candidates.size(), 1024, run, [&](std::size_t a, std::size_t b) {
            return test_pairs(soup, candidates.subspan(a, b - a));
        });
    Contacts contacts;
    contacts.candidates = candidates.size();
    contacts.overlapped.assign(soup.triangles.size(), false);
    Collector collector(soup, contacts);
    for (const PairBlock& block : blocks) {
        contacts.predicates += block.predicates;
        contacts.improper += block.contacts.size();
        for (const PairContact& c : block.contacts) collector.add(c);
        contacts.near.insert(contacts.near.end(), block.near.begin(), block.near.end());
    }
    contacts.points = PointStore(std::move(points));
    contacts.points.append(collector.constructions(), sharing(run));
    contacts.pieces = std::move(collector).pieces();
    return contacts;
}

PointStore::Share sharing(const Run& run) {
    return [&run](std::size_t count, const auto& work) { for_ranges(count, run, work, 4, 256); };
}

namespace {

struct Key {
    double low, high; // around x
    PointIndex point;
};

/// Sorts lexicographically: each share for itself, then all together.
void sort_keys(const PointStore& store, std::vector<Key>& keys, const Run& run) {
    const auto before = [&](const Key& a, const Key& b) {
        if (a.high < b.low || b.high < a.low) return a.high < b.low;
        return store.compare(a.point, b.point) < 0;
    };
    constexpr std::size_t least = 4096; // for a thread
    const std::size_t shares =
        std::clamp<std::size_t>(keys.size() / least, 1, std::max(run.threads, 1U));
    const auto end_of = [&](std::size_t s) {
        return keys.begin() + static_cast<std::ptrdiff_t>(keys.size() * s / shares);
    };
    const auto sort = [&](std::size_t first, std::size_t last) {
        const UpwardRounding guard;
        for (std::size_t s = first; s < last; ++s) std::sort(end_of(s), end_of(s + 1), before);
    };
    for_ranges(shares, run, sort, 1, 1);
    const UpwardRounding guard;
    for (std::size_t s = 1; s < shares; ++s)
        std::inplace_merge(keys.begin(), end_of(s), end_of(s + 1), before);
}

} // namespace

PointOrder order_points(const TriangleSoup& soup, const Contacts& contacts, const Run& run) {
    const PointStore& store = contacts.points;
    const auto inputs = static_cast<PointIndex>(store.input_count());
    std::vector<PointIndex> used;
    std::vector<bool> is_used(inputs, false);
    const auto use = [&](PointIndex p) {
        if (p >= inputs || is_used[p]) return;
        is_used[p] = true;
        used.push_back(p);
    };
    for (const FacePiece& p : contacts.pieces) {
        for (const PointIndex c : soup.triangles[p.face]) use(c);
        for (const PointIndex e : p.ends) use(e);
    }
    for (PointIndex p = inputs; p < store.size(); ++p) used.push_back(p);

    std::vector<Key> keys(used.size());
    for_ranges(used.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            const Enclosure e = store.enclosure(used[k]);
            keys[k] = {e.low[0], e.high[0], used[k]};
        }
    });
    sort_keys(store, keys, run);
    const UpwardRounding guard;
    for (std::size_t i = 0; i < keys.size(); ++i) used[i] = keys[i].point;
    PointOrder order;
    order.same_as.resize(store.size());
    std::iota(order.same_as.begin(), order.same_as.end(), PointIndex{0});
    order.rank.assign(store.size(), 0);
    const auto stands_before = [&](PointIndex a, PointIndex b) {
        if (a < inputs || b < inputs) return a < b;
        return store.construction(a) < store.construction(b);
    };
    std::uint32_t rank = 0;
    for (std::size_t i = 0; i < used.size();) {
        std::size_t end = i + 1;
        while (end < used.size() && store.equal(used[i], used[end])) ++end;
        const PointIndex best =
            *std::min_element(used.begin() + static_cast<std::ptrdiff_t>(i),
                              used.begin() + static_cast<std::ptrdiff_t>(end), stands_before);
        for (; i < end; ++i) {
            order.same_as[used[i]] = best;
            order.rank[used[i]] = rank;
        }
        if (best >= inputs) order.ascending.push_back(best);
        ++rank;
    }
    return order;
}

} // namespace terrane
