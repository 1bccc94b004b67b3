// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <pybind11/pybind11.h>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>
#include <terrane/algorithms/structure/block_names.hpp>

namespace terrane::python {

namespace py = pybind11;

/// A model and what it was made of.
struct ModelHandle {
    Model model;
    std::optional<LeakAdvice> leaks{};  ///< none: not judged, as gaps were closed or nothing ends
    std::optional<SealReport> sealed{}; ///< where gaps were closed
    std::optional<VolumeReport> cut{};  ///< with a volume of interest
    std::optional<BlockMerge> merged{}; ///< where small blocks were merged
    std::optional<SealChoice> choice{}; ///< where the distance of sealing was chosen
    std::optional<RoundingReport> rounding{};   ///< how the mesh became doubles
    std::shared_ptr<const Arrangement> exact{}; ///< what was rounded; nullptr: not kept
    std::optional<ConformingMesh> rounded{};    ///< its mesh, before any improvement; with `exact`
    StratigraphicColumn column{};               ///< by which blocks are named
    std::vector<PlausibilityWarning> doubts{};  ///< about the surfaces and the model
};
using ModelPointer = std::shared_ptr<ModelHandle>;

/// Takes the model out of what was built.
ModelPointer model_of(Built& built, bool judges_leaks, const Run& run);

/// A list of (unit, surface, age, erosive).
StratigraphicColumn to_column(const py::sequence& units);

py::dict to_dict(const SealReport& report);

} // namespace terrane::python
