// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Words, numbers and texts of VTK's legacy files, in text or binary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

/// A type of number in legacy files: its name there and in XML files, and its size in bytes.
struct LegacyType {
    std::string_view name, xml_name;
    std::size_t size;
};

/// The type of the corners of cells up to version 4.
inline constexpr LegacyType legacy_int{"int", "Int32", 4};

/// Returns a text in which %20 and the like stand for characters.
std::string decoded_word(std::string_view text);

/// Goes through the contents of a file. It returns views into them.
class LegacyVtkScanner {
public:
    LegacyVtkScanner(std::string_view contents, std::string_view source) :
        contents_(contents), source_(source) {}

    /// Numbers and texts are binary from now on.
    void set_binary() { binary_ = true; }

    [[nodiscard]] std::string_view source() const { return source_; }
    /// Returns where the last word or line begins.
    [[nodiscard]] std::size_t place() const { return token_at_; }
    [[nodiscard]] std::size_t size() const { return contents_.size(); }

    /// Makes an error at the last word or line, or at a place.
    [[nodiscard]] Error error(ErrorCode code, std::string what) const {
        return error_at(token_at_, code, std::move(what));
    }
    [[nodiscard]] Error error_at(std::size_t at, ErrorCode code, std::string what) const;
    /// Makes an error about a word that is no number; empty: the end of the file.
    [[nodiscard]] Error no_number(std::string_view word) const;

    /// Takes the next word; empty at the end.
    std::string_view token();
    /// Takes the next word if it is this one, in any case.
    bool takes(std::string_view word);
    /// Takes the rest of the line.
    std::string_view line();
    /// Passes over the lines up to an empty one, as after METADATA.
    void skip_paragraph();

    /// Reads a count. No count is larger than the file has bytes.
    MaybeError read_count(std::size_t& count);
    MaybeError read_type(LegacyType& type);
    MaybeError read_numbers(std::size_t count, const LegacyType& type, std::vector<double>& values);
    MaybeError read_numbers(std::size_t count, const LegacyType& type,
                            std::vector<std::int64_t>& values);
    /// Reads texts (type string): each on a line of its own, with %20 for a blank, or binary with its
    /// length before it.
    MaybeError read_texts(std::size_t count, std::vector<std::string>& texts);

private:
    template <class Number>
    MaybeError read_any(std::size_t count, const LegacyType& type, std::vector<Number>& values);
    MaybeError append_number(std::vector<double>& values);
    MaybeError append_number(std::vector<std::int64_t>& values);
    MaybeError read_length(std::size_t& length);

    std::string_view contents_, source_;
    bool binary_ = false;
    std::size_t at_ = 0, token_at_ = 0;
};

} // namespace terrane::detail
