// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstring>

#include <terrane/fuzzing/meshes.hpp>

namespace fuzzing_test {

/// FNV-1a of all that meshes consist of, to the last bit.
class Hash {
public:
    void add(const terrane::fuzzing::Soup& soup) {
        put(soup.size());
        for (const auto& part : soup) {
            put(part.points.size());
            for (const auto& p : part.points)
                for (const double x : {p.x, p.y, p.z}) {
                    std::uint64_t bits = 0;
                    std::memcpy(&bits, &x, sizeof bits);
                    put(bits);
                }
            put(part.triangles.size());
            for (const auto& t : part.triangles)
                for (const auto v : t) put(v);
        }
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    void put(std::uint64_t number) {
        for (unsigned i = 0; i < 8; ++i)
            value_ = (value_ ^ (number >> (8 * i) & 255)) * 1099511628211U;
    }
    std::uint64_t value_ = 14695981039346656037U;
};

/// Calls visit(bytes) for 400 strings of random bytes, up to 96 each.
template <class Visit>
void for_each_string(const Visit& visit) {
    std::uint32_t state = 1;
    for (unsigned i = 0; i < 400; ++i) {
        std::vector<std::uint8_t> bytes;
        for (unsigned k = 0; k < i % 97; ++k) {
            state = state * 1664525U + 1013904223U;
            bytes.push_back(static_cast<std::uint8_t>(state >> 24));
        }
        visit(bytes);
    }
}

} // namespace fuzzing_test
