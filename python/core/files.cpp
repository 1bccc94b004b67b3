// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/io/files.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

std::optional<Format> to_format(const std::optional<std::string>& name) {
    if (!name) return std::nullopt;
    const auto format = format_named(*name);
    if (!format)
        throw Failure{{ErrorCode::unknown_format, "no format is called so", "format=" + *name}};
    return format;
}

py::list read(const py::object& path, const std::optional<std::string>& format, bool depth,
              double max_edge, const std::string& unit, const HowToRun& how) {
    const std::filesystem::path from = to_path(path);
    const ReadOptions options{.depth = depth, .max_edge = max_edge, .unit = unit};
    return from_surfaces(run_stage(how, [from, options, chosen = to_format(format)](const Run&) {
        return read_surfaces(from, chosen, options);
    }));
}

void write(const MeshPointer& mesh, const py::object& path,
           const std::optional<std::string>& format, bool ascii, bool compress,
           const HowToRun& how) {
    const std::filesystem::path to = to_path(path);
    WriteOptions options;
    options.format = to_format(format);
    options.ascii = ascii;
    options.compress = compress;
    run_stage(how, [mesh, to, options](const Run&) { return write_mesh(mesh->mesh, to, options); });
}

} // namespace

void bind_files(py::module_& module) {
    module.def("read", &read, "path"_a, "format"_a, "depth"_a, "max_edge"_a, "unit"_a, "how"_a);
    module.def("write_mesh", &write, "mesh"_a, "path"_a, "format"_a, "ascii"_a, "compress"_a,
               "how"_a);
    module.def(
        "format_of", [](const py::object& path) { return format_of(to_path(path)).has_value(); },
        "path"_a);
}

} // namespace terrane::python
