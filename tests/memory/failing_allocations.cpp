// SPDX-License-Identifier: LGPL-3.0-or-later
//
// failing_allocations [MOST] [NAME]: calls each stage of the library, or those whose name begins
// with NAME, once for each allocation that it makes, and lets that one fail; then the same with all
// later ones failing, too. Each call must return out_of_memory (a function that returns no Result
// must throw std::bad_alloc), give back all memory, and leave the next call as it was before.
// Of more than MOST allocations of a stage (default: 10 000), MOST are tried, evenly spread.
//
// failing_allocations stack KIB: see call_unusually. failing_allocations list: prints the names of all stages.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "fixture.hpp"
#include "stage.hpp"

namespace failing {
namespace {

/// The facts about a stage from calls in which nothing failed.
struct Usual {
    std::string text;
    long allocations = 0;
};

class Trial {
public:
    Trial(const Stage& stage, long most) : stage_(stage), most_(most) {}

    /// Returns the number of flaws that were found.
    int operator()() {
        call_without_failure(); // warms up what is kept for later calls: caches and pools
        usual_ = call_without_failure();
        living_ = living();
        call_without_failure();
        if (living() != living_) return report(-1, Mode::once, "it leaks without any failure"), 1;
        for (const Mode mode : {Mode::once, Mode::from}) {
            for (long n = 0; n < usual_.allocations && flaws_ < most_flaws;) {
                fail_at(n, mode);
                // The first ones are tried all: there a stage sets up what it needs.
                const long step = std::max(1L, usual_.allocations / most_);
                n += n < 20 ? 1 : step;
            }
        }
        std::printf("%-40s %7ld allocations, %6ld failed, %d flaws\n", stage_.name.c_str(),
                    usual_.allocations, calls_, flaws_);
        return flaws_;
    }

private:
    static constexpr int most_flaws = 10; ///< of one stage

    Usual call_without_failure() {
        const Answer answer = stage_.call(-1, Mode::once);
        if (answer.error) report(-1, Mode::once, "it fails: " + answer.error->message());
        if (answer.threw) report(-1, Mode::once, "it throws");
        return {answer.text, answer.allocations};
    }

    void fail_at(long n, Mode mode) {
        ++calls_;
        judge(n, mode, stage_.call(n, mode));
        if (living() != living_) {
            report(n, mode, "it leaks " + std::to_string(living() - living_) + " blocks");
            living_ = living();
        }
        constexpr long seldom = 16; // another call for each failure would double the time
        if (stage_.starts_process || calls_ % seldom != 0) return;
        if (call_without_failure().text != usual_.text) report(n, mode, "the next call differs");
    }

    void judge(long n, Mode mode, const Answer& answer) {
        if (answer.threw && stage_.returns_errors) return report(n, mode, "it throws");
        if (answer.threw) return;
        if (answer.error) {
            if (answer.error->code != terrane::ErrorCode::out_of_memory)
                report(n, mode,
                       "it returns another error (" +
                           std::to_string(static_cast<int>(answer.error->code)) +
                           "): " + answer.error->message());
            return;
        }
        // Threads differ from call to call in what they allocate, and some functions do without:
        // the result is then the usual one.
        if (answer.text != usual_.text) report(n, mode, "it succeeds with another result");
    }

    void report(long n, Mode mode, const std::string& what) {
        ++flaws_;
        std::printf("%s, allocation %ld%s: %s\n", stage_.name.c_str(), n,
                    mode == Mode::from ? " and all later ones" : "", what.c_str());
        std::fflush(stdout);
    }

    const Stage& stage_;
    long most_;
    Usual usual_;
    long living_ = 0;
    long calls_ = 0;
    int flaws_ = 0;
};

} // namespace

std::vector<Stage> all_stages() {
    std::vector<Stage> stages;
    for (const auto& part : {stages_of_meshes(), stages_of_models(), stages_of_surfaces(),
                             stages_of_files(), stages_of_outputs(), stages_of_scale()})
        stages.insert(stages.end(), part.begin(), part.end());
    return stages;
}

} // namespace failing

int main(int argc, char** argv) {
    using namespace failing;
    const long most = argc > 1 ? std::atol(argv[1]) : 10'000;
    const std::string_view wanted = argc > 2 ? argv[2] : "";
    if (argc == 3 && std::string_view(argv[1]) == "stack") {
        int flaws = 0;
        for (const auto& part : {all_stages(), large_stages()})
            flaws += call_unusually(part, std::atol(argv[2]));
        return flaws == 0 ? 0 : 1;
    }
    if (argc == 2 && std::string_view(argv[1]) == "list") {
        for (const Stage& stage : all_stages()) std::printf("%s\n", stage.name.c_str());
        return 0;
    }
    take_over_gmp();
    int flaws = 0, stages = 0;
    for (const Stage& stage : all_stages()) {
        if (!stage.name.starts_with(wanted)) continue;
        ++stages;
        flaws += Trial(stage, stage.starts_process ? std::max(1L, most / 10) : most)();
        std::fflush(stdout);
    }
    std::printf("%d stages, %d flaws\n", stages, flaws);
    return flaws == 0 && stages > 0 ? 0 : 1;
}
