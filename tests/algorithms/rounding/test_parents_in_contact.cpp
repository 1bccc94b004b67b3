// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/read.hpp"
#include "support/rounded.hpp"

#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/work_hook.hpp>
#include <terrane/algorithms/rounding/detail/attempt.hpp>
#include <terrane/algorithms/rounding/detail/parents_in_contact.hpp>
#include <terrane/io/files.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace terrane;
using namespace terrane::rounding::detail;
using namespace test_support;

/// Triangles with one to five parents each, and more contacts between them than are listed.
struct ManyContacts {
    static constexpr std::uint32_t inputs = 60;
    IndexLists<std::uint32_t> parents_of{};
    std::vector<CandidatePair> pairs{};

    explicit ManyContacts(unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_int_distribution<std::uint32_t> input(0, inputs - 10), count(1, 5);
        for (int t = 0; t < 600; ++t) {
            std::set<std::uint32_t> parents;
            for (auto n = count(random); parents.size() < n;) parents.insert(input(random));
            parents_of.push_back(std::vector(parents.begin(), parents.end()));
        }
        for (std::uint32_t s = 0; s < 600; ++s)
            for (std::uint32_t t = s + 1; t < 600; ++t)
                if ((s * 7 + t) % 10 < 8) pairs.push_back({s, t});
    }
};

void take_in(CrowdedContacts& crowd, std::span<const CandidatePair> pairs) {
    for (const CandidatePair& p : pairs)
        if (!crowd.adds_nothing(p)) crowd.add(p);
}

Arrangement of_regression(const char* file, const char* folder = "/regression/") {
    return arranged(read_surfaces(test_data() + folder + file).value());
}

std::atomic<std::size_t> most_searched{0}; ///< triangles of a mesh that is searched for contacts

void note_searched(std::string_view step, std::span<const Point3>, std::span<const Triangle> mesh) {
    if (step == "search contacts") most_searched = std::max(most_searched.load(), mesh.size());
}

} // namespace

TEST_CASE(
    "parents in contact: a list of few contacts pairs the first four parents of each triangle") {
    IndexLists<std::uint32_t> parents;
    parents.push_back(std::vector<std::uint32_t>{7});
    parents.push_back(std::vector<std::uint32_t>{1, 2, 3, 8, 9});
    parents.push_back(std::vector<std::uint32_t>{7, 10});
    parents.push_back(std::vector<std::uint32_t>{11}); // not in contact
    const std::vector<CandidatePair> contacts{{0, 1}, {0, 2}, {0, 1}};
    const auto found = parents_in_contact(contacts, parents);
    CHECK(found.all == std::vector<std::uint32_t>{1, 2, 3, 7, 8, 9, 10});
    CHECK(found.pairs == std::vector<std::pair<std::uint32_t, std::uint32_t>>{
                             {1, 7}, {2, 7}, {3, 7}, {7, 8}, {7, 10}});
}

TEST_CASE("parents in contact: two threads collect the same parents as a list, in any order of "
          "contacts") {
    const ManyContacts many(1);
    REQUIRE(many.pairs.size() > ParentsInContact::most_contacts + 1000);
    const auto wanted = parents_in_contact(many.pairs, many.parents_of);
    REQUIRE(wanted.all.size() == ManyContacts::inputs - 9);
    for (unsigned seed = 0; seed < 3; ++seed) {
        auto pairs = many.pairs;
        std::shuffle(pairs.begin(), pairs.end(), std::mt19937(seed));
        CrowdedContacts crowd(many.parents_of, ManyContacts::inputs,
                              ParentsInContact::most_contacts + 1);
        CHECK_FALSE(crowd.adds_nothing(pairs[0]));
        const auto middle = std::span(pairs).subspan(pairs.size() / 2);
        std::thread other([&] { take_in(crowd, middle); });
        take_in(crowd, std::span(pairs).first(pairs.size() / 2));
        other.join();
        CHECK(crowd.is_full());
        const auto found = crowd.parents();
        CHECK(found.pairs == wanted.pairs);
        CHECK(found.all == wanted.all);
        CHECK(std::all_of(pairs.begin(), pairs.end(),
                          [&](const CandidatePair& p) { return crowd.adds_nothing(p); }));
    }
}

TEST_CASE("parents in contact: a full collector still takes each pair with a new parent") {
    IndexLists<std::uint32_t> parents;
    for (const std::vector<std::uint32_t>& list : {std::vector{0U}, {1U}, {2U}, {0U, 3U}, {1U, 4U}})
        parents.push_back(list);
    CrowdedContacts crowd(parents, 5, ParentsInContact::most_contacts + 1);
    for (std::size_t k = 0; k < ParentsInContact::most_contacts; ++k) crowd.add({0, 1});
    CHECK_FALSE(crowd.is_full());
    CHECK_FALSE(crowd.adds_nothing({0, 1}));
    crowd.add({1, 2});
    REQUIRE(crowd.is_full());
    CHECK(crowd.adds_nothing({0, 1}));
    CHECK_FALSE(crowd.adds_nothing({0, 2})); // both are in contact, but not with each other so far
    CHECK_FALSE(crowd.adds_nothing({0, 4})); // input triangle 4 is new
    crowd.add({0, 4});
    CHECK(crowd.adds_nothing({0, 4}));
    CHECK_FALSE(crowd.adds_nothing({0, 3})); // two parts of one triangle; input triangle 3 is new
    crowd.add({0, 3});
    CHECK(crowd.adds_nothing({0, 3}));
    CHECK(crowd.parents().all == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
    CHECK(crowd.parents().pairs ==
          std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 1}, {1, 2}});
}

