// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/pipeline/build.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/labels.hpp>

namespace terrane {
namespace {

struct Names {
    explicit Names(std::span<const Surface> surfaces) :
        infos(infos_of(surfaces)), labels(unique_labels(infos)) {}

    [[nodiscard]] std::vector<std::uint32_t> called(const std::string& name) const {
        return surfaces_called(name, infos, labels);
    }

    std::vector<SurfaceInfo> infos;
    std::vector<std::string> labels;
};

Result<std::vector<FillTask>> tasks_of(const Project& project, const Names& names) {
    std::vector<FillTask> tasks;
    for (std::size_t i = 0; i < project.fill.size(); ++i) {
        const ProjectFill& entry = project.fill[i];
        const auto key = fmt::format("fill[{}].surface", i);
        auto found = names.called(entry.surface);
        if (found.empty() && (entry.surface == "horizon" || entry.surface.empty()))
            for (std::uint32_t s = 0; s < names.infos.size(); ++s)
                if (entry.surface.empty() || names.infos[s].role == Role::horizon)
                    found.push_back(s);
        if (found.empty())
            return at_key(project, key,
                          entry.surface == "horizon"
                              ? "no surface has the role horizon"
                              : not_called("surface", entry.surface, names.labels));
        for (const std::uint32_t s : found) {
            if (std::any_of(tasks.begin(), tasks.end(),
                            [&](const FillTask& t) { return t.surface == s; }))
                return at_key(project, key, names.labels[s] + " is in an entry before this one");
            tasks.push_back({SurfaceId(s), entry.options});
        }
    }
    return tasks;
}

Result<std::vector<Layer>> order_of(const Project& project, const Names& names) {
    std::vector<Layer> order;
    if (!project.layers) return order;
    for (std::size_t i = 0; i < project.layers->order.size(); ++i) {
        const std::string& name = project.layers->order[i].surface;
        const auto key = fmt::format("layers.order[{}].surface", i);
        auto found = names.called(name);
        if (found.empty()) return at_key(project, key, not_called("surface", name, names.labels));
        if (project.layers->order[i].number) found = {*project.layers->order[i].number};
        if (found.size() != 1)
            return at_key(project, key,
                          fmt::format("{} surfaces are called {}; set a name where they are read",
                                      found.size(), name));
        if (std::any_of(order.begin(), order.end(),
                        [&](const Layer& l) { return l.surface == found[0]; }))
            return at_key(project, key, name + " is in the order twice");
        order.push_back({SurfaceId(found[0]), project.layers->order[i].hardness});
    }
    return order;
}

/// Splits a mesh into its surfaces, each with the vertices that it uses.
std::vector<Surface> surfaces_of(const Mesh& mesh) {
    std::vector<Surface> all;
    std::vector<std::vector<std::uint32_t>> members(mesh.surfaces.size()); // triangles of each
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t s : mesh.surfaces_of[t]) members[s].push_back(t);
    std::vector<std::uint32_t> number(mesh.vertices.size());
    for (std::size_t s = 0; s < members.size(); ++s) {
        all.push_back({mesh.surfaces[s].name, mesh.surfaces[s].role, {}, {}});
        std::vector<bool> used(mesh.vertices.size());
        for (const std::uint32_t t : members[s])
            for (const std::uint32_t v : mesh.triangles[t]) used[v] = true;
        for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
            if (!used[v]) continue;
            number[v] = static_cast<std::uint32_t>(all.back().vertices.size());
            all.back().vertices.push_back(mesh.vertices[v]);
        }
        for (const std::uint32_t t : members[s]) {
            const Triangle& c = mesh.triangles[t];
            all.back().triangles.push_back({number[c[0]], number[c[1]], number[c[2]]});
        }
    }
    return all;
}

/// Tells for each hole whether it is to be filled.
Result<std::vector<bool>> chosen_holes(const Project& project, const FillWork& work) {
    auto chosen = wanted_holes(work);
    if (!project.only_holes) return chosen;
    std::vector<bool> named(chosen.size());
    for (const std::size_t number : *project.only_holes) {
        if (number < 1 || number > named.size())
            return at_key(project, "holes",
                          fmt::format("there is no hole {}, only 1 to {}", number, named.size()));
        named[number - 1] = true;
    }
    for (std::size_t i = 0; i < named.size(); ++i) chosen[i] = chosen[i] && named[i];
    return chosen;
}

Status fill(const std::vector<FillTask>& tasks, const Project& project,
            std::vector<Surface>& surfaces, const Run& run, Preprocessed& done) {
    StageTimer finding(run, "holes");
    auto work = find_holes(surfaces, tasks, finding.inside());
    if (!work) return work.error();
    finding.stop();
    const StageTimer timer(run, "fill");
    const Run inner = timer.inside();
    const auto chosen = chosen_holes(project, *work);
    if (!chosen) return chosen.error();
    if (auto filled = fill_holes(surfaces, *chosen, *work, inner); !filled) return filled;
    auto contacts = contacts_of_new(*work, inner);
    if (!contacts) return contacts.error();
    done.contacts = std::move(*contacts);
    for (const HoledSurface& s : work->surfaces) surfaces[s.task.surface] = s.filled;
    done.filled = std::move(*work);
    return Done{};
}

Status stack(const std::vector<Layer>& order, const Project& project,
             std::vector<Surface>& surfaces, const Run& run, Preprocessed& done) {
    if (run.progress) run.progress("layers", 0);
    const LayerOptions options{.min_thickness = project.layers->min_thickness,
                               .check = project.check,
                               .max_move = project.max_move};
    auto layered = stack_layers(surfaces, order, options, run);
    if (!layered) return layered.error();
    auto replaced = surfaces_of(layered->rounded.mesh);
    for (std::size_t i = 0; i < order.size(); ++i)
        surfaces[order[i].surface] = std::move(replaced[i]);
    done.layered = std::move(*layered);
    return Done{};
}

} // namespace

bool Preprocessed::good() const {
    const bool all_filled =
        !filled || std::all_of(filled->holes.begin(), filled->holes.end(),
                               [](const NumberedHole& hole) { return hole.refused.empty(); });
    return all_filled && contacts.empty() && (!layered || layered->is_stack());
}

Result<Preprocessed> preprocess(const Project& project, std::vector<Surface>& surfaces,
                                const Run& run) {
    return guarded("for the model", "build", [&]() -> Result<Preprocessed> {
        const Names names(surfaces);
        const auto tasks = tasks_of(project, names);
        if (!tasks) return tasks.error();
        const auto order = order_of(project, names);
        if (!order) return order.error();
        Preprocessed done;
        done.order = *order;
        if (!tasks->empty())
            if (auto filled = fill(*tasks, project, surfaces, run, done); !filled)
                return filled.error();
        if (!order->empty() && done.good())
            if (auto stacked = stack(*order, project, surfaces, run, done); !stacked)
                return stacked.error();
        return done;
    });
}

} // namespace terrane
