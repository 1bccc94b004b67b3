// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/files.hpp"

#include <terrane/algorithms/tiles/detail/unnamed_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <vector>

namespace {

using namespace terrane;
using namespace terrane::tiles::detail;

struct Taken {
    std::uint64_t at, size;
};

/// Tells whether all are apart, and where the last one ends.
bool are_apart(std::vector<Taken> all, std::uint64_t& end) {
    std::ranges::sort(all, {}, &Taken::at);
    end = 0;
    for (const Taken& t : all) {
        if (t.at < end) return false;
        end = t.at + t.size;
    }
    return true;
}

} // namespace

TEST_CASE("unnamed file: what is written is read, in a folder that stays empty", "[tiles]") {
    const test_support::TemporaryFolder folder;
    const auto file = UnnamedFile::create(folder.path());
    REQUIRE(file);
    CHECK(test_support::entries(folder.path()) == 0);
    const std::vector<int> written{1, 2, 3};
    std::vector<int> read(3);
    std::uint64_t at = 100;
    CHECK(file->write(written.data(), 12, at));
    CHECK(at == 112);
    CHECK(file->write(written.data(), 0, at));
    at = 100;
    CHECK(file->read(read.data(), 12, at));
    CHECK(read == written);
    CHECK_FALSE(file->read(read.data(), 1, at)); // nothing is there
    CHECK(file->clear());
    at = 100;
    CHECK_FALSE(file->read(read.data(), 1, at));
}

TEST_CASE("unnamed file: where none can be made, the folder is named", "[tiles]") {
    const test_support::TemporaryFolder folder;
    const auto file = UnnamedFile::create(folder / "missing");
    REQUIRE_FALSE(file);
    CHECK(file.error().code == ErrorCode::cannot_open);
    CHECK(file.error().place == (folder / "missing").string());
}

TEST_CASE("free space: parts in use are apart, and what is given back is used again", "[tiles]") {
    std::mt19937 random(1);
    FreeSpace space;
    std::vector<Taken> taken;
    std::uint64_t most = 0, end = 0;
    for (unsigned round = 0; round < 5000; ++round) {
        if (taken.size() > 40 || (!taken.empty() && random() % 2 == 0)) {
            const std::size_t k = random() % taken.size();
            space.give_back(taken[k].at, taken[k].size);
            taken.erase(taken.begin() + static_cast<std::ptrdiff_t>(k));
        } else {
            const std::uint64_t size = 1 + random() % 1000;
            taken.push_back({space.take(size), size});
        }
        REQUIRE(are_apart(taken, end));
        most = std::max(most, end);
    }
    CHECK(most < 41 * 1000 * 2);
    for (const Taken& t : taken) space.give_back(t.at, t.size);
    space.give_back(7, 0);              // of what was never taken
    CHECK(space.take(UINT64_MAX) == 0); // all is free, in one part
}
