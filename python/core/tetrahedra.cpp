// SPDX-License-Identifier: LGPL-3.0-or-later
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/report_members.hpp>

#include "fields.hpp"
#include "handles.hpp"
#include "model_handle.hpp"
#include "surfaces.hpp"
#include "tetrahedra_handle.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

/// size_of, size_in: names and lengths.
std::vector<NamedSize> sizes(const py::dict& given, const char* name) {
    std::vector<NamedSize> all;
    for (const auto& [of, length] : given[name].cast<py::dict>())
        all.push_back({{from_text(of), name}, length.cast<double>()});
    return all;
}

Mesher to_mesher(const std::string& name) {
    if (name == "auto") return Mesher::automatic;
    if (name == "tetgen") return Mesher::tetgen;
    if (name == "gmsh") return Mesher::gmsh;
    refuse("is no mesher: auto, tetgen, gmsh", "mesher=" + name);
}

TetrahedraRequest to_request(const py::dict& given) {
    TetrahedraRequest r;
    r.options = options_in<TetrahedraOptions>(given);
    r.options.mesher = to_mesher(given["mesher"].cast<std::string>());
    if (!given["box"].is_none()) {
        const auto box = given["box"].cast<py::sequence>();
        r.options.box = Box3{to_point(box[0]), to_point(box[1])};
    }
    if (!given["optimise"].cast<bool>()) r.options.optimise.reset();
    r.options.helper = to_path(given["helper"]);
    r.options.gmsh_helper = to_path(given["gmsh_helper"]);
    r.size_of = sizes(given, "size_of");
    r.size_in = sizes(given, "size_in");
    for (const py::handle name : given["split"].cast<py::sequence>())
        r.split.push_back({from_text(name), "split"});
    r.outside = given["outside"].cast<bool>();
    return r;
}

TetrahedraPointer fill(const ModelPointer& model, const py::dict& options, const HowToRun& how) {
    return std::make_shared<FilledBlocks>(
        run_stage(how, [model, request = to_request(options)](const Run& run) {
            return fill_blocks(model->model, request, run);
        }));
}

std::vector<std::string> write(const TetrahedraPointer& t, const py::object& path,
                               const std::optional<std::string>& format, bool compress,
                               unsigned order, const HowToRun& how) {
    const std::filesystem::path to = to_path(path);
    WriteOptions options;
    options.compress = compress;
    options.order = order;
    if (format) {
        options.format = format_named(*format);
        if (!options.format)
            refuse(ErrorCode::unknown_format, "no format is called so", "format=" + *format);
    }
    const auto files = run_stage(how, [t, to, options](const Run&) {
        WriteOptions all = options;
        all.block_names = t->block_names;
        return write_tetrahedra_files(t->tetrahedra, to, all);
    });
    std::vector<std::string> names;
    for (const auto& file : files) names.push_back(file.string());
    return names;
}

/// Makes tetrahedra of a state, which is judged as nobody knows where it comes from.
TetrahedraPointer made_of(const py::tuple& state) {
    auto made = std::make_shared<FilledBlocks>();
    TetrahedralMesh& t = made->tetrahedra;
    t.surfaces = to_infos(state[0].cast<py::sequence>());
    t.vertices = copied<Point3>(state[1].cast<py::array>());
    t.tetrahedra = copied<std::array<std::uint32_t, 4>>(state[2].cast<py::array>());
    t.block_of = copied<std::uint32_t>(state[3].cast<py::array>());
    t.faces = copied<Triangle>(state[4].cast<py::array>());
    t.face_triangle = copied<std::uint32_t>(state[5].cast<py::array>());
    t.surfaces_of = copied_lists(state[6].cast<py::tuple>());
    t.twins = copied<std::array<std::uint32_t, 2>>(state[7].cast<py::array>());
    t.block_count = state[8].cast<std::uint32_t>();
    t.mesher = from_text(state[9]);
    for (const py::handle name : state[10].cast<py::sequence>())
        made->block_names.push_back(from_text(name));
    made->added_nodes = state[11].cast<std::size_t>();
    must(validate_indices(t));
    if (t.block_count > made->block_names.size())
        refuse(ErrorCode::bad_index, "there must be a name for each block", "");
    return made;
}

py::list violations(const FilledBlocks& f) {
    return rows(f.report.violations, &TetrahedraViolation::defect, &TetrahedraViolation::count,
                &TetrahedraViolation::first);
}

py::list block_volumes(const FilledBlocks& f) {
    return rows(f.report.volumes, &BlockVolume::block, &BlockVolume::tetrahedra,
                &BlockVolume::difference, &BlockVolume::bound, &BlockVolume::equal);
}

/// What became of the shapes; None: they were left as the mesher made them.
py::object optimised(const FilledBlocks& f) {
    return f.optimised ? py::object(dict_of(*f.optimised)) : py::none();
}

py::dict shape(const FilledBlocks& f) {
    const TetrahedraShape s = shape_of(f.tetrahedra);
    const auto spread = [](const ShapeSpread& v) {
        return py::make_tuple(v.least, v.mean, v.largest);
    };
    return py::dict("dihedral"_a = spread(s.dihedral), "radius_edge"_a = spread(s.radius_edge),
                    "sicn"_a = spread(s.sicn), "mean_ratio"_a = spread(s.mean_ratio));
}

} // namespace

void bind_tetrahedra(py::module_& module) {
    py::class_<FilledBlocks, TetrahedraPointer> bound(module, "Tetrahedra");
    using F = FilledBlocks;
    bound.def(py::init(&made_of), "state"_a)
        .def_property_readonly("surfaces",
                               [](const F& f) { return to_list(f.tetrahedra.surfaces); })
        .def_property_readonly("block_count", [](const F& f) { return f.tetrahedra.block_count; })
        .def_property_readonly("mesher", [](const F& f) { return to_text(f.tetrahedra.mesher); })
        .def_property_readonly("block_names", [](const F& f) { return to_texts(f.block_names); })
        .def_property_readonly("added_nodes", [](const F& f) { return f.added_nodes; })
        .def_property_readonly("violations", &violations)
        .def_property_readonly("block_volumes", &block_volumes)
        .def_property_readonly("is_checked", [](const F& f) { return !f.report.volumes.empty(); })
        .def_property_readonly("optimised", &optimised)
        .def("shape", &shape);
    arrays_of(bound, &F::tetrahedra)
        .add("vertices", &TetrahedralMesh::vertices)
        .add("tetrahedra", &TetrahedralMesh::tetrahedra)
        .add("block_of", &TetrahedralMesh::block_of)
        .add("faces", &TetrahedralMesh::faces)
        .add("face_triangle", &TetrahedralMesh::face_triangle)
        .add("twins", &TetrahedralMesh::twins)
        .add("surfaces_of", &TetrahedralMesh::surfaces_of);
    module.attr("tetrahedra_fields") = described<TetrahedraOptions>();
    module.def("fill_blocks", &fill, "model"_a, "options"_a, "how"_a);
    module.def("write_tetrahedra", &write, "tetrahedra"_a, "path"_a, "format"_a, "compress"_a,
               "order"_a, "how"_a);
}

} // namespace terrane::python
