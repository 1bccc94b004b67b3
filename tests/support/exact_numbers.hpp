// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include <gmpxx.h>

#include <terrane/algorithms/volumes/volumes.hpp>

namespace test_support {

/// Returns the exact volumes of the blocks of a mesh or an arrangement; [0] is their sum.
template <class Triangles>
std::vector<mpq_class> exact_numbers(const Triangles& triangles, const terrane::Volumes& volumes) {
    const terrane::ExactVolumes exact = terrane::exact_volumes(triangles, volumes);
    std::vector<mpq_class> numbers{mpq_class(exact.total)};
    for (std::size_t b = 1; b < exact.measures.size(); ++b) numbers.emplace_back(exact.measures[b]);
    return numbers;
}

} // namespace test_support
