// SPDX-License-Identifier: MIT
#include <terrane/fuzzing/meshes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace terrane::fuzzing {

namespace {

constexpr std::array<std::uint8_t, 4> magic{'m', 'e', 's', 'h'};
constexpr std::size_t most_parts = 255, most_items = 65535; ///< that 1 and 2 bytes count

void put(std::vector<std::uint8_t>& bytes, std::uint64_t number, int count) {
    while (count > 0) bytes.push_back(static_cast<std::uint8_t>(number >> 8 * --count));
}

unsigned two_bytes(Bytes& bytes) {
    const unsigned high = bytes.byte();
    return high << 8 | bytes.byte();
}

double finite_double(Bytes& bytes) {
    const double x = bytes.any_double();
    return std::isfinite(x) ? x : 0;
}

Part part_of(Bytes& bytes) {
    Part part;
    for (unsigned left = two_bytes(bytes); left > 0 && !bytes.empty(); --left) {
        const double x = finite_double(bytes), y = finite_double(bytes);
        part.points.push_back({x, y, finite_double(bytes)});
    }
    const auto count = static_cast<unsigned>(part.points.size());
    for (unsigned left = two_bytes(bytes); left > 0 && count > 0 && !bytes.empty(); --left) {
        const unsigned a = two_bytes(bytes), b = two_bytes(bytes), c = two_bytes(bytes);
        part.triangles.push_back({a % count, b % count, c % count});
    }
    return part;
}

} // namespace

std::size_t triangle_count(const Soup& soup) {
    std::size_t count = 0;
    for (const Part& part : soup) count += part.triangles.size();
    return count;
}

std::string obj_text(const Soup& soup) {
    std::string text;
    std::size_t first = 1;
    for (std::size_t p = 0; p < soup.size(); ++p) {
        for (const Point& at : soup[p].points) {
            char line[100];
            std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", at.x, at.y, at.z);
            text += line;
        }
        text += "g " + (p < 26 ? std::string(1, char('a' + p)) : "p" + std::to_string(p)) + "\n";
        for (const Triangle& t : soup[p].triangles) {
            text += "f";
            for (const auto v : t) text += " " + std::to_string(first + v);
            text += "\n";
        }
        first += soup[p].points.size();
    }
    return text;
}

bool is_literal(const std::uint8_t* data, std::size_t size) {
    return size >= magic.size() && std::equal(magic.begin(), magic.end(), data);
}

Soup mesh_of(const std::uint8_t* data, std::size_t size, const Generator& generator) {
    Bytes bytes(data, size);
    if (!is_literal(data, size)) return generator(bytes);
    for (std::size_t i = 0; i < magic.size(); ++i) bytes.byte();
    Soup soup(bytes.byte());
    for (Part& part : soup) part = part_of(bytes);
    return soup;
}

std::vector<std::uint8_t> literal(const Soup& soup) {
    std::vector<std::uint8_t> bytes(magic.begin(), magic.end());
    const std::size_t parts = std::min(soup.size(), most_parts);
    put(bytes, parts, 1);
    for (std::size_t p = 0; p < parts; ++p) {
        const std::size_t points = std::min(soup[p].points.size(), most_items);
        put(bytes, points, 2);
        for (std::size_t i = 0; i < points; ++i)
            for (const double x : {soup[p].points[i].x, soup[p].points[i].y, soup[p].points[i].z}) {
                std::uint64_t bits = 0;
                std::memcpy(&bits, &x, sizeof bits);
                put(bytes, bits, 8);
            }
        std::vector<Triangle> triangles;
        for (const Triangle& t : soup[p].triangles)
            if (triangles.size() < most_items && *std::max_element(t.begin(), t.end()) < points)
                triangles.push_back(t);
        put(bytes, triangles.size(), 2);
        for (const Triangle& t : triangles)
            for (const std::uint32_t v : t) put(bytes, v, 2);
    }
    return bytes;
}

} // namespace terrane::fuzzing
