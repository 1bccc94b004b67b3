// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/detail/netcdf.hpp>

#include <algorithm>
#include <bit>

#include <fmt/format.h>

namespace terrane::detail {

namespace {

/// Tags of the lists in the header.
enum class List : std::uint32_t { dimensions = 10, variables = 11, attributes = 12 };

constexpr std::uint64_t most_of_variable = (std::uint64_t(1) << 32) - 4; ///< bytes, in CDF-2

template <class Unsigned>
void append_bytes(std::string& out, Unsigned value) {
    for (std::size_t byte = sizeof(Unsigned); byte-- > 0;)
        out += static_cast<char>(value >> (8 * byte) & 0xFF);
}

void append_length(std::string& out, std::size_t value) {
    append_bytes(out, static_cast<std::uint32_t>(value));
}

/// Fills up to a multiple of four bytes.
void align(std::string& out) {
    out.resize((out.size() + 3) / 4 * 4, '\0');
}

std::uint64_t aligned(std::uint64_t size) {
    return (size + 3) / 4 * 4;
}

void append_name(std::string& out, std::string_view name) {
    append_length(out, name.size());
    out += name;
    align(out);
}

/// Begins a list; one without entries has no tag.
void begin_list(std::string& out, List list, std::size_t count) {
    append_length(out, count == 0 ? 0 : static_cast<std::size_t>(list));
    append_length(out, count);
}

} // namespace

std::size_t NetcdfFile::dimension(std::string_view name, std::size_t length) {
    dimensions_.push_back({std::string(name), length});
    return dimensions_.size() - 1;
}

void NetcdfFile::attribute(std::string_view name, std::string_view text) {
    attributes_.push_back({std::string(name), Type::text, text.size(), std::string(text)});
}

void NetcdfFile::attribute(std::string_view name, std::int32_t value) {
    std::string bytes;
    append_bytes(bytes, static_cast<std::uint32_t>(value));
    attributes_.push_back({std::string(name), Type::integer, 1, std::move(bytes)});
}

void NetcdfFile::attribute(std::string_view name, float value) {
    std::string bytes;
    append_bytes(bytes, std::bit_cast<std::uint32_t>(value));
    attributes_.push_back({std::string(name), Type::single, 1, std::move(bytes)});
}

void NetcdfFile::integers(std::string_view name, const std::vector<std::size_t>& dimensions,
                          std::span<const std::int32_t> data) {
    std::string bytes;
    bytes.reserve(data.size() * 4);
    for (const auto value : data) append_bytes(bytes, static_cast<std::uint32_t>(value));
    variables_.push_back({std::string(name), dimensions, {}, Type::integer, std::move(bytes)});
}

void NetcdfFile::numbers(std::string_view name, const std::vector<std::size_t>& dimensions,
                         std::span<const double> data) {
    std::string bytes;
    bytes.reserve(data.size() * 8);
    for (const auto value : data) append_bytes(bytes, std::bit_cast<std::uint64_t>(value));
    variables_.push_back({std::string(name), dimensions, {}, Type::number, std::move(bytes)});
}

void NetcdfFile::texts(std::string_view name, const std::vector<std::size_t>& dimensions,
                       std::span<const std::string> lines, std::size_t length) {
    std::string bytes;
    bytes.reserve(lines.size() * length);
    for (const auto& line : lines) {
        bytes += line.substr(0, length);
        bytes.append(length - std::min(line.size(), length), '\0');
    }
    variables_.push_back({std::string(name), dimensions, {}, Type::text, std::move(bytes)});
}

void NetcdfFile::describe(std::string_view name, std::string_view text) {
    variables_.back().attributes.push_back(
        {std::string(name), Type::text, text.size(), std::string(text)});
}

void NetcdfFile::append(std::string& out, const std::vector<Attribute>& attributes) {
    begin_list(out, List::attributes, attributes.size());
    for (const Attribute& a : attributes) {
        append_name(out, a.name);
        append_length(out, static_cast<std::size_t>(a.type));
        append_length(out, a.count);
        out += a.bytes;
        align(out);
    }
}

bool NetcdfFile::holds_records(const Variable& variable) const {
    return !variable.dimensions.empty() && dimensions_[variable.dimensions[0]].length == 0;
}

std::string NetcdfFile::header(std::uint64_t size_of_header) const {
    std::string out{'C', 'D', 'F', 2, 0, 0, 0, 0}; // no records
    begin_list(out, List::dimensions, dimensions_.size());
    for (const Dimension& d : dimensions_) {
        append_name(out, d.name);
        append_length(out, d.length);
    }
    append(out, attributes_);
    begin_list(out, List::variables, variables_.size());
    std::uint64_t begin = size_of_header, end = begin; // records follow all else
    for (const Variable& v : variables_) end += aligned(v.bytes.size());
    for (const Variable& v : variables_) {
        append_name(out, v.name);
        append_length(out, v.dimensions.size());
        for (const auto d : v.dimensions) append_length(out, d);
        append(out, v.attributes);
        append_length(out, static_cast<std::size_t>(v.type));
        constexpr std::size_t record = 8; // of one double, the only record that we have
        append_length(out, holds_records(v) ? record : aligned(v.bytes.size()));
        append_bytes(out, holds_records(v) ? end : begin);
        begin += aligned(v.bytes.size());
    }
    return out;
}

Result<std::string> NetcdfFile::contents() const {
    for (const Variable& v : variables_)
        if (v.bytes.size() > most_of_variable)
            return Error{ErrorCode::unsupported,
                         fmt::format("{} has {} bytes; in this format a variable has at most {}",
                                     v.name, v.bytes.size(), most_of_variable),
                         ""};
    auto out = header(header(0).size());
    for (const Variable& v : variables_) {
        out += v.bytes;
        align(out);
    }
    return out;
}

} // namespace terrane::detail
