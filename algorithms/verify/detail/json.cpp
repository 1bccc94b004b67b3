// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/json.hpp>

#include <algorithm>
#include <limits>
#include <utility>

#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

namespace {

constexpr unsigned most_levels = 16;  ///< levels of values within values; a certificate has 5
constexpr std::size_t most_keys = 64; ///< of an object; a certificate has 9
constexpr std::size_t most_values = std::numeric_limits<std::uint32_t>::max() - 1;

bool is_digit(char c) {
    return '0' <= c && c <= '9';
}

void append_utf8(std::string& out, std::uint32_t code) {
    const auto byte = [&](std::uint32_t value) { out += static_cast<char>(value); };
    if (code < 0x80) {
        byte(code);
    } else if (code < 0x800) {
        byte(0xC0U | code >> 6U);
        byte(0x80U | (code & 0x3FU));
    } else if (code < 0x10000) {
        byte(0xE0U | code >> 12U);
        byte(0x80U | (code >> 6U & 0x3FU));
        byte(0x80U | (code & 0x3FU));
    } else {
        byte(0xF0U | code >> 18U);
        byte(0x80U | (code >> 12U & 0x3FU));
        byte(0x80U | (code >> 6U & 0x3FU));
        byte(0x80U | (code & 0x3FU));
    }
}

/// Returns the length of the character in UTF-8 that a text begins with; 0 without such a
/// character.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first < 0xE0) return follows(1) ? 2 : 0;
    if (first >= 0xE0 && first < 0xF0) {
        const bool too_long = first == 0xE0 && byte(1) < 0xA0;
        const bool surrogate = first == 0xED && byte(1) >= 0xA0;
        return follows(1) && follows(2) && !too_long && !surrogate ? 3 : 0;
    }
    if (first >= 0xF0 && first < 0xF5) {
        const bool too_long = first == 0xF0 && byte(1) < 0x90;
        const bool too_large = first == 0xF4 && byte(1) >= 0x90;
        return follows(1) && follows(2) && follows(3) && !too_long && !too_large ? 4 : 0;
    }
    return 0;
}

} // namespace

/// Scans one text. A value is appended before its members, and completed behind them.
class JsonScanner {
public:
    JsonScanner(std::string_view text, Json& out) : text_(text), out_(out) {}

    void scan() {
        if (text_.starts_with("\xEF\xBB\xBF")) fail("a byte order mark stands before the text");
        value(0);
        skip_blanks();
        if (at_ != text_.size()) fail("there is more behind the end");
    }

private:
    [[noreturn]] void fail(std::string sentence) const { throw BadJson{at_, std::move(sentence)}; }

