// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Judges a mesh within limits of time and memory.
#pragma once

#include <functional>
#include <stop_token>

#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/io/judgement/judgement.hpp>

namespace terrane {

/// Returns work(stop), which should end soon after a stop was requested. Errors: those of work;
/// timed_out and out_of_memory at the limits.
Result<MeshJudgement>
judge_within(const JudgementLimits& limits, const std::stop_token& stop,
             const std::function<Result<MeshJudgement>(const std::stop_token&)>& work);

} // namespace terrane
