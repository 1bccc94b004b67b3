// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Harmonic values on a graph: each free node has the mean of its neighbours, the others keep theirs.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/SparseCholesky>

#include <terrane/kernel/point.hpp>

namespace terrane::uncertainty::detail {

class Harmonic {
public:
    /// `known`: per node whether its value is given. Free nodes that no path joins to a known one stay 0.
    Harmonic(std::vector<bool> known, std::span<const std::array<std::uint32_t, 2>> edges);

    /// Replaces the values of free nodes. If all known ones are 0, nothing is computed.
    void extend(std::vector<Point3>& values) const;

private:
    using Matrix = Eigen::SparseMatrix<double>;

    std::vector<std::uint32_t> free_; ///< nodes
    Matrix to_known_; ///< per free node and node: the number of edges to a known one
    std::shared_ptr<Eigen::SimplicialLDLT<Matrix>> factor_; ///< of the Laplacian of free nodes
};

} // namespace terrane::uncertainty::detail
