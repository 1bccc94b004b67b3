// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tetrahedra judged by the surfaces that they fill.
// (1) All tetrahedra are wound one way, and no face has two on one side. The number of tetrahedra round a
//     point then changes only at faces of one tetrahedron.
// (2) The faces on the surfaces, with those of one tetrahedron, are a mesh that is judged as any other: it
//     is the exact arrangement, so (1) gives 1 inside each block that is filled, and 0 outside.
// (3) Tetrahedra that other faces join are a component: it is in the block that the exact regions of its
//     faces bound, and has the volume of that block, but for what points may have moved.
#include <terrane/algorithms/judge/judge.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/judge/detail/comparison.hpp>
#include <terrane/algorithms/judge/detail/soup_properties.hpp>
#include <terrane/algorithms/judge/detail/tetrahedra.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>

namespace terrane {

using namespace judging;

namespace {

struct BoundingBox {
    Point3 low, high;
    bool empty = true;

    void add(const Point3& p) {
        if (std::exchange(empty, false)) low = high = p;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    /// Whether another one is inside, and touches no side.
    [[nodiscard]] bool encloses(const BoundingBox& other) const {
        const auto below = [](const Point3& p, const Point3& q) {
            return p.x < q.x && p.y < q.y && p.z < q.z;
        };
        return !empty && !other.empty && below(low, other.low) && below(other.high, high);
    }
    [[nodiscard]] Surface surface() const {
        Surface box{"box", Role::boundary, {}, {}};
        for (unsigned i = 0; i < 8; ++i)
            box.vertices.push_back({(i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                                    (i & 4U) != 0 ? high.z : low.z});
        box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
        return box;
    }
};

/// Returns the inputs, and a box round them if the tetrahedra fill one.
std::vector<Surface> with_box(std::span<const Surface> inputs, const LabelledTetrahedra& output) {
    BoundingBox given, made;
    for (const Surface& s : inputs)
        for (const Triangle& t : s.triangles)
            for (const std::uint32_t v : t) given.add(s.vertices[v]);
    for (const auto& corners : output.tetrahedra)
        for (const std::uint32_t v : corners) made.add(output.vertices[v]);
    std::vector<Surface> all(inputs.begin(), inputs.end());
    if (made.encloses(given)) all.push_back(made.surface());
    return all;
}

Exact six_volumes_below(const Point3& a, const Point3& b, const Point3& c) {
    using namespace polynomial;
    const auto vector = [](const Point3& p) {
        return Vector<Exact>{Exact(p.x), Exact(p.y), Exact(p.z)};
    };
    return dot(vector(a), cross(vector(b), vector(c)));
}

class TetrahedraJudge {
public:
    TetrahedraJudge(const LabelledTetrahedra& output, const Arrangement& exact, const Bound& bound,
                    std::size_t most) :
        target_(whole_arrangement(exact)),
        bound_(bound), most_(most), mesh_(output, most),
        chosen_(choose_surface_faces(mesh_, target_, find_cells(target_), 2 * bound.reach)),
        component_(components()) {}

    Result<Judged> operator()(const Volumes& volumes, const Run& run) {
        const Surface faces = surface_of_faces();
        const auto checked = check(std::span(&faces, 1), run);
        if (!checked) return checked.error();
        const OutputMesh output(merge_surfaces(std::span(&faces, 1), run), bound_.reach);
        Comparison found = compare(target_, output, bound_, most_);
        find_torn(found.welded);
        Judged on_faces;
        add_checked(*checked, std::span(&faces, 1), most_, on_faces.properties);
        add_compared(found, bound_.bound, on_faces);
        find_volumes_of(volumes, found.placed);

        std::vector<JudgedProperty> properties;
        properties.push_back(
            mesh_.positive.said(counted_as(mesh_.positive.count(), "tetrahedron", "tetrahedra") +
                                " without volume or wound the other way"));
        for (JudgedProperty& p : on_faces.properties) {
            if (p.name == "distinct" || p.name == "orientation") continue;
            for (PropertyFlaw& flaw : p.flaws) flaw.triangles = tetrahedra_at(flaw.triangles);
            properties.push_back(p.name == "conforming" ? conforming(std::move(p)) : std::move(p));
        }
        if (!mesh_.made.labels.empty()) properties.push_back(labels());
        properties.push_back(volume(volumes));
        on_faces.properties = std::move(properties);
        return on_faces;
    }

private:
    [[nodiscard]] const Point3& point(std::uint32_t v) const { return mesh_.made.vertices[v]; }

    [[nodiscard]] std::vector<std::uint32_t> components() const {
        DisjointSets sets(mesh_.made.tetrahedra.size());
        auto next = chosen_.faces.begin();
        for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
            if (next != chosen_.faces.end() && *next == f)
                ++next;
            else if (!mesh_.faces[f].is_border())
                sets.join(mesh_.faces[f].sides[0], mesh_.faces[f].sides[1]);
        }
        return sets.flattened();
    }

    [[nodiscard]] Surface surface_of_faces() const {
        Surface s{"", Role::unknown, mesh_.made.vertices, {}};
        for (const std::uint32_t f : chosen_.faces) s.triangles.push_back(mesh_.faces[f].corners);
        return s;
    }
    /// Returns the tetrahedra at faces of that surface.
    [[nodiscard]] std::vector<std::uint32_t>
    tetrahedra_at(const std::vector<std::uint32_t>& triangles) const {
        std::vector<std::uint32_t> all;
        for (const std::uint32_t t : triangles)
            for (const std::uint32_t cell : mesh_.faces[chosen_.faces[t]].tetrahedra())
                all.push_back(cell);
        sort_unique(all);
        return all;
    }

    /// Finds tetrahedra that have other nodes than their neighbours, and no surface between.
    void find_torn(Flaws& welded) const {
        for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f)
            if (mesh_.is_torn(mesh_.faces[f]) && !std::ranges::binary_search(chosen_.faces, f))
                welded.add({"nodes are torn where no surface is", mesh_.middle(mesh_.faces[f])});
    }

