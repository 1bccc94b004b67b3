// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/quality/improve.hpp>

namespace terrane::python {

/// Options of improve() of a dict with their names; those that are missing have their defaults.
ImproveOptions to_improve_options(const pybind11::dict& given);

/// The resolution of such a dict; of length 0: none.
Resolution to_resolution(const pybind11::dict& given);

} // namespace terrane::python
