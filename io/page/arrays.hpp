// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The numbers of a page as bytes that compress well, and compression itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <terrane/io/page/json.hpp>

namespace terrane::page {

/// Collects arrays of unsigned numbers. Each value is stored as its difference from the one
/// `stride` before, with the sign in the lowest bit; then all lowest bytes follow each other, then
/// all second ones, and so on. The page reads it back (io/page/web/src/data.ts).
class Arrays {
public:
    /// Adds an array. Returns where it is: {"at": first byte, "count": values, "stride": stride}.
    Json add(std::span<const std::uint32_t> values, std::size_t stride = 1);

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// Compresses bytes as a gzip file without name and time: the same bytes for the same input.
std::string gzipped(std::string_view bytes);

/// Writes bytes in base64, without line breaks.
std::string base64_of(std::string_view bytes);

} // namespace terrane::page
