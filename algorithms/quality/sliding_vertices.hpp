// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lets vertices of an improved mesh slide on the original surfaces, within the bounds that improve()
// has proven.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

class SlidingVertices {
public:
    /// `after` is what improve() made of `before` with these options. Both must outlive the object.
    SlidingVertices(const Mesh& before, const Improved& after, const ImproveOptions& options,
                    const Run& run);
    SlidingVertices(const SlidingVertices&) = delete;
    SlidingVertices& operator=(const SlidingVertices&) = delete;
    ~SlidingVertices();

    /// Tells whether a vertex is inside of a sheet, neither on a curve nor at a free border.
    [[nodiscard]] bool is_inner(std::uint32_t v) const { return triangle_at_[v] != UINT32_MAX; }
    /// Returns the point above or below p, along about the normal, on the sheet of an inner vertex;
    /// none if a curve or a fold is on the way there. Several threads may call it at a time.
    [[nodiscard]] std::optional<Point3> place(std::uint32_t v, const Point3& p) const;
    /// Returns the triangles with a corner that has moved to `points` that are not proven to be within
    /// the bound of their surfaces, report.bound_of, of their sheet, or within less where a block is
    /// thin, see improve().
    [[nodiscard]] std::vector<std::uint32_t> not_shown(std::span<const Point3> points) const;

private:
    struct Reference;

    const Mesh& mesh_; ///< the improved one
    const Improved& after_;
    std::unique_ptr<const Reference> reference_;
    std::vector<std::uint32_t>
        triangle_at_; ///< per inner vertex: a triangle at it; else UINT32_MAX
};

} // namespace terrane
