// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>

#include <terrane/algorithms/tetgen/tetrahedra.hpp>

namespace terrane::python {

/// Tetrahedra with the report of their check.
using TetrahedraPointer = std::shared_ptr<FilledBlocks>;

} // namespace terrane::python
