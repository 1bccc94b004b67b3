// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/judgement/judgement.hpp>

#include <system_error>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/verify/stoppable.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/judgement/detail/watch.hpp>

namespace terrane {

namespace fs = std::filesystem;

namespace {

/// Reads a file of this size. Errors: those of read_file; out_of_memory if it is beyond the limit.
Result<std::string> read_within(const fs::path& path, std::uint64_t size,
                                const JudgementLimits& limits) {
    if (static_cast<double>(size) > limits.memory)
        return Error{ErrorCode::out_of_memory, "is larger than the memory that may be used",
                     path.string()};
    return read_file(path);
}

/// Reads the files of a certificate. A name in it can lead to any file of the machine, so only files in its folder are
/// opened, unless the caller names others; and only as much is read as the certificate states.
class CertifiedFiles {
public:
    CertifiedFiles(const JudgementRequest& request, const Certificate& certificate) :
        request_(request), certificate_(certificate),
        folder_(request.certificate == "-" ? fs::path() : request.certificate.parent_path()) {}

    /// Reads the input files. A file whose hash differs from the certificate's need not parse: the verifier rejects it
    /// by its hash.
    [[nodiscard]] Result<std::vector<InputFile>> inputs(std::vector<JudgedInput>& judged) const {
        const auto& stated = certificate_.inputs;
        const CertifiedReading& reading = request_.reading;
        const bool named = !request_.inputs.empty();
        if (named && request_.inputs.size() != stated.size())
            return Error{ErrorCode::bad_option,
                         "the certificate is about " + std::to_string(stated.size()) +
                             (stated.size() == 1 ? " file, not " : " files, not ") +
                             std::to_string(request_.inputs.size()),
                         reading.paths_name};
        std::vector<std::optional<Format>> formats;
        for (std::size_t i = 0; i < stated.size(); ++i)
            formats.push_back(reading.format ? reading.format
                                             : format_to_read(named ? request_.inputs[i]
                                                                    : fs::path(stated[i].name)));
        if (const auto sound = check_reading(formats, reading.options, reading.option_names);
            !sound)
            return sound.error();
        std::vector<InputFile> files;
        for (std::size_t i = 0; i < stated.size(); ++i) {
            auto path = named ? request_.inputs[i] : place_of(stated[i].name);
            if (!path) return path.error();
            auto file = input(stated[i], *path, formats[i]);
            if (!file) return file.error();
            judged.push_back({path->string(), file->bytes, file->sha256});
            files.push_back(std::move(*file));
        }
        return files;
    }

    /// Adds a violation for each expected file that is missing among the inputs.
    [[nodiscard]] Status check_expected(const std::vector<JudgedInput>& read,
                                        std::vector<Violation>& violations) const {
        for (const auto& path : request_.expected) {
            const auto size = size_of_file(path);
            if (!size) return size.error();
            const auto contents = read_within(path, *size, request_.limits);
            if (!contents) return contents.error();
            const auto hash = input_file(*contents, {}).sha256;
            if (std::ranges::find(read, hash, &JudgedInput::sha256) == read.end())
                violations.push_back(
                    {Rule::R9_inputs, {}, path.string() + " is not an input of the certificate"});
        }
        return Done{};
    }

    /// Judges all output files.
    [[nodiscard]] std::vector<JudgedOutput> outputs() const {
        const auto& stated = certificate_.outputs;
        std::vector<std::optional<fs::path>> named(stated.size());
        OutputVerifier verifier(certificate_);
        std::vector<JudgedOutput> judged;
        for (const auto& path : request_.outputs) {
            const auto i = output_like(path, named);
            if (!named[i])
                named[i] = path;
            else // a second copy
                judged.push_back(judge_output(verifier, i, path));
        }
        for (std::size_t i = 0; i < stated.size(); ++i) {
            if (!named[i] && stated[i].name == "-") {
                judged.push_back({i, "standard output", "give it with --output", {}});
                continue;
            }
            const auto path = named[i] ? Result(*named[i]) : place_of(stated[i].name);
            judged.push_back(path ? judge_output(verifier, i, *path)
                                  : JudgedOutput{i, stated[i].name, path.error().sentence, {}});
        }
        return judged;
    }

private:
    /// Returns the place of a file that the certificate names. Errors: cannot_open if it may not be there.
    [[nodiscard]] Result<fs::path> place_of(const std::string& name) const {
        std::error_code failed;
        // A folder that is still to get its name cannot be gone through.
        fs::path path = folder_ / name;
        if (!folder_.empty() && !fs::is_directory(folder_, failed)) path = path.lexically_normal();
        if (const char* const why = flaw_of(name, path))
            return Error{ErrorCode::cannot_open, why, path.string()};
        return path;
    }

    /// Tells why a file that the certificate names is not opened; nullptr: it is.
    [[nodiscard]] const char* flaw_of(const fs::path& name, const fs::path& path) const {
        constexpr const char* outside =
            "is outside of the certificate's folder: name the files, or a folder that has them";
        std::error_code failed;
        if (!request_.folder.empty()) {
            const fs::path base = fs::weakly_canonical(fs::absolute(request_.folder), failed);
            const fs::path place =
                fs::weakly_canonical(fs::absolute(path), failed).lexically_relative(base);
            return failed || place.empty() || *place.begin() == ".." ? outside : nullptr;
        }
        if (name.is_absolute() || std::ranges::find(name, "..") != name.end()) return outside;
        fs::path at = folder_;
        for (const fs::path& part : name)
            if (fs::is_symlink(at /= part, failed))
                return "is reached by a link: name the files, or a folder that has them";
        return nullptr;
    }

