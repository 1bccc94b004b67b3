// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of surfaces that were sealed or extended, and changed then: each is refuted.
#include "support/sealed_certificates.hpp"

using namespace forged;

TEST_CASE("sealed certificates: forged lists of what was added", "[sealing]") {
    const auto first_added = [](Json& s) -> Json& { return s[0]["sealed"][0]; };
    check_grown(
        right_sealed(),
        {
            sealed(
                "a limit of nothing", [](Json& s) { s[0]["limit"] = "0"; }, "R26"),
            sealed(
                "half of the limit",
                [](Json& s) { set_number(s[0]["limit"], number_in(s[0]["limit"]) / 2); }, "R26"),
            sealed(
                "nine tenths of the limit",
                [](Json& s) { set_number(s[0]["limit"], number_in(s[0]["limit"]) * 0.9); }, "R26"),
            sealed(
                "nine tenths of the limit of what was trimmed",
                [](Json& s) { set_number(s[1]["limit"], number_in(s[1]["limit"]) * 0.9); }, "R26"),
            sealed(
                "a limit above all that is accepted",
                [](Json& s) { set_number(s[0]["limit"], 1e9); }, "R26"),
            sealed(
                "a large limit of an unchanged surface", [](Json& s) { s[2]["limit"] = "1"; },
                "R26"),
            sealed(
                "a negative limit", [](Json& s) { s[0]["limit"] = "-1"; }, "R53"),
            sealed(
                "a surface is missing", [](Json& s) { s.erase(2); }, "R53"),
            sealed(
                "a surface too many", [](Json& s) { s.push_back(s[2]); }, "R53"),
            sealed(
                "the surfaces exchanged", [](Json& s) { std::swap(s[0], s[1]); }, "R2"),
            sealed(
                "an added triangle is missing", [](Json& s) { s[0]["sealed"].erase(0); }, "R1"),
            sealed(
                "nothing was added", [](Json& s) { s[0]["sealed"] = Json::array(); }, "R1"),
            sealed(
                "an added corner elsewhere", [&](Json& s) { first_added(s)[2][0] = "6"; }, "R6"),
            sealed(
                "an added corner a little aside",
                [&](Json& s) {
                    Json& x = first_added(s)[2][0];
                    set_number(x, std::nextafter(number_in(x), 100));
                },
                "R6"),
            sealed(
                "an added triangle turned over",
                [&](Json& s) { std::swap(first_added(s)[0], first_added(s)[1]); }, "R19"),
            sealed(
                "an added triangle twice",
                [&](Json& s) { s[0]["sealed"].push_back(first_added(s)); }, "R2"),
            sealed(
                "an added triangle of another surface",
                [&](Json& s) {
                    s[1]["sealed"].push_back(s[0]["sealed"].back());
                    s[0]["sealed"].erase(s[0]["sealed"].size() - 1);
                },
                "R6"),
            sealed(
                "as extended, without a volume",
                [&](Json& s) {
                    s[0]["extended"] = s[0]["sealed"];
                    s[0]["sealed"] = Json::array();
                },
                "R53"),
            {"the added triangles are left out", [](Json& c) { c.erase("sealed"); }, "missing"},
            {"a key of a part is left out", [](Json& c) { c["sealed"][0].erase("extended"); },
             "missing"},
            {"as a cut", [](Json& c) { c["kind"] = "cut"; }, "unknown"},
            {"as an arrangement", [](Json& c) { c["kind"] = "arrangement"; }, "unknown"},
        });
}

TEST_CASE("sealed certificates: forged lists of what was left out", "[sealing]") {
    check_grown(
        right_sealed(),
        {
            left_out(
                "what is beyond the fault was kept",
                [](Json& c) { c["cut"]["dropped"] = Json::array(); }, "R55"),
            left_out(
                "one triangle beyond the fault was kept",
                [](Json& c) {
                    const std::size_t t = exact_triangles(c, true, true).front();
                    std::set<std::size_t> dropped(c["cut"]["dropped"].begin(),
                                                  c["cut"]["dropped"].end());
                    dropped.erase(t);
                    c["cut"]["dropped"] = dropped;
                },
                "R26"),
            left_out(
                "a part of what was trimmed was kept",
                [](Json& c) {
                    const std::size_t t = exact_triangles(c, true, false).front();
                    std::set<std::size_t> dropped(c["cut"]["dropped"].begin(),
                                                  c["cut"]["dropped"].end());
                    dropped.erase(t);
                    c["cut"]["dropped"] = dropped;
                },
                "R56"),
            left_out(
                "a given triangle is missing",
                [](Json& c) { drop_exact(c, {exact_triangles(c, false, false).front()}); }, "R56"),
            left_out(
                "a triangle at the border is missing",
                [](Json& c) { drop_exact(c, {exact_triangles(c, false, false).back()}); }, "R56"),
            left_out(
                "a triangle of a strip is missing",
                [](Json& c) {
                    const auto kept = exact_triangles(c, false, true);
                    drop_exact(c, {kept[kept.size() / 2]});
                },
                "R55"),
            left_out(
                "the fault is missing",
                [](Json& c) {
                    const std::size_t first = Numbering(c).given[2];
                    std::vector<std::size_t> gone;
                    for (const std::size_t t : exact_triangles(c, false, false))
                        if (c["exact"]["parents"][t][0] >= first) gone.push_back(t);
                    drop_exact(c, gone);
                },
                "R56"),
            left_out(
                "the list is not sorted",
                [](Json& c) { std::swap(c["cut"]["dropped"][0], c["cut"]["dropped"][1]); }, "R51"),
            left_out(
                "a triangle twice",
                [](Json& c) { c["cut"]["dropped"].push_back(c["cut"]["dropped"].back()); }, "R51"),
            left_out(
                "a triangle that does not exist",
                [](Json& c) { c["cut"]["dropped"].push_back(1000000); }, "R51"),
            left_out(
                "a volume that is none",
                [](Json& c) {
                    c["cut"]["volume"] = {{"shape", "prism"},
                                          {"corners", Json::array()},
                                          {"between", Json::array()},
                                          {"files", 0},
                                          {"boundary", Json::array()}};
                },
                "R50"),
        });
}

