// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/detail/shapes.hpp>

#include <terrane/algorithms/tetgen/detail/sizes.hpp>

namespace terrane::tetgen::detail {

Result<std::optional<OptimiseReport>> improve_shapes(TetrahedralMesh& tetrahedra, const Mesh& mesh,
                                                     const Volumes& volumes,
                                                     const TetrahedraOptions& options,
                                                     const Run& run) {
    if (!options.optimise) return std::optional<OptimiseReport>();
    const auto sizes = sizes_of(mesh, volumes, options);
    if (!sizes) return sizes.error();
    OptimiseOptions shapes = *options.optimise;
    shapes.may_grow = shapes.may_grow && !sizes->bound_volumes();
    auto report = optimise(tetrahedra, shapes, run);
    if (!report) return report.error();
    return std::optional<OptimiseReport>(*report);
}

} // namespace terrane::tetgen::detail
