// SPDX-License-Identifier: LGPL-3.0-or-later
//
// NetCDF's classic format with offsets of 64 bits (CDF-2), which all versions of its library read since
// 2004. Reference: "NetCDF Classic Format Specification".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::detail {

/// Collects the parts of a file. Numbers are stored with the highest byte first.
class NetcdfFile {
public:
    enum class Type : std::uint32_t { text = 2, integer = 4, single = 5, number = 6 };

    /// Adds a dimension and returns its number. The length 0 is that of records, of which there are
    /// none; only one dimension can have it.
    std::size_t dimension(std::string_view name, std::size_t length);

    void attribute(std::string_view name, std::string_view text);
    void attribute(std::string_view name, std::int32_t value);
    void attribute(std::string_view name, float value);

    /// Adds a variable; `data` has as many values as its dimensions say, the last one fastest.
    void integers(std::string_view name, const std::vector<std::size_t>& dimensions,
                  std::span<const std::int32_t> data);
    void numbers(std::string_view name, const std::vector<std::size_t>& dimensions,
                 std::span<const double> data);
    /// Adds a variable of texts, each with `length` bytes at most and filled up with 0.
    void texts(std::string_view name, const std::vector<std::size_t>& dimensions,
               std::span<const std::string> lines, std::size_t length);
    /// Adds a text to the variable that was added last.
    void describe(std::string_view name, std::string_view text);

    /// Returns the contents of the file. Errors: unsupported (a variable of 4 GiB or more).
    [[nodiscard]] Result<std::string> contents() const;

private:
    struct Dimension {
        std::string name;
        std::size_t length = 0;
    };
    struct Attribute {
        std::string name;
        Type type = Type::text;
        std::size_t count = 0;
        std::string bytes;
    };
    struct Variable {
        std::string name;
        std::vector<std::size_t> dimensions;
        std::vector<Attribute> attributes;
        Type type = Type::integer;
        std::string bytes;
    };

    static void append(std::string& out, const std::vector<Attribute>& attributes);
    [[nodiscard]] std::string header(std::uint64_t size_of_header) const;
    [[nodiscard]] bool holds_records(const Variable& variable) const;

    std::vector<Dimension> dimensions_;
    std::vector<Attribute> attributes_;
    std::vector<Variable> variables_;
};

} // namespace terrane::detail
