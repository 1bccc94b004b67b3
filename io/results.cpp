// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/results.hpp>

#include <algorithm>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/certify.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/gocad/gocad_model.hpp>

namespace terrane {
namespace {

namespace fs = std::filesystem;

class Writer {
public:
    Writer(const Results& results, const fs::path& folder, const Run& run) :
        results_(results), folder_(folder), run_(run) {}

    Result<std::vector<std::string>> operator()() {
        for (const auto step : {&Writer::write_surfaces, &Writer::write_cells,
                                &Writer::write_blocks, &Writer::write_gocad}) {
            if (auto done = (this->*step)(); !done) return done.error();
            if (run_.stop.stop_requested()) return Error{ErrorCode::interrupted, "", ""};
        }
        return std::move(written_);
    }

private:
    Status write_surfaces() {
        const Model& model = results_.model;
        WriteOptions options;
        options.ascii = true; // binary STL would round the checked coordinates
        options.values = results_.values;
        std::vector<BlockPoint> points;
        for (const std::string& format : results_.project.outputs.surfaces) {
            options.format = format_named(format);
            if (points.empty() && (format == "poly" || format == "smesh")) {
                auto found = block_points(model.mesh, model.volumes, run_);
                if (!found) return found.error();
                points = *std::move(found);
                options.block_points = points;
            }
            written_.push_back(file_name("surfaces", format));
            if (auto done = write_mesh(model.mesh, folder_ / written_.back(), options); !done)
                return done;
        }
        return Done{};
    }

    Status write_cells() {
        if (results_.filled == nullptr) return Done{};
        WriteOptions options;
        options.block_names = results_.filled->block_names;
        options.order = results_.project.tetrahedra.order;
        options.values = results_.values_of_faces;
        for (const std::string& format : results_.project.outputs.tetrahedra) {
            options.format = format_named(format);
            const auto files = write_tetrahedra_files(
                results_.filled->tetrahedra, folder_ / file_name("tetrahedra", format), options);
            if (!files) return files.error();
            for (const fs::path& file : *files) written_.push_back(file.filename().string());
        }
        return Done{};
    }

    Status write_blocks() {
        const std::string& format = results_.project.outputs.blocks;
        if (format.empty()) return Done{};
        const fs::path folder = folder_ / "model";
        std::error_code failed;
        fs::create_directory(folder, failed);
        if (failed)
            return Error{ErrorCode::cannot_open, "cannot be made: " + failed.message(),
                         folder.string()};
        written_.emplace_back("model/");
        return write_model_files({results_.model, results_.sealed, results_.leaks, results_.values},
                                 format, folder, run_);
    }

    Status write_gocad() {
        if (!results_.project.outputs.gocad) return Done{};
        const Model& model = results_.model;
        written_.emplace_back("model.ml");
        return write_file(
            folder_ / "model.ml",
            to_gocad_model(model.mesh, model.volumes, model.structure, "model", results_.unit));
    }

    const Results& results_;
    const fs::path& folder_;
    const Run& run_;
    std::vector<std::string> written_;
};

/// Returns the files with this name in these formats.
std::vector<ResultFile> files_as(const fs::path& folder, const char* name,
                                 const std::vector<std::string>& formats, bool ascii) {
    std::vector<ResultFile> files;
    for (const std::string& format : formats)
        files.push_back({folder / file_name(name, format),
                         certified_format(format_named(format).value(), ascii)});
    return files;
}

bool are_called_alike(const SurfaceInfo& info, const Surface& surface) {
    return info.name == surface.name && info.role == surface.role;
}

} // namespace

std::string file_name(const std::string& start, const std::string& format) {
    if (format == "msh22") return start + "_22.msh";
    if (format == "ogs") return start + "_ogs.vtu";
    if (format == "geos") return start + "_geos.vtm";
    if (format == "pylith") return start + "_pylith.msh";
    return start + "." + format;
}

Result<std::vector<std::string>> write_results(const Results& results, const fs::path& folder,
                                               const Run& run) {
    return guarded("to write the results", "write", [&] { return Writer(results, folder, run)(); });
}

Status check_certifiable(const Project& project) {
    return guarded("to check the project", "project", [&]() -> Status {
        if (!project.outputs.certificate) return Done{};
        for (std::size_t i = 0; i < project.surfaces.size(); ++i)
            if (!project.surfaces[i].objects.empty())
                return at_key(
                    project, fmt::format("surfaces[{}].objects", i),
                    "a certificate is about whole files, not about some of their objects");
        return Done{};
    });
}

namespace {

Result<std::vector<WrittenCertificate>> certify_all(const Results& results,
                                                    const ProjectInputs& read,
                                                    const Arranged& arranged,
                                                    const fs::path& folder, const Run& run) {
    const Project& project = results.project;
    std::vector<WrittenCertificate> written;
    if (!project.outputs.certificate) return written;
    CertifiedResult result = result_of(arranged);
    std::vector<Surface> as_read;
    if (!std::ranges::equal(read.as_read, std::span(arranged.surfaces).first(read.as_read.size()),
                            are_called_alike)) {
        as_read = arranged.surfaces;
        for (std::size_t s = 0; s < read.as_read.size(); ++s) {
            as_read[s].name = read.as_read[s].name;
            as_read[s].role = read.as_read[s].role;
        }
        result.surfaces = as_read;
    }
    for (std::size_t entry = 0; entry < project.surfaces.size(); ++entry)
        result.inputs.push_back({project.surfaces[entry].file, read.surfaces_of_entry[entry]});
    result.volume = project.volume;
    const auto write = [&](const char* name, std::vector<ResultFile> outputs) -> Status {
        result.outputs = std::move(outputs);
        const auto text = certify(result, folder / name, run);
        if (!text) return text.error();
        written.push_back({name, stated_deviation(result)});
        return write_file(folder / name, *text);
    };
    if (auto done =
            write("certificate.json", files_as(folder, "surfaces", project.outputs.surfaces, true));
        !done)
        return done.error();
    result.model = &results.model;
    result.sealed = results.sealed;
    result.leaks = results.leaks;
    const std::string& blocks = project.outputs.blocks;
    if (!blocks.empty())
        if (auto done = write("certificate_blocks.json",
                              outputs_of(results.model, folder / "model", blocks));
            !done)
            return done.error();
    if (results.filled == nullptr) return written;
    result.tetrahedra = &results.filled->tetrahedra;
    if (auto done = write("certificate_tetrahedra.json",
                          files_as(folder, "tetrahedra", project.outputs.tetrahedra, false));
        !done)
        return done.error();
    return written;
}

} // namespace

Result<std::vector<WrittenCertificate>> write_certificates(const Results& results,
                                                           const ProjectInputs& read,
                                                           const Arranged& arranged,
                                                           const fs::path& folder, const Run& run) {
    return guarded("for the certificates", "certificate",
                   [&] { return certify_all(results, read, arranged, folder, run); });
}

} // namespace terrane
