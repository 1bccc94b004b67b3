// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces between Python and the library. Python's Surface holds one of the library, which was judged when it was made
// and which nobody changes any more. The stages get a copy of it, which is freed when the stage ends.
#pragma once

#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>

namespace terrane::python {

namespace py = pybind11;

std::string_view name_of(Role role);
Role role_named(py::handle name);

/// Copies of a list of surfaces.
std::vector<Surface> to_surfaces(const py::sequence& list);

/// The same back.
py::object from_surface(Surface surface);
py::list from_surfaces(std::vector<Surface> surfaces);

void bind_surface(py::module_& module);

/// A list of (name, role).
py::list to_list(const std::vector<SurfaceInfo>& surfaces);
/// A list of (about, numbers of surfaces, seen, why, answer).
py::list to_list(const std::vector<PlausibilityWarning>& doubts);
std::vector<SurfaceInfo> to_infos(const py::sequence& list);

} // namespace terrane::python
