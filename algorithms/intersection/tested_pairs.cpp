// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/intersection/tested_pairs.hpp>

#include <terrane/algorithms/intersection/renamed_construction.hpp>

namespace terrane {

void ContactList::push_back(const Contact& contact) {
    shapes_.push_back({contact.overlap, contact.piece_count, contact.pieces});
    points_.push_back(std::span(contact.points).first(contact.point_count));
}

void ContactList::append(const ContactList& other) {
    shapes_.insert(shapes_.end(), other.shapes_.begin(), other.shapes_.end());
    points_.append(other.points_);
}

void ContactList::add_renamed(const ContactList& other, std::size_t i,
                              std::span<const std::uint32_t> name) {
    shapes_.push_back(other.shapes_[i]);
    for (const ContactPoint& point : other.points_[i])
        points_.values.push_back({renamed(point.how, name), point.place});
    points_.close();
}

bool have_same_order(const std::array<Triangle, 2>& before, const std::array<Triangle, 2>& now) {
    const auto before_at = [&](unsigned i) { return before[i / 3][i % 3]; };
    const auto now_at = [&](unsigned i) { return now[i / 3][i % 3]; };
    for (unsigned i = 0; i < 6; ++i)
        for (unsigned k = i + 1; k < 6; ++k)
            if ((before_at(i) < before_at(k)) != (now_at(i) < now_at(k))) return false;
    return true;
}

} // namespace terrane
