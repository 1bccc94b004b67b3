// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/block_certificate.hpp>

#include <algorithm>
#include <utility>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/block_certificate.hpp>
#include <terrane/io/model_folder.hpp>

namespace terrane::cli {
namespace {

/// An output file, as the certificate is to name it.
struct WrittenFile {
    std::filesystem::path path;
    std::string format;
};

std::vector<WrittenFile> files_in(const std::filesystem::path& folder, const Model& model,
                                  const std::string& part_format) {
    std::vector<WrittenFile> files;
    for (const ModelFile& file : model_files(model, part_format))
        files.push_back({folder / file.path, file.format});
    return files;
}

Result<std::vector<OutputRecord>> record(const std::string& certificate,
                                         const std::vector<WrittenFile>& files,
                                         const std::vector<SurfaceInfo>& surfaces) {
    std::vector<OutputRecord> records;
    for (const WrittenFile& file : files) {
        const auto contents = read_file(file.path);
        if (!contents) return contents.error();
        records.push_back(record_output(contents.value(), certified_name(file.path, certificate),
                                        file.format, surfaces));
    }
    return records;
}

/// Makes the text by make(certified).
template <class Make>
Result<std::string> make_text(const BlockProof& proof, const std::vector<WrittenFile>& files,
                              const std::vector<SurfaceInfo>& surfaces, const Make& make,
                              const Session& session) {
    const auto inputs = record_inputs(proof.path, proof.files.inputs, proof.inputs);
    if (!inputs) return inputs.error();
    const auto outputs = record(proof.path, files, surfaces);
    if (!outputs) return outputs.error();
    for (std::size_t s = 0; s < proof.roles.size(); ++s)
        proof.arranged.surfaces[s].role = proof.roles[s];
    const Arranged& arranged = proof.arranged;
    Certified certified{inputs.value(), arranged.surfaces, arranged.exact, &arranged.rounded,
                        outputs.value()};
    const auto sections =
        sections_of(proof.cut, proof.path, proof.inputs, certified, arranged, session);
    if (!sections) return sections.error();
    if (sections.value()) certified.cut = &*sections.value();
    return make(certified);
}

/// Makes the text by make() and writes it.
template <class Make>
Status write(const BlockProof& proof, const Make& make, Session& session) {
    session.begin("write", Phase::writing);
    const auto text = make();
    if (!text) return text.error();
    auto written = write_file(proof.path, text.value());
    session.end_stage();
    if (!written) return written;
    say_written(summary_stream(proof.files), proof.path);
    const Arranged& arranged = proof.arranged;
    warn_of_deviation(proof.path, stated_deviation(arranged.exact, arranged.rounded),
                      arranged.surfaces);
    return written;
}

} // namespace

Status plan_certificate(const std::string& path, const FileOptions& files,
                        const ArrangeSettings& settings) {
    if (path.empty()) return Done{};
    if (auto possible = check_certifiable(settings); !possible) return possible;
    if (path == "-" || std::ranges::count(files.outputs, "-") > 0)
        return Error{ErrorCode::bad_option, "a certificate is about files, and is one",
                     "--certificate"};
    if (std::ranges::count(files.inputs, "-") > 0)
        return Error{ErrorCode::bad_option, "a certificate is about files, not standard input",
                     "--certificate"};
    for (const auto& names : {files.inputs, files.outputs, settings.volume.within})
        if (auto status = check_certified_names(path, names); !status) return status;
    return check_folder(path);
}

std::vector<Role> roles_of(const Inputs& inputs) {
    std::vector<Role> roles;
    for (const Surface& s : inputs.surfaces) roles.push_back(s.role);
    return roles;
}

Result<std::string> certificate_text(const BlockProof& proof, const Model& model,
                                     const std::filesystem::path& folder,
                                     const std::string& part_format, const Session& session) {
    return make_text(
        proof, files_in(folder, model, part_format), model.mesh->surfaces,
        [&](const Certified& certified) {
            return to_certificate(certified, {model.volumes, model.block_count()}, session.run());
        },
        session);
}

Result<std::string> certificate_text(const BlockProof& proof, const Model& model,
                                     const TetrahedralMesh& tetrahedra,
                                     const std::vector<Output>& outputs, const Session& session) {
    std::vector<WrittenFile> files;
    for (const Output& output : outputs)
        files.push_back({output.path, certified_format(output.format, false)});
    return make_text(
        proof, files, tetrahedra.surfaces,
        [&](const Certified& certified) {
            return to_certificate(certified, {model.volumes, model.block_count()}, tetrahedra,
                                  session.run());
        },
        session);
}

Status write_certificate(const BlockProof& proof, const Model& model,
                         const std::filesystem::path& folder, const std::string& part_format,
                         Session& session) {
    return write(
        proof, [&] { return certificate_text(proof, model, folder, part_format, session); },
        session);
}

Status write_certificate(const BlockProof& proof, const Model& model,
                         const TetrahedralMesh& tetrahedra, const std::vector<Output>& outputs,
                         Session& session) {
    return write(
        proof, [&] { return certificate_text(proof, model, tetrahedra, outputs, session); },
        session);
}

} // namespace terrane::cli
