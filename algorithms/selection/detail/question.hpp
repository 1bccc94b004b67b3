// SPDX-License-Identifier: LGPL-3.0-or-later
//
// An expression whose operands are surfaces, and its answers in an arrangement of them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/selection/expression.hpp>
#include <terrane/algorithms/selection/selection.hpp>

namespace terrane::selection {

/// What is asked for.
struct Question {
    Expression expression;
    std::vector<std::vector<std::uint32_t>> surfaces_of; ///< per operand: the surfaces of its name
    std::vector<std::uint32_t>
        solid_of; ///< per surface: the operand of points inside of it, or no_index
    std::vector<std::uint32_t> hulls; ///< operands of points that surfaces enclose, ascending
    std::vector<std::uint32_t> sided; ///< operands that are sides of surfaces, ascending
    InsideRule rule = InsideRule::nonzero;

    /// Whether an operand is a side of a surface.
    [[nodiscard]] bool is_side(std::uint32_t operand) const {
        return expression.operands[operand].kind == Expression::Kind::low_side;
    }
    /// Whether the expression names a surface.
    [[nodiscard]] bool names(std::size_t surface) const;
    /// Returns the operand that may be an open surface: the only one without a function, if others have one;
    /// else no_index.
    [[nodiscard]] std::uint32_t may_be_open() const;
    /// Whether a point with this winding number is inside.
    [[nodiscard]] bool is_inside(int winding) const;
};

/// Finds the surfaces that an expression names. Errors: bad_option.
Result<Question> question_of(std::span<const Surface> surfaces, Expression expression,
                             InsideRule rule);

/// The answers of a question for cells, which are told apart by the operands that hold there.
class Answers {
public:
    /// holds(cell, operand): whether an operand that is no side holds.
    template <class Holds>
    Answers(const Question& question, std::size_t cells, const Holds& holds) : question_(question) {
        std::vector<bool> key(question.expression.operands.size());
        for (std::uint32_t c = 0; c < cells; ++c) {
            for (std::uint32_t k = 0; k < key.size(); ++k)
                key[k] = !question.is_side(k) && holds(c, k);
            add(key);
        }
    }

    /// Whether the answer of a cell depends on one of the sides, whatever the others are.
    [[nodiscard]] bool depends(std::size_t cell, std::size_t side) const {
        return (kinds_[kind_of_[cell]].depends >> side & 1U) != 0;
    }
    /// Whether the answer of a cell is "yes" for some sides.
    [[nodiscard]] bool may_be(std::size_t cell) const { return kinds_[kind_of_[cell]].may_be; }
    /// The answer of a cell. low: per side, as bits, whether the cell is on the lower one.
    [[nodiscard]] bool answer(std::size_t cell, unsigned low) const;

private:
    struct Kind {
        std::vector<bool> key; ///< per operand
        unsigned depends = 0;
        bool may_be = false;
    };
    void add(const std::vector<bool>& key);
    [[nodiscard]] bool value(const std::vector<bool>& key, unsigned low) const;

    const Question& question_;
    std::vector<Kind> kinds_;
    std::map<std::vector<bool>, std::uint32_t> numbers_; ///< of kinds, by their keys
    std::vector<std::uint32_t> kind_of_;                 ///< per cell
};

} // namespace terrane::selection
