// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Preprocesses the surfaces of a project before they are arranged: fills holes, then puts horizons
// in order.
#pragma once

#include <optional>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/project/project.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>

namespace terrane {

/// The reports of preprocess().
struct Preprocessed {
    std::optional<FillWork> filled{};   ///< where the project has "fill"
    std::vector<NewContact> contacts{}; ///< of fillings with other triangles of their surface
    std::vector<Layer> order{};         ///< the layers of the project, from the top down
    std::optional<Layered> layered{};   ///< their stack, if filling succeeded

    /// Tells whether the surfaces can be used: no wanted hole stays open, no filling meets other
    /// triangles, and the stack of layers is conforming and in order.
    [[nodiscard]] bool good() const;
};

/// Fills the holes and orders the layers of a project. Replaced surfaces keep their names and
/// roles. A triangle in which layers coincide belongs to each of them. If filling fails, layers
/// stay unchanged. Errors: bad_option, with the key, for a name that no surface has or that two
/// entries share; those of find_border_loops, fill_holes and stack_layers.
Result<Preprocessed> preprocess(const Project& project, std::vector<Surface>& surfaces,
                                const Run& run = {});

} // namespace terrane
