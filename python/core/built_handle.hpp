// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/io/project.hpp>

#include "model_handle.hpp"
#include "tetrahedra_handle.hpp"

namespace terrane::python {

/// The model of a project, and what it asks to write.
struct BuiltHandle {
    Project project;
    ModelPointer model;
    TetrahedraPointer tetrahedra;  ///< nullptr: the project asks for none
    std::vector<Surface> surfaces; ///< after preprocessing, sealing and so on
    ProjectInputs read{};          ///< what was read, without the surfaces
    std::shared_ptr<const Arranged>
        certified{}; ///< what certificates are about; nullptr: none are wanted
};

/// Keeps what was made of a project. `judges_leaks`: whether it is found which gaps separate blocks.
BuiltHandle built_of(const Project& project, Built made, bool judges_leaks, const Run& run);

} // namespace terrane::python
