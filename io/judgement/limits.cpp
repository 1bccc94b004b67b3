// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/judgement/limits.hpp>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/judgement/detail/watch.hpp>

namespace terrane {

Result<MeshJudgement>
judge_within(const JudgementLimits& limits, const std::stop_token& stop,
             const std::function<Result<MeshJudgement>(const std::stop_token&)>& work) {
    return guarded("for the judgement", "judge", [&]() -> Result<MeshJudgement> {
        detail::JudgementWatch watch(limits, stop);
        auto judged = work(watch.token());
        if (const auto& reached = watch.end()) return *reached;
        return judged;
    });
}

} // namespace terrane
