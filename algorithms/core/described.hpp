// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names the members of a report, once: describe(visit, report) calls visit("name", value, "name", value, ...), in the
// order in which statistics have them.
#pragma once

#include <string_view>

namespace terrane {

/// Takes all that a description says, and ignores it.
struct IgnoredDescription {
    void operator()(const auto&...) const {}
};

/// A report whose describe() argument-dependent lookup finds.
template <class Report>
concept Described = requires(const Report& report) {
    describe(IgnoredDescription(), report);
};

/// Calls visit(name, value) for each member that the description of a report names.
template <Described Report>
void each_member(const Report& report, const auto& visit) {
    const auto pairs = [&](const auto& self, std::string_view name, const auto& value,
                           const auto&... rest) {
        visit(name, value);
        if constexpr (sizeof...(rest) > 0) self(self, rest...);
    };
    describe([&](const auto&... all) { pairs(pairs, all...); }, report);
}

} // namespace terrane
