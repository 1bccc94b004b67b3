// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Computes SHA-256 hashes with the nettle library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <nettle/sha2.h>

namespace terrane {

/// The 32 bytes of a hash, ordered lexicographically.
using Hash = std::array<std::uint8_t, SHA256_DIGEST_SIZE>;

/// Hashes the concatenation of its inputs.
class Sha256 {
public:
    Sha256() { sha256_init(&state_); }

    void feed(std::string_view text) {
        sha256_update(&state_, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
    }
    void feed(const Hash& hash) { sha256_update(&state_, hash.size(), hash.data()); }
    void feed(std::span<const Hash> hashes) {
        for (const Hash& hash : hashes) feed(hash);
    }

    /// Returns the hash of all inputs and resets the object.
    Hash finish() {
        Hash hash{};
        sha256_digest(&state_, hash.size(), hash.data());
        return hash;
    }

private:
    sha256_ctx state_{};
};

/// Returns the hash of a text.
inline Hash sha256(std::string_view text) {
    Sha256 state;
    state.feed(text);
    return state.finish();
}

/// Returns a hash as 64 lower-case hexadecimal digits.
inline std::string hexadecimal(const Hash& hash) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : hash) {
        text += digits[byte >> 4U];
        text += digits[byte & 15U];
    }
    return text;
}

} // namespace terrane
