// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/pair_report.hpp>

#include <map>

#include <fmt/format.h>

#include <terrane/cli/options/choices.hpp>

namespace terrane::cli {

void add_check(CLI::App& command, PairCheckOptions& check) {
    static const std::map<std::string, PairCheck> methods = [] {
        std::map<std::string, PairCheck> all;
        for (const auto m : {PairCheck::bounds, PairCheck::full}) all.emplace(name_of(m), m);
        return all;
    }();
    add_value(command, "--check", check.method, "bounds|full",
              "Which pairs of triangles of the mesh exact predicates test: bounds (those that "
              "no proven bound clears) or full (all whose boxes overlap); the verdict is the "
              "same (default: bounds)")
        ->transform(CLI::Transformer(methods, CLI::ignore_case).description(""))
        ->transform(listing({"bounds", "full"}))
        ->each([&check](const std::string&) {
            check.count_up_to = SIZE_MAX;
            check.most_per_triangle = UINT64_MAX;
        });
}

std::string text_of(const std::optional<PairCounts>& pairs) {
    if (!pairs) return {};
    return fmt::format("pairs of triangles: {} tested by exact predicates; {} cleared by proven "
                       "bounds ({} in injective patches, {} by separation); {} not moved; {} with "
                       "boxes apart\n",
                       pairs->tested, pairs->in_patches + pairs->separated, pairs->in_patches,
                       pairs->separated, pairs->unmoved, pairs->apart);
}

} // namespace terrane::cli
