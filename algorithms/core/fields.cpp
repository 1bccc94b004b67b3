// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/core/fields.hpp>

#include <cmath>

#include <fmt/format.h>

namespace terrane {
namespace {

/// Writes a number as people do: 0.3, 1000, 2e7.
std::string brief(double value) {
    std::string text = fmt::format("{:g}", value);
    if (const auto sign = text.find("e+0"); sign != std::string::npos) text.erase(sign + 1, 2);
    return text;
}

bool has_most(const Field& field) {
    return field.bounds.most < std::numeric_limits<double>::max();
}

} // namespace

std::optional<std::string> flaw_of(const Field& field, double value, bool may_be_0) {
    const auto& [least, most, may_be_least] = field.bounds;
    if (may_be_0 && value == 0 && !field.otherwise.empty()) return std::nullopt;
    if (!(may_be_least ? value >= least : value > least))
        return fmt::format("must be {} {}", may_be_least ? "at least" : "larger than", least);
    if (value <= most) return std::nullopt;
    return has_most(field) ? "must be at most " + brief(most) : "must be finite";
}

std::string text_of(const Field& field) {
    const auto& [least, most, may_be_least] = field.bounds;
    const std::string text(field.sentence);
    if (field.placeholder == "DEGREES") return text;
    if (!has_most(field)) return least > 0 ? text + ", at least " + brief(least) : text;
    if (least > 0) return text + ", " + brief(least) + " to " + brief(most);
    return text + ", at most " + brief(most);
}

std::string default_of(const Field& field, double value) {
    const bool is_default = value == 0 || std::isinf(value);
    return is_default && !field.otherwise.empty() ? std::string(field.otherwise) : brief(value);
}

} // namespace terrane
