// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/judge.hpp>

#include <algorithm>
#include <array>
#include <cmath>
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

Result<MeshJudgement> judge_valid(std::span<const Surface> output, std::span<const Surface> inputs,
                                  const JudgeOptions& options, const Run& run) {
    const auto exact = arrange(inputs, {}, run);
    if (!exact) return exact.error();
    const auto allowed = bound_of(*exact, options.spacings);
    if (!allowed) return allowed.error();
    const auto target = target_of(*exact, options, run);
    if (!target) return target.error();
    const auto checked = check(output, run);
    if (!checked) return checked.error();
    auto judged =
        judge_with_doubt(*target, *allowed, run, [&](const Bound& bound) -> Result<Judged> {
            Judged found;
            add_checked(*checked, output, options.most_flaws, found.properties);
            const OutputMesh mesh(merge_surfaces(output, run), bound.reach);
            Comparison compared = compare(*target, mesh, bound, options.most_flaws);
            add_points_twice(output, compared.welded);
            add_compared(compared, bound.bound, found);
            if (options.operation)
                found.properties.push_back(
                    volume_property(mesh, *target, bound.bound, options.most_flaws));
            return found;
        });
    if (run.stop.stop_requested()) return Error{ErrorCode::interrupted, "stopped on request", ""};
    return judged;
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
        if (const auto valid = check_options(options); !valid) return valid.error();
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
