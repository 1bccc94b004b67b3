// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sections/sections.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sections/detail/cut.hpp>
#include <terrane/algorithms/sections/detail/parts.hpp>

namespace terrane {

using sections::Cut;
using sections::CutRegion;

namespace {

double area_of(const Section& section, const Triangle& t) {
    const Point3& a = section.vertices[t[0]];
    return length(cross(minus(section.vertices[t[1]], a), minus(section.vertices[t[2]], a))) / 2;
}

/// Makes a section of the parts of a cut.
class Assembly {
public:
    explicit Assembly(const Cut& cut) : cut_(cut), sheet_(cut.exact.vertices.size(), no_index) {
        for (const auto& t : cut.triangles)
            for (const std::uint32_t v : t.corners) sheet_[v] = std::min(sheet_[v], t.sheet);
    }

    Section operator()(std::vector<CutRegion> regions, std::vector<SectionLine> lines,
                       const SectionSurface& along) {
        add_polygons(regions);
        made_.lines = std::move(lines);
        number_vertices(along);
        for (std::size_t t = 0; t < made_.triangles.size(); ++t)
            made_.polygons[made_.polygon_of[t]].area += area_of(made_, made_.triangles[t]);
        return std::move(made_);
    }

private:
    void add_polygons(std::vector<CutRegion>& regions) {
        const auto blocks_of = [&](const CutRegion& region) {
            return cut_.triangles[region.triangles[0]].blocks;
        };
        std::stable_sort(
            regions.begin(), regions.end(),
            [&](const CutRegion& r, const CutRegion& s) { return blocks_of(r) < blocks_of(s); });
        for (CutRegion& region : regions) {
            const auto [front, behind] = blocks_of(region);
            for (const std::uint32_t t : region.triangles) {
                made_.triangles.push_back(cut_.triangles[t].corners);
                made_.polygon_of.push_back(static_cast<std::uint32_t>(made_.polygons.size()));
            }
            made_.polygons.push_back({BlockId(front), BlockId(behind), std::move(region.rings)});
        }
    }

    /// Calls visit for each index of a vertex in the section.
    template <class Visit>
    void for_each_vertex(const Visit& visit) {
        for (Triangle& t : made_.triangles)
            for (std::uint32_t& v : t) visit(v);
        for (SectionPolygon& polygon : made_.polygons)
            for (auto& ring : polygon.rings)
                for (std::uint32_t& v : ring) visit(v);
        for (SectionLine& line : made_.lines)
            for (std::uint32_t& v : line.vertices) visit(v);
    }

    void number_vertices(const SectionSurface& along) {
        std::vector<std::uint32_t> used;
        for_each_vertex([&](std::uint32_t v) { used.push_back(v); });
        sort_unique(used);
        std::vector<std::uint32_t> number(cut_.exact.vertices.size(), no_index);
        for (const std::uint32_t v : used) {
            number[v] = static_cast<std::uint32_t>(made_.vertices.size());
            const Point3& p = cut_.exact.nearest(VertexId(v));
            const SectionSheet& sheet = along.sheets[sheet_[v]];
            const Point3 d = minus(p, sheet.origin);
            made_.vertices.push_back(p);
            made_.flat.push_back({sheet.start + dot(sheet.right, d), dot(sheet.up, d)});
        }
        for_each_vertex([&](std::uint32_t& v) { v = number[v]; });
    }

    const Cut& cut_;
    std::vector<std::uint32_t> sheet_; ///< per vertex of the arrangement: the first one
    Section made_;
};

Status check_along(const SectionSurface& along, const Mesh& mesh, const Volumes& volumes) {
    if (along.sheet_of.size() != along.surface.triangles.size())
        return Error{ErrorCode::bad_option, "needs a sheet for each triangle", "section"};
    for (const std::uint32_t sheet : along.sheet_of)
        if (sheet >= along.sheets.size())
            return Error{ErrorCode::bad_option, "names a sheet that is not there", "section"};
    if (!volumes.of_sides.empty() && volumes.of_sides.size() != mesh.triangles.size())
        return Error{ErrorCode::improper_contact, "the volumes are not those of the mesh", ""};
    return Done{};
}

} // namespace

Result<Section> cut_section(const Mesh& mesh, const Volumes& volumes, const SectionSurface& along,
                            const Run& run) {
    return guarded("for the section", "cut_section", [&]() -> Result<Section> {
        if (const auto valid = validate_indices(mesh, run); !valid) return valid.error();
        if (const auto valid = check_along(along, mesh, volumes); !valid) return valid.error();
        const StageTimer timer(run, "section");
        const auto made = sections::cut(mesh, volumes, along, timer.inside());
        if (!made) return made.error();
        auto regions = sections::find_regions(*made, along);
        auto lines = sections::find_lines(*made);
        sections::straighten(*made, regions, lines);
        return Assembly(*made)(std::move(regions), std::move(lines), along);
    });
}

} // namespace terrane
