// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/page/findings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

namespace terrane::page {
namespace {

constexpr std::size_t worst_listed = 20;

double longest_edge(const std::array<Point3, 3>& t) {
    return std::max(
        {distance_between(t[0], t[1]), distance_between(t[1], t[2]), distance_between(t[2], t[0])});
}

Point3 centre_of(const std::array<Point3, 3>& t) {
    return terrane::centre_of(t[0], t[1], t[2]);
}

std::array<Point3, 3> corners_of(const std::vector<Point3>& vertices, const Triangle& t) {
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}

/// Finds triangles of the input by their numbers through all surfaces.
class InputTriangles {
public:
    InputTriangles(const CheckReport& report, std::span<const Surface> surfaces) :
        first_(report.first_triangle), surfaces_(surfaces),
        labels_(unique_labels(infos_of(surfaces))) {}

    [[nodiscard]] std::array<Point3, 3> corners(std::uint32_t t) const {
        const auto s = surface_of(t);
        return corners_of(surfaces_[s].vertices, surfaces_[s].triangles[t - first_[s]]);
    }
    [[nodiscard]] std::string name(std::uint32_t t) const {
        const auto s = surface_of(t);
        return fmt::format("{} triangle {}", labels_[s], t - first_[s]);
    }

private:
    [[nodiscard]] std::size_t surface_of(std::uint32_t t) const {
        const auto after = std::upper_bound(first_.begin(), first_.end(), t);
        return static_cast<std::size_t>(std::distance(first_.begin(), after)) - 1;
    }

