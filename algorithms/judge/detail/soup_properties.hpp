// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Properties of triangles alone.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/judge/detail/properties.hpp>

namespace terrane::judging {

/// Adds conforming and distinct.
void add_checked(const CheckReport& checked, std::span<const Surface> soup, std::size_t most_flaws,
                 std::vector<JudgedProperty>& properties);

/// Adds a flaw for each point that triangles of one surface use under several numbers.
void add_points_twice(std::span<const Surface> soup, Flaws& welded);

/// Returns all properties of judge_soup().
MeshJudgement soup_judgement(std::span<const Surface> soup, const CheckReport& checked,
                             std::size_t most_flaws, const Run& run);

} // namespace terrane::judging
