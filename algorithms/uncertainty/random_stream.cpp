// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/random_stream.hpp>

#include <bit>
#include <cmath>

#include <terrane/algorithms/core/sha256.hpp>

namespace terrane {

double portable_log(double x) {
    constexpr std::uint64_t exponent_bits = 0x7ff0000000000000U, one = 0x3ff0000000000000U;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    auto exponent = static_cast<int>(bits >> 52U) - 1023;
    auto mantissa = std::bit_cast<double>((bits & ~exponent_bits) | one); // in [1, 2)
    constexpr double root = 1.4142135623730951;
    if (mantissa > root) {
        mantissa /= 2;
        ++exponent;
    }
    // log m = 2 artanh s = 2 (s + s^3/3 + s^5/5 + ...), |s| < .1716: the 12th term is below 1e-19
    const double s = (mantissa - 1) / (mantissa + 1), square = s * s;
    double sum = 0;
    for (int k = 23; k >= 3; k -= 2) sum = sum * square + 1.0 / k;
    constexpr double log2_high = 0.693147180369123816490, log2_low = 1.90821492927058770002e-10;
    return exponent * log2_high + (2 * s + (2 * s * square * sum + exponent * log2_low));
}

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
    constexpr std::uint64_t first = 0xd2511f53U, second = 0xcd9e8d57U;
    constexpr std::uint32_t golden = 0x9e3779b9U, root = 0xbb67ae85U;
    constexpr int rounds = 10;
    for (int round = 0; round < rounds; ++round) {
        const std::uint64_t a = first * counter[0], b = second * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32U) ^ counter[1] ^ key[0],
                   static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32U) ^ counter[3] ^ key[1],
                   static_cast<std::uint32_t>(a)};
        key[0] += golden;
        key[1] += root;
    }
    return counter;
}

RandomStream::RandomStream(std::string_view name) {
    const Hash hash = sha256(name);
    for (std::size_t i = 0; i < 8; ++i)
        key_[i / 4] |= static_cast<std::uint32_t>(hash[i]) << (8 * (i % 4));
}

std::uint64_t RandomStream::next() {
    if (left_ == 0) {
        const auto block = philox({static_cast<std::uint32_t>(counter_),
                                   static_cast<std::uint32_t>(counter_ >> 32U), 0, 0},
                                  key_);
        ++counter_;
        bits_ = {block[0] | (static_cast<std::uint64_t>(block[1]) << 32U),
                 block[2] | (static_cast<std::uint64_t>(block[3]) << 32U)};
        left_ = 2;
    }
    return bits_[2 - left_--];
}

double RandomStream::uniform() {
    constexpr double unit = 0x1p-53;
    return (2 * static_cast<double>(next() >> 12U) + 1) * unit;
}

double RandomStream::normal() {
    const double length = std::sqrt(-2 * portable_log(uniform()));
    return length * cos_of_turns(uniform());
}

} // namespace terrane
