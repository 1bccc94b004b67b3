// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/certificate.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/certify.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/results.hpp>
#include <terrane/io/text/utf8.hpp>

namespace terrane::capi::detail {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void unfit(const char* sentence, const char* member) {
    refuse(sentence, std::string("certified.") + member);
}

std::vector<SourceFile> files_of(const terrane_input_file* files, std::size_t count,
                                 const char* member) {
    need_array(files, count, member);
    std::vector<SourceFile> sources;
    for (const terrane_input_file& file : std::span(files, count))
        sources.push_back({needed_file(file.path), file.surface_count});
    return sources;
}

/// Returns the name of an output's format in certificates.
std::string format_in(const terrane_output_file& file) {
    std::string given = file.format ? file.format : "";
    if (given == "stl-ascii") return given;
    const fs::path path = needed_file(file.path);
    const auto format = given.empty() ? format_of(path) : format_named(given);
    if (!format) refuse(ErrorCode::unknown_format, "no format has this name", path.string());
    auto name = certified_format(*format);
    if (name.empty())
        refuse(ErrorCode::unsupported,
               "a certificate cannot be about a file in this format, which terrane verify "
               "does not judge",
               path.string());
    return name;
}

std::vector<ResultFile> outputs_of(const terrane_certified& given) {
    need_array(given.outputs, given.output_count, "certified.outputs");
    std::vector<ResultFile> files;
    if (given.model_folder)
        files = terrane::outputs_of(given.model->model, given.model_folder,
                                    given.part_format ? given.part_format : automatic_parts);
    for (const terrane_output_file& file : std::span(given.outputs, given.output_count))
        files.push_back({file.path, format_in(file)});
    return files;
}

/// Checks what a certificate states of the surfaces, of which the last ones are the boundary.
void check_surfaces(const terrane_certified& given, std::span<const Surface> surfaces,
                    std::span<const SourceFile> inputs) {
    if (given.boundary_count > surfaces.size())
        unfit("is more than there are surfaces", "boundary_count");
    std::size_t read = given.boundary_count;
    for (const SourceFile& file : inputs) {
        if (file.surfaces > surfaces.size() - read)
            unfit("have more surfaces than `surfaces`", "inputs");
        read += file.surfaces;
    }
    if (read != surfaces.size()) unfit("have fewer surfaces than `surfaces`", "inputs");
    for (const Surface& surface : surfaces)
        if (!terrane::detail::is_utf8(surface.name))
            unfit("have a name that is not UTF-8, which a certificate cannot state", "surfaces");
}

/// Checks that the arrangement can be one of these surfaces, and that the rounded mesh is its own.
void check_arranged(const terrane_arrangement& arrangement, const terrane_mesh& rounded,
                    std::span<const Surface> surfaces) {
    std::size_t vertices = 0, triangles = 0;
    for (const Surface& s : surfaces) {
        vertices += s.vertices.size();
        triangles += s.triangles.size();
    }
    const Arrangement& exact = *arrangement.exact;
    if (vertices != exact.input_vertices().size() || triangles != exact.input_corners().size() ||
        surfaces.size() != exact.surfaces.size())
        unfit("are not the surfaces that were arranged", "surfaces");
    if (!rounded.rounded || rounded.origin != arrangement.identity)
        unfit("is not what this arrangement was rounded to", "rounded");
    if (!rounded.proof)
        refuse(ErrorCode::improper_contact, "the rounded mesh is not conforming",
               "certified.rounded");
}

/// Returns the volume of interest; monostate without a boundary.
ProjectVolume volume_of(const terrane_certified& given) {
    if (given.boundary_count == 0) return ProjectVolume();
    if (given.corner_count > 0) {
        ProjectPolygon prism{{}, {given.low, given.high}};
        for (std::size_t c = 0; c < given.corner_count; ++c)
            prism.corners.push_back({given.corners[2 * c], given.corners[2 * c + 1]});
        return ProjectVolume(std::move(prism));
    }
    const auto files =
        files_of(given.volume_files, given.volume_file_count, "certified.volume_files");
    if (files.empty()) return ProjectVolume(RotatedBox{});
    ProjectWithin within;
    for (const SourceFile& source : files) {
        const auto read = must(read_surfaces(source.file));
        if (read.size() != source.surfaces)
            unfit("have another number of surfaces than is stated", "volume_files");
        within.files.push_back(source.file);
    }
    return ProjectVolume(std::move(within));
}

/// Returns what was added to the surfaces of the inputs.
std::vector<SurfaceGrowth> growth_of(const terrane_certified& given,
                                     std::span<const Surface> surfaces) {
    need_array(given.growth, given.growth_count, "certified.growth");
    std::vector<SurfaceGrowth> growth;
    if (given.growth_count == 0) return growth;
    if (given.growth_count != surfaces.size() - given.boundary_count)
        unfit("needs an entry for each surface of the inputs", "growth");
    for (std::size_t s = 0; s < given.growth_count; ++s) {
        const auto& [own, extended] = given.growth[s];
        const std::size_t all = surfaces[s].triangles.size();
        if (own > extended || extended > all || surfaces[s].vertices.size() < 3 * (all - own))
            unfit("counts more triangles than the surface has", "growth");
        growth.push_back({own, extended});
    }
    return growth;
}

/// Checks that the handles which were made of the rounded mesh are of this one.
void check_made(const terrane_certified& given, const terrane_mesh& rounded) {
    if (given.improved && &*needed(given.improved, "certified.improved").before != &*rounded.mesh)
        unfit("was not made from this rounded mesh", "improved");
    if (given.tetrahedra && !given.model) unfit("need their model", "tetrahedra");
    if (given.model_folder && (!given.model || given.tetrahedra))
        unfit("is for a model without tetrahedra", "model_folder");
    if (!given.model) return;
    if (given.improved) unfit("blocks of an improved mesh have no certificate", "improved");
    const Mesh& mesh = needed(given.model, "certified.model").model.mesh;
    if (mesh.triangles != rounded.mesh->triangles || mesh.vertices != rounded.mesh->vertices)
        unfit("is not of this rounded mesh", "model");
    if (!given.tetrahedra) return;
    for (const std::uint32_t face :
         needed(given.tetrahedra, "certified.tetrahedra").filled.tetrahedra.face_triangle)
        if (face != TERRANE_NONE && face >= mesh.triangles.size())
            unfit("are not in this model", "tetrahedra");
}

/// Adds what has a rounded mesh; `growth` is kept by the caller.
void add_arranged(const terrane_certified& given, std::vector<SurfaceGrowth>& growth,
                  CertifiedResult& result) {
    const auto& arrangement = needed(given.arrangement, "certified.arrangement");
    const auto& rounded = needed(given.rounded, "certified.rounded");
    check_arranged(arrangement, rounded, result.surfaces);
    check_made(given, rounded);
    result.volume = volume_of(given);
    growth = growth_of(given, result.surfaces);
    result.exact = &*arrangement.exact;
    result.rounded = &*rounded.rounded;
    if (given.improved) result.improved = &given.improved->improved;
    if (given.model) result.model = &given.model->model;
    if (given.tetrahedra) result.tetrahedra = &given.tetrahedra->filled.tetrahedra;
    result.boundary_count = given.boundary_count;
    result.growth = growth;
}

void add_filled(const terrane_certified& given, CertifiedResult& result) {
    const terrane_holes& holes = needed(given.holes, "certified.holes");
    if (holes.work.surfaces.size() != result.surfaces.size())
        unfit("need a task for each of `surfaces`", "holes");
    for (std::size_t s = 0; s < result.surfaces.size(); ++s) {
        const HoledSurface& done = holes.work.surfaces[s];
        if (done.task.surface != s || done.given_triangles != result.surfaces[s].triangles.size())
            unfit("are not those of `surfaces`, in their order", "holes");
        result.filled.push_back({&holes.surfaces.list[s], done.given_vertices, done.given_triangles,
                                 done.interpolated, done.deviation});
    }
}

/// Adds a stack; `order` is kept by the caller.
void add_layered(const terrane_certified& given, std::vector<Layer>& order,
                 CertifiedResult& result) {
    const Layered& layered = needed(given.layered, "certified.layered").layered;
    if (!layered.is_stack())
        refuse(ErrorCode::improper_contact, "the layers are no stack", "certified.layered");
    for (const terrane_layer& layer : std::span(given.layers, given.layer_count))
        order.push_back({SurfaceId(layer.surface), layer.hardness});
    const auto fits = [](const Layer& layer, const LayerReport& report) {
        return layer.surface == report.surface;
    };
    if (!std::ranges::equal(order, layered.reports, fits))
        unfit("are not those of the stack", "layers");
    result.layered = &layered;
    result.order = order;
}

/// Refuses members that would be ignored.
void check_use(const terrane_certified& given) {
    need_array(given.layers, given.layer_count, "certified.layers");
    need_array(given.corners, given.corner_count, "certified.corners");
    need_array(given.volume_files, given.volume_file_count, "certified.volume_files");
    if (given.part_format && !given.model_folder) unfit("needs model_folder", "part_format");
    if (given.layers && !given.layered) unfit("needs layered", "layers");
    if ((given.low != 0 || given.high != 0) && !given.corners) unfit("needs corners", "low");
}

std::string text_of(const terrane_certified& given, const fs::path& path, const Run& run) {
    check_use(given);
    CertifiedResult result;
    result.surfaces = needed(given.surfaces, "certified.surfaces").list;
    result.inputs = files_of(given.inputs, given.input_count, "certified.inputs");
    check_surfaces(given, result.surfaces, result.inputs);
    if (given.holes && given.layered) unfit("a certificate is about one result", "layered");
    if (given.model_folder && !given.model) unfit("needs the model", "model_folder");
    const bool is_rounded = !given.holes && !given.layered;
    if (!is_rounded && (given.boundary_count > 0 || given.growth_count > 0))
        unfit("filled surfaces and layers have no volume of interest", "boundary_count");
    std::vector<SurfaceGrowth> growth;
    std::vector<Layer> order;
    if (given.holes)
        add_filled(given, result);
    else if (given.layered)
        add_layered(given, order, result);
    else
        add_arranged(given, growth, result);
    result.outputs = outputs_of(given);
    return must(certify(result, path, run));
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_code terrane_certified_init(terrane_certified* certified, size_t struct_size) {
    return init_options(certified, struct_size, terrane_certified{});
}

terrane_code terrane_write_certificate(const char* path, const terrane_certified* certified,
                                       const terrane_run* run, terrane_error** error) {
    return call(error, [&] {
        const std::filesystem::path file = needed_file(path);
        if (!certified) throw BadArgument{"certified", "is null"};
        const auto given = options_of(certified, terrane_certified{});
        must(terrane::write_file(file, text_of(given, file, run_of(run))));
    });
}
