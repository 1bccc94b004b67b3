// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/check/check.hpp>

#include <algorithm>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {
namespace {

/// Returns the improper contacts among some pairs.
std::vector<ImproperContact> contacts_of(const Soup& soup, std::span<const CandidatePair> pairs) {
    std::vector<ImproperContact> found;
    for (const CandidatePair& p : pairs) {
        const auto contact =
            improper_contact(soup.points, soup.triangles[p.first], soup.triangles[p.second]);
        if (!contact) continue;
        ImproperContact c;
        c.triangles = {soup.input_of[p.first], soup.input_of[p.second]};
        c.kind = kind_of(*contact);
        // Common vertices come first, so the last point is not one of them.
        const Construction& how = contact->points[contact->point_count - 1u].how;
        c.place = nearest(soup.points, how);
        found.push_back(c);
    }
    return found;
}

/// Counts free border edges and components and lists non-manifold edges, among the distinct
/// triangles with area.
void describe_edges(const Soup& soup, CheckReport& report) {
    DisjointSets components(soup.triangles.size());
    std::vector<std::uint32_t> surfaces;
    soup.edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
        surfaces.clear();
        for (const auto& s : sides) {
            components.join(sides[0].triangle, s.triangle);
            surfaces.push_back(soup.surface_of[s.triangle]);
        }
        std::sort(surfaces.begin(), surfaces.end());
        bool many = false;
        for (std::size_t i = 0, end = 0; i < surfaces.size(); i = end) {
            while (end < surfaces.size() && surfaces[end] == surfaces[i]) ++end;
            if (end - i == 1) ++report.free_border_edges;
            many = many || end - i > 2;
        }
        if (many) report.non_manifold_edges.push_back({soup.points[low], soup.points[high]});
    });
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
        report.components += components.find(t) == t;
}

void sort_out_duplicates(const Soup& soup, CheckReport& report) {
    const auto& first = soup.first_input_triangle;
    const auto surface = [&](std::uint32_t t) {
        return std::upper_bound(first.begin(), first.end(), t) - first.begin();
    };
    for (const auto& d : soup.duplicates)
        (surface(d[0]) == surface(d[1]) ? report.repeated : report.shared).push_back(d);
}

std::size_t count_used(const Soup& soup) {
    const auto used = used_vertices(soup.points.size(), soup.triangles);
    return static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

Result<CheckReport> check_valid(std::span<const Surface> surfaces, const Run& run) {
    const Soup soup = merge_surfaces(surfaces);
    CheckReport report;
    report.surfaces = surfaces.size();
    report.triangles = soup.first_input_triangle.back();
    report.first_triangle = soup.first_input_triangle;
    report.degenerate = soup.degenerate;
    sort_out_duplicates(soup, report);
    report.vertices = count_used(soup);
    describe_edges(soup, report);
    constexpr double search_share = 0.3; // of the time
    const auto candidates = candidate_pairs({soup.points, soup.triangles}, {}, Search::automatic,
                                            part_of_stage(run, "check", 0, search_share));
    report_part(run, "check", 0, search_share, 1, 1);
    constexpr std::size_t wave = 1U << 20U; // pairs between two reports of the progress
    for (std::size_t start = 0; start < candidates.size(); start += wave) {
        const auto pairs =
            std::span(candidates).subspan(start, std::min(wave, candidates.size() - start));
        const auto blocks = for_blocks<std::vector<ImproperContact>>(
            pairs.size(), 16384, run, [&](std::size_t a, std::size_t b) {
                return contacts_of(soup, pairs.subspan(a, b - a));
            });
        if (run.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        for (const auto& b : blocks)
            report.contacts.insert(report.contacts.end(), b.begin(), b.end());
        report_part(run, "check", search_share, 1, start + pairs.size(), candidates.size());
    }
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    return report;
}

} // namespace

Result<CheckReport> check(std::span<const Surface> surfaces, const Run& run) {
    return guarded("for the check", "check", [&]() -> Result<CheckReport> {
        if (const auto valid = validate(surfaces); !valid) return valid.error();
        return check_valid(surfaces, run);
    });
}

} // namespace terrane