    /// Adds the flaws of faces to those of pairs of faces on the surfaces.
    [[nodiscard]] JudgedProperty conforming(JudgedProperty pairs) {
        const std::size_t count = mesh_.conforming.count();
        JudgedProperty faces = mesh_.conforming.said(
            counted_as(count, "face has", "faces have") + " several tetrahedra on one side, " +
            counted_as(pairs.count, "pair of faces meets", "pairs of faces meet") + " improperly");
        faces.count += pairs.count;
        if (faces.verdict == PropertyVerdict::holds) faces.verdict = pairs.verdict;
        for (PropertyFlaw& flaw : pairs.flaws)
            if (faces.flaws.size() < most_) faces.flaws.push_back(std::move(flaw));
        return faces;
    }

    /// Finds the volume of each component: that with the largest area of faces in front or behind.
    void find_volumes_of(const Volumes& volumes, const std::vector<Placed>& placed) {
        std::map<std::uint32_t, std::map<std::uint32_t, double>> areas;
        for (std::size_t i = 0; i < placed.size(); ++i) {
            if (placed[i].triangle == no_index) continue;
            const TetrahedronFace& face = mesh_.faces[chosen_.faces[i]];
            const auto& volume = volumes.of_sides[target_.source[placed[i].triangle]];
            const auto [a, b, c] = face.corners;
            const double area = length(cross(minus(point(b), point(a)), minus(point(c), point(a))));
            for (unsigned side = 0; side < 2; ++side)
                if (face.sides[side] != no_index)
                    areas[component_[face.sides[side]]]
                         [volume[placed[i].facing > 0 ? side : 1 - side]] += area;
        }
        for (const auto& [component, by_volume] : areas)
            volume_of_[component] = std::ranges::max_element(by_volume, {}, [](const auto& v) {
                                        return v.second;
                                    })->first;
    }
    /// Returns the volume that a tetrahedron is in, or no_index where it is not known.
    [[nodiscard]] std::uint32_t volume_at(std::uint32_t t) const {
        const auto found = volume_of_.find(component_[t]);
        return found == volume_of_.end() ? no_index : found->second;
    }

    /// Judges labels: one for each block, and one block for each. What is flat may have that of either side.
    [[nodiscard]] JudgedProperty labels() const {
        Flaws flaws("labels", most_);
        std::map<std::uint32_t, std::uint32_t> label_of, volume_of;
        for (std::uint32_t t = 0; t < component_.size(); ++t) {
            const std::uint32_t volume = volume_at(t), label = mesh_.made.labels[t];
            if (chosen_.flat[t] || volume == no_index) continue;
            if (label_of.try_emplace(volume, label).first->second != label)
                flaws.add(
                    {"a block has a second label, " + std::to_string(label), mesh_.middle(t), {t}});
            else if (volume_of.try_emplace(label, volume).first->second != volume)
                flaws.add({"the label " + std::to_string(label) + " is that of another block",
                           mesh_.middle(t),
                           {t}});
        }
        return flaws.said(
            counted_as(flaws.count(), "tetrahedron has the label", "tetrahedra have the label") +
            " of another block");
    }

