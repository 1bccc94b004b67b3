// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Turns data into bytes and back. An aggregate takes part by a function fields(archive, object)
// that passes its members to the archive; the same function serves both ways. Bytes are in the
// order of this machine, as they are kept for it alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::pipeline::detail {

/// An object of type U, or a constant one.
template <class T, class U>
concept Is = std::same_as<std::remove_const_t<T>, U>;

/// Types whose bytes are their values, without padding.
template <class T>
inline constexpr bool
    is_flat = (std::is_arithmetic_v<T> && !std::same_as<T, bool>) || std::is_enum_v<T>;
template <>
inline constexpr bool is_flat<Point3> = true;
template <class T, std::size_t N>
inline constexpr bool is_flat<std::array<T, N>> = is_flat<T>;

/// Tells whether all numbers of a flat object are finite.
template <class T>
bool is_finite(const T& object) {
    if constexpr (std::same_as<T, Point3>)
        return is_finite(std::array{object.x, object.y, object.z});
    else if constexpr (std::is_floating_point_v<T>)
        return std::isfinite(object);
    else if constexpr (requires { object.begin(); })
        return std::ranges::all_of(object, [](const auto& part) { return is_finite(part); });
    else
        return true;
}

/// Appends objects to a text of bytes.
class ByteWriter {
public:
    template <class... T>
    void operator()(const T&... objects) {
        (add(objects), ...);
    }
    std::string bytes;

private:
    template <class T>
    void add(const T& object) {
        if constexpr (is_flat<T>)
            add_bytes(std::span(&object, 1));
        else if constexpr (std::same_as<T, bool>)
            add(std::uint8_t{object});
        else
            fields(*this, object);
    }
    void add(const std::string& text) {
        add(std::uint64_t{text.size()});
        bytes += text;
    }
    template <class T>
    void add(const std::vector<T>& list) {
        add(std::uint64_t{list.size()});
        if constexpr (is_flat<T>)
            add_bytes(std::span(list));
        else
            for (const T& object : list) add(object);
    }
    template <class T>
    void add(const IndexLists<T>& lists) {
        add(lists.offsets);
        add(lists.values);
    }
    template <class T>
    void add_bytes(std::span<const T> flat) {
        bytes.append(reinterpret_cast<const char*>(flat.data()), flat.size_bytes());
    }
};

/// Takes objects from bytes, in the order in which they were appended. Any bytes may come: memory is
/// linear in their number, lists of lists have ascending offsets, and all numbers are finite.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <class... T>
    void operator()(T&... objects) {
        (take(objects), ...);
    }
    /// Tells whether all objects were there, and nothing else.
    [[nodiscard]] bool complete() const { return good_ && rest_.empty(); }

private:
    template <class T>
    void take(T& object) {
        if constexpr (is_flat<T>) {
            take_bytes(std::span(&object, 1));
        } else if constexpr (std::same_as<T, bool>) {
            std::uint8_t byte = 0;
            take(byte);
            object = byte != 0;
        } else {
            fields(*this, object);
        }
    }
    void take(std::string& text) {
        text.resize(taken_count(1));
        take_bytes(std::span(text.data(), text.size()));
    }
    template <class T>
    void take(std::vector<T>& list) {
        if constexpr (is_flat<T>) {
            list.resize(taken_count(sizeof(T)));
            take_bytes(std::span(list));
        } else {
            list.clear(); // objects are larger than their bytes: none is made that can't be there
            for (std::size_t left = taken_count(1); left > 0 && good_; --left)
                take(list.emplace_back());
        }
    }
    template <class T>
    void take(IndexLists<T>& lists) {
        take(lists.offsets);
        take(lists.values);
        good_ = good_ && are_lists(lists.offsets, lists.values.size());
        if (!good_) lists = {};
    }
    static bool are_lists(std::span<const std::uint32_t> offsets, std::size_t values) {
        if (offsets.empty() || offsets.front() != 0 || offsets.back() != values) return false;
        for (std::size_t i = 1; i < offsets.size(); ++i)
            if (offsets[i] < offsets[i - 1]) return false;
        return true;
    }
    /// Takes a number of objects; 0 if the rest is too short for them at this least size.
    std::size_t taken_count(std::size_t least_size) {
        std::uint64_t count = 0;
        take(count);
        if (count > rest_.size() / least_size) good_ = false;
        return good_ ? static_cast<std::size_t>(count) : 0;
    }
    template <class T>
    void take_bytes(std::span<T> flat) {
        if (flat.empty()) return;
        good_ = good_ && flat.size_bytes() <= rest_.size();
        if (!good_) return;
        std::memcpy(flat.data(), rest_.data(), flat.size_bytes());
        rest_.remove_prefix(flat.size_bytes());
        good_ = std::ranges::all_of(flat, [](const T& object) { return is_finite(object); });
    }

    std::string_view rest_;
    bool good_ = true;
};

} // namespace terrane::pipeline::detail
