// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Random models within a box, and their blocks by winding numbers in rationals.
#pragma once

#include <optional>
#include <vector>

#include <gmpxx.h>

#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include "sections_of_models.hpp"
#include "support/random_models.hpp"
#include "support/winding_oracle.hpp"

namespace test_support {

inline constexpr int half = 6; ///< of an edge of the box

inline std::optional<SectionModel> random_model(ModelMaker& maker) {
    const auto made =
        arrange_within(maker.model(), *box_boundary({-half, -half, -half}, {half, half, half}));
    REQUIRE(message_of(made) == "no error");
    if (!made->rounded.report.clean) return std::nullopt;
    SectionModel model{*made->rounded.mesh, {}};
    model.volumes = *find_volumes(model.mesh);
    return model;
}

/// Blocks by their boundaries, with winding numbers in rationals.
class BlocksByWinding {
public:
    explicit BlocksByWinding(const SectionModel& model) :
        mesh_(model.mesh), triangles_(model.volumes.measures.size()) {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto [a, b, c] = mesh_.triangles[t];
            const auto [front, behind] = model.volumes.of_sides[t];
            if (front == behind) continue;
            triangles_[front].push_back({a, c, b});
            triangles_[behind].push_back({a, b, c});
        }
    }
    /// The block around a point, or nothing if the rays decide nothing.
    [[nodiscard]] std::optional<std::uint32_t> operator()(const RationalPoint& q) const {
        std::uint32_t found = 0;
        for (std::uint32_t b = 1; b < triangles_.size(); ++b) {
            const auto winding = winding_around(mesh_.vertices, triangles_[b], q);
            if (!winding) return std::nullopt;
            if (*winding != 0) found = b;
        }
        return found;
    }

private:
    const Mesh& mesh_;
    std::vector<std::vector<Triangle>> triangles_; ///< per block, outwards
};

inline RationalPoint rational(const Point3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}

} // namespace test_support
