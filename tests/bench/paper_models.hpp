// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The surfaces of the paper's section 6, as far as it describes them, and random rectangles: the
// inputs of the benchmarks. Every run makes the same numbers.
#pragma once

#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::models {

/// Numbers of cells, two triangles each. The horizon has horizon x horizon cells, the fault fault_x
/// x fault_z.
struct Resolution {
    const char* name;
    int horizon, fault_x, fault_z;
};

constexpr Resolution r7k{"6 800", 41, 58, 29};
constexpr Resolution r68k{"68 000", 130, 184, 92};
constexpr Resolution r680k{"680 000", 412, 582, 291};
constexpr Resolution r6800k{"6 800 000", 1304, 1844, 922};

/// Makes a pair with a localised intersection: the horizon z = 0.1 sin 3x cos 2y on [0, 4]^2 and
/// the fault y = 2 + 0.2 sin 2x + 0.3 z for z in [-1, 1].
std::vector<Surface> pair_1(const Resolution& r);

/// Makes a pair with a widespread intersection: z = 0.3 sin 5x sin 5y, and z = 0.3 cos(4x + 0.3)
/// sin(6y + 0.2) on the square rotated by 0.1 rad about its centre, both with horizon x horizon
/// cells.
std::vector<Surface> pair_2(const Resolution& r);

/// Make the same pairs with the right half refined 30 times in each direction and joined by fans.
std::vector<Surface> nonuniform_1();
std::vector<Surface> nonuniform_2();

/// Squares of side 2 * half_side in random orientations, with centres in [low, high]^3. Each square
/// is a surface of two triangles.
struct RandomSquares {
    int count;
    double half_side;
    unsigned seed;
    double low, high;
};

constexpr RandomSquares rectangles_100{100, 1.5, 1, 0.3, 0.7};
constexpr RandomSquares rectangles_1000{1000, 0.12, 2, 0, 1};

std::vector<Surface> random_squares(const RandomSquares& s);

} // namespace terrane::models
