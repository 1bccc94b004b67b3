// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/seal_rules.hpp>

#include <cstdint>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/labels.hpp>

namespace terrane {

Result<std::vector<SealRule>> seal_rules_for(std::string_view text, double distance,
                                             std::span<const SurfaceInfo> surfaces,
                                             std::span<const std::string> labels) {
    return guarded("for the distances", "seal", [&]() -> Result<std::vector<SealRule>> {
        std::vector<SealRule> rules;
        for (const std::uint32_t s : surfaces_called(text, surfaces, labels))
            rules.push_back({SurfaceId(s), std::nullopt, distance});
        if (!rules.empty()) return rules;
        std::string_view unknown = text; // of a pair: the half that is no name
        for (auto at = text.find('/'); at != std::string_view::npos; at = text.find('/', at + 1)) {
            const auto left = text.substr(0, at), right = text.substr(at + 1);
            const auto from = surfaces_called(left, surfaces, labels),
                       to = surfaces_called(right, surfaces, labels);
            for (const std::uint32_t s : from)
                for (const std::uint32_t t : to)
                    rules.push_back({SurfaceId(s), SurfaceId(t), distance});
            if (!rules.empty()) return rules;
            if (!from.empty())
                unknown = right;
            else if (unknown == text)
                unknown = left;
        }
        return Error{ErrorCode::bad_option, not_called("surface", unknown, labels), "seal"};
    });
}

} // namespace terrane
