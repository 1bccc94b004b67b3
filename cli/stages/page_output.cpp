// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/page_output.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/reports/verdict_report.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {
namespace {

/// Options that change no result, so that pages of equal results are equal.
constexpr std::array<std::string_view, 8> unlisted{"--report", "--stats", "--threads", "--output",
                                                   "--resume", "--help",  "--quiet",   "--color"};

/// Returns the options that were given, and their values.
std::vector<std::pair<std::string, std::string>> given_options(const CLI::App& app) {
    std::vector<std::pair<std::string, std::string>> options;
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() == 0 || option->get_lnames().empty()) continue;
        const std::string name = "--" + option->get_lnames()[0];
        if (std::find(unlisted.begin(), unlisted.end(), name) != unlisted.end()) continue;
        std::string values;
        for (const std::string& value : option->results())
            values += (values.empty() ? "" : " ") + value;
        options.emplace_back(name, values);
    }
    return options;
}

/// Returns a short title: the name of the first input file, and how many more there are.
std::string title_of(const FileOptions& files) {
    if (files.inputs.empty()) return "";
    const std::string& first = files.inputs.front();
    const auto name =
        first == "-" ? "standard input" : std::filesystem::path(first).filename().string();
    return files.inputs.size() == 1 ? name
                                    : fmt::format("{} and {} more", name, files.inputs.size() - 1);
}

/// Returns what `terrane verify` says, line by line, without the name of the certificate.
std::vector<std::string> lines_of(const Judgement& judged, const std::string& certificate) {
    const std::string name = one_line(certificate);
    std::istringstream text(without_marks(verdict_text(judged, name)));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    if (!lines.empty() && lines[0].starts_with(name + ": ")) lines[0].erase(0, name.size() + 2);
    return lines;
}

/// Tells why a certificate cannot be read again by this run; empty: it can.
std::string unreadable(const FileOptions& files, const std::string& certificate) {
    if (certificate == "-") return "Not judged, as it went to standard output.";
    if (std::find(files.inputs.begin(), files.inputs.end(), "-") != files.inputs.end())
        return "Not judged, as an input came from standard input.";
    return "";
}

page::CertificateVerdict judged_by_verifier(const FileOptions& files,
                                            const std::string& certificate) {
    const auto judged = judge({.certificate = certificate,
                               .folder = "/",
                               .reading = {format_named(files.input_format), files.read}});
    if (!judged) return {certificate, std::nullopt, {"Not judged: " + judged.error().message()}};
    return {certificate, judged->violations().empty(), lines_of(*judged, certificate)};
}

/// Returns what differs from run to run: seconds by stage, memory, threads.
Json run_json(const FileOptions& files, const Session& session) {
    Json run;
    run["seconds"] = seconds_json(session);
    run["peak_rss_mb"] = peak_memory();
    run["threads"] = files.threads;
    return run;
}

} // namespace

page::Page plan_page(const FileOptions& files, const Session& session) {
    if (files.report.empty()) return page::Page();
    must(page::check_pages(), "--report");
    check_folder(files.report);
    return page::Page({.command = files.app->get_name(),
                       .title = title_of(files),
                       .unit = {},
                       .options = given_options(*files.app),
                       .files = {}},
                      session.run().timing);
}

void add_page_inputs(page::Page& page, const FileOptions& files, const Inputs& inputs) {
    if (!page.wanted()) return;
    page.set_inputs(inputs.unit, inputs.files);
    for (const std::string& path : files.inputs) must(page.add_file(path));
}

void add_page_certificate(page::Page& page, const FileOptions& files,
                          const std::string& certificate, bool written, Session& session) {
    if (!page.wanted() || certificate.empty()) return;
    if (const auto reason = unreadable(files, certificate); !written || !reason.empty())
        return page.add_certificate(
            {certificate, std::nullopt, {written ? reason : "Not written, as nothing was."}});
    session.begin("verify", Phase::computing);
    page.add_certificate(judged_by_verifier(files, certificate));
    session.end_stage();
}

void write_page(page::Page& page, const FileOptions& files, const Json& statistics,
                Session& session) {
    if (!page.wanted()) return;
    session.begin("page", Phase::writing);
    must(write_file(files.report, must(page.html(statistics, run_json(files, session)))));
    session.end_stage();
    say_written(summary_stream(files), files.report);
}

ExitStatus write_run(page::Page& page, const Json& statistics, const FileOptions& files,
                     Session& session, bool good) {
    write_page(page, files, statistics, session);
    write_statistics(statistics, files.stats, session);
    return good ? ExitStatus::done : ExitStatus::negative;
}

} // namespace terrane::cli
