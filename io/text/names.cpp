// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/names.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace terrane::detail {

namespace {

std::string plain(std::string_view name) {
    std::string result;
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        result += code <= ' ' || code == 127 || c == '#' || c == '\\' ? '_' : c;
    }
    return result;
}

std::string quotable(std::string_view name) {
    auto result = one_line(name);
    std::replace(result.begin(), result.end(), '"', '\'');
    return result;
}

/// Returns a label for Abaqus; every byte beyond ASCII becomes '_'.
std::string label(std::string_view name) {
    constexpr std::size_t most_characters = 60; // Abaqus has 80; leaves room for endings
    std::string result;
    for (const char c : name.substr(0, most_characters)) {
        const bool small = c >= 'a' && c <= 'z';
        const bool kept = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        result += small ? static_cast<char>(c - 'a' + 'A') : kept ? c : '_';
    }
    if (!result.empty() && (result[0] < 'A' || result[0] > 'Z')) result = "S" + result;
    return result.empty() ? "SURFACE" : result;
}

template <class Change>
std::vector<std::string> different_names(const std::vector<SurfaceInfo>& surfaces, Change change) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    std::map<std::string, unsigned> next_number;
    for (const auto& surface : surfaces) {
        auto base = change(surface.name);
        if (base.empty()) base = "surface";
        auto name = base;
        auto& number = next_number.try_emplace(base, 2).first->second;
        while (!taken.insert(name).second) name = base + '_' + std::to_string(number++);
        names.push_back(name);
    }
    return names;
}

} // namespace

std::vector<std::string> plain_names(const std::vector<SurfaceInfo>& surfaces) {
    return different_names(surfaces, plain);
}

std::vector<std::string> quotable_names(const std::vector<SurfaceInfo>& surfaces) {
    return different_names(surfaces, quotable);
}

std::vector<std::string> label_names(const std::vector<SurfaceInfo>& surfaces) {
    return different_names(surfaces, label);
}

std::string one_line(std::string_view name) {
    std::string result(name);
    std::replace_if(
        result.begin(), result.end(),
        [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }, ' ');
    return result;
}

} // namespace terrane::detail
