// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/certificate_cases.hpp"
#include "support/files.hpp"

#include <filesystem>
#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

#include <terrane/io/certify.hpp>
#include <terrane/io/judgement/judgement.hpp>

namespace fs = std::filesystem;
using namespace terrane;

namespace {

/// A folder with a certificate of two crossing surfaces, its input and its two output files.
struct CertifiedFolder {
    test_support::TemporaryFolder folder;
    fs::path certificate = folder / "model.json", input = folder / "input.obj",
             output = folder / "model.vtp", other = folder / "model.off";

    explicit CertifiedFolder(const std::string& obj = certificate_cases::pierced()[0].contents) {
        std::ofstream(input) << obj;
        const auto surfaces = read_surfaces(input).value();
        const auto exact = arrange(surfaces).value();
        const auto rounded = round_to_doubles(exact).value();
        REQUIRE(write_mesh(rounded.mesh, output));
        REQUIRE(write_mesh(rounded.mesh, other));
        const auto text = certify({.inputs = {{input.string(), surfaces.size()}},
                                   .outputs = {{output.string(), "vtp"}, {other.string(), "off"}},
                                   .surfaces = surfaces,
                                   .exact = &exact,
                                   .rounded = &rounded},
                                  certificate);
        REQUIRE(text);
        std::ofstream(certificate) << *text;
    }

    void replace(const std::string& from, const std::string& to) const {
        std::string text = read_file(certificate).value();
        REQUIRE(text.find(from) != std::string::npos);
        text.replace(text.find(from), from.size(), to);
        std::ofstream(certificate) << text;
    }
    [[nodiscard]] Result<Judgement> judged() const { return judge({.certificate = certificate}); }
};

/// Returns two sheets of n x n cells that cross.
std::string crossing_sheets(int n) {
    std::string text;
    for (const double slope : {0.013, -0.017})
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j)
                text += "v " + std::to_string(i) + " " + std::to_string(j) + " " +
                        std::to_string(slope * (i + 0.3 * j - 0.61 * n) + 0.01 * (i * j % 5)) +
                        "\n";
    for (int sheet = 0; sheet < 2; ++sheet) {
        text += "g sheet" + std::to_string(sheet) + "\n";
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const int a = (sheet * (n + 1) + i) * (n + 1) + j + 1;
                const auto face = [&](int b, int c) {
                    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
                            std::to_string(c) + "\n";
                };
                face(a + n + 1, a + n + 2);
                face(a + n + 2, a + 1);
            }
    }
    return text;
}

/// Returns the error of a judgement that must fail at this file.
Error error_at(const Result<Judgement>& judged, const fs::path& file) {
    REQUIRE_FALSE(judged);
    CHECK(judged.error().place == file.string());
    return judged.error();
}

} // namespace

TEST_CASE("judgement: a certificate with all its files in its folder is verified") {
    const CertifiedFolder made;
    const auto judged = made.judged();
    REQUIRE(judged);
    CHECK(judged->verified());
    CHECK(judged->outputs.size() == 2);
}

TEST_CASE("judgement: files outside of the folder are opened only where the caller names them") {
    const CertifiedFolder made;
    const test_support::TemporaryFolder elsewhere;
    const fs::path moved = elsewhere / "input.obj";
    fs::rename(made.input, moved);
    const fs::path climbing = fs::path("..") / elsewhere.path().filename() / "input.obj";
    for (const fs::path& place : {moved, climbing}) {
        const std::string name = place.string();
        const CertifiedFolder again;
        again.replace("\"input.obj\"", "\"" + name + "\"");
        const auto error = error_at(again.judged(), again.folder.path() / name);
        CHECK(error.sentence.find("outside of the certificate's folder") != std::string::npos);
        CHECK(judge({.certificate = again.certificate, .inputs = {moved}})->verified());
        CHECK(judge({.certificate = again.certificate, .folder = "/"})->verified());
    }
    fs::create_symlink(moved, made.input);
    const auto error = error_at(made.judged(), made.input);
    CHECK(error.sentence.find("link") != std::string::npos);
    CHECK(judge({.certificate = made.certificate, .inputs = {made.input}})->verified());
}

TEST_CASE("judgement: a link to a folder leads nowhere") {
    const CertifiedFolder made;
    const test_support::TemporaryFolder elsewhere;
    fs::rename(made.output, elsewhere / "model.vtp");
    fs::create_directory_symlink(elsewhere.path(), made.folder / "sub");
    made.replace("\"model.vtp\"", "\"sub/model.vtp\"");
    const auto judged = made.judged();
    REQUIRE(judged);
    CHECK_FALSE(judged->verified());
    CHECK(judged->outputs[0].missing.find("link") != std::string::npos);
}

