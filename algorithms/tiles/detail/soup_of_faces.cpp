// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tiles/detail/soup_of_faces.hpp>

#include <algorithm>

#include <terrane/algorithms/core/disjoint_sets.hpp>

namespace terrane::tiles::detail {

std::uint32_t SoupOfFaces::point_named(std::uint32_t name) const {
    return static_cast<std::uint32_t>(std::lower_bound(names.begin(), names.end(), name) -
                                      names.begin());
}

std::uint32_t SoupOfFaces::face_with(std::uint32_t id) const {
    return static_cast<std::uint32_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
}

SoupOfFaces soup_of(std::span<const Face> faces) {
    SoupOfFaces soup;
    soup.names.reserve(3 * faces.size());
    for (const Face& f : faces)
        soup.names.insert(soup.names.end(), f.corners.begin(), f.corners.end());
    sort_unique(soup.names);
    soup.names.shrink_to_fit();
    soup.points.resize(soup.names.size());
    soup.triangles.reserve(faces.size());
    soup.ids.reserve(faces.size());
    for (const Face& f : faces) {
        Triangle& t = soup.triangles.emplace_back();
        for (unsigned i = 0; i < 3; ++i) {
            t[i] = soup.point_named(f.corners[i]);
            soup.points[t[i]] = f.at[i];
        }
        soup.ids.push_back(f.id);
    }
    return soup;
}

} // namespace terrane::tiles::detail