TEST_CASE(
    "parents in contact: a sample has all parts of a parent with few, and some of one with many") {
    constexpr std::size_t most = 4;
    IndexLists<std::uint32_t> parents;
    for (const std::uint32_t count : {1U, 3U, 7U, 8U, 100U})
        for (std::uint32_t k = 0; k < count; ++k) parents.push_back(std::vector{count});
    const auto sample = sample_of_parts(parents, most);
    CHECK(std::is_sorted(sample.begin(), sample.end()));
    std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
    for (const std::uint32_t t : sample) parts[parents[t][0]].push_back(t);
    CHECK(parts[1].size() == 1);
    CHECK(parts[3].size() == 3);
    CHECK(parts[7].size() == 7);
    CHECK(parts[8].size() == 4);
    REQUIRE(parts[100].size() == 4);
    CHECK(parts[100].back() - parts[100].front() >= 75); // from all over it
}

TEST_CASE("parents in contact: rounding tells them from a sample where contacts are crowded",
          "[once]") {
    const auto a = of_regression("016-crowded-contacts-listed.obj");
    const auto naive = rounded(a, {.max_rounds = 0});
    const Mesh& mesh = *naive.mesh;
    std::vector<std::uint32_t> each(mesh.triangles.size());
    std::iota(each.begin(), each.end(), 0U);
    auto contacts =
        candidate_pairs_of({mesh.vertices, mesh.triangles}, each, {},
                           [&](const CandidatePair& p) {
                               return improper_contact(mesh.vertices, mesh.triangles[p.first],
                                                       mesh.triangles[p.second])
                                   .has_value();
                           },
                           {});
    std::sort(contacts.begin(), contacts.end());
    REQUIRE(contacts.size() > 4 * a.triangles.size());
    const auto all = parents_in_contact(contacts, mesh.parents_of);

    CHECK(naive.report.naive_contacts > ParentsInContact::most_contacts);
    REQUIRE(naive.report.contacts.size() == ParentsInContact::most_contacts + 1);
    for (std::size_t k = 0; k < naive.report.contacts.size(); ++k) // the first of them
        if (naive.report.contacts[k].triangles != std::array{contacts[k].first, contacts[k].second})
            FAIL("contact " << k);

    const RoundingOptions options;
    const MovedInput unmoved;
    std::optional<ParentsInContact> first;
    for (const Repairs repairs : {Repairs::sparse, Repairs::possible})
        for (const unsigned threads : {1U, 2U}) {
            Run run;
            run.threads = threads;
            const Task task{options, 1e300, a.state->kept_planes, run};
            Rounding rounding(a, unmoved, repairs, task);
            const auto left = rounding();
            REQUIRE(left.ok());
            REQUIRE(rounding.left());
            CHECK_FALSE(left.value().report.clean);
            CHECK(left.value().report.naive_contacts == ParentsInContact::most_contacts + 1);
            const auto& found = *rounding.left();
            CHECK(std::includes(all.pairs.begin(), all.pairs.end(), found.pairs.begin(),
                                found.pairs.end()));
            CHECK(4 * found.pairs.size() >= 3 * all.pairs.size());
            CHECK(
                std::includes(all.all.begin(), all.all.end(), found.all.begin(), found.all.end()));
            CHECK(10 * found.all.size() >= 9 * all.all.size());
            if (!first) first = found;
            CHECK(found.pairs == first->pairs);
        }
}

// Its contacts are in many planes. In a frame of clusters it has a million contacts.
TEST_CASE("rounding: no frame of clusters is tried that leaves most contacts") {
    const auto a = of_regression("018-attempts-beyond-repair.obj", "/regression_slow/");
    most_searched = 0;
    terrane::detail::work_hook = note_searched;
    const auto r = rounded(a, {.max_move = 1e30});
    terrane::detail::work_hook = nullptr;
    CHECK(r.report.clean);
    CHECK(most_searched > 0);
    CHECK(most_searched <= 8 * a.triangles.size()); // as the triangles of no such attempt
}

TEST_CASE("rounding: a round ends as soon as division multiplies the triangles") {
    const auto a = of_regression("017-divided-beyond-repair.obj");
    most_searched = 0;
    terrane::detail::work_hook = note_searched;
    const auto r = rounded(a);
    terrane::detail::work_hook = nullptr;
    CHECK(r.report.clean);
    CHECK(most_searched > 0);
    CHECK(most_searched <= 8 * a.triangles.size());
}
