// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Decides which triangles of the arrangement make up each layer: steps (2) to (4) of layers.hpp.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/layers/detail/vertical_order.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::layers::detail {

using Set = std::vector<std::uint32_t>; ///< triangles of the arrangement, ascending

/// Layer `layer` of the order, moved up by `steps` times the minimum thickness.
struct Copy {
    std::size_t layer = 0;
    int steps = 0;

    friend auto operator<=>(const Copy&, const Copy&) = default;
};

/// The harder layers above and below each layer in the order, the nearest first.
struct Bounds {
    std::vector<std::vector<std::size_t>> above, below;
};

/// The layers and their arrangement. Referenced objects must outlive the resolver.
struct ResolverInput {
    std::span<const Layer> order;
    const Bounds& bounds;
    const std::vector<Copy>&
        copies; ///< copy i is surface i of the arrangement, the walls come last
    bool has_min_thickness = false;
    const Arrangement& arrangement;
};

class LayerResolver {
public:
    LayerResolver(const ResolverInput& input, const Run& run) :
        input_(input), a_(input.arrangement), run_(run), seen_(a_.triangles.size()),
        boxes_(a_.triangles.size()), reports_(input.order.size()) {}

    /// Must be called first. Errors: unsupported for a layer with a vertical triangle.
    Status prepare();
    /// Finds the triangles of a copy after harder layers have replaced parts of it. Reports
    /// describe copies that are not moved. Errors: unsupported for overturned folds; interrupted.
    Result<Set> resolve(const Copy& copy);
    [[nodiscard]] const std::vector<LayerReport>& reports() const { return reports_; }
    /// Returns the corners of a triangle of a layer, counterclockwise from above.
    [[nodiscard]] const UpwardTriangle& upward(std::uint32_t t) const { return seen_[t]; }

private:
    enum class Side : std::uint8_t { above, below };
    /// Two triangles that overlap along z, and on which side of the second the first one lies.
    struct Relation {
        std::uint32_t first, second;
        Sign side;
    };
    /// A change that a harder layer makes in a softer one.
    struct Replacement {
        Set dropped; ///< triangles of the softer layer
        Set taken;   ///< triangles of the harder layer
    };
    /// A layer where a harder one exists, after the replacement, and where that one does not exist.
    struct Covered {
        Set replaced;
        Set rest;
    };

    Result<std::vector<Relation>> relate(const Set& soft, const Set& hard) const;
    [[nodiscard]] Result<Replacement> classify(const std::vector<Relation>& relations,
                                               Sign wrong) const;
    Result<Set> replace(const Set& soft, std::span<const std::size_t> harder, int steps, Side kept,
                        LayerReport* report);
    Result<Covered> replace_by_one(const Set& soft, const Set& hard, Side kept,
                                   LayerReport* report);
    void add_to_report(const Replacement& change, const Set& soft,
                       const std::vector<Relation>& relations, LayerReport& report) const;
    void add_steps(const Replacement& change, const Set& soft, LayerReport& report) const;
    void add_moves(const Replacement& change, const std::vector<Relation>& relations,
                   LayerReport& report) const;
    [[nodiscard]] Point3 corner(std::uint32_t t, unsigned k) const {
        return a_.state->points.nearest(a_.vertices[a_.triangles[t][k]]);
    }
    [[nodiscard]] double height_over(std::uint32_t t, PointIndex v) const;
    [[nodiscard]] double area(std::uint32_t t) const;
    [[nodiscard]] std::string place(std::uint32_t t) const;

    const ResolverInput input_;
    const Arrangement& a_;
    const Run& run_;
    std::vector<UpwardTriangle> seen_; ///< per triangle; of the layers only
    std::vector<Box> boxes_;           ///< per triangle, projected along z
    std::map<Copy, Set> known_;
    std::vector<LayerReport> reports_;
};

} // namespace terrane::layers::detail
