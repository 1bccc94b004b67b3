// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/io/points/well_paths.hpp>
#include <terrane/io/sections/well_text.hpp>

#include "handles.hpp"
#include "model_handle.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

/// Names of blocks, units and surfaces, as lists of Python.
py::dict dict_of_names(const SectionNames& names) {
    py::list blocks, units, surfaces;
    for (const std::string& block : names.blocks) blocks.append(to_text(block));
    for (const std::string& unit : names.units) units.append(to_text(unit));
    for (const SurfaceInfo& surface : names.surfaces) surfaces.append(to_text(surface.name));
    return py::dict("blocks"_a = blocks, "units"_a = units, "surfaces"_a = surfaces);
}

SectionNames names_of_log(const py::dict& given) {
    SectionNames names;
    for (const py::handle one : given["blocks"]) names.blocks.push_back(from_text(one));
    for (const py::handle one : given["units"]) names.units.push_back(from_text(one));
    for (const py::handle one : given["surfaces"]) names.surfaces.push_back({from_text(one)});
    return names;
}

py::tuple tuple_of_point(const Point3& p) {
    return py::make_tuple(p.x, p.y, p.z);
}

Point3 point_of_tuple(const py::handle& given) {
    const auto p = given.cast<std::array<double, 3>>();
    return {p[0], p[1], p[2]};
}

py::dict log_well(const ModelPointer& model, const py::str& name, const py::array& points,
                  const py::array& depths, const HowToRun& how) {
    const WellPath path{from_text(name), copied<Point3>(points), copied<double>(depths)};
    auto made = run_stage(how, [model, path](const Run& run) {
        return log_wells(model->model.mesh, model->model.volumes, std::array{path}, run);
    });
    py::list intervals, markers;
    for (const WellInterval& in : made[0].intervals)
        intervals.append(py::make_tuple(in.from, in.to, tuple_of_point(in.entry),
                                        tuple_of_point(in.exit), in.blocks, in.surfaces));
    for (const WellMarker& m : made[0].markers)
        markers.append(py::make_tuple(m.depth, tuple_of_point(m.point), std::uint32_t(m.surface),
                                      m.before, m.after));
    py::dict values = dict_of_names(names_in(model->model));
    values["name"] = name;
    values["intervals"] = intervals;
    values["markers"] = markers;
    return values;
}

/// Refuses a log whose numbers name nothing, as a changed pickle may have.
void require_numbers(const WellLog& log, const SectionNames& names) {
    if (names.units.size() != names.blocks.size() || log.intervals.empty())
        refuse(ErrorCode::bad_index, "the lists of the log do not belong together", "");
    for (const WellInterval& in : log.intervals) {
        if (in.blocks.empty()) refuse(ErrorCode::bad_index, "an interval has no block", "");
        for (const std::uint32_t b : in.blocks) require_below(b, names.blocks.size(), "block");
        for (const std::uint32_t s : in.surfaces)
            require_below(s, names.surfaces.size(), "surface");
    }
    for (const WellMarker& m : log.markers) {
        require_below(m.surface, names.surfaces.size(), "surface");
        require_below(m.before, log.intervals.size(), "interval");
        require_below(m.after, log.intervals.size(), "interval");
    }
}

void save_log(const py::dict& given, const py::object& file, double step) {
    const auto path = to_path(file);
    const auto format = well_format(path.extension().string());
    if (!format) refuse(ErrorCode::unknown_format, "logs of wells are .csv or .las", path.string());
    if (step > 0 && *format != WellFormat::las) refuse("is for .las files", "step");
    WellLog log{from_text(given["name"]), {}, {}};
    for (const py::handle one : given["intervals"]) {
        const auto v = one.cast<py::tuple>();
        log.intervals.push_back({v[0].cast<double>(), v[1].cast<double>(), point_of_tuple(v[2]),
                                 point_of_tuple(v[3]), v[4].cast<std::vector<std::uint32_t>>(),
                                 v[5].cast<std::vector<std::uint32_t>>()});
    }
    for (const py::handle one : given["markers"]) {
        const auto v = one.cast<py::tuple>();
        log.markers.push_back({v[0].cast<double>(), point_of_tuple(v[1]),
                               SurfaceId(v[2].cast<std::uint32_t>()), v[3].cast<std::uint32_t>(),
                               v[4].cast<std::uint32_t>()});
    }
    const SectionNames names = names_of_log(given);
    require_numbers(log, names);
    must(write_wells(std::array{log}, names, *format, path, step));
}

/// (name, points, depths) of each well of a file; without depths None.
py::list read_wells(const py::object& file, const py::list& given) {
    std::vector<WellHead> heads;
    for (const py::handle one : given) {
        const auto v = one.cast<py::tuple>();
        heads.push_back({from_text(v[0]), point_of_tuple(v[1])});
    }
    const auto path = to_path(file);
    std::ifstream in(path, std::ios::binary);
    if (!in) refuse(ErrorCode::cannot_open, "can't be opened", path.string());
    const std::string contents{std::istreambuf_iterator<char>(in), {}};
    auto read = must(read_well_paths(contents, path.string(), path.stem().string(), heads));
    py::list wells;
    for (WellPath& well : read.paths) {
        const bool has_depths = !well.depths.empty();
        wells.append(py::make_tuple(to_text(well.name), owned(std::move(well.points)),
                                    has_depths ? py::object(owned(std::move(well.depths)))
                                               : py::object(py::none())));
    }
    return wells;
}

} // namespace

void bind_wells(py::module_& module) {
    module.def("log_well", &log_well, "model"_a, "name"_a, "points"_a, "depths"_a, "how"_a);
    module.def("save_log", &save_log, "log"_a, "path"_a, "step"_a);
    module.def("read_wells", &read_wells, "path"_a, "heads"_a);
}

} // namespace terrane::python