    /// Compares the exact sum of the volumes of the tetrahedra in each block with its own.
    [[nodiscard]] JudgedProperty volume(const Volumes& volumes) const {
        constexpr double rounded = 0x1p-50; // share of a volume that doubles may lose
        std::vector<double> allowed;
        for (const double measure : volumes.measures) allowed.push_back(rounded * measure);
        std::vector<Point3> places(allowed.size());
        for (std::uint32_t t = 0; t < target_.triangles.size(); ++t) {
            const auto at = [&](unsigned i) {
                return target_.exact.nearest(VertexId(target_.triangles[t][i]));
            };
            const double area = length(cross(minus(at(1), at(0)), minus(at(2), at(0)))) / 2;
            for (const std::uint32_t v : volumes.of_sides[target_.source[t]]) {
                allowed[v] += 2 * bound_.bound * area;
                places[v] = at(0);
            }
        }
        const auto sums = sums_of_volumes(allowed.size());
        Flaws flaws("volume", most_);
        double total = 0, largest = 0;
        for (std::uint32_t v = 1; v < allowed.size(); ++v) {
            total += sums[v];
            const double difference = sums[v] - volumes.measures[v];
            if (std::abs(difference) > std::abs(largest)) largest = difference;
            if (!(std::abs(difference) <= allowed[v]))
                flaws.add({"the tetrahedra of a block have the volume " + figure(sums[v]) +
                               ", not " + figure(volumes.measures[v]),
                           places[v],
                           {},
                           difference});
        }
        return flaws.said(figure(total) + ", exactly " + figure(volumes.total) +
                              "; no block differs by more than " + figure(std::abs(largest)),
                          largest);
    }
    /// Returns the volume of all tetrahedra in each volume, which follows from the faces round them.
    [[nodiscard]] std::vector<double> sums_of_volumes(std::size_t count) const {
        std::vector<Exact> sums(count, Exact(0.0));
        for (const TetrahedronFace& face : mesh_.faces) {
            const auto volume = [&](unsigned side) {
                return face.sides[side] == no_index ? no_index : volume_at(face.sides[side]);
            };
            const std::uint32_t front = volume(0), behind = volume(1);
            if (front == behind) continue;
            const auto [a, b, c] = face.corners;
            const Exact part = six_volumes_below(point(a), point(b), point(c));
            if (front != no_index) sums[front] -= part;
            if (behind != no_index) sums[behind] += part;
        }
        std::vector<double> rounded;
        for (const Exact& sum : sums) rounded.push_back(nearest_quotient(sum, Exact(6.0)));
        return rounded;
    }

    const Target target_;
    const Bound bound_;
    const std::size_t most_;
    TetrahedronFaces mesh_;
    const SurfaceFaces chosen_;
    const std::vector<std::uint32_t> component_;       ///< per tetrahedron
    std::map<std::uint32_t, std::uint32_t> volume_of_; ///< by component
};

Status validate_tetrahedra(const LabelledTetrahedra& output) {
    if (auto valid = validate(output.vertices, {}); !valid) return valid;
    for (std::size_t t = 0; t < output.tetrahedra.size(); ++t)
        for (const std::uint32_t v : output.tetrahedra[t])
            if (v >= output.vertices.size())
                return Error{ErrorCode::bad_index, "there is no vertex " + std::to_string(v),
                             "tetrahedron " + std::to_string(t)};
    if (!output.labels.empty() && output.labels.size() != output.tetrahedra.size())
        return Error{ErrorCode::bad_index, "there must be one label per tetrahedron", "labels"};
    return Done{};
}

} // namespace

Result<MeshJudgement> judge(const LabelledTetrahedra& output, std::span<const Surface> inputs,
                            const JudgeOptions& options, const Run& run) {
    return guarded("for the judgement", "judge", [&]() -> Result<MeshJudgement> {
        if (const auto valid = check_options(options); !valid) return valid.error();
        if (options.operation)
            return Error{ErrorCode::bad_option, "is for triangles, not for tetrahedra",
                         "operation"};
        if (const auto valid = validate_tetrahedra(output); !valid) return valid.error();
        if (const auto valid = validate(inputs); !valid) return valid.error();
        const auto exact = arrange(with_box(inputs, output), {}, run);
        if (!exact) return exact.error();
        const auto bound = bound_of(*exact, options.spacings);
        if (!bound) return bound.error();
        const auto volumes = find_volumes(*exact, run);
        if (!volumes) return volumes.error();
        auto judged =
            judge_with_doubt(whole_arrangement(*exact), *bound, run, [&](const Bound& by) {
                return TetrahedraJudge(output, *exact, by, options.most_flaws)(*volumes, run);
            });
        if (run.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        return judged;
    });
}

} // namespace terrane
