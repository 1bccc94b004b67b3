// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/cli/session/stage_seconds.hpp>

using terrane::cli::StageSeconds;

namespace {

using Seconds = std::vector<std::pair<std::string, double>>;

/// Ends stages at stated seconds.
class Run {
public:
    void end(const std::string& path, double from, double to) {
        const auto at = std::chrono::duration_cast<StageSeconds::Clock::duration>(
            std::chrono::duration<double>(to));
        stages_.end(path, to - from, StageSeconds::Clock::time_point(at));
    }
    void expect(const Seconds& expected) const {
        const auto all = stages_.all();
        REQUIRE(all.size() == expected.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            CHECK(all[i].first == expected[i].first);
            CHECK(all[i].second == Approx(expected[i].second));
        }
    }

private:
    StageSeconds stages_;
};

} // namespace

TEST_CASE("stage seconds: each second counts once, for the innermost stage", "[cli]") {
    Run run;
    run.end("read", 0, 1);
    run.end("seal/arrange/prepare", 2, 3);
    run.end("seal/arrange/assemble", 3, 5);
    run.end("seal/arrange", 2, 6);
    run.end("seal/arrange/prepare", 6, 8);
    run.end("seal", 2, 10);
    run.end("write", 11, 12);
    run.expect({{"read", 1},
                {"prepare", 3},
                {"stitch", 2},
                {"arrange", 1},
                {"seal", 2},
                {"write", 1}}); // and two seconds that no stage has
}

TEST_CASE("stage seconds: steps without a key of their own count for their stage", "[cli]") {
    Run run;
    run.end("volumes/shells", 0, 1);
    run.end("volumes/nesting", 1, 2);
    run.end("volumes", 0, 4);
    run.end("check float32", 4, 5);
    run.expect({{"volumes", 4}, {"check_float32", 1}});
}

TEST_CASE("stage seconds: a begin that is off by the rounding of clocks", "[cli]") {
    Run run;
    run.end("page", 1, 2);
    run.end("page", 1 + 1e-6, 3);  // it seems to have begun after the one within it
    run.end("write", 3 - 1e-6, 4); // it seems to have begun before the end of the one before
    run.expect({{"page", 2}, {"write", 1}});
}
