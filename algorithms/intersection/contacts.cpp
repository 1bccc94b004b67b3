// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/intersection/contacts.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/intersection/detail/construction_table.hpp>
#include <terrane/algorithms/intersection/detail/equal_points.hpp>
#include <terrane/algorithms/intersection/pencils.hpp>
#include <terrane/kernel/assertion.hpp>
#include <terrane/kernel/separation_filter.hpp>

namespace terrane {

using namespace intersection::detail;

namespace {

/// The contacts of a range of candidates.
struct PairBlock {
    std::size_t improper = 0; ///< number of pairs
    std::vector<Construction> points;
    std::array<std::vector<FaceConstraint>, 2>
        pieces;                            ///< on the first and on the second faces of pairs; ends
                                           ///< are indices into points
    std::vector<std::uint32_t> overlapped; ///< faces with a coplanar overlap
    std::vector<CandidatePair> near;
    std::vector<std::uint32_t> outcomes; ///< of the tests, or fresh_contact; if they are wanted
    ContactList contacts;                ///< the fresh ones, if they are wanted
    PredicateCounts predicates;

    /// c: a Contact or the shape of one.
    template <class Shape>
    void add(const CandidatePair& pair, const Shape& c, std::span<const ContactPoint> at) {
        ++improper;
        const auto first_point = static_cast<PointIndex>(points.size());
        for (const ContactPoint& p : at) points.push_back(p.how);
        const std::array faces{pair.first, pair.second};
        if (c.overlap) overlapped.insert(overlapped.end(), faces.begin(), faces.end());
        for (unsigned k = 0; k < 2; ++k)
            for (unsigned n = 0; n < c.piece_count[k]; ++n) {
                const auto& [ends, support] = c.pieces[k][n];
                pieces[k].push_back({faces[k],
                                     {faces[1 - k], support},
                                     {at[ends[0]].place[k], at[ends[1]].place[k]},
                                     {first_point + ends[0], first_point + ends[1]}});
            }
    }
};

bool have_common_vertex(const Triangle& t, const Triangle& u) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return v == u[0] || v == u[1] || v == u[2]; });
}

/// Stands for the next contact that is not known yet.
constexpr std::uint32_t fresh_contact = UINT32_MAX;

/// Tests the candidates [begin, end). tested: or null.
PairBlock test_pairs(const TriangleSoup& soup, const PlanePools& pools,
                     std::span<const CandidatePair> pairs, std::size_t begin, std::size_t end,
                     const TestedPairs* tested) {
    PairBlock block;
    const PredicateCounts before = predicate_counts();
    const auto at = [&](std::uint32_t t, unsigned i) -> const Point3& {
        return soup.points[soup.triangles[t][i]];
    };
    std::uint32_t last = UINT32_MAX;
    std::optional<SeparationFilter> first; // reused, as pairs are sorted by their first triangle
    if (tested != nullptr)
        block.outcomes.assign(tested->outcomes.begin() + static_cast<std::ptrdiff_t>(begin),
                              tested->outcomes.begin() + static_cast<std::ptrdiff_t>(end));
    for (std::size_t k = begin; k < end; ++k) {
        const std::uint32_t known = tested != nullptr ? tested->outcomes[k] : TestedPairs::untested;
        if (known == TestedPairs::apart) continue;
        const CandidatePair& p = pairs[k];
        const auto [f, g] = p;
        if (pools.are_one(f, g)) continue;
        if (known != TestedPairs::untested) {
            block.near.push_back(p);
            if (known < TestedPairs::first_contact) continue;
            const std::uint32_t i = known - TestedPairs::first_contact;
            block.add(p, tested->contacts.shape(i), tested->contacts.points(i));
            continue;
        }
        if (tested != nullptr) block.outcomes[k - begin] = TestedPairs::apart;
        if (f != last) first.emplace(at(f, 0), at(f, 1), at(f, 2));
        last = f;
        const bool joined = have_common_vertex(soup.triangles[f], soup.triangles[g]);
        if (!joined && first->is_apart(at(g, 0), at(g, 1), at(g, 2))) continue;
        const auto contact = improper_contact(soup.points, soup.triangles[f], soup.triangles[g],
                                              joined ? Filters::all : Filters::none);
        block.near.push_back(p);
        if (contact) block.add(p, *contact, std::span(contact->points).first(contact->point_count));
        if (tested == nullptr) continue;
        block.outcomes[k - begin] = contact ? fresh_contact : TestedPairs::near;
        if (contact) block.contacts.push_back(*contact);
    }
    block.predicates = predicate_counts() - before;
    return block;
}

