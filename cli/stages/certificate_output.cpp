// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/certificate_output.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/verify/verify_certificate.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/exact_text.hpp>
#include <terrane/io/text/utf8.hpp>

namespace terrane::cli {

namespace {

Status write(const std::string& path, const std::string& text, std::FILE* told, Session& session) {
    session.begin("write", Phase::writing);
    auto status = write_file(path, text);
    session.end_stage();
    if (status) say_written(told, path);
    return status;
}

/// The contents of an output as it was written. A standard stream can't be read again: what went
/// there is made once more.
Result<std::string> contents_of(const Output& output, const Mesh& mesh, bool ascii) {
    if (output.path != "-") return read_file(output.path);
    WriteOptions options;
    options.ascii = ascii;
    return format_mesh(mesh, output.format, options);
}

Result<std::vector<OutputRecord>> record_outputs(const std::string& certificate,
                                                 const ProofFiles& files, const Mesh& mesh) {
    std::vector<OutputRecord> records;
    for (const Output& output : files.outputs) {
        const auto contents = contents_of(output, mesh, files.ascii);
        if (!contents) return contents.error();
        records.push_back(record_output(
            contents.value(),
            output.path == "-" ? output.path : certified_name(output.path, certificate),
            certified_format(output.format, files.ascii), mesh.surfaces));
    }
    return records;
}

} // namespace

std::optional<CutRequest> cut_request(const ArrangeSettings& settings, const Arranged& arranged) {
    const VolumeOptions& volume = settings.volume;
    if (!volume.wanted() && !arranged.sealed) return std::nullopt;
    CutRequest request{{}, settings.search};
    if (volume.wanted())
        request.volume = [&volume](const std::string& path) { return record_of(volume, path); };
    return request;
}

Result<ChangeRecord> change_of(const CutRequest& request, const std::string& path,
                               const Inputs& inputs, const Arranged& arranged) {
    ChangeRecord change{std::nullopt, 0, arranged.growth};
    if (!request.volume) return change;
    auto volume = request.volume(path);
    if (!volume) return volume.error();
    change.volume = std::move(volume).value();
    std::size_t own = 0;
    for (const std::size_t count : inputs.surfaces_of_file) own += count;
    change.boundary_count = arranged.surfaces.size() - own;
    return change;
}

Result<std::optional<CutSections>> sections_of(const std::optional<CutRequest>& request,
                                               const std::string& path, const Inputs& inputs,
                                               const Certified& certified, const Arranged& arranged,
                                               const Session& session) {
    if (!request) return std::optional<CutSections>();
    const auto change = change_of(*request, path, inputs, arranged);
    if (!change) return change.error();
    auto sections =
        cut_sections(certified, change->record(), {.search = request->search}, session.run());
    if (!sections) return sections.error();
    return std::optional(std::move(sections).value());
}

Status check_certified_names(const std::string& certificate,
                             const std::vector<std::string>& files) {
    for (const std::string& file : files)
        if (file != "-" && !detail::is_utf8(certified_name(file, certificate)))
            return Error{ErrorCode::bad_option,
                         "a certificate cannot name this file, as its path is not UTF-8", file};
    return Done{};
}

Status check_certified_surfaces(std::span<const std::string> names,
                                std::span<const std::string> files) {
    for (std::size_t s = 0; s < names.size(); ++s)
        if (!detail::is_utf8(names[s]))
            return Error{ErrorCode::bad_option,
                         fmt::format("a certificate cannot state the name of surface {} of {}, as "
                                     "it is not UTF-8",
                                     s + 1, names.size()),
                         files[s]};
    return Done{};
}

Result<Inputs> read_certified_inputs(const std::string& certificate, const FileOptions& options,
                                     Session& session) {
    auto inputs = read_inputs(options, session);
    if (!inputs || certificate.empty()) return inputs;
    std::vector<std::string> names;
    for (const Surface& surface : inputs->surfaces) names.push_back(surface.name);
    if (const auto sound = check_certified_surfaces(names, inputs->files); !sound)
        return sound.error();
    return inputs;
}

Result<std::vector<InputRecord>> record_inputs(const std::string& certificate,
                                               const std::vector<std::string>& files,
                                               const Inputs& inputs) {
    std::vector<InputRecord> records;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string& path = files[i];
        auto record =
            record_input(path, certified_name(path, certificate), inputs.surfaces_of_file[i]);
        if (!record) return record.error();
        records.push_back(std::move(record.value()));
    }
    return records;
}

bool is_certifiable(Format format, unsigned order) {
    return order == 1 && holds_tetrahedra(format) && format <= Format::medit;
}

void add_certificate(CLI::App& command, std::string& certificate) {
    command
        .add_option("--certificate", certificate,
                    "Write all that it takes to check the result (terrane verify)")
        ->type_name("FILE");
}

void add_proof(CLI::App& command, ProofOptions& options) {
    add_certificate(command, options.certificate);
    command.add_option("--exact", options.exact, "Write the exact coordinates, as fractions")
        ->type_name("FILE");
}

void warn_of_deviation(const std::string& certificate, double deviation,
                       std::span<const Surface> inputs) {
    const double accepted = default_max_deviation(inputs);
    if (!(deviation > accepted)) return;
    warn(fmt::format(
        "{} states a deviation of {}, and terrane verify accepts at most {:.3g} unless it "
        "is given --max-deviation {}",
        certificate, deviation, accepted, deviation));
}

