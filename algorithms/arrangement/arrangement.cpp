// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/arrangement.hpp>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <memory>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/intersection_edges.hpp>
#include <terrane/algorithms/arrangement/known_triangles.hpp>
#include <terrane/algorithms/arrangement/retriangulation.hpp>
#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/invariants.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/intersection/pencils.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/kernel/fraction.hpp>

namespace terrane {
namespace {

/// Returns the parents of each triangle: the input triangles of its faces, and their duplicates.
IndexLists<std::uint32_t>
parents_of_faces(const Soup& soup, const IndexLists<std::uint32_t>& faces_of, const Run& run) {
    auto by_first = soup.duplicates;
    std::sort(by_first.begin(), by_first.end(), [](const auto& a, const auto& b) {
        return std::pair{a[1], a[0]} < std::pair{b[1], b[0]};
    });
    const auto first_before = [](const auto& d, std::uint32_t first) { return d[1] < first; };
    IndexLists<std::uint32_t> parents;
    if (by_first.empty()) { // input_of ascends, so the lists stay sorted
        parents = faces_of;
        const bool kept_all =
            soup.input_of.empty() || soup.input_of.back() + 1 == soup.input_of.size();
        if (kept_all) return parents;
        for_ranges(parents.values.size(), run, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k)
                parents.values[k] = soup.input_of[parents.values[k]];
        });
        return parents;
    }
    parents.offsets.reserve(faces_of.offsets.size());
    parents.values.reserve(faces_of.values.size() + soup.duplicates.size());
    for (std::size_t t = 0; t < faces_of.size(); ++t) {
        const auto begin = static_cast<std::ptrdiff_t>(parents.values.size());
        for (const std::uint32_t f : faces_of[t]) {
            const std::uint32_t first = soup.input_of[f];
            parents.values.push_back(first);
            if (by_first.empty()) continue;
            auto d = std::lower_bound(by_first.begin(), by_first.end(), first, first_before);
            for (; d != by_first.end() && (*d)[1] == first; ++d) parents.values.push_back((*d)[0]);
        }
        std::sort(parents.values.begin() + begin, parents.values.end());
        parents.close();
    }
    return parents;
}

/// Assigns each triangle to the patch of its face, or to none if it has several faces.
InjectivePatches patches_of_faces(InjectivePatches of_soup,
                                  const IndexLists<std::uint32_t>& faces_of, const Run& run) {
    InjectivePatches patches;
    patches.axis = std::move(of_soup.axis);
    patches.turn = std::move(of_soup.turn);
    patches.of.resize(faces_of.size());
    for_ranges(faces_of.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t)
            patches.of[t] = faces_of[t].size() == 1 ? of_soup.of[faces_of[t][0]] : no_group;
    });
    return patches;
}

/// Tells for each triangle of the soup whether one of its parts has a constructed point.
std::vector<char> divided_faces(const Soup& soup, const Retriangulation& division) {
    std::vector<char> has_constructed(soup.triangles.size(), 0);
    const auto inputs = static_cast<PointIndex>(division.points.input_count());
    const auto look_at = [&](std::size_t t) {
        const Triangle& c = division.triangles[t];
        if (c[0] < inputs && c[1] < inputs && c[2] < inputs) return;
        for (const std::uint32_t f : division.faces_of[t]) has_constructed[f] = 1;
    };
    // Triangles are in the order of the soup: parts of divided ones lie between those that are whole.
    std::size_t next = 0;
    for (const std::uint32_t whole : division.unchanged_as) {
        if (whole == UINT32_MAX) continue;
        TERRANE_ASSERT_DEBUG(next <= whole);
        while (next < whole) look_at(next++);
        ++next;
    }
    while (next < division.triangles.size()) look_at(next++);
    return has_constructed;
}

/// Pairs that the search for candidates leaves out, besides those within one patch.
struct LeftOut {
    Pencils pencils;
    bool any_crowded = false; ///< pairs at crowded vertices
};

