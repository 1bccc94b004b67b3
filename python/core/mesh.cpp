// SPDX-License-Identifier: LGPL-3.0-or-later
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/mesh/carry.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/regions/regions.hpp>
#include <terrane/io/report_members.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

/// Makes a mesh of a state, which is judged as nobody knows where it comes from.
MeshPointer mesh_of(const py::tuple& state) {
    Mesh mesh;
    mesh.surfaces = to_infos(state[0].cast<py::sequence>());
    mesh.vertices = copied<Point3>(state[1].cast<py::array>());
    mesh.triangles = copied<Triangle>(state[2].cast<py::array>());
    mesh.surfaces_of = copied_lists(state[3].cast<py::tuple>());
    mesh.regions_of = copied_lists(state[4].cast<py::tuple>());
    mesh.parents_of = copied_lists(state[5].cast<py::tuple>());
    mesh.intersection_edges = copied<Edge>(state[6].cast<py::array>());
    must(validate_indices(mesh));
    return handle_of(SharedMesh(std::move(mesh)));
}

/// Returns the mesh with a proof, which is made if there is none.
MeshPointer proven(const MeshPointer& handle, const HowToRun& how) {
    if (handle->conforming) return handle;
    return handle_of(run_stage(how, [mesh = handle->mesh](const Run& run) {
        std::vector<std::uint32_t> labels;
        labels.reserve(mesh->triangles.size());
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
            labels.push_back(mesh->surfaces_of[t].empty() ? 0 : mesh->surfaces_of[t].front());
        return prove_conforming(Mesh(*mesh), labels, run);
    }));
}

const Mesh& mesh_in(const MeshHandle& handle) {
    return *handle.mesh;
}

py::dict quality(const MeshPointer& handle, const HowToRun& how) {
    const auto q = run_stage(how, [mesh = handle->mesh](const Run& run) {
        return measure_quality(mesh->vertices, mesh->triangles, run);
    });
    auto all = dict_of(q);
    for (const char* spread : {"q", "smallest_angle", "largest_angle", "edge_length"})
        all[spread]["percentiles"] = all[spread].attr("pop")("percentiles_1_5_50_95_99");
    return all;
}

py::dict check_all(const std::vector<Surface>& surfaces, const HowToRun& how) {
    auto report = run_stage(how, [surfaces](const Run& run) { return check(surfaces, run); });
    py::list edges;
    for (const auto& [a, b] : report.non_manifold_edges)
        edges.append(py::make_tuple(to_tuple(a), to_tuple(b)));
    return py::dict(
        "surfaces"_a = report.surfaces, "triangles"_a = report.triangles,
        "vertices"_a = report.vertices, "first_triangle"_a = owned(report.first_triangle),
        "contacts"_a = to_list(report.contacts), "degenerate"_a = owned(report.degenerate),
        "repeated"_a = owned(report.repeated), "shared"_a = owned(report.shared),
        "non_manifold_edges"_a = edges, "free_border_edges"_a = report.free_border_edges,
        "components"_a = report.components, "clean"_a = report.clean());
}

py::tuple regions(const MeshPointer& handle, const HowToRun& how) {
    auto found =
        run_stage(how, [mesh = handle->mesh](const Run& run) { return find_regions(mesh, run); });
    return py::make_tuple(owned(std::move(found.regions_of.offsets)),
                          owned(std::move(found.regions_of.values)), to_list(found.regions));
}

} // namespace

py::list to_list(const std::vector<ImproperContact>& contacts) {
    return rows(contacts, &ImproperContact::triangles, &ImproperContact::kind,
                &ImproperContact::place);
}

py::list to_list(const std::vector<Region>& regions) {
    return rows(regions, &Region::surface, &Region::first_triangle, &Region::triangles,
                &Region::area, &Region::neighbours);
}

void bind_mesh(py::module_& module) {
    py::class_<MeshHandle, MeshPointer> mesh(module, "Mesh");
    mesh.def(py::init([](const py::tuple& state) { return mesh_of(state); }), "state"_a)
        .def_property_readonly("surfaces",
                               [](const MeshHandle& m) { return to_list(m.mesh->surfaces); })
        .def_property_readonly("is_proven",
                               [](const MeshHandle& m) { return m.conforming.has_value(); });
    arrays_of(mesh, &mesh_in)
        .add("vertices", &Mesh::vertices)
        .add("triangles", &Mesh::triangles)
        .add("intersection_edges", &Mesh::intersection_edges)
        .add("surfaces_of", &Mesh::surfaces_of)
        .add("regions_of", &Mesh::regions_of)
        .add("parents_of", &Mesh::parents_of);
    module.def("proven", &proven, "mesh"_a, "how"_a);
    module.def("quality", &quality, "mesh"_a, "how"_a);
    module.def("regions", &regions, "mesh"_a, "how"_a);
    module.def(
        "check",
        [](const py::sequence& surfaces, const HowToRun& how) {
            return check_all(to_surfaces(surfaces), how);
        },
        "surfaces"_a, "how"_a);
    module.def(
        "surfaces_of_mesh",
        [](const MeshPointer& m, const py::sequence& given) {
            auto surfaces = surfaces_of_mesh(m->mesh);
            const auto sources = to_surfaces(given);
            auto values = carry_values({sources, {}}, m->mesh);
            for (std::size_t s = 0; s < values.size(); ++s)
                surfaces[s].arrays = std::move(values[s]);
            return from_surfaces(std::move(surfaces));
        },
        "mesh"_a, "given"_a);
    module.def(
        "concatenate",
        [](const py::sequence& surfaces) {
            return handle_of(SharedMesh(concatenate(to_surfaces(surfaces))));
        },
        "surfaces"_a);
}

} // namespace terrane::python
