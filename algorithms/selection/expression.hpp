// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Expressions over operands: "(a | b) - c & ~d".
//
// Operators as in Python, from the strongest: ~ (complement), - (difference), & (intersection),
// ^ (symmetric difference), | (union); operators of one strength apply from the left. Names are made of
// letters, digits, '_' and '.'; others stand in double quotes. Functions: inside(a) is the same as a for a closed
// surface a; hull(a) is all that a keeps from infinity; below(s) and above(s), west(s) and east(s), south(s) and
// north(s) are the sides of a surface s. Of a model, block(b) is a block, by its name or number, and unit(u) all blocks
// of a unit; volume < 1e6, volume > 1e6, age < 66 and age > 66 are all blocks that are so.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// An expression in reverse Polish notation.
struct Expression {
    enum class Action : std::uint8_t { operand, complement, difference, intersect, exclude, unite };
    struct Step {
        Action action;
        std::uint32_t operand = 0; ///< its index in `operands`, of Action::operand
    };
    enum class Kind : std::uint8_t {
        bare,     ///< the point is inside of the surfaces; they are named without a function
        inside,   ///< the point is inside of the surfaces
        enclosed, ///< each way from the point to infinity meets the surfaces
        low_side, ///< the point is on their lower side along an axis
        block,    ///< the point is in the block with this name or number
        unit,     ///< the point is in a block of this unit
        volume,   ///< the point is in a block with such a volume
        age,      ///< the point is in a block of a unit whose base has such an age
    };
    /// A statement about a point.
    struct Operand {
        std::string name; ///< of surfaces, of a block or of a unit
        Kind kind = Kind::bare;
        Axis axis = Axis::z;  ///< of low_side
        bool is_less = false; ///< of volume and age: less than the number, otherwise greater
        double number = 0;    ///< of volume and age

        friend bool operator==(const Operand&, const Operand&) = default;
    };
    std::vector<Step> steps;
    std::vector<Operand>
        operands; ///< each once, by their first place in the text; bare or inside, not both

    /// Whether an operand is a set of blocks.
    [[nodiscard]] bool is_of_blocks(std::uint32_t operand) const {
        return operands[operand].kind >= Kind::block;
    }
    /// Returns the value of the expression at a point. is_inside(k): whether operand k holds.
    [[nodiscard]] bool value(const std::function<bool(std::uint32_t)>& is_inside) const;
};

/// Reads an expression. Errors: bad_option with the column, counted from 1 in bytes.
Result<Expression> parse_expression(std::string_view text);

} // namespace terrane
