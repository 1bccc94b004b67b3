// SPDX-License-Identifier: LGPL-3.0-or-later
//
// SHA-256 for the verifier, by the nettle library.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <nettle/sha2.h>

namespace terrane::verifier {

/// 32 bytes, compared as such.
using Digest = std::array<std::uint8_t, SHA256_DIGEST_SIZE>;

/// Hashes all that is added, as if it were joined.
class Hasher {
public:
    Hasher();
    void add(std::string_view text);
    void add(const Digest& digest);
    void add(std::span<const Digest> digests); ///< one after the other
    /// Returns the hash of all that was added, and starts anew.
    Digest take();

private:
    sha256_ctx state_{};
};

Digest hash_of(std::string_view text);

/// Returns 64 lower-case hexadecimal digits.
std::string in_hexadecimal(const Digest& digest);

} // namespace terrane::verifier
