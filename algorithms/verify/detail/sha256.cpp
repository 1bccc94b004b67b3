// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/sha256.hpp>

namespace terrane::verifier {

Hasher::Hasher() {
    sha256_init(&state_);
}

void Hasher::add(std::string_view text) {
    sha256_update(&state_, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
}

void Hasher::add(const Digest& digest) {
    sha256_update(&state_, digest.size(), digest.data());
}

void Hasher::add(std::span<const Digest> digests) {
    for (const Digest& digest : digests) add(digest);
}

Digest Hasher::take() {
    Digest digest{};
    sha256_digest(&state_, digest.size(), digest.data());
    return digest;
}

Digest hash_of(std::string_view text) {
    Hasher hasher;
    hasher.add(text);
    return hasher.take();
}

std::string in_hexadecimal(const Digest& digest) {
    std::string text;
    for (const std::uint8_t byte : digest)
        for (const unsigned half : {byte / 16U, byte % 16U}) text += "0123456789abcdef"[half];
    return text;
}

} // namespace terrane::verifier
