// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/sha256.hpp>

#include <algorithm>
#include <cstddef>

#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

Hasher::Hasher() {
    sha256_init(&state_);
}

void Hasher::add(std::string_view text) {
    constexpr std::size_t piece = std::size_t(1) << 20;
    for (; !text.empty(); text.remove_prefix(std::min(piece, text.size()))) {
        look_for_stop();
        sha256_update(&state_, std::min(piece, text.size()),
                      reinterpret_cast<const std::uint8_t*>(text.data()));
    }
}

void Hasher::add(const Digest& digest) {
    look_for_stop();
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
