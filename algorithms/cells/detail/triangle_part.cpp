// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/cells/detail/triangle_part.hpp>

namespace terrane::cells::detail {

Sign TrianglePart::side_of(const PartCorner& corner, const CellPlane& plane) const {
    const auto& corners = triangle_->corners;
    if (corner.planes == 0) return sign_of(along(corners[corner.number], plane.axis) - plane.at);
    for (std::size_t i = 0; i < corner.planes; ++i)
        if (corner.on[i].axis == plane.axis) return sign_of(corner.on[i].at - plane.at);
    Point3 place;
    along(place, plane.axis) = plane.at;
    for (std::size_t i = 0; i < corner.planes; ++i)
        along(place, corner.on[i].axis) = corner.on[i].at;
    if (corner.planes == 2)
        return -orient3d(corners[0], corners[1], corners[2], place) * triangle_->normal[plane.axis];
    const std::size_t a = corner.on[0].axis, b = plane.axis;
    const Point3 &p = corners[corner.number], &q = corners[(corner.number + 1) % 3];
    const Sign side = orient2d(static_cast<Axis>(3 - a - b), p, q, place);
    const Sign way = along(q, a) > along(p, a) ? Sign::Positive : Sign::Negative;
    return b == (a + 1) % 3 ? -side * way : side * way;
}

void TrianglePart::cut(const CellPlane& plane, Sign side) {
    std::array<Sign, 10> signs{};
    bool some_stays = false, all_stays = true;
    for (std::size_t i = 0; i < size_; ++i) {
        signs[i] = side_of(corners_[i], plane) * side;
        some_stays = some_stays || signs[i] == Sign::Positive;
        all_stays = all_stays && signs[i] != Sign::Negative;
    }
    if (some_stays && all_stays) return;
    const std::array<PartCorner, 10> before = corners_;
    const std::size_t count = some_stays ? size_ : 0;
    size_ = 0;
    const PartSide on_plane{3, plane};
    for (std::size_t i = 0; i < count; ++i) {
        const PartCorner& corner = before[i];
        const Sign here = signs[i], next = signs[(i + 1) % count];
        if (here != Sign::Negative)
            add(corner, here == Sign::Zero && next == Sign::Negative ? on_plane : corner.side);
        if (here * next != Sign::Negative) continue;
        const PartSide& at = corner.side;
        const PartCorner crossing = at.edge < 3 ? PartCorner{1, at.edge, {plane}, {}}
                                                : PartCorner{2, 0, {at.plane, plane}, {}};
        add(crossing, here == Sign::Positive ? on_plane : at);
    }
}

} // namespace terrane::cells::detail