/// Returns the sets of triangles within which the search for candidates leaves pairs out: those at
/// crowded vertices, and the pencils.
IndexLists<std::uint32_t> sets_with_pairs_left_out(const Soup& soup,
                                                   const std::vector<bool>& crowded,
                                                   const Pencils& pencils) {
    std::vector<std::vector<std::uint32_t>> at(crowded.size());
    if (!crowded.empty())
        for (std::uint32_t f = 0; f < soup.triangles.size(); ++f)
            for (const std::uint32_t v : soup.triangles[f])
                if (crowded[v]) at[v].push_back(f);
    IndexLists<std::uint32_t> sets;
    for (const auto& set : at)
        if (!set.empty()) sets.push_back(set);
    for (const Pencil& p : pencils.list) sets.push_back(p.triangles);
    return sets;
}

/// Adds the pairs of these sets to state.neighbours if they are few for a mesh of this size. Returns
/// whether they are.
bool add_pairs_of_sets(const IndexLists<std::uint32_t>& sets, const Soup& soup,
                       const Retriangulation& division, std::span<const std::uint32_t> patch_of,
                       std::span<const char> has_constructed, ExactState& state) {
    constexpr std::uint64_t most_per_triangle = 4;
    std::uint64_t sum = 0;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        const std::uint64_t n = sets[s].size();
        sum += n * (n - 1) / 2;
    }
    if (sum > most_per_triangle * division.triangles.size()) return false;
    const BoxSource boxes(division.points.inputs(), soup.triangles);
    const auto in_one = [](std::span<const std::uint32_t> groups, std::uint32_t f,
                           std::uint32_t g) {
        return !groups.empty() && groups[f] != no_group && groups[f] == groups[g];
    };
    for (std::size_t s = 0; s < sets.size(); ++s)
        for (std::size_t i = 0; i < sets[s].size(); ++i) {
            const std::uint32_t f = sets[s][i];
            const Box box = boxes[f];
            for (const std::uint32_t g : sets[s].subspan(i + 1))
                if ((has_constructed[f] != 0 || has_constructed[g] != 0) &&
                    !in_one(patch_of, f, g) && !in_one(division.pools, f, g) &&
                    box.overlaps(boxes[g]))
                    state.neighbours.push_back({soup.input_of[f], soup.input_of[g]});
        }
    sort_unique(state.neighbours);
    return true;
}

/// Finds the near pairs of which at least one triangle has a constructed point, as input triangles,
/// and the triangles of which pairs are left out.
void find_neighbours_of_divided(const Soup& soup, const Retriangulation& division,
                                const LeftOut& left_out, std::span<const std::uint32_t> patch_of,
                                ExactState& state) {
    const auto has_constructed = divided_faces(soup, division);
    for (const CandidatePair& p : division.near)
        if (has_constructed[p.first] != 0 || has_constructed[p.second] != 0)
            state.neighbours.push_back({soup.input_of[p.first], soup.input_of[p.second]});
    const Pencils& pencils = left_out.pencils;
    if (!left_out.any_crowded && pencils.of.empty()) return;
    std::vector<bool> crowded;
    if (left_out.any_crowded)
        crowded = crowded_vertices(division.points.input_count(), soup.triangles);
    if (add_pairs_of_sets(sets_with_pairs_left_out(soup, crowded, pencils), soup, division,
                          patch_of, has_constructed, state))
        return;
    const auto is_crowded = [&](std::uint32_t f) {
        const Triangle& t = soup.triangles[f];
        return (!pencils.of.empty() && pencils.of[f] != no_group) ||
               (!crowded.empty() && (crowded[t[0]] || crowded[t[1]] || crowded[t[2]]));
    };
    for (std::uint32_t f = 0; f < soup.triangles.size(); ++f)
        if (has_constructed[f] != 0 && is_crowded(f)) state.crowded.push_back(soup.input_of[f]);
}

