// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <terrane/algorithms/structure/structure.hpp>

namespace terrane::python {

/// The boundary representation as lists of tuples.
pybind11::dict to_dict(const Structure& structure);

} // namespace terrane::python
