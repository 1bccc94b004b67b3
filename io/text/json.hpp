// SPDX-License-Identifier: LGPL-3.0-or-later
//
// JSON as a tree of values. nlohmann/json reads the text and writes its strings and numbers, but its
// own trees need memory to be destroyed, and end the process where they get none. These need none,
// so that lack of memory is an exception here, as anywhere.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <terrane/algorithms/core/described.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::detail {

class JsonItem;

/// null, true or false, a number, a string, an array, or an object whose keys keep their order.
class Json {
public:
    /// A member of an object that is there as long.
    struct Member {
        const std::string& key;
        const Json& value;
    };

    Json() = default; ///< null
    Json(std::nullptr_t) {}
    Json(std::same_as<bool> auto truth) : value_(truth) {}
    Json(std::floating_point auto number) : value_(double{number}) {}
    template <std::integral Number>
    requires(!std::same_as<Number, bool>) Json(Number number) {
        if constexpr (std::is_signed_v<Number>)
            value_ = std::int64_t{number};
        else
            value_ = std::uint64_t{number};
    }
    /// Makes a number of an index that has a type of its own.
    template <class Index>
    requires(std::is_class_v<Index>&& std::is_convertible_v<Index, std::uint32_t> &&
             !std::same_as<Index, Json>) Json(Index index) :
        Json(static_cast<std::uint32_t>(index)) {}
    Json(std::string text) : value_(std::move(text)) {}
    Json(std::string_view text) : value_(std::string(text)) {}
    Json(const char* text) : value_(std::string(text)) {}
    /// Makes an array of a list of values.
    template <class List>
    requires(!std::same_as<List, Json> && !std::is_convertible_v<const List&, std::string_view> &&
             requires(const List& list) { list.begin() != list.end(); }) Json(const List& list) {
        auto& entries = value_.emplace<std::vector<Json>>();
        for (const auto& entry : list) entries.push_back(Json(entry));
    }
    Json(const Point3& p) : Json(std::array{p.x, p.y, p.z}) {}
    /// Makes a text of a kind that has a name.
    template <class Kind>
    requires(std::is_enum_v<Kind>&& requires(Kind kind) { name_of(kind); }) Json(Kind kind) :
        Json(name_of(kind)) {}
    /// Makes an object of the members of a report.
    template <Described Report>
    Json(const Report& report) {
        value_.emplace<Object>();
        each_member(report, [this](std::string_view name, const auto& value) {
            add_member(std::string(name), Json(value));
        });
    }
    /// Makes an object if all items are pairs that begin with a string, else an array.
    Json(std::initializer_list<JsonItem> items);

    Json(const Json& other);
    Json(Json&& other) noexcept;
    Json& operator=(const Json& other);
    Json& operator=(Json&& other) noexcept;
    ~Json();

    static Json array() { return of(std::vector<Json>()); }
    static Json array(std::initializer_list<JsonItem> items);
    static Json object();

    [[nodiscard]] bool is_null() const { return holds<std::nullptr_t>(); }
    [[nodiscard]] bool is_boolean() const { return holds<bool>(); }
    [[nodiscard]] bool is_string() const { return holds<std::string>(); }
    [[nodiscard]] bool is_array() const { return holds<std::vector<Json>>(); }
    [[nodiscard]] bool is_object() const { return holds<Object>(); }
    [[nodiscard]] bool is_number() const { return is_number_integer() || holds<double>(); }
    [[nodiscard]] bool is_number_integer() const {
        return holds<std::int64_t>() || holds<std::uint64_t>();
    }

    /// Returns the value as bool, std::string or a number, which it must be.
    template <class T>
    [[nodiscard]] T get() const {
        if constexpr (std::same_as<T, bool> || std::same_as<T, std::string>)
            return std::get<T>(value_);
        else
            return holds<std::int64_t>()    ? static_cast<T>(std::get<std::int64_t>(value_))
                   : holds<std::uint64_t>() ? static_cast<T>(std::get<std::uint64_t>(value_))
                                            : static_cast<T>(std::get<double>(value_));
    }
    /// Returns the string that it must be.
    [[nodiscard]] const std::string& text() const { return std::get<std::string>(value_); }
    friend bool operator==(const Json& json, std::string_view text) {
        return json.is_string() && json.text() == text;
    }

