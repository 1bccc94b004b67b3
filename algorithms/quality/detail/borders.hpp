// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Keeps the borders of injective patches while curves change.
//
// Guarantee of keeps(): a patch that is injective in its projection is injective after the change
// if all triangles that it gets have its orientation there: statement (6) of
// docs/explanation/injective-patches.md. The border changes along one chain, and no other border
// touches the region between the old chain and the new one except at their ends. Cost: linear in
// the border of the patch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/quality/detail/working_mesh.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::quality::detail {

class Borders {
private:
    struct Corner {
        std::uint32_t name = none; ///< the vertex, or `old_place`: the former position of the moved
                                   ///< one
        Point3 point{};
    };
    using Swept = std::array<Corner, 3>;
    static constexpr std::uint32_t old_place = none - 1;

public:
    /// The mesh must outlive the object.
    explicit Borders(const WorkMesh& mesh) : mesh_(mesh) {}

    /// Finds the borders of all patches. patch_of is given per triangle; no_group: none.
    void find(std::span<const std::uint32_t> patch_of, std::size_t patches);

    /// Working memory of one thread; callers do not use its contents.
    class Search {
        friend class Borders;
        std::vector<Edge> chain_;  ///< new edges of a border, and removed ones in the opposite
                                   ///< direction
        std::vector<Swept> swept_; ///< the region between the old chain and the new one
    };
    /// Tells whether the patch is proven to be injective along the axis after the change, which
    /// replaces some of its triangles by added ones of the same orientation. The answer depends
    /// only on those edges of the border that are in the change's box in the projection.
    [[nodiscard]] bool keeps(const Change& change, std::span<const std::uint32_t> patch_of,
                             std::uint32_t patch, Axis axis, Search& search) const;

    /// Must be called before the mesh changes. The patch loses its removed triangles, and gets the
    /// added ones if it is kept.
    void update(const Change& change, std::span<const std::uint32_t> patch_of, std::uint32_t patch,
                bool is_kept);

private:
    void find_chain(const Change& change, std::span<const std::uint32_t> patch_of,
                    std::uint32_t patch, bool with_added, std::uint32_t name_of_old,
                    std::vector<Edge>& chain) const;
    [[nodiscard]] bool find_swept(const Change& change, Axis axis, Search& search) const;
    [[nodiscard]] bool stays_apart(const Edge& e, Axis axis, const Search& search) const;

    const WorkMesh& mesh_;
    std::vector<std::vector<Edge>> edges_; ///< per patch: its border edges, oriented like its
                                           ///< triangles
    std::vector<Edge> chain_;              ///< of the current change
};

} // namespace terrane::quality::detail
