// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/gocad/vertex_properties.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <terrane/io/text/names.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane::detail {
namespace {

/// Splits a line into words, which may be quoted and then have blanks.
std::vector<std::string> words_of(std::string_view line) {
    std::vector<std::string> words;
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
        const bool quoted = line.front() == '"';
        if (quoted) line.remove_prefix(1);
        const auto end = std::min(line.find_first_of(quoted ? "\"" : " \t"), line.size());
        words.push_back(std::string(trimmed(line.substr(0, end))));
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return words;
}

} // namespace

void VertexProperties::read_header(std::string_view keyword, std::string_view line) {
    if (vertices_ > 0) return;
    if (keyword == "PROPERTIES") names_ = words_of(line);
    if (keyword == "ESIZES") sizes_ = words_of(line);
    if (keyword == "UNITS") units_ = words_of(line);
    if (keyword == "NO_DATA_VALUES") no_data_ = words_of(line);
}

void VertexProperties::read_vertex(const LineParser& in, Tokens tokens) {
    if (names_.empty()) return;
    if (vertices_++ == 0) begin();
    for (std::size_t k = 0; k < width_; ++k) {
        double& value = numbers_.emplace_back(std::nan(""));
        const auto token = tokens.next();
        double number = 0;
        if (token.empty() || in.read_number(token, number)) continue;
        value = number;
        is_any_ = true;
    }
}

void VertexProperties::begin() {
    constexpr std::size_t most_numbers = 64; // per vertex, so that memory is linear in the file
    for (std::size_t i = 0; i < names_.size(); ++i) {
        std::int64_t size = 1;
        if (i < sizes_.size() && (!parse_integer(sizes_[i], size) || size < 1)) size = 1;
        if (static_cast<std::size_t>(size) > most_numbers - width_) return;
        ValueArray& array = described_.emplace_back();
        array.name = names_[i];
        array.components = static_cast<std::uint32_t>(size);
        if (i < units_.size())
            for (const char* none : {"none", "unitless", "unknown", "**none**"})
                if (same_ignoring_case(units_[i], none)) units_[i].clear();
        if (i < units_.size()) array.unit = units_[i];
        double number = 0;
        if (i < no_data_.size() && parse_double(no_data_[i], number) == NumberState::ok)
            array.no_data = number;
        width_ += array.components;
    }
}

void VertexProperties::end(Surface& surface) const {
    for (std::size_t i = described_.size(); is_any_ && i < names_.size(); ++i)
        note_values(names_[i], surface.values);
    std::size_t first = 0;
    for (const ValueArray& described : is_any_ ? described_ : std::vector<ValueArray>()) {
        ValueArray array = described;
        std::vector<double> numbers;
        numbers.reserve(vertices_ * array.components);
        for (std::size_t v = 0; v < vertices_; ++v)
            for (std::size_t c = 0; c < array.components; ++c)
                numbers.push_back(numbers_[v * width_ + first + c]);
        first += array.components;
        array.numbers = std::move(numbers);
        const std::string name = array.name;
        if (!add_array(std::move(array), surface.vertices.size(), surface.arrays))
            note_values(name, surface.values);
    }
}

void VertexProperties::end_unread(Surface& surface) const {
    for (const std::string& name : names_) note_values(name, surface.values);
}

} // namespace terrane::detail
