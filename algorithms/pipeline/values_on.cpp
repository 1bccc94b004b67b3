// SPDX-License-Identifier: LGPL-3.0-or-later
#include <utility>

#include <terrane/algorithms/mesh/carry.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/pipeline/build.hpp>

namespace terrane {
namespace {

/// The sources of values on meshes of the arranged surfaces.
class BuiltSources {
public:
    explicit BuiltSources(const Built& built) : built_(built) {
        for (const SurfaceGrowth& g : built.arranged.growth) filled_.push_back(g.given);
    }
    [[nodiscard]] ValueSources operator()() const {
        return {built_.given, built_.arranged.surfaces, filled_};
    }

private:
    const Built& built_;
    std::vector<std::size_t>
        filled_; ///< per surface: its given triangles and those that fill holes
};

} // namespace

std::vector<Surface> with_values(std::vector<Surface>& surfaces) {
    std::vector<Surface> given;
    if (!have_values(surfaces)) return given;
    given.resize(surfaces.size());
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        if (surfaces[s].arrays.empty()) continue;
        given[s].vertices = surfaces[s].vertices;
        given[s].triangles = surfaces[s].triangles;
        given[s].arrays = std::exchange(surfaces[s].arrays, {});
    }
    return given;
}

std::vector<SurfaceValues> values_on(const Built& built, const Mesh& mesh) {
    return carry_values(BuiltSources(built)(), mesh);
}

std::vector<SurfaceValues> values_on(const Built& built, const TetrahedralMesh& tetrahedra) {
    const Mesh& mesh =
        built.improved ? *built.improved->improved.mesh : *built.arranged.rounded.mesh;
    return carry_values(BuiltSources(built)(), mesh, tetrahedra);
}

std::vector<SurfaceValues> values_on_preprocessed(const Built& built) {
    const Preprocessed& done = built.preprocessed;
    std::vector<Surface> given, parents;
    const auto give = [&](std::size_t s) {
        given.push_back(s < built.given.size() ? built.given[s] : Surface());
    };
    if (done.layered) {
        for (const Layer& layer : done.order) give(layer.surface);
        return carry_values({given, {}}, done.layered->rounded.mesh);
    }
    if (!done.filled || built.given.empty()) return {};
    for (const HoledSurface& s : done.filled->surfaces) {
        give(s.task.surface);
        parents.push_back(s.filled);
    }
    return carry_values({given, parents}, concatenate(parents));
}

} // namespace terrane
