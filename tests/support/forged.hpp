// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates that were changed and sealed anew: the digest and the hashes of the output files are
// computed again, as a forger would.
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <terrane/algorithms/verify/detail/digest.hpp>

#include "support/certificate_cases.hpp"
#include "support/effort.hpp"

namespace forged {

using namespace certificate_cases;
using Json = nlohmann::json;

/// A certificate with the files that it is about.
struct Subject {
    std::vector<InputFile> inputs;
    std::vector<Surface> surfaces;     ///< of all inputs
    Json certificate;                  ///< as the producer wrote it, until it is changed
    std::vector<std::string> contents; ///< of the output files
};

/// Adds files and their surfaces to a subject; returns what a certificate says about them.
inline std::vector<InputRecord> add_inputs(Subject& s, const std::vector<File>& files) {
    std::vector<InputRecord> records;
    for (InputFile& file : input_files(files)) {
        records.push_back(
            {files[records.size()].name, file.sha256, file.bytes, file.surfaces.size()});
        s.surfaces.insert(s.surfaces.end(), file.surfaces.begin(), file.surfaces.end());
        s.inputs.push_back(std::move(file));
    }
    return records;
}

/// Adds an output file in each format: "obj", "stl-ascii", "vtp-plain"; returns what a certificate
/// says about them.
inline std::vector<OutputRecord> add_outputs(Subject& s, const Mesh& mesh,
                                             const std::vector<std::string>& formats) {
    std::vector<OutputRecord> records;
    for (const std::string& format : formats) {
        WriteOptions options;
        options.ascii = format == "stl-ascii";
        options.compress = format != "vtp-plain";
        const std::string name = format.substr(0, format.find('-'));
        auto text = format_mesh(mesh, format_named(name).value(), options);
        REQUIRE(text);
        records.push_back(record_output(text.value(), "out." + name, options.ascii ? format : name,
                                        mesh.surfaces));
        s.contents.push_back(std::move(text).value());
    }
    return records;
}

/// What certificates of an arrangement and of its improved mesh are made of.
struct RoundedInputs {
    std::vector<InputRecord> records;
    Arrangement exact;
    RoundedMesh rounded;
};

/// Adds files to a subject, arranges and rounds its surfaces.
inline RoundedInputs rounded_inputs(Subject& s, const std::vector<File>& files) {
    RoundedInputs made;
    made.records = add_inputs(s, files);
    auto exact = arrange(s.surfaces);
    REQUIRE(exact);
    made.exact = std::move(exact).value();
    auto rounded = round_to_doubles(made.exact);
    REQUIRE(rounded);
    made.rounded = std::move(rounded).value();
    return made;
}

/// Returns the certificate of these files with an output file in each format.
inline Subject subject(const std::vector<File>& files,
                       const std::vector<std::string>& formats = {"obj"}) {
    Subject s;
    const auto [records, exact, rounded] = rounded_inputs(s, files);
    const auto outputs = add_outputs(s, rounded.mesh, formats);
    s.certificate = Json::parse(to_certificate({records, s.surfaces, exact, &rounded, outputs}));
    return s;
}

/// Computes the digest and the hashes of the output files anew, where the text can be parsed.
inline void seal(Subject& s) {
    for (std::size_t i = 0; i < s.contents.size() && i < s.certificate["outputs"].size(); ++i) {
        s.certificate["outputs"][i]["sha256"] = hexadecimal(sha256(s.contents[i]));
        s.certificate["outputs"][i]["bytes"] = s.contents[i].size();
    }
    const auto parsed = parse_certificate(s.certificate.dump(), "c");
    if (!parsed || !s.certificate.contains("digest")) return; // some kinds have no digest
    for (const Violation& v : verify_arrangement(s.surfaces, parsed->exact))
        if (v.rule <= Rule::R2_vertices) return; // a digest needs sound indices
    if (const auto digest = verifier::digest_of(s.surfaces, parsed->exact); digest)
        s.certificate["digest"] = *digest;
}

/// Returns the violated rules, as "R5 R7", or the error if the text is not a certificate; with the
/// rules that the output files violate, if there are no others.
inline std::string judged(const Subject& s, const VerifyOptions& options = {}) {
    const auto certificate = parse_certificate(s.certificate.dump(), "c.json");
    if (!certificate) return certificate.error().message();
    auto violations = verify_certificate(s.inputs, certificate.value(), options).violations;
    if (violations.empty())
        for (std::size_t i = 0; i < certificate->outputs.size() && i < s.contents.size(); ++i)
            for (const Violation& v :
                 verify_output(s.contents[i], certificate.value(), i).violations)
                violations.push_back(v);
    std::set<Rule> rules;
    for (const Violation& v : violations) rules.insert(v.rule);
    std::string result;
    for (const Rule rule : rules) result += (result.empty() ? "" : " ") + name_of(rule);
    return result;
}

/// A way to change a certificate, and a rule that it breaks.
struct Forgery {
    std::string name;
    std::function<void(Json&)> change;
    std::string rule;
};

/// Checks that the certificate is valid, and that each forgery, once its digest and hashes are computed
/// anew by `make_consistent`, is refuted by its rule. Under sanitizers, which judge no verdicts, each third one.
inline void check_forgeries(const Subject& right, const std::vector<Forgery>& forgeries,
                            const std::function<void(Subject&)>& make_consistent = seal) {
    REQUIRE(judged(right) == "");
    for (std::size_t i = 0; i < forgeries.size(); i += test_support::is_sanitized ? 3 : 1) {
        const Forgery& forgery = forgeries[i];
        INFO(forgery.name);
        Subject wrong = right;
        forgery.change(wrong.certificate);
        REQUIRE(wrong.certificate != right.certificate);
        make_consistent(wrong);
        const auto rules = judged(wrong);
        INFO(rules);
        CHECK((" " + rules + " ").find(" " + forgery.rule + " ") != std::string::npos);
    }
}

/// Changes a digit in each output file, the first one at or behind a place, and checks that R21
/// refutes the file: by its SHA-256, and by what it holds where the certificate has the new one.
inline void check_changed_digits(const Subject& right,
                                 const std::function<std::size_t(const std::string&)>& place) {
    REQUIRE(judged(right) == "");
    REQUIRE_FALSE(right.contents.empty());
    for (std::size_t i = 0; i < right.contents.size(); ++i) {
        INFO(right.certificate["outputs"][i]["name"]);
        Subject wrong = right;
        std::string& text = wrong.contents[i];
        const auto digit = text.find_first_of("123456789", place(text));
        REQUIRE(digit != std::string::npos);
        text[digit] = text[digit] == '9' ? '8' : static_cast<char>(text[digit] + 1);
        CHECK(judged(wrong) == "R21");
        seal(wrong);
        CHECK(judged(wrong) == "R21");
    }
}

/// Checks that R21 refutes each output file with a byte altered, deleted or inserted, at each fiftieth of
/// the file, where the certificate has the new hash. Compressed numbers are not altered: they have many
/// forms. The certificate must be valid.
inline void check_each_byte(const Subject& right) {
    constexpr std::size_t places = 50;
    REQUIRE(judged(right) == "");
    auto certificate = parse_certificate(right.certificate.dump(), "c").value();
    OutputVerifier verifier(certificate);
    for (std::size_t i = 0; i < right.contents.size(); ++i)
        for (std::size_t n = 0; n <= places; ++n) {
            const std::string& text = right.contents[i];
            const std::size_t at = n * (text.size() - 1) / places;
            INFO(certificate.outputs[i].name << " byte " << at);
            const auto accepts = [&](const std::string& wrong) {
                certificate.outputs[i].sha256 = hexadecimal(sha256(wrong));
                certificate.outputs[i].bytes = wrong.size();
                return verifier(wrong, i).violations.empty();
            };
            std::string wrong = text;
            wrong[at] = static_cast<char>(wrong[at] ^ 1);
            const bool is_packed = verifier(text, i).check == OutputCheck::inflated &&
                                   text[text.rfind('\n', at) + 1] != '<';
            CHECK((is_packed || !accepts(wrong)));
            CHECK_FALSE(accepts(std::string(text).erase(at, 1)));
            CHECK_FALSE(accepts(std::string(text).insert(at, 1, text[at])));
            CHECK(accepts(text));
        }
}

inline std::size_t middle_of(const std::string& text) {
    return text.size() / 2;
}

/// Returns where the first vertex of an OBJ file is.
inline std::size_t first_vertex(const std::string& obj) {
    return obj.find("\nv ");
}

// --- Numbers, and files of surfaces -------------------------------------------------------------

inline double number_in(const Json& number) {
    return std::stod(number.get<std::string>());
}

/// Returns the shortest text that reads back as the same double.
inline std::string decimal_text(double value) {
    std::array<char, 64> buffer{};
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + 64, value).ptr};
}

