// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/selection/detail/question.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>

namespace terrane::selection {
namespace {

/// All ways in which a point can be on the sides of surfaces are tried: 2 to the power of their number.
constexpr std::size_t most_sides = 10;

Error of_expression(std::string sentence) {
    return {ErrorCode::bad_option, std::move(sentence), "expression"};
}

} // namespace

bool Question::names(std::size_t surface) const {
    return std::ranges::any_of(
        surfaces_of, [&](const auto& own) { return std::ranges::count(own, surface) > 0; });
}

std::uint32_t Question::may_be_open() const {
    std::uint32_t found = no_index;
    const auto& operands = expression.operands;
    for (std::uint32_t k = 0; k < operands.size(); ++k) {
        if (operands[k].kind != Expression::Kind::bare) continue;
        if (found != no_index) return no_index;
        found = k;
    }
    return operands.size() > 1 ? found : no_index;
}

bool Question::is_inside(int winding) const {
    switch (rule) {
    case InsideRule::positive:
        return winding > 0;
    case InsideRule::odd:
        return winding % 2 != 0;
    default:
        return winding != 0;
    }
}

Result<Question> question_of(std::span<const Surface> surfaces, Expression expression,
                             InsideRule rule) {
    const auto infos = infos_of(surfaces);
    const auto labels = unique_labels(infos);
    Question question{std::move(expression),
                      {},
                      std::vector<std::uint32_t>(surfaces.size(), no_index),
                      {},
                      {},
                      rule};
    const auto& operands = question.expression.operands;
    for (std::uint32_t k = 0; k < operands.size(); ++k) {
        const auto& name = operands[k].name;
        if (question.expression.is_of_blocks(k))
            return of_expression("block(), unit(), volume and age are those of a model, and there "
                                 "are surfaces alone");
        question.surfaces_of.push_back(surfaces_called(name, infos, labels));
        if (question.surfaces_of[k].empty())
            return of_expression(not_called("surface", name, labels));
        if (question.is_side(k)) {
            question.sided.push_back(k);
            continue;
        }
        if (operands[k].kind == Expression::Kind::enclosed) {
            question.hulls.push_back(k);
            continue;
        }
        for (const std::uint32_t s : question.surfaces_of[k]) {
            auto& own = question.solid_of[s];
            if (own != no_index)
                return of_expression("names one surface in two ways, \"" + operands[own].name +
                                     "\" and \"" + name + "\"");
            own = k;
        }
    }
    if (question.sided.size() > most_sides)
        return of_expression("names the sides of more than " + std::to_string(most_sides) +
                             " surfaces");
    if (Answers(question, 1, [](std::uint32_t, std::uint32_t) { return false; }).may_be(0))
        return of_expression("the region has no end: all that is outside of the surfaces is in it");
    return question;
}

void Answers::add(const std::vector<bool>& key) {
    const auto [known, is_new] =
        numbers_.try_emplace(key, static_cast<std::uint32_t>(kinds_.size()));
    kind_of_.push_back(known->second);
    if (!is_new) return;
    Kind kind{key};
    const std::size_t sides = question_.sided.size();
    for (unsigned low = 0; low < 1U << sides; ++low) {
        const bool is_in = value(key, low);
        kind.may_be = kind.may_be || is_in;
        for (std::size_t j = 0; j < sides; ++j)
            if (is_in != value(key, low ^ 1U << j)) kind.depends |= 1U << j;
    }
    kinds_.push_back(std::move(kind));
}

bool Answers::value(const std::vector<bool>& key, unsigned low) const {
    return question_.expression.value([&](std::uint32_t k) {
        if (!question_.is_side(k)) return bool(key[k]);
        const auto j = std::ranges::lower_bound(question_.sided, k) - question_.sided.begin();
        return (low >> static_cast<unsigned>(j) & 1U) != 0;
    });
}

bool Answers::answer(std::size_t cell, unsigned low) const {
    return value(kinds_[kind_of_[cell]].key, low);
}

} // namespace terrane::selection
