// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/statistics.hpp>

#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>

#include <terrane/algorithms/triangulation/point_surface.hpp>
#include <terrane/cli/session/text_width.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/report_members.hpp>

namespace terrane::cli {

// getrusage counts in KiB on Linux.
double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

Json statistics_of(const Inputs& inputs) {
    Json json;
    json["version"] = TERRANE_VERSION;
    json["input"] = {{"surfaces", inputs.labels.size()},
                     {"triangles", inputs.triangles},
                     {"vertices", inputs.vertices}};
    add_constants(json, "read", point_constants());
    return json;
}

void add_statistics(Json& json, const Arrangement& a) {
    json["input"]["degenerate"] = a.degenerate.size();
    json["input"]["duplicates"] = a.inputs.duplicates.size();
    add_statistics(json, a.statistics);
}

void add_statistics(Json& json, const ArrangeStatistics& s) {
    json["search"] = {{"method", name_of(s.search)},
                      {"candidates", s.candidates},
                      {"tests", s.candidates - s.known},
                      {"improper_contacts", s.improper_contacts}};
    json["arrangement"] = {{"triangles", s.triangles},
                           {"vertices", s.vertices},
                           {"divided", s.divided},
                           {"constructed_points", s.constructed_points}};
    json["predicates"] = {{"static", s.predicates.static_filter},
                          {"interval", s.predicates.interval},
                          {"exact", s.predicates.exact}};
}

void add_statistics(Json& json, const RoundedMesh& rounded) {
    const Mesh& m = rounded.mesh;
    const RoundingReport& r = rounded.report;
    json["output"] = {{"triangles", m.triangles.size()},
                      {"vertices", m.vertices.size()},
                      {"intersection_edges", m.intersection_edges.size()},
                      {"regions", rounded.regions.size()},
                      {"volumes", nullptr}};
    json["rounding"] = r;
    if (r.pairs) json["rounding"]["pairs"] = *r.pairs;
    add_constants(json, "round", rounding_constants());
}

void add_constants(Json& json, const char* stage, std::span<const NamedConstant> constants) {
    Json& all = json["constants"][stage];
    for (const NamedConstant& c : constants) all[std::string(c.name)] = c.value;
}

Json seconds_json(const Session& session) {
    Json json = Json::object();
    for (const auto& [stage, seconds] : session.seconds().all()) json[stage] = seconds;
    json["total"] = session.elapsed();
    return json;
}

void write_statistics(Json json, const std::string& path, const Session& session) {
    if (path.empty()) return;
    json["seconds"] = seconds_json(session);
    json["peak_rss_mb"] = peak_memory();
    must(write_file(path, text_of(json)));
}

std::string text_of(const Json& json) {
    const auto dumped = json.dump(2);
    std::string text;
    for (std::size_t i = 0; i < dumped.size(); ++i) {
        const auto code = static_cast<unsigned char>(dumped[i]);
        const std::size_t length = code < 0xC0 ? 1 : code < 0xE0 ? 2 : code < 0xF0 ? 3 : 4;
        char32_t character = length == 1 ? code : code & (0xFFU >> (length + 1));
        for (std::size_t k = 1; k < length; ++k) // dump() has made it UTF-8
            character = character << 6U | (static_cast<unsigned char>(dumped[i + k]) & 0x3FU);
        // Controls that JSON allows, and terminals obey.
        if ((character >= 0x7F && character < 0xA0) || reorders(character))
            text += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(character));
        else
            text.append(dumped, i, length);
        i += length - 1;
    }
    return text + "\n";
}

} // namespace terrane::cli
