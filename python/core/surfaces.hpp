// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces between Python and the library. Python's Surface holds NumPy arrays; the stages get a copy of them,
// which is made while the GIL is held and freed when the stage ends.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::python {

namespace py = pybind11;

std::string_view name_of(Role role);
Role role_named(py::handle name);

/// A list of (name, role, vertices, triangles, frame) with arrays of float64 and uint32, and frame =
/// (horizontal_unit, vertical_unit, system, vertical_axis, column_of_depths).
std::vector<Surface> to_surfaces(const py::sequence& list);

/// The same back. The arrays own the memory of the surface.
py::tuple from_surface(Surface surface);
py::list from_surfaces(std::vector<Surface> surfaces);

/// A list of (name, role).
py::list to_list(const std::vector<SurfaceInfo>& surfaces);
std::vector<SurfaceInfo> to_infos(const py::sequence& list);

} // namespace terrane::python