namespace {

/// Refuses outputs that terrane verify does not read.
Status check_certified_formats(const FileOptions& files) {
    for (const std::string& file : files.outputs) {
        const auto format = !files.output_format.empty() ? format_named(files.output_format)
                            : file == "-"                ? format_named(files.format)
                                                         : format_of(file);
        if (format == Format::vtk || (format && holds_outlines(*format)))
            return Error{
                ErrorCode::bad_option,
                "a certificate cannot be about a file in this format, which terrane verify "
                "does not read",
                file};
    }
    return Done{};
}

} // namespace

Status plan_proof(const ProofOptions& options, const FileOptions& files) {
    if (options.certificate == "-" || options.exact == "-")
        return Error{ErrorCode::bad_option, "standard output is for the mesh: name a file", "-"};
    if (!options.certificate.empty() && std::ranges::count(files.inputs, "-") > 0)
        return Error{ErrorCode::bad_option, "a certificate is about files, not standard input",
                     "--certificate"};
    for (const auto& path : {options.certificate, options.exact})
        if (!path.empty())
            if (auto status = check_folder(path); !status) return status;
    if (options.certificate.empty()) return Done{};
    if (auto status = check_certified_formats(files); !status) return status;
    if (auto status = check_certified_names(options.certificate, files.inputs); !status)
        return status;
    return check_certified_names(options.certificate, files.outputs);
}

Result<std::string> certificate_text(const std::string& path, const ProofFiles& files,
                                     const Inputs& inputs, const Arranged& arranged,
                                     const Session& session) {
    const auto records = record_inputs(path, files.inputs, inputs);
    if (!records) return records.error();
    const auto outputs = record_outputs(path, files, arranged.rounded.mesh);
    if (!outputs) return outputs.error();
    const Certified certified{records.value(), arranged.surfaces, arranged.exact, &arranged.rounded,
                              outputs.value()};
    if (!files.cut) return to_certificate(certified, session.run());
    const auto change = change_of(*files.cut, path, inputs, arranged);
    if (!change) return change.error();
    return to_cut_certificate(certified, change->record(), {.search = files.cut->search},
                              session.run());
}

Status write_proof(const ProofOptions& options, const ProofFiles& files, const Inputs& inputs,
                   const Arranged& arranged, Session& session) {
    if (!options.certificate.empty()) {
        session.begin("certificate", Phase::computing);
        const auto text = certificate_text(options.certificate, files, inputs, arranged, session);
        if (!text) return text.error();
        if (auto status = write(options.certificate, text.value(), files.told, session); !status)
            return status;
        warn_of_deviation(options.certificate, stated_deviation(arranged.exact, arranged.rounded),
                          arranged.surfaces);
    }
    if (options.exact.empty()) return Done{};
    session.begin("write", Phase::computing);
    return write(options.exact, to_text(to_exact(arranged.exact, session.run())), files.told,
                 session);
}

Status write_improved_certificate(const std::string& path, const ProofFiles& files,
                                  const Inputs& inputs, const Arranged& before,
                                  const Improved& improved, Session& session) {
    session.begin("certificate", Phase::computing);
    const auto records = record_inputs(path, files.inputs, inputs);
    if (!records) return records.error();
    const auto outputs = record_outputs(path, files, improved.mesh);
    if (!outputs) return outputs.error();
    Certified certified{records.value(), before.surfaces, before.exact, &before.rounded,
                        outputs.value()};
    const auto sections = sections_of(files.cut, path, inputs, certified, before, session);
    if (!sections) return sections.error();
    if (sections.value()) certified.cut = &*sections.value();
    const auto text =
        to_improved_certificate(certified, improved.mesh, improved.report.bound_of, session.run());
    auto status = write(path, text, files.told, session);
    if (status)
        warn_of_deviation(path, stated_deviation(before.exact, before.rounded), before.surfaces);
    return status;
}

Status write_filled_certificate(const std::string& path, const ProofFiles& files,
                                const Inputs& inputs, const FillWork& work, const Mesh& mesh,
                                Session& session) {
    session.begin("certificate", Phase::computing);
    const auto records = record_inputs(path, files.inputs, inputs);
    if (!records) return records.error();
    const auto outputs = record_outputs(path, files, mesh);
    if (!outputs) return outputs.error();
    std::vector<FilledRecord> filled;
    for (const HoledSurface& s : work.surfaces)
        filled.push_back(
            {&s.filled, s.given_vertices, s.given_triangles, s.interpolated, s.deviation});
    const auto text =
        to_filled_certificate(records.value(), inputs.surfaces, outputs.value(), filled);
    return write(path, text, files.told, session);
}

Status write_layered_certificate(const std::string& path, const ProofFiles& files,
                                 const Inputs& inputs, std::span<const Layer> order,
                                 const Layered& layered, Session& session) {
    session.begin("certificate", Phase::computing);
    const auto records = record_inputs(path, files.inputs, inputs);
    if (!records) return records.error();
    const auto outputs = record_outputs(path, files, layered.rounded.mesh);
    if (!outputs) return outputs.error();
    const auto text =
        to_layered_certificate(records.value(), inputs.surfaces, outputs.value(), order, layered);
    auto status = write(path, text, files.told, session);
    if (status) warn_of_deviation(path, stated_deviation(layered), inputs.surfaces);
    return status;
}

} // namespace terrane::cli