inline void shift_number(Json& number, double by) {
    number = decimal_text(number_in(number) + by);
}

/// Returns an OBJ text of surfaces.
inline std::string obj_text(const std::vector<Surface>& surfaces) {
    std::string text;
    std::size_t first = 1;
    for (const Surface& s : surfaces) {
        for (const Point3& p : s.vertices)
            text +=
                "v " + decimal_text(p.x) + " " + decimal_text(p.y) + " " + decimal_text(p.z) + "\n";
        text += "g " + s.name + "\n";
        for (const Triangle& t : s.triangles) {
            text += "f";
            for (const std::uint32_t v : t) text += " " + std::to_string(v + first);
            text += "\n";
        }
        first += s.vertices.size();
    }
    return text;
}

/// Returns what a file of any format holds, as OBJ.
inline std::string obj_in(const std::string& path) {
    const auto surfaces = read_surfaces(path);
    REQUIRE(surfaces);
    return obj_text(surfaces.value());
}

inline std::string text_in(const std::string& path) {
    std::ifstream in(path);
    std::string text(std::istreambuf_iterator<char>(in), {});
    REQUIRE_FALSE(text.empty());
    return text;
}

// --- Changes of a part, "exact" or "rounded" ----------------------------------------------------

inline const std::vector<std::string> both{"exact", "rounded"};

