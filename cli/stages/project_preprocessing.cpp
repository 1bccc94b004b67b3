// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/project_preprocessing.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/stopwatch.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/reports/fill_report.hpp>
#include <terrane/cli/stages/layer_stage.hpp>
#include <terrane/cli/stages/project_inputs.hpp>

namespace terrane::cli {
namespace {

std::vector<std::uint32_t> called(const std::string& name, const Inputs& inputs) {
    std::vector<SurfaceInfo> infos;
    for (const Surface& s : inputs.surfaces) infos.push_back({s.name, s.role});
    return surfaces_called(name, infos, inputs.labels);
}

FillOptions options_of(const ProjectFill& entry) {
    FillOptions o;
    if (entry.method == "rbf") o.method = FillMethod::rbf;
    o.model = variogram_model_named(entry.model);
    o.max_area = entry.max_area.value_or(o.max_area);
    o.mesh_size = entry.mesh_size.value_or(o.mesh_size);
    o.gap_slope = entry.gap_slope.value_or(o.gap_slope);
    o.bridge = entry.bridge_faults;
    o.smoothing = entry.smoothing;
    return o;
}

Result<std::vector<FillTask>> tasks_of(const Project& project, const std::string& source,
                                       const Inputs& inputs) {
    std::vector<FillTask> tasks;
    for (std::size_t i = 0; i < project.fill.size(); ++i) {
        const ProjectFill& entry = project.fill[i];
        const auto key = fmt::format("fill[{}].surface", i);
        auto found = called(entry.surface, inputs);
        if (found.empty() && entry.surface == "horizon")
            for (std::uint32_t s = 0; s < inputs.surfaces.size(); ++s)
                if (inputs.surfaces[s].role == Role::horizon) found.push_back(s);
        if (found.empty())
            return at_key(source, key,
                          entry.surface == "horizon" ? "no surface has the role horizon"
                                                     : "no surface is called " + entry.surface);
        for (const std::uint32_t s : found) {
            if (std::any_of(tasks.begin(), tasks.end(),
                            [&](const FillTask& t) { return t.surface == s; }))
                return at_key(source, key, inputs.labels[s] + " is in an entry before this one");
            tasks.push_back({s, options_of(entry)});
        }
    }
    return tasks;
}

Result<std::vector<Layer>> order_of(const ProjectLayers& layers, const std::string& source,
                                    const Inputs& inputs) {
    std::vector<Layer> order;
    for (std::size_t i = 0; i < layers.order.size(); ++i) {
        const std::string& name = layers.order[i].surface;
        const auto key = fmt::format("layers.order[{}].surface", i);
        const auto found = called(name, inputs);
        if (found.empty()) return at_key(source, key, "no surface is called " + name);
        if (found.size() > 1)
            return at_key(source, key,
                          fmt::format("{} surfaces are called {}; set a name where they are read",
                                      found.size(), name));
        if (std::any_of(order.begin(), order.end(),
                        [&](const Layer& l) { return l.surface == found[0]; }))
            return at_key(source, key, name + " is in the order twice");
        order.push_back({found[0], layers.order[i].hardness});
    }
    return order;
}

Status fill(const std::vector<FillTask>& tasks, Inputs& inputs, Preprocessed& mended,
            Session& session, Json& statistics) {
    Stopwatch watch;
    session.begin("holes", Phase::computing);
    auto work = find_holes(inputs.surfaces, tasks, session.run());
    if (!work) return work.error();
    if (auto done = fill_holes(inputs.surfaces, wanted_holes(*work), *work, session.run()); !done)
        return done;
    mended.said += borders_text(*work) + filled_text(*work);
    mended.refused = refusals_text(*work);
    const auto contacts = contacts_of_new(*work, session.run());
    session.end_stage();
    if (!contacts) return contacts.error();
    if (!contacts->empty())
        mended.refused +=
            "terrane: what was invented meets other triangles\n" + contacts_text(*work, *contacts);
    for (const HoledSurface& s : work.value().surfaces) inputs.surfaces[s.task.surface] = s.filled;
    statistics["holes"] = json_of(work.value());
    statistics["seconds"]["fill"] = watch.lap();
    mended.filled = std::move(work).value();
    return Done{};
}

Status stack(const std::vector<Layer>& order, double min_thickness, Inputs& inputs,
             Preprocessed& mended, Session& session, Json& statistics) {
    const auto layered =
        layer_inputs(inputs, order, {.min_thickness = min_thickness}, session, statistics);
    if (!layered) return layered.error();
    mended.said += text_of(inputs, layered.value());
    mended.refused = contacts_text(layered.value());
    auto surfaces = surfaces_of(layered.value().rounded.mesh);
    for (std::size_t i = 0; i < order.size(); ++i)
        inputs.surfaces[order[i].surface] = std::move(surfaces[i]);
    return Done{};
}

} // namespace

Result<Preprocessed> mend(const Project& project, const std::string& source, Inputs& inputs,
                          Session& session, Json& statistics) {
    const auto tasks = tasks_of(project, source, inputs);
    if (!tasks) return tasks.error();
    std::vector<Layer> order;
    if (project.layers) {
        auto found = order_of(*project.layers, source, inputs);
        if (!found) return found.error();
        order = std::move(found).value();
    }
    Preprocessed mended;
    if (!tasks.value().empty())
        if (auto done = fill(tasks.value(), inputs, mended, session, statistics); !done)
            return done.error();
    if (!order.empty() && mended.refused.empty())
        if (auto done =
                stack(order, project.layers->min_thickness, inputs, mended, session, statistics);
            !done)
            return done.error();
    return mended;
}

} // namespace terrane::cli
