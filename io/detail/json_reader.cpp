// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/detail/json_reader.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <terrane/io/text/names.hpp>

namespace terrane::detail {

namespace {

/// Returns the number of characters that must be changed, added or removed to turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

/// Suggests the key that is most similar to an unknown one, or lists all keys if none is similar.
std::string advice(std::string_view unknown, Keys keys) {
    const auto nearest =
        std::min_element(keys.begin(), keys.end(), [&](std::string_view a, std::string_view b) {
            return edit_distance(unknown, a) < edit_distance(unknown, b);
        });
    if (edit_distance(unknown, *nearest) <= std::max<std::size_t>(2, nearest->size() / 3))
        return fmt::format("unknown key; did you mean {}?", *nearest);
    return "unknown key; there are " + listed(keys);
}

std::size_t line_of(std::string_view text, std::size_t byte) {
    const auto before = text.substr(0, std::min(byte, text.size()));
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

} // namespace

Result<Json> parse_json(std::string_view text, std::string_view source) {
    using State = ParsedJson::State;
    ParsedJson parsed = parse_json_text(text);
    switch (parsed.state) {
    case State::good:
        break;
    case State::no_json:
        return Error{ErrorCode::bad_syntax, "this is not JSON",
                     fmt::format("{}:{}", source, line_of(text, parsed.byte))};
    case State::number_too_large:
        return Error{ErrorCode::bad_syntax, "a number is too large", std::string(source)};
    case State::nested_too_deeply:
        return Error{ErrorCode::bad_syntax, "lists and objects are nested too deeply",
                     std::string(source)};
    }
    if (parsed.repeated.empty()) return std::move(parsed.value);
    return Error{ErrorCode::bad_option, "the key " + one_line(parsed.repeated) + " is there twice",
                 std::string(source)};
}

std::string listed(Keys words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += fmt::format("{}{}", i == 0 ? "" : i + 1 == words.size() ? " or " : ", ", words[i]);
    return text;
}

void JsonReader::fail(const std::string& path, std::string sentence) {
    if (!error_)
        error_ = Error{ErrorCode::bad_option, std::move(sentence),
                       path.empty() ? source_ : source_ + ": " + path};
}

bool JsonReader::object(const Json& value, const std::string& path, Keys keys) {
    if (!value.is_object()) {
        fail(path, "must be an object");
        return false;
    }
    for (const auto& [key, unused] : value.items())
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
            fail(join(path, key), advice(key, keys));
    return !error_;
}

const Json* JsonReader::find(const Json& object, std::string_view key) const {
    return error_ ? nullptr : object.find(key);
}

const Json* JsonReader::need(const Json& object, std::string_view key, const std::string& path) {
    const Json* value = find(object, key);
    if (value == nullptr) fail(path, fmt::format("the key {} is missing", key));
    return value;
}

std::string JsonReader::text(const Json& value, const std::string& path) {
    if (!value.is_string() || value.text().empty()) {
        fail(path, "must be a string, not empty");
        return {};
    }
    auto text = value.get<std::string>();
    if (text.find('\0') == std::string::npos) return text;
    fail(path, "must not have the character U+0000, which no name of a file can have");
    return {};
}

std::string JsonReader::one_of(const Json& value, const std::string& path, Keys words) {
    if (value.is_string() &&
        std::find(words.begin(), words.end(), value.get<std::string>()) != words.end())
        return value.get<std::string>();
    fail(path, "must be " + listed(words));
    return {};
}

double JsonReader::number(const Json& value, const std::string& path) {
    if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
    fail(path, "must be a number");
    return 0;
}

double JsonReader::positive(const Json& value, const std::string& path) {
    if (value.is_number() && std::isfinite(value.get<double>()) && value.get<double>() > 0)
        return value.get<double>();
    fail(path, "must be a number larger than 0");
    return 0;
}

bool JsonReader::truth(const Json& value, const std::string& path) {
    if (value.is_boolean()) return value.get<bool>();
    fail(path, "must be true or false");
    return false;
}

std::vector<std::string> JsonReader::texts(const Json& value, const std::string& path,
                                           std::size_t least) {
    std::vector<std::string> all;
    array(value, path, least, SIZE_MAX,
          [&](const Json& entry, const std::string& at) { all.push_back(text(entry, at)); });
    return all;
}

std::vector<std::string> JsonReader::words(const Json& value, const std::string& path,
                                           Keys choice) {
    std::vector<std::string> all;
    array(value, path, 1, SIZE_MAX, [&](const Json& entry, const std::string& at) {
        all.push_back(one_of(entry, at, choice));
    });
    return all;
}

Point3 JsonReader::point(const Json& value, const std::string& path) {
    const auto [x, y, z] = numbers<3>(value, path);
    return {x, y, z};
}

std::string JsonReader::join(const std::string& path, std::string_view key) {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

bool JsonReader::check_array(const Json& value, const std::string& path, std::size_t least,
                             std::size_t most) {
    if (value.is_array() && value.size() >= least && value.size() <= most) return true;
    const auto count = least == most ? fmt::format(" of {}", least)
                       : least > 0   ? fmt::format(" of at least {}", least)
                                     : std::string();
    fail(path, "must be a list" + count);
    return false;
}

} // namespace terrane::detail
