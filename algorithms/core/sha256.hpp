// SPDX-License-Identifier: LGPL-3.0-or-later
//
// SHA-256, by the nettle library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <nettle/sha2.h>

namespace terrane {

/// 32 bytes, compared as such.
using Hash = std::array<std::uint8_t, SHA256_DIGEST_SIZE>;

/// Hashes what it is fed, as if joined.
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

    /// The hash of all that was fed; the object then starts anew.
    Hash finish() {
        Hash hash{};
        sha256_digest(&state_, hash.size(), hash.data());
        return hash;
    }

private:
    sha256_ctx state_{};
};

inline Hash sha256(std::string_view text) {
    Sha256 state;
    state.feed(text);
    return state.finish();
}

/// 64 lower-case hexadecimal digits.
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