    [[nodiscard]] Result<InputFile> input(const CertifiedInput& stated, const fs::path& path,
                                          std::optional<Format> format) const {
        const auto size = size_of_file(path);
        if (!size) return size.error();
        if (*size != stated.bytes) return InputFile{"", *size, {}};
        const auto contents = read_within(path, *size, request_.limits);
        if (!contents) return contents.error();
        if (!format)
            return Error{ErrorCode::unknown_format, "no format that can be read has this extension",
                         path.string()};
        auto surfaces = parse_surfaces(*contents, stated.name, *format, request_.reading.options);
        InputFile file = input_file(*contents, {});
        if (surfaces)
            file.surfaces = std::move(*surfaces);
        else if (file.sha256 == stated.sha256)
            return surfaces.error();
        return file;
    }

    [[nodiscard]] JudgedOutput judge_output(OutputVerifier& verifier, std::size_t number,
                                            const fs::path& path) const {
        const CertifiedOutput& stated = certificate_.outputs[number];
        JudgedOutput judged{number, path.string(), {}, {}};
        const auto size = size_of_file(path);
        if (size && *size != stated.bytes) {
            judged.verdict.violations = {{Rule::R21_output,
                                          {static_cast<std::uint32_t>(number)},
                                          path.string() + " has " + std::to_string(*size) +
                                              " bytes, not " + std::to_string(stated.bytes)}};
            return judged;
        }
        const auto contents = size ? read_within(path, *size, request_.limits) : size.error();
        if (contents)
            judged.verdict = verifier(*contents, number);
        else
            judged.missing = contents.error().sentence;
        return judged;
    }

    /// Returns the output in whose place a file is judged: the one with its bytes, else the first with its extension
    /// for which none is named, else the first.
    [[nodiscard]] std::size_t output_like(const fs::path& path,
                                          const std::vector<std::optional<fs::path>>& named) const {
        const auto& outputs = certificate_.outputs;
        const auto found_if = [&](const auto& fits) {
            std::size_t i = 0;
            while (i < outputs.size() && !fits(i)) ++i;
            return i;
        };
        if (const auto size = size_of_file(path); size)
            if (const auto contents = read_within(path, *size, request_.limits); contents) {
                const auto hash = input_file(*contents, {}).sha256;
                const auto same =
                    found_if([&](std::size_t i) { return outputs[i].sha256 == hash && !named[i]; });
                if (same < outputs.size()) return same;
            }
        const auto alike = found_if([&](std::size_t i) {
            return fs::path(outputs[i].name).extension() == path.extension() && !named[i];
        });
        return alike < outputs.size() ? alike : 0;
    }

    const JudgementRequest& request_;
    const Certificate& certificate_;
    fs::path folder_;
};

Result<Judgement> judged_within(const JudgementRequest& request) {
    const bool standard = request.certificate == "-";
    const auto size = standard ? Result<std::uint64_t>(0) : size_of_file(request.certificate);
    if (!size) return size.error();
    const auto text = read_within(request.certificate, *size, request.limits);
    if (!text) return text.error();
    auto certificate =
        parse_certificate(*text, standard ? "standard input" : request.certificate.string());
    if (!certificate) return certificate.error();
    const CertifiedFiles files(request, *certificate);
    std::vector<JudgedInput> read;
    const auto inputs = files.inputs(read);
    if (!inputs) return inputs.error();
    if (!request.outputs.empty() && certificate->outputs.empty())
        return Error{ErrorCode::bad_option, "the certificate names no output file", "--output"};
    auto verdict = verify_certificate(*inputs, *certificate, request.options);
    if (const auto checked = files.check_expected(read, verdict.violations); !checked)
        return checked.error();
    auto outputs = verdict.violations.empty() ? files.outputs() : std::vector<JudgedOutput>();
    return Judgement{std::move(*certificate), std::move(verdict), std::move(read),
                     std::move(outputs)};
}

} // namespace

ArrangementClaim claim_of(const Arrangement& exact) {
    ArrangementClaim claim;
    for (std::uint32_t v = 0; v < exact.vertices.size(); ++v)
        claim.vertices.push_back(exact.construction(VertexId(v)));
    claim.triangles = exact.triangles;
    claim.parents_of = exact.parents_of;
    claim.intersection_edges = exact.intersection_edges;
    claim.degenerate = exact.degenerate;
    claim.duplicates = exact.inputs.duplicates;
    return claim;
}

Result<Judgement> judge(const JudgementRequest& request, const std::stop_token& stop) {
    const auto& [time, memory] = request.limits;
    if (!(time > 0) || !(memory > 0))
        return Error{ErrorCode::bad_option, "must be positive", time > 0 ? "memory" : "time"};
    return guarded("for the judgement", "verify", [&]() -> Result<Judgement> {
        detail::JudgementWatch watch(request.limits, stop);
        auto judged = stoppable(watch.token(), [&] { return judged_within(request); });
        if (const auto& reached = watch.end(); !judged && reached) return *reached;
        return judged;
    });
}

} // namespace terrane
