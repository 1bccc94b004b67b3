// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Messages between tiles: arrays of records that are copied byte by byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace terrane::tiles {

using Bytes = std::vector<std::byte>;

/// Records of different types travel in different channels.
constexpr std::size_t channels = 4;

/// Appends a record to bytes.
template <class T>
void append_record(Bytes& bytes, const T& record) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto at = bytes.size();
    bytes.resize(at + sizeof(T));
    std::memcpy(bytes.data() + at, &record, sizeof(T));
}

/// The messages of one tile to the others in one step.
class Outbox {
public:
    explicit Outbox(std::size_t tiles) : to_(tiles) {}

    /// Adds a record to the message to a tile.
    template <class T>
    void put(std::size_t tile, std::size_t channel, const T& record) {
        append_record(to_[tile][channel], record);
    }
    /// Adds a record to the messages to all tiles.
    template <class T>
    void put_to_all(std::size_t channel, const T& record) {
        for (std::size_t tile = 0; tile < to_.size(); ++tile) put(tile, channel, record);
    }
    /// Adds text to the message to a tile.
    void put_text(std::size_t tile, std::size_t channel, std::span<const char> text) {
        for (const char c : text) put(tile, channel, c);
    }

    [[nodiscard]] std::size_t tiles() const { return to_.size(); }
    [[nodiscard]] Bytes& bytes(std::size_t tile, std::size_t channel) { return to_[tile][channel]; }
    /// Returns the number of bytes in all messages.
    [[nodiscard]] std::size_t size() const {
        std::size_t sum = 0;
        for (const auto& message : to_)
            for (const Bytes& b : message) sum += b.size();
        return sum;
    }

private:
    std::vector<std::array<Bytes, channels>> to_; ///< per tile
};

/// The messages that one tile received in one step.
class Inbox {
public:
    explicit Inbox(std::size_t tiles) : from_(tiles) {}

    [[nodiscard]] Bytes& bytes(std::size_t tile, std::size_t channel) {
        return from_[tile][channel];
    }
    [[nodiscard]] std::size_t tiles() const { return from_.size(); }

    /// Calls use(source tile, record) for all records of a channel, by source, in the order in
    /// which they were put, and frees each message.
    template <class T, class Use>
    void take(std::size_t channel, const Use& use) {
        static_assert(std::is_trivially_copyable_v<T>);
        for (std::size_t tile = 0; tile < from_.size(); ++tile) {
            const Bytes bytes = std::exchange(from_[tile][channel], {});
            T record;
            for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) {
                std::memcpy(&record, bytes.data() + at, sizeof(T));
                use(static_cast<std::uint32_t>(tile), record);
            }
        }
    }
    /// Returns all records of a channel, by source.
    template <class T>
    std::vector<T> all(std::size_t channel) {
        std::size_t size = 0;
        for (const auto& message : from_) size += message[channel].size();
        std::vector<T> records;
        records.reserve(size / sizeof(T));
        take<T>(channel, [&](std::uint32_t, const T& record) { records.push_back(record); });
        return records;
    }
    [[nodiscard]] std::size_t size() const {
        std::size_t sum = 0;
        for (const auto& message : from_)
            for (const Bytes& b : message) sum += b.size();
        return sum;
    }

private:
    std::vector<std::array<Bytes, channels>> from_; ///< per tile
};

} // namespace terrane::tiles
