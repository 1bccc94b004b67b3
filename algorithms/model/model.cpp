// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/model.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/structure/build_structure.hpp>

namespace terrane {
namespace {

/// Returns the names that are given to the exact blocks.
GivenNames names_given(const Arrangement& arrangement, const Volumes& exact,
                       const BlockNaming& naming) {
    GivenNames given{.column = naming.column};
    if (naming.stated.empty()) return given;
    for (const std::uint32_t r : match_blocks(arrangement, exact, naming.stated)) {
        given.stated.push_back(r == no_index ? "" : naming.stated[r].name);
        given.layers.push_back(r == no_index ? "" : naming.stated[r].layer);
    }
    return given;
}

/// Adds what follows from the volumes: structure, free borders and times.
Result<Model> finished(Model model, const GivenNames& given, const Run& run) {
    StageTimer timer(run, "structure");
    auto structure = build_structure(model.mesh, model.volumes, run);
    if (!structure) return structure.error();
    model.structure = std::move(structure).value();
    if (!given.column.empty() || !given.stated.empty())
        name_blocks(model.mesh, model.volumes, given, model.structure);
    timer.next("free borders");
    model.borders = find_free_borders(model.mesh, model.structure);
    timer.stop();
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    return model;
}

/// Gives the volumes of the mesh the numbers of their matches. Those without a match come last.
void number(const Volumes& found, const std::vector<std::uint32_t>& match, Model& model) {
    const std::size_t count = model.exact_volumes.size();
    model.made = static_cast<std::size_t>(std::count(match.begin(), match.end(), UINT32_MAX));
    model.lost = count - (match.size() - model.made);
    model.volumes = renumbered(found, match, count);
    model.number_of = match;
    auto next = static_cast<std::uint32_t>(count);
    for (std::uint32_t& n : model.number_of) // the same numbers as from renumbered()
        if (n == UINT32_MAX) n = next++;
}

/// Returns the volumes' own numbers, in order.
std::vector<std::uint32_t> own_numbers(const Volumes& volumes) {
    std::vector<std::uint32_t> numbers(volumes.measures.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

} // namespace

Result<Model> make_model(const Arrangement& arrangement, const ConformingMesh& mesh, const Run& run,
                         const BlockNaming& naming) {
    return guarded("for the model", "model", [&]() -> Result<Model> {
        StageTimer timer(run, "volumes");
        const Run inner = timer.inside();
        const auto exact = find_volumes(arrangement, inner);
        if (!exact) return exact.error();
        const auto rounded = find_volumes(mesh, inner);
        if (!rounded) return rounded.error();
        Model model{.mesh = mesh, .exact_volumes = exact->measures, .total_volume = exact->total};
        number(*rounded, match_volumes(arrangement, *exact, mesh, *rounded), model);
        const GivenNames given = names_given(arrangement, *exact, naming);
        timer.stop();
        return finished(std::move(model), given, run);
    });
}

Result<Model> make_model(const Arrangement& arrangement, const ConformingMesh& rounded,
                         const Improved& improved, const Run& run, const BlockNaming& naming) {
    return guarded("for the model", "model", [&]() -> Result<Model> {
        StageTimer timer(run, "volumes");
        Model model{.mesh = improved.conforming.value()};
        if (!improved.report.sides_kept) {
            model.exact_volumes = improved.volumes.measures;
            model.total_volume = improved.volumes.total;
            number(improved.volumes, own_numbers(improved.volumes), model);
            timer.stop();
            return finished(std::move(model), {.column = naming.column}, run);
        }
        const auto exact = find_volumes(arrangement, timer.inside());
        if (!exact) return exact.error();
        const auto of_rounded =
            match_volumes(arrangement, *exact, rounded, improved.volumes_before);
        std::vector<std::uint32_t> match;
        for (const std::uint32_t before : improved.volume_before)
            match.push_back(of_rounded[before]);
        model.exact_volumes = exact->measures;
        model.total_volume = improved.volumes.total;
        number(improved.volumes, match, model);
        for (std::size_t v = 0; v < match.size(); ++v)
            if (match[v] != UINT32_MAX)
                model.exact_volumes[match[v]] = improved.volumes.measures[v];
        const GivenNames given = names_given(arrangement, *exact, naming);
        timer.stop();
        return finished(std::move(model), given, run);
    });
}

Volumes volumes_as_found(const Model& model) {
    std::vector<std::uint32_t> found(model.volumes.measures.size());
    Volumes out = model.volumes;
    out.measures.clear();
    for (std::uint32_t v = 0; v < model.number_of.size(); ++v) {
        found[model.number_of[v]] = v;
        out.measures.push_back(model.volumes.measures[model.number_of[v]]);
    }
    for (auto& sides : out.of_sides) sides = {found[sides[0]], found[sides[1]]};
    return out;
}

} // namespace terrane
