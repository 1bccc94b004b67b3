// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Results of tests of the pairs of a soup, which another soup takes over where it has the same
// triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>

namespace terrane {

/// A list of contacts that takes little memory, as most of them have few points.
class ContactList {
public:
    /// The members of Contact that say how the points are connected.
    struct Shape {
        bool overlap = false;
        std::array<std::uint8_t, 2> piece_count{};
        std::array<std::array<ContactPiece, 3>, 2> pieces{};
    };

    [[nodiscard]] std::size_t size() const { return shapes_.size(); }
    [[nodiscard]] const Shape& shape(std::size_t i) const { return shapes_[i]; }
    [[nodiscard]] std::span<const ContactPoint> points(std::size_t i) const { return points_[i]; }

    void push_back(const Contact& contact);
    /// Appends all contacts of `other`.
    void append(const ContactList& other);
    /// Appends contact i of `other`, between triangles whose vertices have other names. name: per old
    /// name; the new names must be in the same order (have_same_order).
    void add_renamed(const ContactList& other, std::size_t i, std::span<const std::uint32_t> name);

private:
    std::vector<Shape> shapes_;
    IndexLists<ContactPoint> points_;
};

/// The results per pair of triangles.
struct TestedPairs {
    // Outcomes of a test:
    static constexpr std::uint32_t untested = 0, ///< nothing is known
        apart = 1, ///< the two do not meet, and will not when their points are rounded
        near = 2,  ///< they may meet when their points are rounded, but have no improper contact
        first_contact = 3; ///< first_contact + i: they have contact i

    std::vector<std::uint32_t> outcomes; ///< per pair
    ContactList contacts;                ///< those of pairs, and perhaps others
};

/// Tells whether improper_contact() gives pairs of triangles the same contact, but for the names of
/// vertices: whether the corners are named in the same order as before.
bool have_same_order(const std::array<Triangle, 2>& before, const std::array<Triangle, 2>& now);

} // namespace terrane
