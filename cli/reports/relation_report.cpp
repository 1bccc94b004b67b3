// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/relation_report.hpp>

#include <fmt/format.h>

namespace terrane::cli {
namespace {

/// Quotes a text that has a comma, a quote or a line break, as RFC 4180 says.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

} // namespace

std::string csv_of(std::span<const SurfaceRelation> relations,
                   const std::vector<std::string>& labels) {
    std::string text = "surface,kind,other,length,least_gap,largest_gap,x,y,z\n";
    for (const SurfaceRelation& r : relations) {
        const std::string gaps = r.kind == RelationKind::near
                                     ? fmt::format("{},{}", r.least, r.largest)
                                     : std::string(",");
        text += fmt::format("{},{},{},{},{},{},{},{}\n", field(labels[r.from]), name_of(r.kind),
                            field(labels[r.to]), r.length, gaps, r.place.x, r.place.y, r.place.z);
    }
    return text;
}

std::string csv_of(std::span<const Juxtaposition> juxtapositions,
                   const std::vector<std::string>& labels, const Structure& structure) {
    std::string text = "surface,block,name,other_block,other_name,area\n";
    for (const Juxtaposition& j : juxtapositions)
        text += fmt::format("{},{},{},{},{},{}\n", field(labels[j.surface]), j.blocks[0],
                            field(structure.blocks[j.blocks[0]].name), j.blocks[1],
                            field(structure.blocks[j.blocks[1]].name), j.area);
    return text;
}

} // namespace terrane::cli