TEST_CASE("judgement: pipes and devices are not opened") {
    const CertifiedFolder made;
    fs::remove(made.input);
    REQUIRE(::mkfifo(made.input.c_str(), 0600) == 0); // opening it would wait for ever
    CHECK(error_at(made.judged(), made.input).sentence == "is no regular file");
    CHECK(error_at(judge({.certificate = made.certificate, .inputs = {"/dev/zero"}}), "/dev/zero")
              .sentence == "is no regular file");
    CHECK(error_at(judge({.certificate = "/dev/zero"}), "/dev/zero").sentence ==
          "is no regular file");
}

TEST_CASE("judgement: a file of another size is refuted unread") {
    const CertifiedFolder made;
    // 2^40 bytes without blocks on the disk.
    REQUIRE(::truncate(made.output.c_str(), off_t(1) << 40) == 0);
    auto judged = made.judged();
    REQUIRE(judged);
    REQUIRE(judged->violations().size() == 1);
    CHECK(judged->violations()[0].rule == Rule::R21_output);
    REQUIRE(::truncate(made.input.c_str(), off_t(1) << 40) == 0);
    judged = made.judged();
    REQUIRE(judged);
    REQUIRE(judged->violations().size() == 1);
    CHECK(judged->violations()[0].rule == Rule::R9_inputs);
}

TEST_CASE("judgement: a file that is larger than the memory is not read, whatever is stated") {
    const CertifiedFolder made;
    const auto bytes = fs::file_size(made.input);
    REQUIRE(::truncate(made.input.c_str(), off_t(1) << 40) == 0);
    made.replace("\"bytes\":" + std::to_string(bytes),
                 "\"bytes\":" + std::to_string(std::uint64_t(1) << 40));
    CHECK(error_at(made.judged(), made.input).code == ErrorCode::out_of_memory);
}

TEST_CASE("judgement: all outputs are judged, whichever are named") {
    const CertifiedFolder made;
    std::string text = read_file(made.other).value();
    text[text.size() - 2] ^= 1;
    std::ofstream(made.other) << text;
    const fs::path moved = made.folder / "moved.vtp";
    fs::rename(made.output, moved);
    const auto judged = judge({.certificate = made.certificate, .outputs = {moved}});
    REQUIRE(judged);
    REQUIRE(judged->outputs.size() == 2);
    CHECK(judged->outputs[0].verified());
    CHECK_FALSE(judged->outputs[1].verified());
    CHECK_FALSE(judged->verified());
}

TEST_CASE("judgement: a certificate about another file than expected is refuted") {
    const CertifiedFolder made;
    const fs::path copy = made.folder / "copy.obj", other = made.folder / "other.obj";
    fs::copy_file(made.input, copy);
    std::ofstream(other) << read_file(made.input).value() << "# one\n";
    CHECK(judge({.certificate = made.certificate, .expected = {copy}})->verified());
    const auto judged = judge({.certificate = made.certificate, .expected = {copy, other}});
    REQUIRE(judged);
    REQUIRE(judged->violations().size() == 1);
    CHECK(judged->violations()[0].rule == Rule::R9_inputs);
    CHECK_FALSE(judge({.certificate = made.certificate, .expected = {made.folder / "none"}}));
}

TEST_CASE("judgement: a certificate about no file is refuted") {
    const CertifiedFolder made;
    std::string text = read_file(made.certificate).value();
    const auto from = text.find("\"inputs\":["), to = text.find("],\n\"outputs\"");
    REQUIRE(from < to);
    text.replace(from, to - from, "\"inputs\":[");
    std::ofstream(made.certificate) << text;
    const auto judged = made.judged();
    REQUIRE(judged);
    REQUIRE(!judged->violations().empty());
    CHECK(judged->violations()[0].sentence == "there is no input file");
}

TEST_CASE("judgement: limits of time and memory, and the caller's stop") {
    const CertifiedFolder made(crossing_sheets(60));
    const auto error_within = [&](const JudgementLimits& limits) {
        const auto judged = judge({.certificate = made.certificate, .limits = limits});
        REQUIRE_FALSE(judged);
        CHECK(judged.error().place.empty());
        return judged.error().code;
    };
    CHECK(error_within({1e-3, 16e9}) == ErrorCode::timed_out);
    // The limit lets the text in, but not the parsed certificate, which is three times as large.
    CHECK(error_within({3600, 1. + double(fs::file_size(made.certificate))}) ==
          ErrorCode::out_of_memory);
    std::stop_source stopped;
    stopped.request_stop();
    const auto judged = judge({.certificate = made.certificate}, stopped.get_token());
    REQUIRE_FALSE(judged);
    CHECK(judged.error().code == ErrorCode::interrupted);
    CHECK(made.judged()->verified());
}
