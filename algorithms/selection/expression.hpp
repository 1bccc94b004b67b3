// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Expressions over operands: "(a | b) - c & ~d".
//
// Operators as in Python, from the strongest: ~ (complement), - (difference), & (intersection),
// ^ (symmetric difference), | (union); operators of one strength apply from the left. Names are made of
// letters, digits, '_' and '.'; others stand in double quotes. inside(a) is the same as a.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// An expression in reverse Polish notation.
struct Expression {
    enum class Action : std::uint8_t { operand, complement, difference, intersect, exclude, unite };
    struct Step {
        Action action;
        std::uint32_t operand = 0; ///< its index in `operands`, of Action::operand
    };
    std::vector<Step> steps;
    std::vector<std::string> operands; ///< names, each once, by their first place in the text

    /// Returns the value of the expression at a point. is_inside(k): whether it is in operand k.
    [[nodiscard]] bool value(const std::function<bool(std::uint32_t)>& is_inside) const;
};

/// Reads an expression. Errors: bad_option with the column, counted from 1 in bytes.
Result<Expression> parse_expression(std::string_view text);

} // namespace terrane
