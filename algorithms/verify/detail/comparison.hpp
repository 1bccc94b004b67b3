// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares a file with the bytes that it must have while a writer makes them. Nothing of the file is
// interpreted, so that it can hold nothing else.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

#include <terrane/kernel/point.hpp>

namespace terrane::verifier {

static_assert(std::endian::native == std::endian::little, "numbers are compared as they lie");

/// Where a file differs from what it must be. A Comparison throws it.
struct Difference {
    std::string place; ///< "line 12, byte 4711"; without the line where the file is not text
    std::string sentence;
};

/// Takes what a writer makes, piece by piece. All functions throw a Difference where the file has
/// other bytes.
class Comparison {
public:
    explicit Comparison(std::string_view file) : file_(file) {}

    Comparison& operator<<(std::string_view text);
    /// Takes numbers as decimals: doubles and floats as the shortest that read back as the same.
    template <class Number>
    requires std::unsigned_integral<Number> || std::floating_point<Number> Comparison&
    operator<<(Number number);
    /// Takes three numbers, with blanks in between.
    Comparison& operator<<(const Point3& p) { return *this << p.x << " " << p.y << " " << p.z; }

    /// Takes the bytes of a number, the lowest first.
    template <class Number>
    void binary(Number number) {
        const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
        *this << std::string_view(bytes.data(), bytes.size());
    }
    /// The file must end here.
    void end() const;

    /// Returns the rest of the file, which is not compared yet.
    [[nodiscard]] std::string_view rest() const { return file_.substr(at_); }
    /// Throws a Difference at the next byte.
    [[noreturn]] void fail(std::string sentence) const;

private:
    std::string_view file_;
    std::size_t at_ = 0; ///< the bytes before it are right
};

} // namespace terrane::verifier
