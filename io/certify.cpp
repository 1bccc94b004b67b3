// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/certify.hpp>

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <utility>
#include <variant>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/block_certificate.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/results.hpp>
#include <terrane/io/text/utf8.hpp>

namespace terrane {
namespace {

namespace fs = std::filesystem;

Result<std::string> name_of(const fs::path& file, const fs::path& certificate) {
    auto name = file == "-" ? file.string() : certified_name(file, certificate);
    if (detail::is_utf8(name)) return name;
    return Error{ErrorCode::bad_option,
                 "a certificate cannot name this file, as its path is not UTF-8", file.string()};
}

Result<InputRecord> record(const SourceFile& input, const fs::path& certificate) {
    auto name = name_of(input.file, certificate);
    if (!name) return name.error();
    return record_input(input.file, *std::move(name), input.surfaces);
}

/// Returns the surfaces as the output files call them.
std::vector<SurfaceInfo> names_in_outputs(const CertifiedResult& result) {
    if (result.layered != nullptr) return result.layered->rounded.mesh->surfaces;
    if (result.tetrahedra != nullptr) return result.tetrahedra->surfaces;
    if (result.model != nullptr) return result.model->mesh->surfaces;
    if (result.improved != nullptr) return result.improved->mesh->surfaces;
    if (result.rounded != nullptr) return result.rounded->mesh->surfaces;
    std::vector<SurfaceInfo> names;
    for (const FilledRecord& f : result.filled) names.push_back({f.filled->name, f.filled->role});
    return names;
}

Result<std::vector<OutputRecord>> record_outputs(const CertifiedResult& result,
                                                 const fs::path& certificate) {
    const auto surfaces = names_in_outputs(result);
    std::vector<OutputRecord> records;
    for (const ResultFile& output : result.outputs) {
        auto name = name_of(output.file, certificate);
        if (!name) return name.error();
        const auto contents =
            output.contents ? Result<std::string>(*output.contents) : read_file(output.file);
        if (!contents) return contents.error();
        records.push_back(record_output(*contents, *std::move(name), output.format, surfaces));
    }
    return records;
}

Result<std::vector<InputRecord>> record_inputs(const CertifiedResult& result,
                                               const fs::path& certificate) {
    std::vector<InputRecord> records;
    for (const SourceFile& input : result.inputs) {
        auto made = record(input, certificate);
        if (!made) return made.error();
        records.push_back(*std::move(made));
    }
    return records;
}

Result<VolumeRecord> record(const ProjectBox& box, const fs::path&) {
    const auto& [low, high] = box;
    VolumeRecord prism;
    prism.corners = {{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}};
    prism.between = {low.z, high.z};
    return prism;
}

Result<VolumeRecord> record(const RotatedBox&, const fs::path&) {
    return VolumeRecord{"hexahedron"};
}

Result<VolumeRecord> record(const ProjectPolygon& polygon, const fs::path&) {
    VolumeRecord prism;
    prism.corners = polygon.corners;
    if (prism.corners.front() == prism.corners.back()) prism.corners.pop_back();
    const auto [low, high] = std::minmax(polygon.between[0], polygon.between[1]);
    prism.between = {low, high};
    return prism;
}

Result<VolumeRecord> record(const ProjectWithin& within, const fs::path& certificate) {
    VolumeRecord volume{"surface"};
    for (const fs::path& file : within.files) {
        auto surfaces = read_surfaces(file);
        if (!surfaces) return surfaces.error();
        auto input = record(SourceFile{file, surfaces->size()}, certificate);
        if (!input) return input.error();
        volume.files.push_back(*std::move(input));
        std::ranges::move(*surfaces, std::back_inserter(volume.surfaces));
    }
    return volume;
}

/// Returns the volume of interest as a certificate describes it, if there is one.
Result<std::optional<VolumeRecord>> record_volume(const CertifiedResult& result,
                                                  const fs::path& certificate) {
    return std::visit(
        [&](const auto& volume) -> Result<std::optional<VolumeRecord>> {
            if constexpr (std::is_same_v<std::decay_t<decltype(volume)>, std::monostate>) {
                return std::optional<VolumeRecord>();
            } else {
                auto made = record(volume, certificate);
                if (!made) return made.error();
                return std::optional(*std::move(made));
            }
        },
        result.volume);
}

/// Returns the text about a rounded mesh and what was made of it.
Result<std::string> text_of_mesh(const CertifiedResult& result, Certified certified,
                                 const fs::path& path, const Run& run) {
    const auto volume = record_volume(result, path);
    if (!volume) return volume.error();
    const CutRecord cut{*volume ? &**volume : nullptr, *volume ? result.boundary_count : 0,
                        result.growth};
    const bool is_changed = *volume || !result.growth.empty();
    const ArrangeOptions options{.search = result.search};
    if (is_changed && result.model == nullptr && result.improved == nullptr)
        return to_cut_certificate(certified, cut, options, run);
    std::optional<CutSections> sections;
    if (is_changed) {
        auto made = cut_sections(certified, cut, options, run);
        if (!made) return made.error();
        certified.cut = &sections.emplace(*std::move(made));
    }
    if (result.improved != nullptr)
        return to_improved_certificate(certified, result.improved->mesh,
                                       result.improved->report.bound_of, run);
    if (result.model == nullptr) return to_certificate(certified, run);
    if (result.tetrahedra != nullptr)
        return to_certificate(certified, {*result.model}, *result.tetrahedra, run);
    const ModelReports reports{*result.model, result.sealed, result.leaks};
    return to_certificate(certified, {*result.model, extras_of(reports)}, run);
}

} // namespace

CertifiedResult result_of(const Arranged& arranged) {
    CertifiedResult result;
    result.surfaces = arranged.surfaces;
    result.exact = &arranged.exact;
    result.rounded = &arranged.rounded;
    result.boundary_count = arranged.boundary_count;
    result.growth = arranged.growth;
    return result;
}

std::vector<ResultFile> outputs_of(const Model& model, const fs::path& folder,
                                   const std::string& part_format) {
    std::vector<ResultFile> files;
    for (const ModelFile& file : model_files(model, part_format))
        files.push_back({folder / file.path, file.format});
    return files;
}

namespace {

Result<std::string> text_of(const CertifiedResult& result, const fs::path& path, const Run& run) {
    for (const Surface& surface : result.surfaces)
        if (!detail::is_utf8(surface.name))
            return Error{ErrorCode::bad_option,
                         "a certificate cannot state the name of this surface, as it is not UTF-8",
                         surface.name};
    const auto inputs = record_inputs(result, path);
    if (!inputs) return inputs.error();
    const auto outputs = record_outputs(result, path);
    if (!outputs) return outputs.error();
    if (!result.filled.empty())
        return to_filled_certificate(*inputs, result.surfaces, *outputs, result.filled);
    if (result.layered != nullptr)
        return to_layered_certificate(*inputs, result.surfaces, *outputs, result.order,
                                      *result.layered);
    return text_of_mesh(result, {*inputs, result.surfaces, *result.exact, result.rounded, *outputs},
                        path, run);
}

} // namespace

Result<std::string> certify(const CertifiedResult& result, const fs::path& path, const Run& run) {
    return guarded("for the certificate", "certificate",
                   [&] { return text_of(result, path, run); });
}

double stated_deviation(const CertifiedResult& result) {
    if (result.layered != nullptr) return stated_deviation(*result.layered);
    return result.rounded != nullptr ? stated_deviation(*result.exact, *result.rounded) : 0;
}

} // namespace terrane
