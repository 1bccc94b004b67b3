// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/mesh.h>

#include <memory>
#include <utility>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/regions/regions.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/files.hpp>

using namespace terrane::capi::detail;

terrane_mesh::terrane_mesh(terrane::RoundedMesh made, Origin made_from) :
    mesh(made.mesh), proof(made.conforming), rounded(std::move(made)), origin(std::move(made_from)),
    contacts(contacts_of(rounded->report.contacts)) {
    const terrane::RoundingReport& r = rounded->report;
    report.is_conforming = r.clean ? 1 : 0;
    report.rounds = r.rounds;
    report.naive_contacts = r.naive_contacts;
    report.max_move = r.max_move;
    report.surface_deviation = r.surface_deviation;
    report.max_allowed = r.max_allowed;
    report.vanished_length = r.vanished_length;
    report.deviation = r.deviation;
    report.moved_input_vertices = r.moved_input_vertices;
    report.merged_vertices = r.merged_vertices;
    report.collapsed_triangles = r.collapsed_triangles;
    report.vanished = r.vanished.size();
    report.arranged_again = r.arranged_again ? 1 : 0;
}

terrane_regions::terrane_regions(terrane::Regions found) :
    of_triangles(std::move(found.regions_of)) {
    for (const terrane::Region& r : found.regions) {
        array.push_back({r.surface, r.first_triangle, r.triangles, r.area});
        neighbours.push_back(r.neighbours);
    }
}

namespace terrane::capi::detail {

ConformingMesh proven(const terrane_mesh& mesh, const Run& run) {
    if (mesh.proof) return *mesh.proof;
    return must(prove_conforming(*mesh.mesh, run));
}

} // namespace terrane::capi::detail

terrane_code terrane_mesh_from_surfaces(const terrane_surfaces* surfaces, terrane_mesh** out,
                                        terrane_error** error) {
    return produce(out, error, [&] {
        const auto& list = needed(surfaces, "surfaces").list;
        must(terrane::validate(list));
        auto mesh = std::make_unique<terrane_mesh>();
        mesh->mesh = terrane::SharedMesh(terrane::concatenate(list));
        return mesh;
    });
}

terrane_code terrane_mesh_to_surfaces(const terrane_mesh* mesh, terrane_surfaces** out,
                                      terrane_error** error) {
    return produce(out, error, [&] {
        auto surfaces = std::make_unique<terrane_surfaces>();
        surfaces->list = terrane::surfaces_of_mesh(needed(mesh, "mesh").mesh);
        return surfaces;
    });
}

terrane_code terrane_mesh_prove(const terrane_mesh* mesh, const terrane_run* run,
                                terrane_mesh** out, terrane_error** error) {
    return produce(out, error, [&] {
        const terrane_mesh& given = needed(mesh, "mesh");
        auto proof = proven(given, run_of(run));
        auto made = std::make_unique<terrane_mesh>(proof);
        made->rounded = given.rounded;
        made->origin = given.origin;
        made->report = given.report;
        return made;
    });
}

void terrane_mesh_free(terrane_mesh* mesh) {
    release(mesh);
}

int terrane_mesh_is_conforming(const terrane_mesh* mesh) {
    return known(mesh) && mesh->proof ? 1 : 0;
}

size_t terrane_mesh_surface_count(const terrane_mesh* mesh) {
    return known(mesh) ? mesh->mesh->surfaces.size() : 0;
}

const char* terrane_mesh_surface_name(const terrane_mesh* mesh, size_t surface) {
    return surface < terrane_mesh_surface_count(mesh) ? mesh->mesh->surfaces[surface].name.c_str()
                                                      : nullptr;
}

terrane_role terrane_mesh_surface_role(const terrane_mesh* mesh, size_t surface) {
    return surface < terrane_mesh_surface_count(mesh)
               ? static_cast<terrane_role>(mesh->mesh->surfaces[surface].role)
               : TERRANE_ROLE_UNKNOWN;
}

const double* terrane_mesh_vertices(const terrane_mesh* mesh, size_t* vertex_count) {
    return array_of<double>(known(mesh) ? &mesh->mesh->vertices : nullptr, vertex_count);
}

const uint32_t* terrane_mesh_triangles(const terrane_mesh* mesh, size_t* triangle_count) {
    return array_of<uint32_t>(known(mesh) ? &mesh->mesh->triangles : nullptr, triangle_count);
}

terrane_code terrane_mesh_surfaces(const terrane_mesh* mesh, terrane_lists* lists) {
    return give_lists(known(mesh) ? &mesh->mesh->surfaces_of : nullptr, lists);
}

terrane_code terrane_mesh_regions(const terrane_mesh* mesh, terrane_lists* lists) {
    return give_lists(known(mesh) ? &mesh->mesh->regions_of : nullptr, lists);
}

terrane_code terrane_mesh_parents(const terrane_mesh* mesh, terrane_lists* lists) {
    return give_lists(known(mesh) ? &mesh->mesh->parents_of : nullptr, lists);
}

const uint32_t* terrane_mesh_intersection_edges(const terrane_mesh* mesh, size_t* count) {
    return array_of<uint32_t>(known(mesh) ? &mesh->mesh->intersection_edges : nullptr, count);
}

terrane_code terrane_mesh_get_rounding(const terrane_mesh* mesh, terrane_rounding_report* report,
                                       size_t struct_size) {
    return known(mesh) ? give_report(mesh->report, report, struct_size) : TERRANE_BAD_ARGUMENT;
}

const terrane_contact* terrane_mesh_contacts(const terrane_mesh* mesh, size_t* count) {
    return array_of<terrane_contact>(known(mesh) ? &mesh->contacts : nullptr, count);
}

terrane_code terrane_mesh_write(const terrane_mesh* mesh, const char* path,
                                const terrane_write_options* options, terrane_error** error) {
    return call(error, [&] {
        const terrane::Mesh& written = needed(mesh, "mesh").mesh;
        must(terrane::write_mesh(written, needed_file(path), writing_of(options)));
    });
}

terrane_code terrane_find_regions(const terrane_mesh* mesh, const terrane_run* run,
                                  terrane_regions** out, terrane_error** error) {
    return produce(out, error, [&] {
        return std::make_unique<terrane_regions>(
            terrane::find_regions(needed(mesh, "mesh").mesh, run_of(run)));
    });
}

void terrane_regions_free(terrane_regions* regions) {
    release(regions);
}

const terrane_region* terrane_regions_array(const terrane_regions* regions, size_t* count) {
    return array_of<terrane_region>(known(regions) ? &regions->array : nullptr, count);
}

terrane_code terrane_regions_neighbours(const terrane_regions* regions, terrane_lists* lists) {
    return give_lists(known(regions) ? &regions->neighbours : nullptr, lists);
}

terrane_code terrane_regions_of_triangles(const terrane_regions* regions, terrane_lists* lists) {
    return give_lists(known(regions) ? &regions->of_triangles : nullptr, lists);
}
