// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/certificate_cases.hpp"
#include "support/files.hpp"

#include <filesystem>
#include <fstream>

using namespace certificate_cases;

TEST_CASE("certificate: what the producer writes is valid") {
    for (const auto& files : {pierced(), overlapping()})
        for (const bool with_doubles : {true, false})
            CHECK(verdict(input_files(files), certificate_of(files, with_doubles)).empty());
}

TEST_CASE("certificate: of an arrangement whose rounding was refused, with what is left said") {
    const File file = overlapping().front();
    const auto surfaces = surfaces_of(file);
    const auto exact = arrange(surfaces);
    REQUIRE(exact);
    RoundedMesh rounded = round_to_doubles(exact.value()).value();
    rounded.report.clean = false; // the mesh is conforming, so that this is refuted
    const std::vector<InputRecord> records{
        {file.name, hexadecimal(sha256(file.contents)), file.contents.size(), surfaces.size()}};
    const Certified certified{records, surfaces, exact.value(), &rounded};
    CHECK(verdict(input_files({file}), to_certificate(certified)) == "R11");
    Mesh changed = rounded.mesh;
    std::swap(changed.triangles[0], changed.triangles[1]); // parents no longer fit either
    rounded.mesh = changed;
    CHECK(verdict(input_files({file}), to_certificate(certified)) != "");
}

TEST_CASE("certificate: the first lines are as documented") {
    const auto text = certificate_of(pierced());
    CHECK(text.starts_with(
        R"({"format":"terrane-certificate","version":2,"kind":"arrangement",
"inputs":[{"name":"plane.obj","sha256":")"));
    CHECK(text.find(R"("exact":{"vertices":[["v",0],)") != std::string::npos);
    CHECK(text.find(R"(["lp",3,5,0,1,2])") != std::string::npos);
    CHECK(text.find(R"("rounded":{"vertices":[["0","0","0"],)") != std::string::npos);
    CHECK(text.find("\"digest\":\"sha256:") != std::string::npos);
}

TEST_CASE("certificate: read as it was written") {
    const auto files = overlapping();
    const auto text = certificate_of(files);
    const auto certificate = parse_certificate(text, "c.json");
    REQUIRE(certificate);
    const Certificate& c = certificate.value();
    REQUIRE(c.inputs.size() == 1);
    CHECK(c.inputs[0].name == "model.obj");
    CHECK(c.inputs[0].bytes == files[0].contents.size());
    CHECK(c.inputs[0].surfaces.size() == 3);
    CHECK(c.inputs[0].surfaces[1] == CertifiedSurface{"b", Role::unknown, 3, 2});
    CHECK(c.exact.degenerate == std::vector<std::uint32_t>{1});
    CHECK(c.exact.duplicates == std::vector<std::array<std::uint32_t, 2>>{{3, 2}});
    REQUIRE(c.rounded);
    CHECK(c.rounded->clean);
    CHECK(c.rounded->max_move == 0.0);
    CHECK(c.rounded->regions_of.size() == c.rounded->triangles.size());
}

TEST_CASE("certificate: names that need escapes, and some that are no UTF-8") {
    auto surfaces = surfaces_of(pierced()[0]);
    surfaces[0].name = "a \"quoted\"\\ \n name";
    const auto exact = arrange(surfaces);
    REQUIRE(exact);
    const std::vector<InputRecord> records{{"x.obj", std::string(64, '0'), 1, 1}};
    auto c = parse_certificate(to_certificate({records, surfaces, exact.value()}), "c");
    REQUIRE(c);
    CHECK(c.value().inputs[0].surfaces[0].name == surfaces[0].name);
    surfaces[0].name = "\xff";
    c = parse_certificate(to_certificate({records, surfaces, exact.value()}), "c");
    REQUIRE(c);
    CHECK(c.value().inputs[0].surfaces[0].name == "\xEF\xBF\xBD");
}

TEST_CASE("certificate: files are called relative to it") {
    CHECK(certified_name("data/a.obj", "out/c.json") == "../data/a.obj");
    CHECK(certified_name("a.obj", "c.json") == "a.obj");
    CHECK(certified_name("/data/a.obj", "/data/out/c.json") == "../a.obj");
    // The folder exists, but the file does not.
    const auto here = std::filesystem::current_path().filename();
    CHECK(certified_name("data/a.obj", "../c.json") == (here / "data/a.obj").generic_string());
}

TEST_CASE("certificate: inputs are hashed as they are on the disk") {
    const test_support::TemporaryFolder folder;
    const auto path = folder / "input.obj";
    std::ofstream(path) << "abc";
    const auto record = record_input(path, "name", 2);
    std::filesystem::remove(path);
    REQUIRE(record);
    CHECK(record.value().bytes == 3);
    CHECK(record.value().surfaces == 2);
    CHECK(record.value().sha256 ==
          "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    const auto missing = record_input(path, "name", 2);
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == ErrorCode::cannot_open);
}

TEST_CASE("certificate: what is no JSON is refused with its place") {
    const auto c = parse_certificate("{\n  \"format\": terrane}", "c.json");
    REQUIRE_FALSE(c);
    CHECK(c.error().code == ErrorCode::bad_syntax);
    CHECK(c.error().place == "c.json, line 2, column 13");
    CHECK_FALSE(parse_certificate("", "c"));
    CHECK_FALSE(parse_certificate(std::string(100'000, '['), "c"));
    const auto whole = certificate_of(pierced());
    for (std::size_t cut = 0; cut + 2 < whole.size(); cut += 7)
        CHECK_FALSE(parse_certificate(whole.substr(0, cut), "c"));
}