    /// Returns the number of entries or members; 0 for all else.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] bool empty() const { return size() == 0; }

    // Entries of an array. A null value becomes an array when an entry is added.
    void push_back(Json entry);
    [[nodiscard]] std::span<const Json> entries() const;
    [[nodiscard]] auto begin() const { return entries().begin(); }
    [[nodiscard]] auto end() const { return entries().end(); }
    [[nodiscard]] auto begin() { return own_entries().begin(); }
    [[nodiscard]] auto end() { return own_entries().end(); }
    template <std::integral Index>
    [[nodiscard]] const Json& operator[](Index index) const {
        return entries()[static_cast<std::size_t>(index)];
    }
    template <std::integral Index>
    [[nodiscard]] Json& operator[](Index index) {
        return own_entries()[static_cast<std::size_t>(index)];
    }

    // Members of an object. A null value becomes an object when a member is added.
    [[nodiscard]] std::vector<Member> items() const;
    /// Returns the value of a key; null if there is none.
    [[nodiscard]] const Json* find(std::string_view key) const;
    [[nodiscard]] bool contains(std::string_view key) const { return find(key) != nullptr; }
    /// Returns the value of a key, which is added if there is none.
    Json& operator[](std::string_view key);
    Json& operator[](const char* key) { return (*this)[std::string_view(key)]; }
    Json& operator[](const std::string& key) { return (*this)[std::string_view(key)]; }
    /// Returns the value of a key; a null value if there is none.
    const Json& operator[](std::string_view key) const;
    const Json& operator[](const char* key) const { return (*this)[std::string_view(key)]; }
    /// Adds a member to an object that does not have its key, without looking for it.
    void add_member(std::string key, Json value);
    void erase(std::string_view key);
    /// Adds the members of another object, or replaces their values.
    void update(Json other);

    /// Returns the text: on one line, or with an indent per level. Bytes that are not UTF-8 become
    /// U+FFFD; numbers that are not finite become null. `ascii`: other characters are escaped.
    [[nodiscard]] std::string dump(int indent = -1, bool ascii = false) const;

private:
    struct Object {
        std::vector<std::string> keys{};
        std::vector<Json> values{}; ///< as many
    };

    template <class T>
    [[nodiscard]] bool holds() const {
        return std::holds_alternative<T>(value_);
    }
    static Json of(std::vector<Json> entries);
    [[nodiscard]] std::span<Json> own_entries();

    std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string,
                 std::vector<Json>, Object>
        value_{nullptr};
};

/// An item in braces. It is moved from there.
class JsonItem {
public:
    // The constraint leaves copies and moves alone, which clang-tidy 14 does not see.
    // NOLINTBEGIN(bugprone-forwarding-reference-overload)
    template <class T>
    requires(!std::same_as<std::remove_cvref_t<T>, JsonItem> && std::constructible_from<Json, T>)
        JsonItem(T&& value) :
        value_(std::forward<T>(value)) {}
    // NOLINTEND(bugprone-forwarding-reference-overload)
    JsonItem(std::initializer_list<JsonItem> items) : value_(items) {}

    [[nodiscard]] bool is_member() const {
        return value_.is_array() && value_.size() == 2 && value_[0].is_string();
    }
    [[nodiscard]] Json take() const { return std::move(value_); }

private:
    mutable Json value_;
};

/// The value of a text, or its flaw.
struct ParsedJson {
    enum class State { good, no_json, number_too_large, nested_too_deeply };

    Json value{};
    State state = State::good;
    std::size_t byte = 0;   ///< where it stops to be JSON
    std::string repeated{}; ///< the first key that its object has twice; empty if there is none
};

/// Parses a text, with at most 100 levels of arrays and objects.
ParsedJson parse_json_text(std::string_view text);

} // namespace terrane::detail
