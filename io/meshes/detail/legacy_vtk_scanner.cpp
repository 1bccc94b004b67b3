// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/detail/legacy_vtk_scanner.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <terrane/io/meshes/detail/vtk_data.hpp>

namespace terrane::detail {

namespace {

constexpr std::array<LegacyType, 14> legacy_types{{
    {"float", "Float32", 4},
    {"double", "Float64", 8},
    {"char", "Int8", 1},
    {"unsigned_char", "UInt8", 1},
    {"short", "Int16", 2},
    {"unsigned_short", "UInt16", 2},
    legacy_int,
    {"unsigned_int", "UInt32", 4},
    {"long", "Int64", 8},
    {"unsigned_long", "UInt64", 8},
    {"vtkIdType", "Int32", 4},
    {"vtktypeint64", "Int64", 8},
    {"vtktypeuint64", "UInt64", 8},
    {"vtktypeint32", "Int32", 4},
}};

bool is_space(char c) {
    return is_blank(c) || c == '\n';
}

} // namespace

std::string decoded_word(std::string_view text) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool coded = text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 &&
                           digit(text[i + 2]) >= 0;
        if (!coded) {
            plain += text[i];
            continue;
        }
        plain += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
        i += 2;
    }
    return plain;
}

Error LegacyVtkScanner::error_at(std::size_t at, ErrorCode code, std::string what) const {
    if (binary_) return {code, std::move(what), fmt::format("{}, byte {}", source_, at)};
    const auto end = contents_.begin() + static_cast<std::ptrdiff_t>(at);
    return {code, std::move(what),
            fmt::format("{}:{}", source_, 1 + std::count(contents_.begin(), end, '\n'))};
}

Error LegacyVtkScanner::no_number(std::string_view word) const {
    if (word.empty()) return error(ErrorCode::bad_syntax, "the file ends within its numbers");
    return error(ErrorCode::bad_number, shown(word) + " is not such a number");
}

std::string_view LegacyVtkScanner::token() {
    while (at_ < contents_.size() && is_space(contents_[at_])) ++at_;
    token_at_ = at_;
    while (at_ < contents_.size() && !is_space(contents_[at_])) ++at_;
    return contents_.substr(token_at_, at_ - token_at_);
}

bool LegacyVtkScanner::takes(std::string_view word) {
    const auto before = at_;
    if (same_ignoring_case(token(), word)) return true;
    at_ = before;
    return false;
}

std::string_view LegacyVtkScanner::line() {
    token_at_ = at_;
    const auto end = std::min(contents_.find('\n', at_), contents_.size());
    const auto text = contents_.substr(at_, end - at_);
    at_ = std::min(end + 1, contents_.size());
    return trimmed(text);
}

void LegacyVtkScanner::skip_paragraph() {
    line();
    while (at_ < contents_.size() && !line().empty()) {
    }
}

MaybeError LegacyVtkScanner::read_count(std::size_t& count) {
    std::int64_t number = 0;
    const auto word = token();
    if (!parse_integer(word, number) || number < 0)
        return error(ErrorCode::bad_syntax,
                     (word.empty() ? std::string("the end of the file") : shown(word)) +
                         " is no count");
    if (static_cast<std::uint64_t>(number) > contents_.size())
        return error(ErrorCode::bad_syntax,
                     fmt::format("{} elements are more than the file has bytes", number));
    count = static_cast<std::size_t>(number);
    return std::nullopt;
}

MaybeError LegacyVtkScanner::read_type(LegacyType& type) {
    const auto word = token();
    for (const LegacyType& known : legacy_types)
        if (same_ignoring_case(word, known.name)) {
            type = known;
            return std::nullopt;
        }
    return error(ErrorCode::unsupported, shown(lower(word)) + " is no type of number that is read");
}

MaybeError LegacyVtkScanner::append_number(std::vector<double>& values) {
    const auto word = token();
    if (parse_double(word, values.emplace_back()) != NumberState::not_a_number) return std::nullopt;
    return no_number(word);
}

MaybeError LegacyVtkScanner::append_number(std::vector<std::int64_t>& values) {
    const auto word = token();
    if (parse_integer(word, values.emplace_back())) return std::nullopt;
    return no_number(word);
}

template <class Number>
MaybeError LegacyVtkScanner::read_any(std::size_t count, const LegacyType& type,
                                      std::vector<Number>& values) {
    values.clear();
    if (!binary_) {
        for (std::size_t i = 0; i < count; ++i)
            if (auto trouble = append_number(values)) return trouble;
        return std::nullopt;
    }
    line(); // binary data begin after the end of the line
    token_at_ = at_;
    if (count > (contents_.size() - at_) / type.size)
        return error(
            ErrorCode::bad_syntax,
            fmt::format("{} numbers of {} bytes are more than the file has", count, type.size));
    const auto bytes = contents_.substr(at_, count * type.size);
    at_ += bytes.size();
    if (auto flaw = convert_vtk(bytes, type.xml_name, std::endian::big, values))
        return error(ErrorCode::bad_syntax, *flaw);
    return std::nullopt;
}

MaybeError LegacyVtkScanner::read_numbers(std::size_t count, const LegacyType& type,
                                          std::vector<double>& values) {
    return read_any(count, type, values);
}

MaybeError LegacyVtkScanner::read_numbers(std::size_t count, const LegacyType& type,
                                          std::vector<std::int64_t>& values) {
    return read_any(count, type, values);
}

/// Reads the length of a binary text: two bits tell whether it has 8, 4, 2 or 1 bytes.
MaybeError LegacyVtkScanner::read_length(std::size_t& length) {
    token_at_ = at_;
    if (at_ >= contents_.size()) return no_number({});
    const auto first = static_cast<unsigned char>(contents_[at_]);
    const std::size_t bytes = std::size_t{1} << (3U - (first >> 6U));
    if (bytes > contents_.size() - at_) return no_number({});
    length = first & 63U;
    for (std::size_t i = 1; i < bytes; ++i)
        length = 256 * length + static_cast<unsigned char>(contents_[at_ + i]);
    at_ += bytes;
    if (length > contents_.size() - at_) return no_number({});
    return std::nullopt;
}

MaybeError LegacyVtkScanner::read_texts(std::size_t count, std::vector<std::string>& texts) {
    line();
    for (std::size_t i = 0; i < count; ++i) {
        if (!binary_) {
            texts.push_back(decoded_word(line()));
            continue;
        }
        std::size_t length = 0;
        if (auto trouble = read_length(length)) return trouble;
        texts.emplace_back(contents_.substr(at_, length));
        at_ += length;
    }
    return std::nullopt;
}

} // namespace terrane::detail