inline void drop_triangle(Json& part, std::size_t t) {
    for (const char* list : {"triangles", "parents", "regions"})
        if (part.contains(list)) part[list].erase(t);
}

inline void add_triangle(Json& part, const Json& corners, const Json& parents) {
    part["triangles"].push_back(corners);
    part["parents"].push_back(parents);
    if (part.contains("regions")) part["regions"].push_back(part["regions"].back());
}

inline void turn_over(Json& part, std::size_t t) {
    const Json first = part["triangles"][t][0];
    part["triangles"][t][0] = part["triangles"][t][1];
    part["triangles"][t][1] = first;
}

/// Removes the vertices that no triangle has, and numbers the others anew.
inline void drop_unused(Json& part) {
    std::vector<int> number(part["vertices"].size(), -1);
    for (const Json& t : part["triangles"])
        for (const Json& v : t) number[v.get<std::size_t>()] = 0;
    Json vertices = Json::array();
    for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] == 0) {
            number[v] = static_cast<int>(vertices.size());
            vertices.push_back(part["vertices"][v]);
        }
    part["vertices"] = vertices;
    for (Json& t : part["triangles"])
        for (Json& v : t) v = number[v.get<std::size_t>()];
    if (!part.contains("intersection_edges")) return;
    Json edges = Json::array();
    for (const Json& e : part["intersection_edges"]) {
        const int low = number[e[0].get<std::size_t>()], high = number[e[1].get<std::size_t>()];
        if (low >= 0 && high >= 0) edges.push_back({low, high});
    }
    part["intersection_edges"] = edges;
}

/// Numbers the regions of doubles by surface, then by their lowest triangles, as a producer does.
inline void number_regions(Json& mesh, const std::vector<Surface>& surfaces) {
    std::vector<std::size_t> surface_of;
    for (std::size_t s = 0; s < surfaces.size(); ++s)
        surface_of.insert(surface_of.end(), surfaces[s].triangles.size(), s);
    const auto surfaces_at = [&](std::size_t t) {
        std::set<std::size_t> found;
        for (const Json& p : mesh["parents"][t]) found.insert(surface_of[p.get<std::size_t>()]);
        return found;
    };
    std::map<std::pair<std::size_t, Json>, std::size_t> lowest; // by surface and number
    for (std::size_t t = 0; t < mesh["triangles"].size(); ++t)
        for (std::size_t i = 0; const std::size_t s : surfaces_at(t))
            lowest.try_emplace({s, mesh["regions"][t][i++]}, t);
    std::set<std::pair<std::size_t, std::size_t>> order; // surface and lowest triangle
    for (const auto& [region, t] : lowest) order.insert({region.first, t});
    for (std::size_t t = 0; t < mesh["triangles"].size(); ++t)
        for (std::size_t i = 0; const std::size_t s : surfaces_at(t)) {
            Json& number = mesh["regions"][t][i++];
            number = std::distance(order.begin(), order.find({s, lowest.at({s, number})}));
        }
}

/// Drops the triangles whose only parent is one of these.
inline void drop_children(Json& part, const std::set<int>& inputs) {
    for (std::size_t t = part["triangles"].size(); t-- > 0;) {
        bool all = true;
        for (const Json& p : part["parents"][t]) all = all && inputs.count(p.get<int>()) == 1;
        if (all) drop_triangle(part, t);
    }
    drop_unused(part);
}

} // namespace forged
