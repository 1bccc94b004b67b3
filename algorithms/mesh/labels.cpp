// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/labels.hpp>

#include <algorithm>
#include <unordered_map>

#include <terrane/algorithms/core/spelling.hpp>

namespace terrane {
namespace {

std::string label(std::string_view name) {
    auto result = one_line(name);
    std::replace(result.begin(), result.end(), '"', '\'');
    return result;
}

} // namespace

std::vector<SurfaceInfo> infos_of(std::span<const Surface> surfaces) {
    std::vector<SurfaceInfo> infos;
    for (const Surface& s : surfaces) infos.push_back({s.name, s.role});
    return infos;
}

std::vector<std::string> unique_names(std::span<const SurfaceInfo> surfaces,
                                      const std::function<std::string(std::string_view)>& change) {
    std::vector<std::string> names;
    std::unordered_map<std::string, unsigned> next_number; // of each name that is taken
    for (const auto& surface : surfaces) {
        auto base = change(surface.name);
        if (base.empty()) base = "surface";
        auto name = base;
        while (!next_number.try_emplace(name, 2).second)
            name = base + '_' + std::to_string(next_number[base]++);
        names.push_back(std::move(name));
    }
    return names;
}

std::vector<std::string> unique_labels(std::span<const SurfaceInfo> surfaces) {
    return unique_names(surfaces, label);
}

std::string one_line(std::string_view name) {
    std::string result(name);
    std::replace_if(
        result.begin(), result.end(),
        [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }, ' ');
    return result;
}

std::vector<std::uint32_t> surfaces_called(std::string_view name,
                                           std::span<const SurfaceInfo> surfaces,
                                           std::span<const std::string> labels) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t s = 0; s < surfaces.size(); ++s)
        if (surfaces[s].name == name || (s < labels.size() && labels[s] == name))
            found.push_back(s);
    return found;
}

std::string not_called(std::string_view kind, std::string_view name,
                       std::span<const std::string> labels) {
    constexpr std::size_t most = 10;
    std::string text = "no " + std::string(kind) + " is called " + std::string(name);
    if (const auto near = nearest_name(name, labels)) return text + "; did you mean " + *near + "?";
    if (labels.empty()) return text;
    const std::size_t listed = std::min(labels.size(), most);
    text += labels.size() == 1 ? "; there is " : "; there are ";
    for (std::size_t i = 0; i < listed; ++i) text += (i == 0 ? "" : ", ") + labels[i];
    if (listed < labels.size()) text += " and " + std::to_string(labels.size() - listed) + " more";
    return text;
}

} // namespace terrane