    void skip_blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' ||
                                      text_[at_] == '\t' || text_[at_] == '\r'))
            ++at_;
    }
    [[nodiscard]] char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    bool take(char c) {
        const bool there = at_ < text_.size() && text_[at_] == c;
        if (there) ++at_;
        return there;
    }
    bool take(std::string_view word) {
        const bool there = text_.substr(at_).starts_with(word);
        if (there) at_ += word.size();
        return there;
    }

    std::uint32_t append(JsonKind kind, std::uint64_t content = 0) {
        look_for_stop();
        if (out_.values_.size() >= most_values) fail("there are too many values");
        const auto index = static_cast<std::uint32_t>(out_.values_.size());
        out_.values_.push_back({kind, 0, index + 1, content});
        return index;
    }

    void value(unsigned depth) {
        if (depth > most_levels) fail("values lie too deep within each other");
        skip_blanks();
        const char c = next();
        if (take('{')) return object(depth);
        if (take('[')) return array(depth);
        if (take('"')) return string();
        if (is_digit(c) || c == '-') return integer();
        if (take(std::string_view("true"))) return void(append(JsonKind::boolean, 1));
        if (take(std::string_view("false"))) return void(append(JsonKind::boolean, 0));
        if (take(std::string_view("null"))) return void(append(JsonKind::null));
        fail("this is no JSON");
    }

    void array(unsigned depth) {
        const std::uint32_t index = append(JsonKind::array);
        std::uint32_t count = 0;
        skip_blanks();
        if (!take(']')) {
            do {
                value(depth + 1);
                ++count;
                skip_blanks();
            } while (take(','));
            if (!take(']')) fail("a comma or ] is needed");
        }
        close(index, count);
    }

    void object(unsigned depth) {
        const std::uint32_t index = append(JsonKind::object);
        std::vector<std::uint32_t> keys;
        skip_blanks();
        if (!take('}')) {
            do {
                keys.push_back(key(keys));
                skip_blanks();
                if (!take(':')) fail("a colon is needed");
                value(depth + 1);
                skip_blanks();
            } while (take(','));
            if (!take('}')) fail("a comma or } is needed");
        }
        close(index, static_cast<std::uint32_t>(keys.size()));
    }

    std::uint32_t key(const std::vector<std::uint32_t>& earlier) {
        skip_blanks();
        const std::size_t start = at_;
        if (earlier.size() == most_keys) fail("an object has too many keys");
        if (!take('"')) fail("a key in quotes is needed");
        const auto index = static_cast<std::uint32_t>(out_.values_.size());
        string();
        const auto text = out_.string(out_[index]);
        const bool twice = std::ranges::any_of(
            earlier, [&](std::uint32_t other) { return out_.string(out_[other]) == text; });
        if (twice) throw BadJson{start, "the key \"" + std::string(text) + "\" is there twice"};
        return index;
    }

    void close(std::uint32_t index, std::uint32_t count) {
        out_.values_[index].count = count;
        out_.values_[index].after = static_cast<std::uint32_t>(out_.values_.size());
    }

    void integer() {
        const std::size_t start = at_;
        std::uint64_t number = 0;
        for (; is_digit(next()); ++at_) {
            const auto digit = static_cast<std::uint64_t>(next() - '0');
            if (number > (std::numeric_limits<std::uint64_t>::max() - digit) / 10)
                throw BadJson{start, "the number is too large"};
            number = 10 * number + digit;
        }
        const bool padded = at_ - start > 1 && text_[start] == '0';
        const bool ends = std::string_view(".eE+-").find(next()) == std::string_view::npos;
        if (at_ == start || padded || !ends)
            throw BadJson{start, "a whole number, not negative, is needed"};
        append(JsonKind::integer, number);
    }

    void string() {
        const std::uint32_t index = append(JsonKind::string, out_.strings_.size());
        while (!take('"')) {
            if (at_ >= text_.size()) fail("a string has no end");
            if (take('\\'))
                escape();
            else
                character();
        }
        const std::size_t size = out_.strings_.size() - out_[index].content;
        if (size >= most_values) fail("the string is too long");
        out_.values_[index].count = static_cast<std::uint32_t>(size);
    }

    void character() {
        const std::size_t length = utf8_length(text_.substr(at_, 4));
        if (length == 0) fail("this is no UTF-8");
        if (static_cast<unsigned char>(text_[at_]) < 0x20) fail("a control character in a string");
        out_.strings_.append(text_.substr(at_, length));
        at_ += length;
    }

    void escape() {
        constexpr std::string_view letters = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
        if (const auto which = letters.find(next()); which != std::string_view::npos) {
            out_.strings_ += meanings[which];
            ++at_;
            return;
        }
        if (!take('u')) fail("no escape of this name");
        std::uint32_t code = code_unit();
        if (code >= 0xDC00 && code < 0xE000) fail("half of a surrogate pair");
        if (code >= 0xD800 && code < 0xDC00) {
            const std::uint32_t low = take(std::string_view("\\u")) ? code_unit() : 0;
            if (low < 0xDC00 || low >= 0xE000) fail("half of a surrogate pair");
            code = 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00);
        }
        append_utf8(out_.strings_, code);
    }

    std::uint32_t code_unit() {
        std::uint32_t code = 0;
        for (int i = 0; i < 4; ++i, ++at_) {
            const char c = next();
            if (is_digit(c))
                code = 16 * code + static_cast<std::uint32_t>(c - '0');
            else if ('a' <= c && c <= 'f')
                code = 16 * code + static_cast<std::uint32_t>(c - 'a' + 10);
            else if ('A' <= c && c <= 'F')
                code = 16 * code + static_cast<std::uint32_t>(c - 'A' + 10);
            else
                fail("four hexadecimal digits are needed");
        }
        return code;
    }

    std::string_view text_;
    Json& out_;
    std::size_t at_ = 0; ///< the next byte
};

Json::Json(std::string_view text) {
    JsonScanner(text, *this).scan();
}

std::optional<std::uint32_t> Json::find(std::uint32_t object, std::string_view key) const {
    std::uint32_t at = object + 1;
    for (std::uint32_t i = 0; i < values_[object].count; ++i) {
        if (string(values_[at]) == key) return at + 1;
        at = values_[at + 1].after;
    }
    return std::nullopt;
}

std::string place_in(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, offset);
    const auto line = std::ranges::count(before, '\n') + 1;
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

} // namespace terrane::verifier
