// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the parts of two faces for which statements (3) and (4) of separation.hpp prove nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/detail/moved_parts.hpp>
#include <terrane/algorithms/rounding/detail/separation_faces.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::rounding::detail {

/// The vertices of one face by their points, so that each is found at once.
class MarkedFace {
public:
    void mark(const Faces& faces, std::uint32_t slot) {
        if (slot == slot_) return;
        slot_ = slot;
        at_.resize(faces.at.size(), {none, none});
        const Face& f = faces.faces[slot];
        for (std::uint32_t v = f.vertex; v < f.vertex_end; ++v) at_[faces.vertices[v]] = {slot, v};
    }
    [[nodiscard]] std::uint32_t slot() const { return slot_; }
    /// Returns the vertex of the face at a point, or none.
    [[nodiscard]] std::uint32_t find(std::uint32_t point) const {
        return at_[point].face == slot_ ? at_[point].vertex : none;
    }

private:
    std::uint32_t slot_ = none;
    std::vector<VertexOfFace> at_; ///< per point: the face that was marked last there
};

/// Finds the parts of two faces that may meet improperly. Keeps memory from pair to pair: for one
/// thread.
class PairProver {
public:
    PairProver(const MovedParts& moved, const Faces& faces) : moved_(moved), faces_(faces) {}

    /// Adds each pair of a part of g and a part of f that may meet improperly. If there are many such
    /// pairs, it adds the parts of one face instead; see Unproven. g and f are indices into
    /// Faces::faces. Consecutive calls with the same g cost less.
    void operator()(std::uint32_t g, std::uint32_t f, Unproven& found);

private:
    /// A pair of faces, for proving that parts of f are clear of g.
    struct Pair {
        std::uint32_t f_slot, g_slot;
        const Face &f, &g;
        double d; ///< the margin
        Functional height;
        std::array<Functional, 3> beyond;
    };

    [[nodiscard]] Pair pair_of(std::uint32_t f_slot, std::uint32_t g_slot) const;
    [[nodiscard]] std::uint32_t vertex_of_g(const Pair& pair, std::uint32_t v) const;
    [[nodiscard]] bool is_part_of_g(const Pair& pair, std::uint32_t e) const;
    [[nodiscard]] bool is_clear(const Pair& pair, const Triangle& part) const;
    [[nodiscard]] const FaceClusters* clusters_of(const Face& f) const {
        return f.clusters == none ? nullptr : &faces_.clusters[f.clusters];
    }
    [[nodiscard]] bool find_sides(const Pair& pair);
    void find_left(const Pair& pair, std::vector<std::uint32_t>& left);
    void add_pairs(Unproven& found);

    const MovedParts& moved_;
    const Faces& faces_;
    MarkedFace marked_;                           ///< g
    std::vector<std::uint8_t> sides_;             ///< per vertex of a face
    std::vector<std::uint8_t> beyond_;            ///< per vertex: see edges_before, or unknown
    std::vector<std::uint32_t> low_;              ///< vertices not clearly above or below the plane
    std::vector<std::uint32_t> far_;              ///< clusters of vertices clear of the plane
    std::vector<std::uint32_t> left_, left_back_; ///< entries of Faces::parts without proof
    std::vector<Box> boxes_;                      ///< per entry of left_back_
};

} // namespace terrane::rounding::detail
