// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/plausibility/detail/examination.hpp>
#include <terrane/algorithms/plausibility/detail/thresholds.hpp>

namespace terrane::plausibility::detail {
namespace {

constexpr int float_bits = 24;

bool is_float(double x) {
    return static_cast<double>(static_cast<float>(x)) == x;
}

double mean_edge(const Surface& surface) {
    double sum = 0;
    for (const Triangle& t : surface.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const Point3 &a = surface.vertices[t[i]], &b = surface.vertices[t[(i + 1) % 3]];
            sum += std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
        }
    return sum / (3 * static_cast<double>(surface.triangles.size()));
}

/// Returns the spacing of floats at the largest coordinate if all coordinates are floats and some
/// use bits that the largest has lost: then they were not rounded on purpose, to metres for
/// example.
std::optional<double> spacing_of_floats(const Surface& surface, const Extent& extent) {
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i)
        largest = std::max({largest, std::abs(extent.low[i]), std::abs(extent.high[i])});
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double spacing = std::ldexp(1.0, exponent - float_bits);
    bool finer = false;
    for (const Triangle& t : surface.triangles)
        for (const auto v : t) {
            const Point3& p = surface.vertices[v];
            if (!is_float(p.x) || !is_float(p.y) || !is_float(p.z)) return std::nullopt;
            for (const double x : {p.x, p.y, p.z}) finer = finer || std::fmod(x, spacing) != 0;
        }
    return finer ? std::optional(spacing) : std::nullopt;
}

std::uint64_t mixed(std::uint64_t x) { // splitmix64
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
}

std::uint64_t hash_of(const Point3& p, std::uint64_t seed) {
    for (const double x : {p.x, p.y, p.z})
        seed = mixed(seed ^ std::bit_cast<std::uint64_t>(x + 0.0)); // -0 becomes 0
    return seed;
}

/// A fingerprint of a set of triangles, whatever their order, numbering and winding: 128 bits.
using Fingerprint = std::array<std::uint64_t, 3>;

Fingerprint fingerprint_of(const Surface& surface) {
    Fingerprint sums{surface.triangles.size(), 0, 0};
    for (const Triangle& t : surface.triangles) {
        std::uint64_t first = 0, second = 0;
        for (const auto v : t) {
            first += hash_of(surface.vertices[v], 1);
            second += hash_of(surface.vertices[v], 2);
        }
        sums[1] += mixed(first);
        sums[2] += mixed(second);
    }
    return sums;
}

} // namespace

void check_float32(Examination& e) {
    std::vector<std::uint32_t> coarse;
    double widest = 0;
    for (const auto s : e.used) {
        const auto spacing = spacing_of_floats(e.surfaces[s], e.extents[s]);
        if (!spacing || *spacing < thresholds.float32_spacing * mean_edge(e.surfaces[s])) continue;
        coarse.push_back(s);
        widest = std::max(widest, *spacing);
    }
    if (coarse.empty()) return;
    e.warn(
        Doubt::float32, coarse,
        fmt::format(
            "the coordinates of {} were stored with 24 bits (float32): at their size they are "
            "multiples of {}",
            e.names(coarse), figure(widest, 3)),
        "Points that should lie on a plane or on another surface are that far off it, which gives "
        "slivers and gaps",
        "Export doubles or text, or subtract a common origin before storing; --seal closes the "
        "gaps");
}

void check_values(Examination& e) {
    std::vector<std::uint32_t> about;
    std::vector<std::string> values;
    for (const auto s : e.used) {
        const auto& more = e.surfaces[s].values;
        if (!more.empty()) about.push_back(s);
        for (const std::string& value : more)
            if (std::ranges::find(values, value) == values.end()) values.push_back(value);
    }
    if (about.empty()) return;
    constexpr std::size_t most = 6;
    const std::size_t told = std::min(values.size(), most);
    const auto first = std::span(values).first(told);
    e.warn(
        Doubt::values_left_out, about,
        fmt::format("{} {} values that are not read: {}{}", e.names(about),
                    about.size() == 1 ? "has" : "have", fmt::join(first, ", "),
                    values.size() > told ? fmt::format(" and {} more", values.size() - told) : ""),
        "No output has them",
        "Keep the input: the array parent of .vtp tells from which of its triangles each "
        "triangle is");
}

void check_faces(Examination& e) {
    for (const auto s : e.used) {
        const auto& [crossing, bent, first] = e.surfaces[s].flawed_faces;
        if (crossing + bent == 0) continue;
        e.warn(Doubt::flawed_faces, {s},
               fmt::format(
                   "{} has faces with more than three corners that cross themselves ({}) or are "
                   "not flat ({}), the first one at {}",
                   e.labels[s], crossing, bent, place_text(first)),
               "Triangles of a face that crosses itself are a fan round its first corner, and "
               "overlap; "
               "those of a bent one are one of several surfaces with this border",
               "Let the program that wrote the file divide its faces into triangles");
    }
}

void check_duplicates(Examination& e) {
    std::map<Fingerprint, std::uint32_t> first;
    for (const auto s : e.used) {
        const auto [same, added] = first.try_emplace(fingerprint_of(e.surfaces[s]), s);
        if (added) continue;
        e.warn(Doubt::duplicate_surface, {same->second, s},
               fmt::format("{} has the same {} triangles as {}", e.labels[s],
                           e.surfaces[s].triangles.size(), e.labels[same->second]),
               "It bounds nothing of its own, and every block next to it has two names for one "
               "surface",
               "Leave one of the two files out");
    }
}

} // namespace terrane::plausibility::detail
