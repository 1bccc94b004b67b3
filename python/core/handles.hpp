// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What objects of Python hold: values of the library that nobody changes any more, and the functions that add
// them to the module.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <pybind11/pybind11.h>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/io/files.hpp>

#include "arrays.hpp"
#include "stage.hpp"

namespace terrane::python {

/// A mesh, and its proof if it has one.
struct MeshHandle {
    SharedMesh mesh;
    std::optional<ConformingMesh> conforming{};
};
using MeshPointer = std::shared_ptr<MeshHandle>;
using ArrangementPointer = std::shared_ptr<Arrangement>;
using VolumesPointer = std::shared_ptr<Volumes>;

inline MeshPointer handle_of(const SharedMesh& mesh,
                             const std::optional<ConformingMesh>& conforming = std::nullopt) {
    return std::make_shared<MeshHandle>(MeshHandle{mesh, conforming});
}
inline MeshPointer handle_of(const ConformingMesh& mesh) {
    return handle_of(mesh.mesh(), mesh);
}

/// Refuses a number that names none of `count` surfaces, blocks and so on.
inline void require_below(std::uint32_t number, std::size_t count, const char* what) {
    if (number >= count)
        refuse(ErrorCode::bad_index,
               "there is no " + std::string(what) + " " + std::to_string(number), "");
}

/// Returns the format of a name; none for None. Raises unknown_format.
std::optional<Format> to_format(const std::optional<std::string>& name);

/// The numbers of a report on rounding.
py::dict to_dict(const RoundingReport& report);
/// (triangles, kind, place) of each contact.
py::list to_list(const std::vector<ImproperContact>& contacts);
/// A list of regions.
py::list to_list(const std::vector<Region>& regions);

void bind_files(py::module_& module);
void bind_mesh(py::module_& module);
void bind_arrangement(py::module_& module);
void bind_volumes(py::module_& module);
void bind_model(py::module_& module);
void bind_sealing(py::module_& module);
void bind_improve(py::module_& module);
void bind_fill(py::module_& module);
void bind_layers(py::module_& module);
void bind_selection(py::module_& module);
void bind_maps(py::module_& module);
void bind_sections(py::module_& module);
void bind_cells(py::module_& module);
void bind_wells(py::module_& module);
void bind_tetrahedra(py::module_& module);
void bind_verify(py::module_& module);
void bind_judge(py::module_& module);
void bind_project(py::module_& module);
void bind_ensemble(py::module_& module);
void bind_report(py::module_& module);

} // namespace terrane::python
