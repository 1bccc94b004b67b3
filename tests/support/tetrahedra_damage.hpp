// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Kinds of damage to a filled mesh, each with the defect that the check must name.
#pragma once

#include <functional>
#include <vector>

#include "support/filled.hpp"

namespace test_support {

/// A change that breaks a sound mesh.
struct Damage {
    const char* name;
    TetrahedraDefect expected;            ///< must be among what is found
    std::function<void(Filled&)> inflict; ///< needs a mesh after divide()
    bool needs_outside = false;           ///< is about the outside or its box
};

/// Appends a list to another one.
inline std::vector<Damage> joined(std::vector<Damage> first, const std::vector<Damage>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

/// Damage to places: nodes are moved, doubled, or lost.
std::vector<Damage> damage_to_nodes();

/// Damage to tetrahedra: they are lost, doubled, turned over.
std::vector<Damage> damage_to_tetrahedra();

/// Damage to what faces, blocks and lists say.
std::vector<Damage> damage_to_attributes();

/// Damage to cuts, for meshes with twins.
std::vector<Damage> damage_to_cuts();

} // namespace test_support
