// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Random numbers that depend on a name alone: stream "17 top/field" is the same on every machine, in
// every order and thread. Philox4x32-10 turns a key, the hash of the name, and a counter into bits
// (Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC 2011); the functions that make
// normal numbers of them use only operations that IEEE 754 rounds correctly, so that no mathematical
// library can change a bit.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace terrane {

/// Returns the natural logarithm of x, which must be positive, finite and normal; the error is below 4
/// units in the last place. The same bits on every machine.
double portable_log(double x);

/// Returns cos(2 pi t) for |t| < 2^50, with an error below 1e-15. The same bits on every machine.
inline double cos_of_turns(double t) {
    constexpr double shift = 6755399441055744.0; // 1.5 * 2^52: adding it rounds to whole numbers
    const double quarters = std::fabs(t - ((t + shift) - shift)) * 4; // in [0, 2], exact
    // cos(pi/2 q) = sin(pi/2 (1 - q)), and 1 - q is exact where q > 1/2, and small errors do not count
    // elsewhere, as the sine is flat near 1.
    const double x = (1 - quarters) * 1.5707963267948966, square = x * x;
    double sum = 0;
    // The series of the sine up to x^21; |x| <= pi/2, so that the next term is below 2e-18.
    constexpr std::array terms{1 / 51090942171709440000.0,
                               -1 / 121645100408832000.0,
                               1 / 355687428096000.0,
                               -1 / 1307674368000.0,
                               1 / 6227020800.0,
                               -1 / 39916800.0,
                               1 / 362880.0,
                               -1 / 5040.0,
                               1 / 120.0,
                               -1 / 6.0};
    for (const double term : terms) sum = sum * square + term;
    return x + x * square * sum;
}

/// Applies Philox4x32-10 to a counter, under a key.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

/// A sequence of random numbers that a name determines.
class RandomStream {
public:
    explicit RandomStream(std::string_view name);

    /// Returns a number in (0, 1), evenly distributed over the odd multiples of 2^-53.
    double uniform();
    /// Returns a normal number of mean 0 and standard deviation 1, by the method of Box and Muller.
    double normal();

private:
    std::uint64_t next();

    std::array<std::uint32_t, 2> key_{};
    std::uint64_t counter_ = 0;
    std::array<std::uint64_t, 2> bits_{};
    unsigned left_ = 0; ///< of bits_
};

} // namespace terrane