/// Notes the outcomes of a block for the candidates from `first` on. Returns the end of these.
std::size_t note_tests(const PairBlock& block, std::size_t first, TestedPairs& tested) {
    auto next = static_cast<std::uint32_t>(TestedPairs::first_contact + tested.contacts.size());
    for (const std::uint32_t outcome : block.outcomes)
        tested.outcomes[first++] = outcome == fresh_contact ? next++ : outcome;
    tested.contacts.append(block.contacts);
    return first;
}

bool has_lower_face(const FaceConstraint& a, const FaceConstraint& b) {
    return a.face < b.face;
}

/// Sorts constraints by face, and those of one face in the order of pairs: pairs of which the face
/// is the second triangle come before those of which it is the first. `of_first` is sorted already.
std::vector<FaceConstraint> by_face(std::vector<FaceConstraint> of_first,
                                    std::vector<FaceConstraint> of_second) {
    std::stable_sort(of_second.begin(), of_second.end(), has_lower_face);
    std::vector<FaceConstraint> all(of_first.size() + of_second.size());
    std::merge(of_second.begin(), of_second.end(), of_first.begin(), of_first.end(), all.begin(),
               has_lower_face);
    return all;
}

/// Collects the blocks. Points and pieces that came since the last call of settle() are not merged
/// yet.
class Collector {
public:
    Collector(const TriangleSoup& soup, Contacts& contacts, const Run& run) :
        soup_(soup), run_(run), first_(static_cast<PointIndex>(soup.points.size())), table_(first_),
        contacts_(contacts), equal_(contacts.points) {}

    void add(const PairBlock& block) {
        index_.clear();
        for (const Construction& how : block.points) index_.push_back(table_.enter(how));
        for (const std::uint32_t face : block.overlapped) contacts_.overlapped[face] = true;
        for (unsigned k = 0; k < 2; ++k)
            for (FaceConstraint piece : block.pieces[k]) {
                for (PointIndex& end : piece.ends) end = index_[end];
                pieces_[k].push_back(piece);
            }
        contacts_.near.insert(contacts_.near.end(), block.near.begin(), block.near.end());
        contacts_.improper += block.improper;
        contacts_.predicates += block.predicates;
    }

    /// Whether so much came that merging is worthwhile.
    [[nodiscard]] bool is_full() const {
        constexpr std::size_t many = 32768;
        return table_.constructions().size() - settled_ > many + settled_ / 2 ||
               pieces_[0].size() + pieces_[1].size() > 4 * many + 2 * kept_pieces_;
    }

    void settle() {
        if (merge_points()) name_again();
        drop_repeated_pieces();
    }

    /// Merges what is left and returns all pieces.
    std::vector<FaceConstraint> pieces() && {
        merge_points();
        drop_repeated_pieces();
        return by_face(std::move(pieces_[0]), std::move(pieces_[1]));
    }

private:
    /// Appends the new points to the store and keeps one of equal ones, with the lowest of their
    /// constructions. Returns whether there were equal ones; if so, the table is out of date.
    bool merge_points() {
        PointStore& store = contacts_.points;
        equal_.reserve(table_.constructions().size());
        const auto fresh = table_.constructions().subspan(settled_);
        const auto start = static_cast<PointIndex>(first_ + settled_);
        const auto end = static_cast<PointIndex>(start + fresh.size());
        store.append(fresh, sharing(run_));
        std::vector<PointIndex> now(fresh.size());
        PointIndex next = start;
        for (PointIndex p = start; p < end; ++p) {
            PointIndex* const same = equal_.enter(p);
            if (same != nullptr && *same != p) {
                if (store.construction(p) < store.construction(*same)) store.exchange(p, *same);
                now[p - start] = *same;
                continue;
            }
            if (next != p) store.exchange(p, next);
            if (same != nullptr) *same = next;
            now[p - start] = next++;
        }
        settled_ = next - first_;
        if (next == end) return false;
        rename_ends(start, now);
        std::vector<PointIndex> kept(settled_);
        std::iota(kept.begin(), kept.end(), first_);
        store.keep_constructed(kept);
        return true;
    }

    void name_again() {
        table_ = ConstructionTable(first_);
        for (PointIndex p = first_; p < first_ + settled_; ++p)
            table_.enter(contacts_.points.construction(p));
    }

