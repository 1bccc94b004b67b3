// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/carry.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/reading.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

std::optional<Format> to_format(const std::optional<std::string>& name) {
    if (!name) return std::nullopt;
    const auto format = format_named(*name);
    if (!format) refuse(ErrorCode::unknown_format, "no format is called so", "format=" + *name);
    return format;
}

namespace {

py::list read(const py::object& path, const std::optional<std::string>& format, bool depth,
              double max_edge, const std::string& unit, const std::string& columns,
              const HowToRun& how) {
    const std::filesystem::path from = to_path(path);
    const ReadOptions options{
        .depth = depth, .max_edge = max_edge, .unit = unit, .columns = columns};
    return from_surfaces(run_stage(how, [from, options, chosen = to_format(format)](const Run&) {
        return read_surfaces(from, chosen, options);
    }));
}

/// Refuses options of reading that no file makes use of.
void check_all(const std::vector<std::string>& paths, const std::optional<std::string>& format,
               bool depth, double max_edge, const std::string& columns) {
    std::vector<std::optional<Format>> formats;
    for (const std::string& path : paths)
        formats.push_back(format ? to_format(format) : format_to_read(path));
    must(check_reading(formats, {.depth = depth, .max_edge = max_edge, .columns = columns},
                       {"depth", "max_edge", "columns"}));
}

void write(const MeshPointer& mesh, const py::object& path,
           const std::optional<std::string>& format, bool ascii, bool compress,
           const HowToRun& how) {
    const std::filesystem::path to = to_path(path);
    WriteOptions options;
    options.format = to_format(format);
    if (ascii && (options.format ? options.format : format_of(to)) != Format::stl)
        refuse("is for STL files", "ascii");
    options.ascii = ascii;
    options.compress = compress;
    run_stage(how, [mesh, to, options](const Run&) { return write_mesh(mesh->mesh, to, options); });
}

/// Writes surfaces as they are, with their values. Returns the names of values that the format has no place for.
py::list write_surfaces(const py::sequence& surfaces, const py::object& path,
                        const std::optional<std::string>& format, const HowToRun& how) {
    const std::filesystem::path to = to_path(path);
    const auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    const auto chosen = to_format(format);
    run_stage(how, [given, to, chosen](const Run&) {
        const auto values = values_of(*given);
        return write_mesh(concatenate(*given), to, {.format = chosen, .values = values});
    });
    const auto written = chosen ? chosen : format_of(to);
    return to_texts(written ? values_left_out(*written, values_of(*given))
                            : std::vector<std::string>());
}

} // namespace

void bind_files(py::module_& module) {
    module.def("read", &read, "path"_a, "format"_a, "depth"_a, "max_edge"_a, "unit"_a, "columns"_a,
               "how"_a);
    module.def("write_mesh", &write, "mesh"_a, "path"_a, "format"_a, "ascii"_a, "compress"_a,
               "how"_a);
    module.def("write_surfaces", &write_surfaces, "surfaces"_a, "path"_a, "format"_a, "how"_a);
    module.def("check_reading", &check_all, "paths"_a, "format"_a, "depth"_a, "max_edge"_a,
               "columns"_a);
}

} // namespace terrane::python
