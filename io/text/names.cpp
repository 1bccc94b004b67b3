// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/names.hpp>

#include <algorithm>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/utf8.hpp>
#include <terrane/io/text/values.hpp>

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

/// Returns what a word keeps of a name; it may be empty.
std::string word(std::string_view name) {
    constexpr std::size_t most_bytes = 200; // names of files have 255; leaves room for endings
    const bool has_letters_beyond_ascii = is_utf8(name);
    std::string result;
    bool gap = false;
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        const bool kept = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                          (c >= '0' && c <= '9') || (c == '-' && !result.empty()) ||
                          (code >= 128 && has_letters_beyond_ascii);
        if (kept && gap && !result.empty()) result += '_';
        if (kept) result += c;
        gap = !kept;
    }
    if (result.size() <= most_bytes) return result;
    std::size_t end = most_bytes; // not within a character of several bytes
    while (end > 0 && (static_cast<unsigned char>(result[end]) & 0xC0) == 0x80) --end;
    return result.substr(0, end);
}

} // namespace

std::string WordNames::add(std::string_view name, std::string_view kind) {
    auto start = word(name);
    if (start.empty()) start = kind;
    if (start[0] >= '0' && start[0] <= '9') start = std::string(kind) + "_" + start;
    auto made = start;
    for (std::size_t n = 2; !taken_.insert(lower(made)).second; ++n)
        made = start + "_" + std::to_string(n);
    return made;
}

std::vector<std::string> plain_names(const std::vector<SurfaceInfo>& surfaces) {
    return unique_names(surfaces, plain);
}

std::vector<std::string> quotable_names(const std::vector<SurfaceInfo>& surfaces) {
    return unique_labels(surfaces);
}

std::vector<std::string> label_names(const std::vector<SurfaceInfo>& surfaces) {
    return unique_names(surfaces, label);
}

void note_values(std::string_view name, std::vector<std::string>& names) {
    constexpr std::size_t most = 64;
    const std::string noted = one_line(trimmed(name));
    if (noted.empty() || names.size() == most) return;
    const auto is_it = [&](std::string_view other) { return same_ignoring_case(noted, other); };
    if (is_reserved(noted) || std::ranges::any_of(names, is_it)) return;
    names.push_back(noted);
}

std::string one_line(std::string_view name) {
    return terrane::one_line(name);
}

} // namespace terrane::detail