/// Labels triangles by patch, and those without a patch by surface.
Labels labels_of(const Soup& soup, const InjectivePatches& patches, const Run& run) {
    Labels labels(patches.of.size());
    const auto count = static_cast<std::uint32_t>(patches.axis.size());
    for_ranges(labels.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t)
            labels[t] = patches.of[t] == no_group ? count + soup.surface_of[t] : patches.of[t];
    });
    for (const auto& [repeated, first] : soup.duplicates)
        labels[static_cast<std::size_t>(
            std::lower_bound(soup.input_of.begin(), soup.input_of.end(), first) -
            soup.input_of.begin())] = no_label;
    return labels;
}

/// Makes the points in use vertices: input points by number, then constructed points in
/// lexicographic order. Returns the vertex of each point.
std::vector<std::uint32_t> name_vertices(Arrangement& a, const PointStore& points,
                                         std::span<const PointIndex> ascending, const Run& run) {
    const auto inputs = static_cast<PointIndex>(points.input_count());
    constexpr std::uint32_t unused = UINT32_MAX;
    std::vector<std::uint32_t> vertex_of(points.size(), unused);
    for_ranges(a.triangles.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t)
            for (const PointIndex p : a.triangles[t])
                std::atomic_ref(vertex_of[p]).store(0, std::memory_order_relaxed);
    });
    a.vertices.reserve(inputs + ascending.size());
    const auto name = [&](PointIndex p) {
        if (vertex_of[p] == unused) return;
        vertex_of[p] = static_cast<std::uint32_t>(a.vertices.size());
        a.vertices.push_back(p);
    };
    for (PointIndex p = 0; p < inputs; ++p) name(p);
    for (const PointIndex p : ascending) name(p);
    for_ranges(a.triangles.size(), run, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t)
            for (PointIndex& p : a.triangles[t]) p = vertex_of[p];
    });
    return vertex_of;
}

/// Finds the pairs of triangles that are to be tested, and what they leave out.
std::vector<CandidatePair> find_all_candidates(const Soup& soup,
                                               std::span<const std::uint32_t> patches,
                                               Search method, LeftOut& left_out, const Run& run) {
    Pencils& pencils = left_out.pencils;
    const TriangleSoup all{soup.points, soup.triangles};
    const auto find_crowds = [&](std::span<const std::uint32_t> busy) {
        pencils = find_pencils(all, busy, run);
        return pencils.of;
    };
    auto candidates = candidate_pairs({soup.points, soup.triangles}, patches, method, run,
                                      find_crowds, &left_out.any_crowded);
    if (pencils.list.empty()) return candidates;
    const auto coplanar = coplanar_pairs(all, pencils, patches, run);
    std::vector<CandidatePair> both_kinds;
    both_kinds.reserve(candidates.size() + coplanar.size());
    std::set_union(candidates.begin(), candidates.end(), coplanar.begin(), coplanar.end(),
                   std::back_inserter(both_kinds));
    return both_kinds;
}

/// Does the same, but takes over what an earlier arrangement found. known: or null.
Candidates find_candidates(const Soup& soup, std::span<const std::uint32_t> patches, Search used,
                           const KnownInSoup* known, LeftOut& left_out, const Run& run) {
    if (known != nullptr)
        if (auto candidates = known->candidates(patches, run)) return *std::move(candidates);
    return {find_all_candidates(soup, patches, used, left_out, run), {}};
}

Error interrupted() {
    return {ErrorCode::interrupted, "stopped on request", ""};
}

