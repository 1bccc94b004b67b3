// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reads the values of a certificate: each kind of certificate reads its own sections with it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/verify/detail/decimal.hpp>
#include <terrane/algorithms/verify/detail/json.hpp>
#include <terrane/algorithms/verify/stoppable.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::verifier {

/// Why a value is refused, and where it is. parse_certificate() catches it.
struct Malformed {
    std::string place; ///< "exact.triangles[12]"
    std::string sentence;
};

/// A value in a JSON text, and its path.
class Node {
public:
    explicit Node(const Json& json) : json_(json) {}

    /// Precondition: the value is an object with this key.
    [[nodiscard]] Node operator[](std::string_view key) const {
        return {json_, json_.find(value_, key).value(), this, key, 0};
    }
    [[nodiscard]] bool is_null() const { return kind() == JsonKind::null; }

    /// Tells whether the value is an object with this key.
    [[nodiscard]] bool has(std::string_view key) const {
        return kind() == JsonKind::object && json_.find(value_, key).has_value();
    }
    /// Checks that the value is an object with this key.
    void expect_key(std::string_view key) const {
        if (kind() != JsonKind::object) fail("an object is needed");
        if (!json_.find(value_, key)) fail("\"" + std::string(key) + "\" is missing");
    }
    /// Checks that the value is an object with these keys, and no others.
    void expect_keys(std::span<const std::string_view> keys) const {
        for (const std::string_view key : keys) expect_key(key);
        if (json_[value_].count != keys.size()) fail("an unknown key");
    }
    void expect_keys(std::initializer_list<std::string_view> keys) const {
        expect_keys(std::span(keys.begin(), keys.size()));
    }

    /// Returns the size of an array.
    [[nodiscard]] std::size_t size() const {
        if (kind() != JsonKind::array) fail("an array is needed");
        return json_[value_].count;
    }
    void expect_size(std::size_t n) const {
        if (size() != n) fail("an array of " + std::to_string(n) + " is needed");
    }

    /// Calls visit(item, i) for each item of an array, in order.
    template <class Visit>
    void for_each(const Visit& visit) const {
        const std::size_t count = size();
        std::uint32_t at = value_ + 1;
        for (std::size_t i = 0; i < count; ++i, at = json_[at].after) {
            look_for_stop();
            visit(Node(json_, at, this, {}, i), i);
        }
    }

    [[nodiscard]] std::uint64_t count() const {
        if (kind() != JsonKind::integer) fail("a whole number, not negative, is needed");
        return json_[value_].content;
    }
    [[nodiscard]] std::uint32_t index() const {
        const std::uint64_t n = count();
        if (n > UINT32_MAX) fail("the number is too large");
        return static_cast<std::uint32_t>(n);
    }
    [[nodiscard]] bool flag() const {
        if (kind() != JsonKind::boolean) fail("true or false is needed");
        return json_[value_].content == 1;
    }
    [[nodiscard]] std::string_view string() const {
        if (kind() != JsonKind::string) fail("a string is needed");
        return json_.string(json_[value_]);
    }
    /// Returns a double that is given as a string, the shortest decimal that reads back as it.
    [[nodiscard]] double number() const {
        const auto value = verifier::shortest_decimal<double>(string());
        if (!value) fail("a finite number in quotes, in its shortest form, is needed");
        return *value;
    }

    [[noreturn]] void fail(std::string sentence) const {
        throw Malformed{place(), std::move(sentence)};
    }

private:
    Node(const Json& json, std::uint32_t value, const Node* up, std::string_view key,
         std::size_t i) :
        json_(json),
        value_(value), up_(up), key_(key), i_(i) {}

    [[nodiscard]] JsonKind kind() const { return json_[value_].kind; }
    [[nodiscard]] std::string place() const {
        if (up_ == nullptr) return "";
        const std::string before = up_->place();
        if (key_.empty()) return before + "[" + std::to_string(i_) + "]";
        return before + (before.empty() ? "" : ".") + std::string(key_);
    }

    const Json& json_;
    std::uint32_t value_ = 0;  ///< its index
    const Node* up_ = nullptr; ///< nullptr: the value is the whole text
    std::string_view key_;     ///< of an object's member
    std::size_t i_ = 0;        ///< of an array's
};

/// Returns make(item) for each item of an array.
template <class Make>
auto each(const Node& array, const Make& make) {
    std::vector<decltype(make(array))> result;
    result.reserve(array.size());
    array.for_each([&](const Node& item, std::size_t) { result.push_back(make(item)); });
    return result;
}

/// Returns the n indices of an array.
template <std::size_t n>
std::array<std::uint32_t, n> indices(const Node& array) {
    array.expect_size(n);
    std::array<std::uint32_t, n> values{};
    array.for_each([&](const Node& item, std::size_t i) { values[i] = item.index(); });
    return values;
}

/// Returns the index that a value is.
inline std::uint32_t index(const Node& node) {
    return node.index();
}

/// Returns the lists of indices that an array of arrays holds.
inline IndexLists<std::uint32_t> lists(const Node& array) {
    IndexLists<std::uint32_t> result;
    array.for_each([&](const Node& list, std::size_t) {
        list.for_each(
            [&](const Node& item, std::size_t) { result.values.push_back(item.index()); });
        result.close();
    });
    return result;
}

/// Returns the point that an array of three numbers is.
inline Point3 point(const Node& node) {
    node.expect_size(3);
    std::array<double, 3> values{};
    node.for_each([&](const Node& item, std::size_t i) { values[i] = item.number(); });
    return {values[0], values[1], values[2]};
}

} // namespace terrane::verifier
