// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading JSON whose objects have known keys, with errors that name the key.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/text/json.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::detail {

using Keys = std::span<const std::string_view>;

/// Parses a JSON text. Errors: bad_syntax with "source:line", or with `source` for a number that no
/// double can hold, or for more than 100 levels; bad_option for a key that is repeated in an object, which JSON permits.
Result<Json> parse_json(std::string_view text, std::string_view source);

/// Lists words in a sentence: "a, b or c".
std::string listed(Keys words);

/// Reads values and keeps the first error; after an error it returns empty values. The `path` of a
/// value names it in errors: "surfaces[2].role".
class JsonReader {
public:
    explicit JsonReader(std::string_view source) : source_(source) {}

    [[nodiscard]] const std::optional<Error>& error() const { return error_; }
    void fail(const std::string& path, std::string sentence);

    /// Checks that a value is an object which has only keys of `keys`.
    bool object(const Json& value, const std::string& path, Keys keys);

    /// Returns the value of a key; nullptr if there is none, or after an error.
    [[nodiscard]] const Json* find(const Json& object, std::string_view key) const;
    /// Returns the value of a key; it is an error if there is none.
    const Json* need(const Json& object, std::string_view key, const std::string& path);

    /// Returns a string that is not empty.
    std::string text(const Json& value, const std::string& path);
    /// Returns a string that is one of `words`.
    std::string one_of(const Json& value, const std::string& path, Keys words);
    /// Returns a finite number.
    double number(const Json& value, const std::string& path);
    /// Returns a finite number larger than 0.
    double positive(const Json& value, const std::string& path);
    /// Returns true or false.
    bool truth(const Json& value, const std::string& path);

    /// Calls read(entry, path) for each entry of an array with `least` to `most` entries.
    template <class Read>
    void array(const Json& value, const std::string& path, std::size_t least, std::size_t most,
               const Read& read) {
        if (!check_array(value, path, least, most)) return;
        for (std::size_t i = 0; i < value.size() && !error_; ++i)
            read(value[i], fmt::format("{}[{}]", path, i));
    }

    /// Returns the strings of an array with at least `least` entries.
    std::vector<std::string> texts(const Json& value, const std::string& path, std::size_t least);
    /// Returns the strings of an array with at least one entry, each one of `choice`.
    std::vector<std::string> words(const Json& value, const std::string& path, Keys choice);

    /// Returns the numbers of an array with N entries.
    template <std::size_t N>
    std::array<double, N> numbers(const Json& value, const std::string& path) {
        std::array<double, N> all{};
        std::size_t next = 0;
        array(value, path, N, N,
              [&](const Json& entry, const std::string& at) { all[next++] = number(entry, at); });
        return all;
    }

    Point3 point(const Json& value, const std::string& path);

    /// Returns the path of a key of the object at `path`.
    static std::string join(const std::string& path, std::string_view key);

private:
    bool check_array(const Json& value, const std::string& path, std::size_t least,
                     std::size_t most);

    std::string source_;
    std::optional<Error> error_;
};

} // namespace terrane::detail