TEST_CASE("sealed certificates: forged doubles", "[sealing]") {
    const auto doubles = [](const std::string& name, const std::function<void(Json&)>& change,
                            const std::string& rule) {
        return Forgery{name, [change](Json& c) { change(c["rounded"]); }, rule};
    };
    check_grown(right_sealed(),
                {
                    doubles(
                        "a triangle is missing", [](Json& m) { drop_triangle(m, 7); }, "R12"),
                    doubles(
                        "a vertex moved",
                        [](Json& m) {
                            Json& z = m["vertices"][9][2];
                            set_number(z, number_in(z) + 1e-9);
                        },
                        "R13"),
                    doubles(
                        "turned over", [](Json& m) { turn_over(m, 3); }, "R14"),
                    doubles(
                        "another region", [](Json& m) { m["regions"][3][0] = 77; }, "R16"),
                    {"what was trimmed is there", put_back, "R14"},
                });
    check_grown(with_diagonal(right_sealed()),
                {{"what was trimmed is there, among other triangles", put_back, "R18"}});
}

TEST_CASE("sealed certificates: forged volumes and extensions", "[sealing]") {
    check_grown(
        right_extended(),
        {
            {"another height", [](Json& c) { c["cut"]["volume"]["between"][1] = "3"; }, "R50"},
            {"another corner", [](Json& c) { c["cut"]["volume"]["corners"][0][0] = "1"; }, "R50"},
            {"no volume", [](Json& c) { c["cut"]["volume"] = nullptr; }, "R53"},
            {"a nameless volume", [](Json& c) { c["cut"]["volume"]["shape"] = ""; }, "shape"},
            {"a side of the box is missing",
             [](Json& c) { c["cut"]["volume"]["boundary"].erase(2); }, "R50"},
            {"all is kept", [](Json& c) { c["cut"]["dropped"] = Json::array(); }, "R51"},
            {"a triangle of the boundary is missing",
             [](Json& c) {
                 const auto kept = exact_triangles(c, false, false);
                 drop_exact(c, {kept.back()});
             },
             "R51"},
            {"a triangle inside is missing",
             [](Json& c) { drop_exact(c, {exact_triangles(c, false, false).front()}); }, "R56"},
            {"nothing that was added was kept inside",
             [](Json& c) {
                 auto kept = exact_triangles(c, false, true);
                 kept.resize(kept.size() / 2);
                 drop_exact(c, kept);
             },
             "R55"},
            sealed(
                "an extension shorter than it is",
                [](Json& s) { set_number(s[0]["limit"], number_in(s[0]["limit"]) * 0.9); }, "R26"),
            sealed(
                "an extended corner elsewhere", [](Json& s) { s[0]["extended"][0][2][0] = "0.25"; },
                "R6"),
            sealed(
                "an extension is left out", [](Json& s) { s[0]["extended"].erase(1); }, "R1"),
        });
}

TEST_CASE("sealed certificates: volumes that no text can state are refused", "[sealing]") {
    const auto parsed = parse_certificate(right_extended().certificate.dump(), "c");
    REQUIRE(parsed);
    Certificate nameless = *parsed;
    nameless.cut->volume.shape = ""; // the boundary is there, but nothing says of what
    Certificate more_files = *parsed;
    more_files.cut->volume.files = 99;
    for (const Certificate& wrong : {nameless, more_files}) {
        const auto verdict = verify_certificate(right_extended().inputs, wrong);
        REQUIRE_FALSE(verdict.violations.empty());
        CHECK(verdict.violations.front().rule == Rule::R50_volume);
    }
}

TEST_CASE("sealed certificates: output files", "[sealing]") {
    const Subject right =
        sealed_subject(gaping(), {gaping_box(), 0.3, 2.5}, {"obj", "ply", "vtp", "ts"});
    REQUIRE(judged(right) == "");
    for (std::size_t i = 0; i < right.contents.size(); ++i) {
        INFO(right.certificate["outputs"][i]["name"]);
        for (const double place : {0.3, 0.5, 0.7}) {
            Subject wrong = right;
            std::string& text = wrong.contents[i];
            const auto digit = text.find_first_of(
                "123456789", static_cast<std::size_t>(static_cast<double>(text.size()) * place));
            REQUIRE(digit != std::string::npos);
            text[digit] = text[digit] == '9' ? '8' : static_cast<char>(text[digit] + 1);
            CHECK(judged(wrong) == "R21");
            seal_grown(wrong); // with its new SHA-256 in the certificate
            CHECK(judged(wrong) == "R21");
        }
    }
}

TEST_CASE("sealed certificates: any digit of an output file counts", "[sealing]") {
    const Subject& right = right_sealed();
    const auto certificate = parse_certificate(right.certificate.dump(), "c");
    REQUIRE(certificate);
    std::size_t count = 0;
    for (std::size_t i = 0; i < right.contents[0].size(); i += 29) {
        std::string text = right.contents[0];
        if (text[i] < '0' || text[i] > '9') continue;
        text[i] = text[i] == '9' ? '8' : static_cast<char>(text[i] + 1);
        auto resealed = certificate.value();
        resealed.outputs[0].sha256 = hexadecimal(sha256(text));
        CHECK_FALSE(verify_output(text, resealed, 0).violations.empty());
        ++count;
    }
    CHECK(count > 20);
}
