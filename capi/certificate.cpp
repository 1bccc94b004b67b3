// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/certificate.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/block_certificate.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/model_folder.hpp>
#include <terrane/io/text/utf8.hpp>

namespace terrane::capi::detail {
namespace {

namespace fs = std::filesystem;

Error unfit(const char* sentence, const char* member) {
    return {ErrorCode::bad_option, sentence, std::string("certified.") + member};
}

Result<std::string> name_in(const fs::path& certificate, const char* path) {
    const fs::path file = needed_file(path);
    auto name = certified_name(file, certificate);
    if (!terrane::detail::is_utf8(name))
        return Error{ErrorCode::bad_option,
                     "a certificate cannot name this file, as its path is not UTF-8",
                     file.string()};
    return name;
}

Result<std::vector<InputRecord>> records_of(const terrane_input_file* files, std::size_t count,
                                            const char* member, const fs::path& certificate) {
    need_array(files, count, member);
    std::vector<InputRecord> records;
    for (const terrane_input_file& file : std::span(files, count)) {
        auto name = name_in(certificate, file.path);
        if (!name) return name.error();
        auto record = record_input(file.path, *std::move(name), file.surface_count);
        if (!record) return record.error();
        records.push_back(*std::move(record));
    }
    return records;
}

/// Returns the name of an output's format in certificates.
Result<std::string> format_in(const terrane_output_file& file) {
    const std::string given = file.format ? file.format : "";
    if (given == "stl-ascii") return given;
    const fs::path path = needed_file(file.path);
    const auto format = given.empty() ? format_of(path) : format_named(given);
    if (!format) return Error{ErrorCode::unknown_format, "no format has this name", path.string()};
    auto name = certified_format(*format);
    if (name.empty())
        return Error{ErrorCode::unsupported,
                     "a certificate cannot be about a file in this format, which terrane verify "
                     "does not read",
                     path.string()};
    return name;
}

Result<OutputRecord> output_of(const char* path, std::string format,
                               const std::vector<SurfaceInfo>& surfaces,
                               const fs::path& certificate) {
    auto name = name_in(certificate, path);
    if (!name) return name.error();
    const auto contents = read_file(path);
    if (!contents) return contents.error();
    return record_output(*contents, *std::move(name), std::move(format), surfaces);
}

Result<std::vector<OutputRecord>> outputs_of(const terrane_certified& given,
                                             const std::vector<SurfaceInfo>& surfaces,
                                             const fs::path& certificate) {
    need_array(given.outputs, given.output_count, "certified.outputs");
    std::vector<OutputRecord> records;
    if (given.model_folder)
        for (const ModelFile& file : model_files(
                 given.model->model, given.part_format ? given.part_format : automatic_parts)) {
            auto record = output_of((fs::path(given.model_folder) / file.path).c_str(), file.format,
                                    surfaces, certificate);
            if (!record) return record.error();
            records.push_back(*std::move(record));
        }
    for (const terrane_output_file& file : std::span(given.outputs, given.output_count)) {
        auto format = format_in(file);
        if (!format) return format.error();
        auto record = output_of(file.path, *std::move(format), surfaces, certificate);
        if (!record) return record.error();
        records.push_back(*std::move(record));
    }
    return records;
}

/// Checks what a certificate states of the surfaces, of which the last ones are the boundary.
Status check_surfaces(const terrane_certified& given, std::span<const Surface> surfaces,
                      std::span<const InputRecord> inputs) {
    if (given.boundary_count > surfaces.size())
        return unfit("is more than there are surfaces", "boundary_count");
    std::size_t read = given.boundary_count;
    for (const InputRecord& file : inputs) {
        if (file.surfaces > surfaces.size() - read)
            return unfit("have more surfaces than `surfaces`", "inputs");
        read += file.surfaces;
    }
    if (read != surfaces.size()) return unfit("have fewer surfaces than `surfaces`", "inputs");
    for (const Surface& surface : surfaces)
        if (!terrane::detail::is_utf8(surface.name))
            return unfit("have a name that is not UTF-8, which a certificate cannot state",
                         "surfaces");
    return Done{};
}

/// Checks that the arrangement can be one of these surfaces, and that the rounded mesh is its own.
Status check_arranged(const terrane_arrangement& arrangement, const terrane_mesh& rounded,
                      std::span<const Surface> surfaces) {
    std::size_t vertices = 0, triangles = 0;
    for (const Surface& s : surfaces) {
        vertices += s.vertices.size();
        triangles += s.triangles.size();
    }
    const Arrangement& exact = *arrangement.exact;
    if (vertices != exact.input_vertices().size() || triangles != exact.input_corners().size() ||
        surfaces.size() != exact.surfaces.size())
        return unfit("are not the surfaces that were arranged", "surfaces");
    if (!rounded.rounded || rounded.origin != arrangement.identity)
        return unfit("is not what this arrangement was rounded to", "rounded");
    if (!rounded.proof)
        return Error{ErrorCode::improper_contact, "the rounded mesh is not conforming",
                     "certified.rounded"};
    return Done{};
}

/// Returns the volume of interest; none without a boundary.
Result<std::optional<VolumeRecord>> volume_of(const terrane_certified& given,
                                              const fs::path& certificate) {
    if (given.boundary_count == 0) return std::optional<VolumeRecord>();
    need_array(given.corners, given.corner_count, "certified.corners");
    if (given.corner_count > 0) {
        VolumeRecord prism;
        for (std::size_t c = 0; c < given.corner_count; ++c)
            prism.corners.push_back({given.corners[2 * c], given.corners[2 * c + 1]});
        if (prism.corners.front() == prism.corners.back()) prism.corners.pop_back();
        prism.between = {std::min(given.low, given.high), std::max(given.low, given.high)};
        return std::optional(std::move(prism));
    }
    VolumeRecord record{given.volume_file_count > 0 ? "surface" : "hexahedron"};
    auto files = records_of(given.volume_files, given.volume_file_count, "certified.volume_files",
                            certificate);
    if (!files) return files.error();
    record.files = *std::move(files);
    for (std::size_t f = 0; f < record.files.size(); ++f) {
        auto read = read_surfaces(given.volume_files[f].path);
        if (!read) return read.error();
        if (read->size() != record.files[f].surfaces)
            return unfit("have another number of surfaces than is stated", "volume_files");
        std::ranges::move(*read, std::back_inserter(record.surfaces));
    }
    return std::optional(std::move(record));
}

/// Returns what was added to the surfaces of the inputs.
Result<std::vector<SurfaceGrowth>> growth_of(const terrane_certified& given,
                                             std::span<const Surface> surfaces) {
    need_array(given.growth, given.growth_count, "certified.growth");
    std::vector<SurfaceGrowth> growth;
    if (given.growth_count == 0) return growth;
    if (given.growth_count != surfaces.size() - given.boundary_count)
        return unfit("needs an entry for each surface of the inputs", "growth");
    for (std::size_t s = 0; s < given.growth_count; ++s) {
        const auto& [own, extended] = given.growth[s];
        const std::size_t all = surfaces[s].triangles.size();
        if (own > extended || extended > all || surfaces[s].vertices.size() < 3 * (all - own))
            return unfit("counts more triangles than the surface has", "growth");
        growth.push_back({own, extended});
    }
    return growth;
}

/// Returns the surfaces as the output files call them.
const std::vector<SurfaceInfo>& names_of(const terrane_certified& given,
                                         const terrane_mesh& rounded) {
    if (given.tetrahedra) return given.tetrahedra->filled.tetrahedra.surfaces;
    if (given.model) return given.model->model.mesh->surfaces;
    return given.improved ? given.improved->improved.mesh->surfaces : rounded.mesh->surfaces;
}

/// Checks that the handles which were made of the rounded mesh are of this one.
Status check_made(const terrane_certified& given, const terrane_mesh& rounded) {
    if (given.improved && &*needed(given.improved, "certified.improved").before != &*rounded.mesh)
        return unfit("was not made from this rounded mesh", "improved");
    if (given.tetrahedra && !given.model) return unfit("need their model", "tetrahedra");
    if (given.model_folder && (!given.model || given.tetrahedra))
        return unfit("is for a model without tetrahedra", "model_folder");
    if (!given.model) return Done{};
    if (given.improved) return unfit("blocks of an improved mesh have no certificate", "improved");
    const Mesh& mesh = needed(given.model, "certified.model").model.mesh;
    if (mesh.triangles != rounded.mesh->triangles || mesh.vertices != rounded.mesh->vertices)
        return unfit("is not of this rounded mesh", "model");
    if (!given.tetrahedra) return Done{};
    for (const std::uint32_t face :
         needed(given.tetrahedra, "certified.tetrahedra").filled.tetrahedra.face_triangle)
        if (face != TERRANE_NONE && face >= mesh.triangles.size())
            return unfit("are not in this model", "tetrahedra");
    return Done{};
}

/// Makes the text of what has a rounded mesh.
Result<std::string> arranged_text(const terrane_certified& given, const fs::path& path,
                                  std::span<const InputRecord> inputs, const Run& run) {
    const auto& arrangement = needed(given.arrangement, "certified.arrangement");
    const auto& rounded = needed(given.rounded, "certified.rounded");
    const std::span<const Surface> surfaces = given.surfaces->list;
    if (auto fit = check_arranged(arrangement, rounded, surfaces); !fit) return fit.error();
    if (auto fit = check_made(given, rounded); !fit) return fit.error();
    const auto outputs = outputs_of(given, names_of(given, rounded), path);
    if (!outputs) return outputs.error();
    const auto volume = volume_of(given, path);
    if (!volume) return volume.error();
    const auto growth = growth_of(given, surfaces);
    if (!growth) return growth.error();
    Certified certified{inputs, surfaces, *arrangement.exact, &*rounded.rounded, *outputs};
    const CutRecord record{*volume ? &**volume : nullptr, given.boundary_count, *growth};
    const bool is_changed = *volume || !growth->empty();
    std::optional<CutSections> sections;
    if (is_changed && !given.model && !given.improved)
        return to_cut_certificate(certified, record, {}, run);
    if (is_changed) {
        auto made = cut_sections(certified, record, {}, run);
        if (!made) return made.error();
        certified.cut = &sections.emplace(*std::move(made));
    }
    if (given.improved)
        return to_improved_certificate(certified, given.improved->improved.mesh,
                                       given.improved->improved.report.bound_of, run);
    if (!given.model) return to_certificate(certified, run);
    const Model& model = given.model->model;
    const CertifiedBlocks blocks{model.volumes, model.block_count()};
    return given.tetrahedra
               ? to_certificate(certified, blocks, given.tetrahedra->filled.tetrahedra, run)
               : to_certificate(certified, blocks, run);
}

Result<std::string> filled_text(const terrane_certified& given, const fs::path& path,
                                std::span<const InputRecord> inputs) {
    const terrane_holes& holes = needed(given.holes, "certified.holes");
    const std::span<const Surface> surfaces = given.surfaces->list;
    if (holes.work.surfaces.size() != surfaces.size())
        return unfit("need a task for each of `surfaces`", "holes");
    std::vector<SurfaceInfo> infos;
    std::vector<FilledRecord> filled;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const HoledSurface& done = holes.work.surfaces[s];
        const Surface& made = holes.surfaces.list[s];
        if (done.task.surface != s || done.given_triangles != surfaces[s].triangles.size())
            return unfit("are not those of `surfaces`, in their order", "holes");
        infos.push_back({made.name, made.role});
        filled.push_back(
            {&made, done.given_vertices, done.given_triangles, done.interpolated, done.deviation});
    }
    const auto outputs = outputs_of(given, infos, path);
    if (!outputs) return outputs.error();
    return to_filled_certificate(inputs, surfaces, *outputs, filled);
}

Result<std::string> layered_text(const terrane_certified& given, const fs::path& path,
                                 std::span<const InputRecord> inputs) {
    const Layered& layered = needed(given.layered, "certified.layered").layered;
    if (!layered.is_stack())
        return Error{ErrorCode::improper_contact, "the layers are no stack", "certified.layered"};
    need_array(given.layers, given.layer_count, "certified.layers");
    std::vector<Layer> order;
    for (const terrane_layer& layer : std::span(given.layers, given.layer_count))
        order.push_back({SurfaceId(layer.surface), layer.hardness});
    const auto fits = [](const Layer& layer, const LayerReport& report) {
        return layer.surface == report.surface;
    };
    if (!std::ranges::equal(order, layered.reports, fits))
        return unfit("are not those of the stack", "layers");
    const auto outputs = outputs_of(given, layered.rounded.mesh->surfaces, path);
    if (!outputs) return outputs.error();
    return to_layered_certificate(inputs, given.surfaces->list, *outputs, order, layered);
}

/// Refuses members that would be ignored.
Status check_use(const terrane_certified& given) {
    need_array(given.layers, given.layer_count, "certified.layers");
    need_array(given.corners, given.corner_count, "certified.corners");
    need_array(given.volume_files, given.volume_file_count, "certified.volume_files");
    if (given.part_format && !given.model_folder) return unfit("needs model_folder", "part_format");
    if (given.layers && !given.layered) return unfit("needs layered", "layers");
    if ((given.low != 0 || given.high != 0) && !given.corners) return unfit("needs corners", "low");
    return Done{};
}

Result<std::string> text_of(const terrane_certified& given, const fs::path& path, const Run& run) {
    if (const auto used = check_use(given); !used) return used.error();
    const std::span<const Surface> surfaces = needed(given.surfaces, "certified.surfaces").list;
    const auto inputs = records_of(given.inputs, given.input_count, "certified.inputs", path);
    if (!inputs) return inputs.error();
    if (auto fit = check_surfaces(given, surfaces, *inputs); !fit) return fit.error();
    if (given.holes && given.layered) return unfit("a certificate is about one result", "layered");
    if (given.model_folder && !given.model) return unfit("needs the model", "model_folder");
    if (given.holes || given.layered) {
        if (given.boundary_count > 0 || given.growth_count > 0)
            return unfit("filled surfaces and layers have no volume of interest", "boundary_count");
        return given.holes ? filled_text(given, path, *inputs) : layered_text(given, path, *inputs);
    }
    return arranged_text(given, path, *inputs, run);
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_code terrane_certified_init(terrane_certified* certified, size_t struct_size) {
    return init_options(certified, struct_size, terrane_certified{});
}

terrane_code terrane_write_certificate(const char* path, const terrane_certified* certified,
                                       const terrane_run* run, terrane_error** error) {
    return call(error, [&]() -> terrane::Status {
        const std::filesystem::path file = needed_file(path);
        if (!certified) throw BadArgument{"certified", "is null"};
        const auto given = options_of(certified, terrane_certified{});
        const auto text = text_of(given, file, run_of(run));
        if (!text) return text.error();
        return terrane::write_file(file, *text);
    });
}