    void rename_ends(PointIndex start, const std::vector<PointIndex>& now) {
        for (auto& pieces : pieces_)
            for (FaceConstraint& piece : pieces)
                for (PointIndex& end : piece.ends)
                    if (end >= start) end = now[end - start];
    }

    /// Drops pieces with the same ends as an earlier one from triangles with many pieces. In others
    /// they do no harm, and which of several planes through a line names its crossings stays as is.
    void drop_repeated_pieces() {
        constexpr std::uint32_t many = 64;
        std::vector<std::uint32_t> counts(soup_.triangles.size(), 0);
        bool any = false;
        for (const auto& pieces : pieces_)
            for (const FaceConstraint& piece : pieces) any |= ++counts[piece.face] > many;
        kept_pieces_ = pieces_[0].size() + pieces_[1].size();
        if (!any) return;
        std::vector<std::array<std::uint32_t, 4>> keys; // face, ends, position
        std::vector<bool> repeated(kept_pieces_, false);
        std::uint32_t position = 0;
        for (const unsigned k : {1u, 0u})
            for (const FaceConstraint& piece : pieces_[k]) {
                const auto [low, high] = std::minmax(piece.ends[0], piece.ends[1]);
                if (counts[piece.face] > many) keys.push_back({piece.face, low, high, position});
                ++position;
            }
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 1; i < keys.size(); ++i)
            repeated[keys[i][3]] =
                std::equal(keys[i].begin(), keys[i].end() - 1, keys[i - 1].begin());
        position = 0;
        for (const unsigned k : {1u, 0u})
            std::erase_if(pieces_[k],
                          [&](const FaceConstraint&) -> bool { return repeated[position++]; });
        kept_pieces_ = pieces_[0].size() + pieces_[1].size();
    }

    const TriangleSoup& soup_;
    const Run& run_;
    PointIndex first_;
    std::size_t settled_ = 0, kept_pieces_ = 0;
    ConstructionTable table_;
    Contacts& contacts_;
    EqualPoints equal_;
    std::array<std::vector<FaceConstraint>, 2> pieces_; ///< on the first and the second faces
    std::vector<PointIndex> index_;                     ///< per point of a block: its index
};

} // namespace

bool FaceConstraint::is_inner_segment() const {
    if (ends[0] == ends[1]) return false;
    for (unsigned e = 0; e < 3; ++e)
        if (on_closed_edge(place[0], e) && on_closed_edge(place[1], e)) return false;
    return true;
}

Contacts find_contacts(const TriangleSoup& soup, std::vector<Point3> points,
                       std::span<const CandidatePair> candidates, const Pencils& pencils,
                       const Run& run, TestedPairs* tested) {
    Contacts contacts;
    TERRANE_ASSERT(tested == nullptr || tested->outcomes.size() == candidates.size());
    contacts.candidates = candidates.size();
    contacts.overlapped.assign(soup.triangles.size(), false);
    contacts.pools = find_plane_pools(soup, candidates, run);
    contacts.points = PointStore(std::move(points));
    Collector collector(soup, contacts, run);
    for (const Pencil& pencil : pencils.list) {
        PencilContacts found = contacts_of(soup, pencil);
        PairBlock block;
        block.points = std::move(found.points);
        block.pieces[1] = std::move(found.pieces);
        collector.add(block);
    }
    constexpr std::size_t wave = 65536; // pairs whose contacts are in memory at a time
    for (std::size_t start = 0; start < candidates.size(); start += wave) {
        const std::size_t end = std::min(start + wave, candidates.size());
        const auto blocks =
            for_blocks<PairBlock>(end - start, 1024, run, [&](std::size_t a, std::size_t b) {
                return test_pairs(soup, contacts.pools, candidates, start + a, start + b, tested);
            });
        for (std::size_t k = start; const PairBlock& block : blocks) {
            collector.add(block);
            if (tested != nullptr) k = note_tests(block, k, *tested);
        }
        if (run.stop.stop_requested()) return contacts;
        if (collector.is_full()) collector.settle();
        report_part(run, "contacts", 0, 1, end, candidates.size());
    }
    contacts.pieces = std::move(collector).pieces();
    return contacts;
}

PointStore::Share sharing(const Run& run) {
    return [&run](std::size_t count, const auto& work) { for_ranges(count, run, work, 4, 256); };
}