/// Asserts the properties that arrangement.hpp states for the arrays.
void assert_invariants([[maybe_unused]] const Arrangement& a) {
    TERRANE_ASSERT(a.parents_of.size() == a.triangles.size());
    TERRANE_ASSERT(a.surfaces_of.size() == a.triangles.size());
    TERRANE_ASSERT_PARANOID(corners_below(a.triangles, a.vertices.size()));
    TERRANE_ASSERT_PARANOID(all_below(a.vertices, a.state->points.size()));
    TERRANE_ASSERT_PARANOID(are_sorted_lists(a.parents_of, a.triangles.size()));
    TERRANE_ASSERT_PARANOID(are_sorted_lists(a.surfaces_of, a.triangles.size()));
    TERRANE_ASSERT_PARANOID(all_below(a.surfaces_of.values, a.surfaces.size()));
    TERRANE_ASSERT_PARANOID(is_sorted_unique(a.intersection_edges));
    TERRANE_ASSERT_PARANOID(is_sorted_unique(a.degenerate));
}

void count_statistics(ArrangeStatistics& all, const Candidates& candidates,
                      const Retriangulation& division) {
    all.candidates = candidates.pairs.size();
    all.improper_contacts = division.statistics.improper_contacts;
    all.divided = division.statistics.divided;
    all.constructed_points = division.ascending.size();
    all.predicates = division.statistics.predicates;
}

/// Keeps patches and candidates for the next arrangement. Keeps nothing if the search or the test left
/// pairs out.
void keep_known(KnownTriangles* known, const Soup& soup, const InjectivePatches& patches,
                const Retriangulation& division, const LeftOut& left_out, Candidates candidates) {
    if (known == nullptr || left_out.any_crowded || !left_out.pencils.of.empty() ||
        !division.pools.empty())
        return;
    const auto points = division.points.inputs();
    known->keep({points.begin(), points.end()}, soup, patches, std::move(candidates));
}

/// Makes one mesh of the triangles after division, with what later stages ask of it.
void assemble(Arrangement& a, Soup soup, InjectivePatches patches, Retriangulation division,
              const LeftOut& left_out, const Run& run) {
    a.inputs = {soup.first_input_triangle, soup.first_input_vertex, soup.duplicates};
    a.degenerate = soup.degenerate;
    const auto state = std::make_shared<ExactState>();
    a.state = state;
    state->corners = std::move(soup.input_corners);
    find_neighbours_of_divided(soup, division, left_out, patches.of, *state);
    if (!division.pools.empty()) {
        state->pools.assign(state->corners.size(), no_group);
        for (std::size_t f = 0; f < division.pools.size(); ++f)
            state->pools[soup.input_of[f]] = division.pools[f];
    }
    const Labels labels = labels_of(soup, patches, run);
    std::vector<std::uint32_t> vertex_of;
    both(
        run,
        [&] {
            a.parents_of = parents_of_faces(soup, division.faces_of, run);
            a.surfaces_of = surfaces_of_parents(a.inputs, a.parents_of, run);
        },
        [&] {
            state->patches = patches_of_faces(std::move(patches), division.faces_of, run);
            state->points = std::move(division.points);
            a.triangles = std::move(division.triangles);
            vertex_of = name_vertices(a, state->points, division.ascending, run);
        });
    if (run.progress) run.progress("arrange", 0.9);
    state->adjacency = adjacency_after(
        soup.edges, labels,
        {a.triangles, division.faces_of, division.unchanged_as, vertex_of, a.vertices.size()}, run);
    a.intersection_edges = find_intersection_edges(state->adjacency, a.inputs, a.parents_of);
}

