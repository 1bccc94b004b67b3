// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include <terrane/algorithms/selection/expression.hpp>
#include <terrane/algorithms/selection/selection.hpp>

namespace terrane {

/// Selects by an expression that was read. Errors: those of select().
Result<Selected> select_parsed(std::span<const Surface> surfaces, Expression expression,
                               const SelectOptions& options, const Run& run);

} // namespace terrane
