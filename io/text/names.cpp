// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/names.hpp>

#include <terrane/algorithms/mesh/labels.hpp>

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

} // namespace

std::vector<std::string> plain_names(const std::vector<SurfaceInfo>& surfaces) {
    return unique_names(surfaces, plain);
}

std::vector<std::string> quotable_names(const std::vector<SurfaceInfo>& surfaces) {
    return unique_labels(surfaces);
}

std::vector<std::string> label_names(const std::vector<SurfaceInfo>& surfaces) {
    return unique_names(surfaces, label);
}

std::string one_line(std::string_view name) {
    return terrane::one_line(name);
}

} // namespace terrane::detail
