// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/text_width.hpp>

#include <algorithm>
#include <clocale>
#include <cwchar>

namespace terrane::cli {
namespace {

/// The C library's knowledge of characters, for the calling thread as long as the object lives. The
/// locale of the process stays what it is.
class CharacterTable {
public:
    CharacterTable() {
        static const locale_t unicode = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
        if (unicode != nullptr) before_ = uselocale(unicode);
    }
    ~CharacterTable() {
        if (before_ != nullptr) uselocale(before_);
    }
    CharacterTable(const CharacterTable&) = delete;
    CharacterTable& operator=(const CharacterTable&) = delete;

    /// A character and its columns.
    struct Step {
        std::size_t bytes = 1, columns = 1;
    };
    [[nodiscard]] Step first_of(std::string_view text) const {
        if (static_cast<unsigned char>(text[0]) < 0x80 || before_ == nullptr) return {};
        std::mbstate_t state{};
        wchar_t character = 0;
        const std::size_t bytes = std::mbrtowc(&character, text.data(), text.size(), &state);
        if (bytes == 0 || bytes > text.size()) return {}; // not UTF-8
        if (reorders(static_cast<char32_t>(character))) return {bytes, code_width};
        return {bytes, static_cast<std::size_t>(std::max(wcwidth(character), 0))};
    }

private:
    locale_t before_ = nullptr; ///< none: the table is not there, and every byte counts as one
};

} // namespace

std::size_t width_of(std::string_view text) {
    const CharacterTable table;
    std::size_t width = 0;
    while (!text.empty()) {
        const auto step = table.first_of(text);
        width += step.columns;
        text.remove_prefix(step.bytes);
    }
    return width;
}

std::string padded(std::string_view text, std::size_t width) {
    const std::size_t taken = width_of(text);
    return std::string(text) + std::string(width > taken ? width - taken : 0, ' ');
}

std::size_t column_width(std::span<const std::string> names, std::size_t least) {
    std::size_t width = least;
    for (const std::string& name : names) {
        const std::size_t taken = width_of(name);
        if (taken <= widest_column) width = std::max(width, taken);
    }
    return width;
}

std::string_view cut_to(std::string_view text, std::size_t width) {
    const CharacterTable table;
    std::size_t at = 0, taken = 0;
    while (at < text.size()) {
        const auto step = table.first_of(text.substr(at));
        if (taken + step.columns > width) break;
        taken += step.columns;
        at += step.bytes;
    }
    return text.substr(0, at);
}

} // namespace terrane::cli