    const std::vector<std::uint32_t>& first_;
    std::span<const Surface> surfaces_;
    std::vector<std::string> labels_;
};

std::string surfaces_text(const Mesh& mesh, std::uint32_t t,
                          const std::vector<std::string>& labels) {
    std::string text;
    for (const std::uint32_t s : mesh.surfaces_of[t])
        text += (text.empty() ? "" : " and ") + labels[s];
    return text;
}

/// Returns the name of a constant as words.
std::string in_words(std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

/// Returns the indices of the least values, the least first; equal ones by index.
std::vector<std::uint32_t> least_of(const std::vector<double>& values) {
    std::vector<std::uint32_t> order(values.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto count = std::min(worst_listed, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                      order.end(), [&](std::uint32_t a, std::uint32_t b) {
                          return std::pair(values[a], a) < std::pair(values[b], b);
                      });
    order.resize(count);
    return order;
}

} // namespace

void add_contacts(Findings& findings, const Mesh& mesh, const RoundingReport& report,
                  const std::vector<std::string>& labels) {
    for (const ImproperContact& c : report.contacts) {
        const auto [a, b] = c.triangles;
        const double size = std::max(longest_edge(corners_of(mesh.vertices, mesh.triangles[a])),
                                     longest_edge(corners_of(mesh.vertices, mesh.triangles[b])));
        findings.push_back(
            {"improper contact",
             fmt::format("{} triangle {} and {} triangle {}: {}", surfaces_text(mesh, a, labels), a,
                         surfaces_text(mesh, b, labels), b, name_of(c.kind)),
             size, "length", c.place, 2 * size});
    }
}

void add_flaws(Findings& findings, const CheckReport& report, std::span<const Surface> surfaces) {
    const InputTriangles triangles(report, surfaces);
    for (const ImproperContact& c : report.contacts) {
        const double size = std::max(longest_edge(triangles.corners(c.triangles[0])),
                                     longest_edge(triangles.corners(c.triangles[1])));
        findings.push_back({"improper contact",
                            fmt::format("{} and {}: {}", triangles.name(c.triangles[0]),
                                        triangles.name(c.triangles[1]), name_of(c.kind)),
                            size, "length", c.place, 2 * size});
    }
    for (const std::uint32_t t : report.degenerate) {
        const auto corners = triangles.corners(t);
        const double size = longest_edge(corners);
        findings.push_back({"triangle without area", triangles.name(t), size, "length",
                            centre_of(corners), 2 * size});
    }
    for (const auto& [t, other] : report.repeated) {
        const auto corners = triangles.corners(t);
        const double size = longest_edge(corners);
        findings.push_back({"repeated triangle",
                            triangles.name(t) + " repeats " + triangles.name(other), size, "length",
                            centre_of(corners), 2 * size});
    }
}

void add_flaws(Findings& findings, const MeshJudgement& judged, std::span<const Surface> surfaces) {
    constexpr double seen = 0.02; // share of the model that a flaw without a size is seen in
    Point3 low, high;
    bool first = true;
    for (const Surface& s : surfaces)
        for (const Point3& p : s.vertices) {
            if (std::exchange(first, false)) low = high = p;
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    for (const JudgedProperty& p : judged.properties) {
        const std::string kind =
            p.verdict == PropertyVerdict::fails ? p.name : p.name + " in doubt";
        const char* measure = p.name == "coverage" ? "area"
                              : p.name == "volume" ? "volume"
                              : p.name == "tetgen" ? "angle"
                                                   : "length";
        for (const PropertyFlaw& flaw : p.flaws)
            findings.push_back({kind, flaw.sentence, std::abs(flaw.size), measure, flaw.place,
                                seen * distance_between(low, high)});
    }
}

Status add_holes(Findings& findings, std::span<const Surface> surfaces, const Run& run) {
    const auto labels = unique_labels(infos_of(surfaces));
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const auto loops = find_border_loops(surfaces[s], run);
        if (!loops) return loops.error();
        for (const BorderLoop& loop : *loops) {
            if (loop.kind == LoopKind::outer) continue;
            const bool gap = loop.kind == LoopKind::fault_gap;
            findings.push_back({gap ? "fault gap" : "hole",
                                fmt::format("in {}, border of {}", labels[s],
                                            counted(loop.vertices.size(), "edge")),
                                loop.area, "area", loop.centre, loop.length / 2});
        }
    }
    return Done{};
}

void add_fillings(Findings& findings, const FillWork& work) {
    for (const NumberedHole& hole : work.holes) {
        const BorderLoop& loop = loop_of(work, hole);
        const std::string& label = work.surfaces[hole.task].label;
        const auto where = fmt::format("hole {} of {}", hole.number, label);
        if (hole.report)
            findings.push_back({"filled hole",
                                fmt::format("{}: {}, expected error {}", where,
                                            counted(hole.report->interpolated, "new vertex"),
                                            figure(hole.report->expected_error, 3)),
                                loop.area, "area", loop.centre, loop.length / 2});
        else
            findings.push_back(
                {loop.kind == LoopKind::fault_gap ? "open fault gap" : "open hole",
                 where + (hole.refused.empty() ? " was not chosen" : ": " + hole.refused),
                 loop.area, "area", loop.centre, loop.length / 2});
    }
}

void add_leaks(Findings& findings, const Model& model, const std::optional<LeakAdvice>& advice,
               const std::vector<std::string>& labels) {
    const auto add = [&](const char* kind, const Leak& l) {
        findings.push_back({kind,
                            fmt::format("{} ends by {}, {} to {} apart", labels[l.from],
                                        l.from == l.to ? "itself" : labels[l.to],
                                        figure(l.least, 3), figure(l.largest, 3)),
                            l.length, "length", l.place, std::max(8 * l.largest, l.length / 4)});
    };
    if (advice)
        for (const Leak& l : advice->separating) add("leak between blocks", l);
    const auto leaks = leaks_of(model.borders);
    for (std::size_t l = 0; l < leaks.size(); ++l) {
        const bool judged = advice && l < advice->verdicts.size();
        const bool separates = judged && advice->verdicts[l] == LeakVerdict::separates;
        if (!separates) add("free border near a surface", leaks[l]);
    }
}

void add_seal(Findings& findings, const std::optional<SealReport>& sealed,
              const std::optional<BlockMerge>& merged, const std::vector<std::string>& labels) {
    if (sealed) {
        for (const ClosedGap& gap : sealed->closed)
            findings.push_back({"closed gap",
                                fmt::format("{} was extended to {} across {}", labels[gap.from],
                                            labels[gap.to], figure(gap.width, 3)),
                                gap.length, "length", gap.place,
                                std::max(8 * gap.width, gap.length)});
        for (const OpenGap& gap : sealed->open)
            findings.push_back(
                {"open gap",
                 fmt::format("between {} and {}, up to {} wide: {}", labels[gap.from],
                             labels[gap.to], figure(gap.width, 3), in_words(name_of(gap.reason))),
                 gap.length, "length", gap.place, std::max(8 * gap.width, gap.length / 4)});
    }
    if (!merged) return;
    for (const MergedBlock& block : merged->merged)
        findings.push_back({"merged block",
                            fmt::format("too small, {} thick", figure(block.thickness, 3)),
                            block.volume, "volume", block.place, 4 * std::cbrt(block.volume)});
}

void add_thin_blocks(Findings& findings, const Model& model) {
    const Mesh& mesh = model.mesh;
    if (mesh.triangles.empty()) return;
    std::vector<double> lengths;
    lengths.reserve(3 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        const auto c = corners_of(mesh.vertices, t);
        for (std::size_t i = 0; i < 3; ++i)
            lengths.push_back(distance_between(c[i], c[(i + 1) % 3]));
    }
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    const double thin = *middle / 10;
    for (std::size_t b = 1; b < model.structure.blocks.size(); ++b) {
        const ModelBlock& block = model.structure.blocks[b];
        if (!(block.area > 0) || block.interfaces.empty()) continue;
        const double thickness = 2 * block.volume / block.area;
        if (thickness >= thin) continue;
        const auto& outline = model.structure.interfaces[block.interfaces[0]];
        const auto corners = corners_of(mesh.vertices, mesh.triangles[outline.triangles[0]]);
        findings.push_back(
            {"thin block",
             fmt::format("block {}, {}: {} thick", b, block.name, figure(thickness, 3)),
             block.volume, "volume", centre_of(corners), 4 * std::sqrt(block.area)});
    }
}

void add_worst_triangles(Findings& findings, const Mesh& mesh,
                         const std::vector<std::string>& labels) {
    std::vector<double> q;
    q.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        q.push_back(quality_of(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
    for (const std::uint32_t t : least_of(q)) {
        const auto corners = corners_of(mesh.vertices, mesh.triangles[t]);
        const auto angles = angles_of(corners[0], corners[1], corners[2]);
        findings.push_back(
            {"worst triangle",
             fmt::format("{}: smallest angle {} degrees", surfaces_text(mesh, t, labels),
                         figure(std::min({angles[0], angles[1], angles[2]}), 3)),
             1 - q[t], "1 - q", centre_of(corners), 4 * longest_edge(corners)});
    }
}

void add_worst_tetrahedra(Findings& findings, const TetrahedralMesh& mesh,
                          const std::vector<std::string>& block_names) {
    const auto corners_at = [&](std::size_t t) {
        const auto& v = mesh.tetrahedra[t];
        return std::array<Point3, 4>{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]],
                                     mesh.vertices[v[3]]};
    };
    std::vector<double> least(mesh.tetrahedra.size(), 180);
    for (std::size_t t = 0; t < least.size(); ++t) {
        if (mesh.block_of[t] == 0) continue;
        const auto angles = dihedral_angles(corners_at(t));
        least[t] = *std::min_element(angles.begin(), angles.end());
    }
    for (const std::uint32_t t : least_of(least)) {
        const auto c = corners_at(t);
        const std::uint32_t block = mesh.block_of[t];
        if (block == 0) continue;
        const Point3 centre{(c[0].x + c[1].x + c[2].x + c[3].x) / 4,
                            (c[0].y + c[1].y + c[2].y + c[3].y) / 4,
                            (c[0].z + c[1].z + c[2].z + c[3].z) / 4};
        findings.push_back(
            {"worst tetrahedron",
             fmt::format("least dihedral angle, in block {}{}", block,
                         block < block_names.size() ? ", " + block_names[block] : ""),
             -least[t], "angle", centre,
             4 * std::max(longest_edge({c[0], c[1], c[2]}), distance_between(c[0], c[3]))});
    }
}

Json json_of(Findings findings, std::size_t most) {
    std::map<std::string, std::pair<std::size_t, std::size_t>> kinds; // order, count
    for (const Finding& f : findings)
        ++kinds.try_emplace(f.kind, kinds.size(), 0).first->second.second;
    std::stable_sort(findings.begin(), findings.end(), [&](const Finding& a, const Finding& b) {
        return std::pair(kinds.at(a.kind).first, -a.size) <
               std::pair(kinds.at(b.kind).first, -b.size);
    });
    Json list = Json::array(), counts = Json::object();
    std::map<std::string, std::size_t> listed;
    for (const Finding& f : findings) {
        counts[f.kind] = kinds.at(f.kind).second;
        if (++listed[f.kind] > most) continue;
        list.push_back({{"kind", f.kind},
                        {"text", f.text},
                        {"size", std::fabs(f.size)},
                        {"measure", f.measure},
                        {"place", Json::array({f.place.x, f.place.y, f.place.z})},
                        {"extent", f.extent}});
    }
    return {{"counts", counts}, {"list", list}};
}

} // namespace terrane::page
