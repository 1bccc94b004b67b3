// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/judge.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/judge/detail/comparison.hpp>
#include <terrane/algorithms/judge/detail/soup_properties.hpp>
#include <terrane/algorithms/judge/detail/target.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

using namespace judging;

namespace {

constexpr std::array<std::string_view, 4> operation_names{"union", "intersection", "difference",
                                                          "symmetric-difference"};

/// Largest coordinate and extent of what has area.
struct Size {
    double largest = 0; ///< absolute coordinate
    double extent = 0;  ///< diagonal of the bounding box
};

Size size_of(const Arrangement& exact) {
    Size size;
    Point3 low, high;
    for (std::uint32_t v = 0; v < exact.vertices.size(); ++v) {
        const Point3& p = exact.nearest(VertexId(v));
        if (v == 0) low = high = p;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        size.largest = std::max({size.largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    size.extent = length(minus(high, low));
    return size;
}

/// Judges nothing where the bound is more than this share of the extent: nearly all would be in doubt.
constexpr double most_of_extent = 0x1p-12;

/// Compares the volume of a mesh with the exact one. `bound`: of points. The tolerance follows from the
/// exact boundary alone: triangles that are too many can't widen it.
JudgedProperty volume_property(const OutputMesh& output, const Target& target, double bound,
                               std::size_t most) {
    constexpr double rounded_sum = 0x1p-43; // share of the volume that its sum may lose
    double area = 0;
    for (const Triangle& t : target.triangles) {
        const auto at = [&](unsigned i) { return target.exact.nearest(VertexId(t[i])); };
        area += length(cross(minus(at(1), at(0)), minus(at(2), at(0)))) / 2;
    }
    double volume = 0;
    const auto& points = output.soup.points;
    const Point3 o = output.vertices.empty() ? Point3{} : points[output.vertices[0]];
    for (const auto& [i, j, k] : output.soup.triangles)
        volume += dot(minus(points[i], o),
                      cross(minus(points[j], points[i]), minus(points[k], points[j]))) /
                  6;
    const double exact = target.volume;
    Flaws flaws("volume", most);
    if (!(std::abs(volume - exact) <= 2 * bound * area + rounded_sum * std::abs(exact)))
        flaws.add(
            {"the volume is " + figure(volume) + ", not " + figure(exact), o, {}, volume - exact});
    return flaws.said(figure(volume) + ", exactly " + figure(exact), volume - exact);
}

Result<Target> target_of(const Arrangement& exact, const JudgeOptions& options, const Run& run) {
    if (options.operation) return boundary_of(exact, options, run);
    return whole_arrangement(exact);
}

/// Returns the properties that a comparison found, said in words.
void say(Comparison& found, double bound, std::vector<JudgedProperty>& properties) {
    const auto count = [](const Flaws& f, std::string_view one, std::string_view many) {
        return counted_as(f.count(), one, many);
    };
    properties.push_back(
        found.welded.said(count(found.welded, "point twice or torn", "points twice or torn")));
    properties.push_back(found.vertices.said(
        count(found.vertices, "point", "points") + " missing; the others moved by " +
            figure(found.largest_move) + " at most, of " + figure(bound) + " allowed",
        found.largest_move));
    properties.push_back(
        found.curves.said(count(found.curves, "edge", "edges") + " of curves missing"));
    properties.push_back(found.coverage.said("area missing " + figure(found.missing_area) +
                                                 ", too much " + figure(found.extra_area),
                                             found.missing_area + found.extra_area));
    properties.push_back(found.topology.said(count(found.topology, "difference", "differences")));
    properties.push_back(
        found.orientation.said(count(found.orientation, "triangle turned", "triangles turned")));
}

Result<MeshJudgement> judge_valid(std::span<const Surface> output, std::span<const Surface> inputs,
                                  const JudgeOptions& options, const Run& run) {
    const auto exact = arrange(inputs, {}, run);
    if (!exact) return exact.error();
    const auto [largest, extent] = size_of(*exact);
    if (largest > 0x1p250 || (largest > 0 && largest < 0x1p-250)) // squares of areas are no doubles
        return Error{ErrorCode::unsupported, "the largest coordinate must be from 1e-75 to 1e75",
                     "inputs"};
    const double spacing =
        std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
    const double bound = options.spacings * spacing;
    if (extent > 0 && bound > most_of_extent * extent)
        return Error{ErrorCode::unsupported,
                     "the bound " + figure(bound) + " is more than a 4096th of the inputs' extent",
                     "spacings"};
    const auto target = target_of(*exact, options, run);
    if (!target) return target.error();
    const auto checked = check(output, run);
    if (!checked) return checked.error();
    MeshJudgement judgement;
    add_checked(*checked, output, options.most_flaws, judgement.properties);
    const double reach = std::max(bound, spacing / 4); // the grid of points has cells of some size
    const OutputMesh mesh(merge_surfaces(output, run), reach);
    Comparison found = compare(*target, mesh, reach, options.most_flaws);
    add_points_twice(output, found.welded);
    say(found, bound, judgement.properties);
    if (options.operation)
        judgement.properties.push_back(volume_property(mesh, *target, bound, options.most_flaws));
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    return judgement;
}

} // namespace

std::string_view name_of(BooleanOperation operation) {
    return operation_names[static_cast<std::size_t>(operation)];
}

std::optional<BooleanOperation> operation_named(std::string_view name) {
    const auto found = std::ranges::find(operation_names, name);
    if (found == operation_names.end()) return std::nullopt;
    return static_cast<BooleanOperation>(found - operation_names.begin());
}

std::string_view name_of(PropertyVerdict verdict) {
    constexpr std::array<std::string_view, 3> names{"holds", "fails", "not judged"};
    return names[static_cast<std::size_t>(verdict)];
}

bool MeshJudgement::holds() const {
    return std::ranges::none_of(properties,
                                [](const auto& p) { return p.verdict == PropertyVerdict::fails; });
}

bool MeshJudgement::complete() const {
    return std::ranges::none_of(
        properties, [](const auto& p) { return p.verdict == PropertyVerdict::not_judged; });
}

std::string MeshJudgement::failures() const {
    std::string lines;
    for (const JudgedProperty& p : properties) {
        if (p.verdict != PropertyVerdict::fails) continue;
        lines += p.name + ": " + p.sentence + "\n";
        if (p.flaws.empty()) continue;
        const Point3& at = p.flaws[0].place;
        lines += "  " + p.flaws[0].sentence + " at (" + figure(at.x) + ", " + figure(at.y) + ", " +
                 figure(at.z) + ")\n";
    }
    return lines;
}

const JudgedProperty* MeshJudgement::find(std::string_view name) const {
    const auto found = std::ranges::find(properties, name, &JudgedProperty::name);
    return found == properties.end() ? nullptr : &*found;
}

Result<MeshJudgement> judge(std::span<const Surface> output, std::span<const Surface> inputs,
                            const JudgeOptions& options, const Run& run) {
    return guarded("for the judgement", "judge", [&]() -> Result<MeshJudgement> {
        if (!(options.spacings >= 0 && options.spacings <= 0x1p40))
            return Error{ErrorCode::bad_option, "must be from 0 to 2^40", "spacings"};
        for (const auto surfaces : {output, inputs})
            if (const auto valid = validate(surfaces); !valid) return valid.error();
        return judge_valid(output, inputs, options, run);
    });
}

Result<MeshJudgement> judge_soup(std::span<const Surface> soup, const JudgeOptions& options,
                                 const Run& run) {
    return guarded("for the judgement", "judge", [&]() -> Result<MeshJudgement> {
        const auto checked = check(soup, run);
        if (!checked) return checked.error();
        return soup_judgement(soup, *checked, options.most_flaws, run);
    });
}

} // namespace terrane