Result<Arrangement> arrange_checked(std::span<const Surface> surfaces,
                                    const ArrangeOptions& options, KnownTriangles* kept,
                                    const Run& run) {
    const auto report = [&](double share) {
        if (run.progress) run.progress("arrange", share);
    };
    StageTimer step(run, "prepare");
    Arrangement a;
    for (const Surface& s : surfaces) a.surfaces.push_back({s.name, s.role});

    // (a) one soup of distinct points and triangles
    Soup soup = merge_with_repeated(surfaces, run);
    const Search search = method_used(options.search, soup.triangles.size());
    std::unique_ptr<KnownInSoup> known;
    if (kept != nullptr && search == Search::bvh) known = kept->find_in(soup);
    soup.edges = known ? known->edges(run) : group_edges(soup.triangles, soup.points.size(), run);
    if (set_repeated_aside(soup, run) && known) known->find_again();
    InjectivePatches patches =
        known ? known->patches(run)
              : find_injective_patches(soup.points, soup.triangles, soup.surface_of, soup.edges,
                                       run, soup.turns);
    report(0.1);

    // (b) candidate pairs
    step.next("search");
    LeftOut left_out;
    Candidates candidates = find_candidates(soup, patches.of, search, known.get(), left_out,
                                            part_of_stage(run, "arrange", 0.1, 0.3));
    known.reset();
    TERRANE_ASSERT_PARANOID(is_sorted_unique(candidates.pairs));
    step.stop();
    report(0.3);
    if (run.stop.stop_requested()) return interrupted();

    // (c) contacts, (d) equal points, (e) triangulation of the faces with contacts
    auto& outcomes = candidates.tested.outcomes;
    if (kept != nullptr && outcomes.empty())
        outcomes.assign(candidates.pairs.size(), TestedPairs::untested);
    a.statistics.known = outcomes.size() - static_cast<std::size_t>(
                                               std::ranges::count(outcomes, TestedPairs::untested));
    Retriangulation division = retriangulate(
        std::move(soup.points), soup.triangles, candidates.pairs, left_out.pencils,
        part_of_stage(run, "arrange", 0.3, 0.85), kept != nullptr ? &candidates.tested : nullptr);
    if (run.stop.stop_requested()) return interrupted();
    count_statistics(a.statistics, candidates, division);
    a.statistics.search = search;
    keep_known(kept, soup, patches, division, left_out, std::move(candidates));

    // (f) one mesh
    step.next("assemble");
    assemble(a, std::move(soup), std::move(patches), std::move(division), left_out, run);
    a.statistics.triangles = a.triangles.size();
    a.statistics.vertices = a.vertices.size();
    step.stop();
    assert_invariants(a);
    report(1);
    return a;
}

Result<Arrangement> arrange_knowing(std::span<const Surface> surfaces,
                                    const ArrangeOptions& options, KnownTriangles* known,
                                    const Run& run) {
    return guarded("for the arrangement", "arrange", [&]() -> Result<Arrangement> {
        if (const auto valid = validate(surfaces, run); !valid) return valid.error();
        // Within one arena the threads stay awake from stage to stage.
        Result<Arrangement> arranged = Error{};
        const StageTimer timer(run, "arrange");
        const Run inner = timer.inside();
        with_threads(run, [&] { arranged = arrange_checked(surfaces, options, known, inner); });
        return arranged;
    });
}

} // namespace

std::shared_ptr<const ExactState> empty_state() {
    static const auto empty = std::make_shared<const ExactState>();
    return empty;
}

ExactState& own_state(Arrangement& a) {
    if (a.state.use_count() != 1) a.state = std::make_shared<ExactState>(*a.state);
    return const_cast<ExactState&>(*a.state); // created non-const, here or by arrange
}

const Point3& Arrangement::nearest(VertexId vertex) const {
    return state->points.nearest(vertices[vertex]);
}

std::array<std::string, 3> Arrangement::coordinates(VertexId vertex) const {
    return fractions(state->points, vertices[vertex], 10);
}

Construction Arrangement::construction(VertexId vertex) const {
    return state->points.construction(vertices[vertex]);
}

std::span<const Point3> Arrangement::input_vertices() const {
    return state->points.inputs();
}

std::span<const Triangle> Arrangement::input_corners() const {
    return state->corners;
}

Result<Arrangement> arrange(std::span<const Surface> surfaces, const ArrangeOptions& options,
                            const Run& run) {
    return arrange_knowing(surfaces, options, nullptr, run);
}

Result<Arrangement> arrange(std::span<const Surface> surfaces, const ArrangeOptions& options,
                            KnownTriangles& known, const Run& run) {
    return arrange_knowing(surfaces, options, &known, run);
}

} // namespace terrane
