// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/violations.hpp>

#include <algorithm>
#include <tuple>

namespace terrane::verifier {

std::string text(std::uint64_t number) {
    return std::to_string(number);
}

std::string text(Edge pair) {
    return text(pair[0]) + " and " + text(pair[1]);
}

void sort_by_rule(Violations& violations) {
    std::sort(violations.begin(), violations.end(), [](const Violation& a, const Violation& b) {
        return std::tie(a.rule, a.elements, a.sentence) < std::tie(b.rule, b.elements, b.sentence);
    });
}

} // namespace terrane::verifier
