// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/arrangement/known_triangles.hpp>
#include <terrane/algorithms/pipeline/build.hpp>

namespace terrane {

/// Builds as build() does, and shares what its arrangements find with those of other versions of the
/// model, which have most surfaces in common.
Result<Built> build(const Project& project, BuildInput input, KnownTriangles& known,
                    const Run& run = {});

} // namespace terrane
