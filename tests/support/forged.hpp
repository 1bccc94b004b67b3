// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates that were changed and sealed anew: the digest and the hashes of the output files are
// computed again, as a forger would.
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <terrane/algorithms/verify/detail/digest.hpp>

#include "support/certificate_cases.hpp"

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

/// Returns the certificate of these files with an output file in each format: "obj", "stl-ascii".
inline Subject subject(const std::vector<File>& files,
                       const std::vector<std::string>& formats = {"obj"}) {
    Subject s;
    s.inputs = input_files(files);
    std::vector<InputRecord> records;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const InputFile& file = s.inputs[i];
        records.push_back({files[i].name, file.sha256, file.bytes, file.surfaces.size()});
        s.surfaces.insert(s.surfaces.end(), file.surfaces.begin(), file.surfaces.end());
    }
    const auto exact = arrange(s.surfaces);
    REQUIRE(exact);
    const auto rounded = round_to_doubles(exact.value());
    REQUIRE(rounded);
    std::vector<OutputRecord> outputs;
    for (const std::string& format : formats) {
        WriteOptions options;
        options.ascii = format == "stl-ascii";
        options.compress = format != "vtp-plain";
        const std::string name = format.substr(0, format.find('-'));
        auto text = format_mesh(rounded->mesh, format_named(name).value(), options);
        REQUIRE(text);
        outputs.push_back(record_output(text.value(), "out." + name, options.ascii ? format : name,
                                        rounded->mesh->surfaces));
        s.contents.push_back(std::move(text).value());
    }
    s.certificate = Json::parse(
        to_certificate({records, s.surfaces, exact.value(), &rounded.value(), outputs}));
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

/// Checks that the certificate is valid, and that each forgery is refuted by its rule.
inline void check_forgeries(const Subject& right, const std::vector<Forgery>& forgeries) {
    REQUIRE(judged(right) == "");
    for (const Forgery& forgery : forgeries) {
        INFO(forgery.name);
        Subject wrong = right;
        forgery.change(wrong.certificate);
        REQUIRE(wrong.certificate != right.certificate);
        seal(wrong);
        const auto rules = judged(wrong);
        INFO(rules);
        CHECK((" " + rules + " ").find(" " + forgery.rule + " ") != std::string::npos);
    }
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
    Json edges = Json::array();
    for (const Json& e : part["intersection_edges"]) {
        const int low = number[e[0].get<std::size_t>()], high = number[e[1].get<std::size_t>()];
        if (low >= 0 && high >= 0) edges.push_back({low, high});
    }
    part["intersection_edges"] = edges;
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
