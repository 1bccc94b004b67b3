// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/relation_report.hpp>

#include <fmt/format.h>

#include <terrane/io/text/text.hpp>

namespace terrane::cli {

using detail::csv_field;

std::string csv_of(std::span<const SurfaceRelation> relations,
                   const std::vector<std::string>& labels) {
    std::string text = "surface,kind,other,length,least_gap,largest_gap,x,y,z\n";
    for (const SurfaceRelation& r : relations) {
        const std::string gaps = r.kind == RelationKind::near
                                     ? fmt::format("{},{}", r.least, r.largest)
                                     : std::string(",");
        text +=
            fmt::format("{},{},{},{},{},{},{},{}\n", csv_field(labels[r.from]), name_of(r.kind),
                        csv_field(labels[r.to]), r.length, gaps, r.place.x, r.place.y, r.place.z);
    }
    return text;
}

std::string csv_of(std::span<const Juxtaposition> juxtapositions,
                   const std::vector<std::string>& labels, const Structure& structure) {
    std::string text = "surface,block,name,other_block,other_name,area\n";
    for (const Juxtaposition& j : juxtapositions)
        text += fmt::format("{},{},{},{},{},{}\n", csv_field(labels[j.surface]), j.blocks[0],
                            csv_field(structure.blocks[j.blocks[0]].name), j.blocks[1],
                            csv_field(structure.blocks[j.blocks[1]].name), j.area);
    return text;
}

} // namespace terrane::cli
