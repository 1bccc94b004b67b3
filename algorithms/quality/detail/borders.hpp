// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Keeps the borders of proven patches while curves change. Private to improve.
//
// Guarantee of keeps(): a patch that was injective in its projection is injective after the change, if
// all triangles that it gets are oriented there as all of it: statement (6) of
// docs/explanation/injective-patches.md. The border changes along one chain, and no other border
// touches what lies between the old chain and the new one but in their ends.
// Cost: a look at each edge of the patch's border.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/quality/detail/working_mesh.hpp>
#include <terrane/kernel/construction.hpp>

namespace terrane::improving {

class Borders {
private:
    struct Corner {
        std::uint32_t name = none; ///< the vertex, or `old_place`: where the moved one was
        Point3 point{};
    };
    using Swept = std::array<Corner, 3>;
    static constexpr std::uint32_t old_place = none - 1;

public:
    /// What is named must outlive it.
    explicit Borders(const WorkMesh& mesh) : mesh_(mesh) {}

    /// patch_of: per triangle, or no_group.
    void find(std::span<const std::uint32_t> patch_of, std::size_t patches);

    /// What a thread that asks has to itself; its contents mean nothing to it.
    class Search {
        friend class Borders;
        std::vector<Edge> chain_;  ///< what comes to a border; what goes, turned round
        std::vector<Swept> swept_; ///< what lies between
    };
    /// Whether the patch is shown to be one-to-one along the axis after the change, which gives it
    /// the triangles added for those it loses; they are wound as it is. What is asked for depends
    /// on edges of the border only that are in the change's box in the projection.
    [[nodiscard]] bool keeps(const Change& change, std::span<const std::uint32_t> patch_of,
                             std::uint32_t patch, Axis axis, Search& search) const;

    /// To be called before the mesh is changed: the patch loses its removed triangles, and gets
    /// what is added for them where it is kept.
    void update(const Change& change, std::span<const std::uint32_t> patch_of, std::uint32_t patch,
                bool is_kept);

private:
    void find_chain(const Change& change, std::span<const std::uint32_t> patch_of,
                    std::uint32_t patch, bool with_added, std::uint32_t name_of_old,
                    std::vector<Edge>& chain) const;
    [[nodiscard]] bool find_swept(const Change& change, Axis axis, Search& search) const;
    [[nodiscard]] bool stays_apart(const Edge& e, Axis axis, const Search& search) const;

    const WorkMesh& mesh_;
    std::vector<std::vector<Edge>> edges_; ///< per patch: of its border, as its triangles run
    std::vector<Edge> chain_;              ///< of the change at hand
};

} // namespace terrane::improving
