// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Numbers of different things as different types, so that one cannot be passed for another.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace terrane {

/// An index of one kind. It is made explicitly, `SurfaceId(2)`, and is a std::uint32_t wherever one
/// is read: it indexes arrays, and prints as its number. It neither converts to an index of another
/// kind nor compares with one. It costs what a std::uint32_t costs.
///
/// Members and parameters are of such types where indices of several kinds meet. Arrays with one
/// entry per triangle, such as Mesh::triangles and surfaces_of, hold plain numbers: files and
/// algorithms copy them whole, and the array's name says what they number.
template <class Tag>
class Id {
public:
    /// The number 0.
    constexpr Id() = default;
    /// This number.
    constexpr explicit Id(std::uint32_t number) : number_(number) {}
    /// Not from an index of another kind, even explicitly; go through its number if it must be.
    template <class Other>
    Id(Id<Other>) = delete;

    /// The number.
    constexpr operator std::uint32_t() const { return number_; } // NOLINT: implicit on purpose

    /// Compares the numbers of two indices of one kind.
    friend constexpr bool operator==(Id, Id) = default;
    /// Compares the numbers of two indices of one kind.
    friend constexpr auto operator<=>(Id, Id) = default;
    /// Indices of different kinds do not compare.
    template <class Other>
    friend bool operator==(Id, Id<Other>) = delete;
    /// Indices of different kinds do not compare.
    template <class Other>
    friend auto operator<=>(Id, Id<Other>) = delete;

private:
    std::uint32_t number_ = 0;
};

/// A surface, in the order of the input or of the mesh.
using SurfaceId = Id<struct SurfaceTag>;
/// A triangle of a mesh or an arrangement.
using TriangleId = Id<struct TriangleTag>;
/// An input triangle, counted through all surfaces; see InputTriangles.
using InputTriangleId = Id<struct InputTriangleTag>;
/// A vertex of a mesh or an arrangement: an index into its `vertices`, not a PointIndex.
using VertexId = Id<struct VertexTag>;
/// A volume, as Volumes numbers them; 0 is the outside.
using BlockId = Id<struct BlockTag>;
/// An interface of a Structure.
using InterfaceId = Id<struct InterfaceTag>;

} // namespace terrane

/// Hashes the number.
template <class Tag>
struct std::hash<terrane::Id<Tag>> {
    /// That of the number.
    std::size_t operator()(terrane::Id<Tag> id) const noexcept {
        return std::hash<std::uint32_t>()(id);
    }
};