namespace {

struct Key {
    double x; // the nearest double; if two differ, their order is that of the points
    PointIndex point;
};

/// Sorts the keys into as many buckets as there are keys, by the position of their x between the
/// lowest and the highest. All keys of a bucket precede those of the next. Returns the starts of
/// the buckets and the end of the last.
std::vector<std::uint32_t> into_buckets(std::vector<Key>& keys) {
    const auto [low, high] = std::minmax_element(
        keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.x < b.x; });
    // Halving keeps the difference of finite numbers finite. A constructed point may be infinite.
    const double start = low->x / 2, length = high->x / 2 - start;
    const double highest = static_cast<double>(keys.size() - 1);
    const double scale = highest / length;
    const std::size_t buckets = scale > 0 && std::isfinite(scale) ? keys.size() : 1;
    const auto bucket_of = [&](const Key& key) {
        return buckets == 1 ? std::size_t{0}
                            : static_cast<std::size_t>(
                                  std::min((key.x / 2 - start) * scale, highest)); // monotone
    };
    std::vector<std::uint32_t> starts(buckets + 1, 0);
    for (const Key& key : keys) ++starts[bucket_of(key) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::uint32_t> next = starts;
    std::vector<Key> sorted(keys.size());
    for (const Key& key : keys) sorted[next[bucket_of(key)]++] = key;
    keys = std::move(sorted);
    return starts;
}

/// Sorts points that are equal in the coordinates before the given one. Comparing equal coordinates
/// is exact and slow. A three-way partition compares each of n equal ones with the pivot only, an
/// ordinary sort log n times. After `depth` partitions within one another, an ordinary sort bounds
/// the cost.
void sort_points(const PointStore& store, std::span<Key> keys, unsigned coordinate,
                 unsigned depth) {
    for (; keys.size() > 1 && coordinate < 3; ++coordinate) {
        if (depth == 0) {
            std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
                return store.compare(a.point, b.point) < 0;
            });
            return;
        }
        const PointIndex pivot = keys[keys.size() / 2].point;
        std::size_t less = 0, greater = keys.size();
        for (std::size_t k = 0; k < greater;) {
            const auto order = store.compare(coordinate, keys[k].point, pivot);
            if (order < 0)
                std::swap(keys[less++], keys[k++]);
            else if (order > 0)
                std::swap(keys[k], keys[--greater]);
            else
                ++k;
        }
        sort_points(store, keys.first(less), coordinate, depth - 1);
        sort_points(store, keys.subspan(greater), coordinate, depth - 1);
        keys = keys.subspan(less, greater - less);
    }
}

/// Sorts keys by x, which needs no look at the points, and those with equal x by their points.
void sort_bucket(const PointStore& store, std::span<Key> keys) {
    const auto before = [](const Key& a, const Key& b) { return a.x < b.x; };
    std::sort(keys.begin(), keys.end(), before);
    while (!keys.empty()) {
        const auto end = std::upper_bound(keys.begin(), keys.end(), keys.front(), before);
        const auto count = static_cast<std::size_t>(end - keys.begin());
        sort_points(store, keys.first(count), 0, 2 * static_cast<unsigned>(std::bit_width(count)));
        keys = keys.subspan(count);
    }
}

/// Sorts the keys by the lexicographic order of their points.
void sort_keys(const PointStore& store, std::vector<Key>& keys, const Run& run) {
    if (keys.empty()) return;
    const auto starts = into_buckets(keys);
    const auto at = [&](std::size_t bucket) {
        return keys.begin() + static_cast<std::ptrdiff_t>(starts[bucket]);
    };
    const auto sort = [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b)
            if (starts[b + 1] - starts[b] > 1) sort_bucket(store, {at(b), at(b + 1)});
    };
    for_ranges(starts.size() - 1, run, sort, 4, 1024);
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
    for (const FaceConstraint& p : contacts.pieces) {
        for (const PointIndex c : soup.triangles[p.face]) use(c);
        for (const PointIndex e : p.ends) use(e);
    }
    for (const FaceCrossing& c : contacts.crossings) use(c.point); // on merged segments
    for (PointIndex p = inputs; p < store.size(); ++p) used.push_back(p);

    std::vector<Key> keys(used.size());
    for_ranges(used.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) keys[k] = {store.nearest(used[k]).x, used[k]};
    });
    sort_keys(store, keys, run);
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
        while (end < used.size() && keys[end].x == keys[i].x && store.equal(used[i], used[end]))
            ++end;
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
