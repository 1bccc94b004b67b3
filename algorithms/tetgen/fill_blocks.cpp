// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/tetgen/detail/shapes.hpp>
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/algorithms/tetrahedra/without_outside.hpp>

namespace terrane {
namespace {

// ---- Names --------------------------------------------------------------------------------------

using SurfaceLabels = std::vector<std::string>; // per surface of the mesh

Error nothing_called(const char* what, const GivenName& named, std::span<const std::string> names) {
    return {ErrorCode::bad_option, not_called(what, named.name, names), named.place};
}

Result<std::vector<std::uint32_t>> surfaces_of(const Model& model, const SurfaceLabels& labels,
                                               const GivenName& named) {
    auto found = surfaces_called(named.name, model.mesh->surfaces, labels);
    if (found.empty()) return nothing_called("surface", named, labels);
    return found;
}

/// Finds a block by its number, else by its name.
Result<std::uint32_t> block_of(const Model& model, const GivenName& named) {
    const auto& all = model.structure.blocks;
    std::uint32_t number = 0;
    const char* const end = named.name.data() + named.name.size();
    const auto [after, failed] = std::from_chars(named.name.data(), end, number);
    if (failed == std::errc() && after == end && number < all.size()) return number;
    const auto at = std::find_if(all.begin(), all.end(),
                                 [&](const ModelBlock& block) { return block.name == named.name; });
    if (at == all.end()) {
        SurfaceLabels names;
        for (const ModelBlock& block : all) names.push_back(block.name);
        return nothing_called("block", named, names);
    }
    return static_cast<std::uint32_t>(at - all.begin());
}

Result<TetrahedraOptions> options_of(const Model& model, const SurfaceLabels& labels,
                                     const TetrahedraRequest& request) {
    const auto& shown = model.number_of;
    TetrahedraOptions options = request.options;
    for (const NamedSize& size : request.size_of) {
        const auto surfaces = surfaces_of(model, labels, size.of);
        if (!surfaces) return surfaces.error();
        for (const std::uint32_t s : surfaces.value())
            options.surface_sizes.push_back({SurfaceId(s), size.edge_length});
    }
    for (const NamedSize& size : request.size_in) {
        const auto block = block_of(model, size.of);
        if (!block) return block.error();
        const auto own = std::find(shown.begin(), shown.end(), block.value());
        if (own == shown.end())
            return Error{ErrorCode::bad_option,
                         fmt::format("block {} is too thin for doubles", block.value()),
                         size.of.place};
        options.block_sizes.push_back(
            {BlockId(static_cast<std::uint32_t>(own - shown.begin())), size.edge_length});
    }
    return options;
}

Result<std::vector<std::uint32_t>> surfaces_to_split(const Model& model,
                                                     const SurfaceLabels& labels,
                                                     const std::vector<GivenName>& split) {
    std::vector<std::uint32_t> all;
    const auto& surfaces = model.mesh->surfaces;
    for (const GivenName& named : split) {
        auto found = surfaces_called(named.name, surfaces, labels);
        if (named.name == "fault")
            for (std::uint32_t s = 0; s < surfaces.size(); ++s)
                if (surfaces[s].role == Role::fault) found.push_back(s);
        if (found.empty())
            return named.name == "fault"
                       ? Error{ErrorCode::bad_option, "no surface has the role fault", named.place}
                       : nothing_called("surface", named, labels);
        all.insert(all.end(), found.begin(), found.end());
    }
    sort_unique(all);
    return all;
}

// ---- Results ------------------------------------------------------------------------------------

/// Gives the blocks of tetrahedra the numbers of the model's blocks.
void renumber(const Model& model, FilledBlocks& filled) {
    const auto& shown = model.number_of;
    const std::size_t count = model.volumes.measures.size();
    for (std::uint32_t& block : filled.tetrahedra.block_of) block = shown[block];
    filled.tetrahedra.block_count = static_cast<std::uint32_t>(count);
    std::vector<BlockVolume> volumes(count);
    for (std::size_t r = 0; r < filled.report.volumes.size(); ++r)
        volumes[shown[r]] = filled.report.volumes[r];
    for (std::size_t r = 0; r < count; ++r) // a block too thin for doubles has nothing to compare
        if (std::find(shown.begin(), shown.end(), r) == shown.end()) volumes[r].equal = true;
    filled.report.volumes = std::move(volumes);
}

/// Removes the outside unless it is wanted, and splits nodes.
Status finish(const TetrahedraRequest& request, std::span<const std::uint32_t> split,
              TetrahedralMesh& mesh, std::size_t& added_nodes) {
    if (!request.outside) mesh = without_outside(std::move(mesh));
    if (mesh.tetrahedra.empty())
        return Error{ErrorCode::nothing_to_do, "there is no closed block to fill", ""};
    if (split.empty()) return Done{};
    auto cut = split_nodes(mesh, split);
    if (!cut) return cut.error();
    added_nodes = cut.value().vertices.size() - mesh.vertices.size();
    mesh = std::move(cut).value();
    return Done{};
}

/// Checks the tetrahedra. If they are sound, improves them and checks them again: nothing of them is
/// trusted, and improving trusts that they are sound.
Status check_and_improve(const Model& model, const TetrahedraRequest& request, const Run& run,
                         StageTimer& timer, FilledBlocks& filled) {
    const Volumes volumes = volumes_as_found(model);
    if (run.progress) run.progress("check tetrahedra", 0);
    filled.report = check_tetrahedra(filled.tetrahedra, model.mesh, volumes);
    if (!filled.report.violations.empty()) return Done{};
    auto options = options_of(model, unique_labels(model.mesh->surfaces), request);
    if (!options) return options.error();
    if (!options->optimise) return Done{};
    options->optimise->outside = options->optimise->outside && request.outside;
    timer.stop();
    auto improved =
        tetgen::detail::improve_shapes(filled.tetrahedra, *model.mesh, volumes, *options, run);
    if (!improved) return improved.error();
    filled.optimised = *improved;
    timer.next("check");
    if (run.progress) run.progress("check tetrahedra", 0);
    filled.report = check_tetrahedra(filled.tetrahedra, model.mesh, volumes);
    return Done{};
}

} // namespace

Result<TetrahedralMesh> make_tetrahedra(const Model& model, const TetrahedraRequest& request,
                                        const Run& run) {
    return guarded("for the tetrahedra", "tetrahedralize", [&]() -> Result<TetrahedralMesh> {
        const StageTimer timer(run, "tetrahedralize");
        if (run.progress) run.progress("tetrahedralize", 0);
        const SurfaceLabels labels = unique_labels(model.mesh->surfaces);
        auto options = options_of(model, labels, request);
        if (!options) return options.error();
        options->optimise.reset(); // fill_blocks() does that
        // A name that does not exist is an error before the work, not after it.
        if (auto split = surfaces_to_split(model, labels, request.split); !split)
            return split.error();
        return tetrahedralize(model.mesh, volumes_as_found(model), *options, timer.inside());
    });
}

Result<std::optional<OptimiseReport>> improve_tetrahedra(const Model& model,
                                                         const TetrahedraRequest& request,
                                                         const OptimiseOptions& steps,
                                                         TetrahedralMesh& made, const Run& run) {
    using Report = std::optional<OptimiseReport>;
    return guarded("for the tetrahedra", "tetrahedralize", [&]() -> Result<Report> {
        auto options = options_of(model, unique_labels(model.mesh->surfaces), request);
        if (!options) return options.error();
        if (!options->optimise) return Report();
        const Volumes volumes = volumes_as_found(model);
        if (!check_tetrahedra(made, model.mesh, volumes).violations.empty()) return Report();
        options->optimise->outside = options->optimise->outside && request.outside;
        options->optimise->freedom = steps.freedom;
        options->optimise->angles = steps.angles;
        options->optimise->shapes = steps.shapes;
        return tetgen::detail::improve_shapes(made, *model.mesh, volumes, *options, run);
    });
}

Result<FilledBlocks> fill_blocks(const Model& model, const TetrahedraRequest& request,
                                 TetrahedralMesh made, const Run& run) {
    return guarded("for the tetrahedra", "tetrahedralize", [&]() -> Result<FilledBlocks> {
        const auto split =
            surfaces_to_split(model, unique_labels(model.mesh->surfaces), request.split);
        if (!split) return split.error();
        FilledBlocks filled;
        filled.tetrahedra = std::move(made);

        StageTimer timer(run, "check");
        if (auto checked = check_and_improve(model, request, run, timer, filled); !checked)
            return checked.error();
        const auto& violations = filled.report.violations;
        if (!violations.empty() && violations.front().defect == TetrahedraDefect::unusable_lists)
            return filled; // nothing can be said about them
        timer.next("split");
        renumber(model, filled);
        if (violations.empty())
            if (auto done = finish(request, *split, filled.tetrahedra, filled.added_nodes); !done)
                return done.error();
        if (violations.empty() && !request.outside)
            filled.report.volumes[0] = {.equal = true};    // its tetrahedra are gone
        filled.report.shape = shape_of(filled.tetrahedra); // of those that are left
        for (const ModelBlock& block : model.structure.blocks)
            filled.block_names.push_back(block.name);
        timer.stop();
        if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "", ""};
        return filled;
    });
}

Result<FilledBlocks> fill_blocks(const Model& model, const TetrahedraRequest& request,
                                 const Run& run) {
    return guarded("for the tetrahedra", "tetrahedralize", [&]() -> Result<FilledBlocks> {
        auto made = make_tetrahedra(model, request, run);
        if (!made) return made.error();
        return fill_blocks(model, request, std::move(*made), run);
    });
}

} // namespace terrane
