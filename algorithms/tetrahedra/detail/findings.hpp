// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>

namespace terrane::tetrahedra::detail {

/// Counts violations by kind and keeps a sentence about the first of each.
class Findings {
public:
    template <class... T>
    void add(TetrahedraDefect defect, fmt::format_string<T...> sentence, T&&... values) {
        TetrahedraViolation& violation = of_kind_[static_cast<std::size_t>(defect)];
        if (violation.count++ > 0) return;
        violation.defect = defect;
        violation.first = fmt::format(sentence, std::forward<T>(values)...);
    }
    [[nodiscard]] bool has(TetrahedraDefect defect) const {
        return of_kind_[static_cast<std::size_t>(defect)].count > 0;
    }
    /// Returns the kinds that occur, in their order.
    [[nodiscard]] std::vector<TetrahedraViolation> taken() && {
        std::vector<TetrahedraViolation> found;
        for (TetrahedraViolation& violation : of_kind_)
            if (violation.count > 0) found.push_back(std::move(violation));
        return found;
    }

private:
    static constexpr auto last = TetrahedraDefect::wrong_volume;
    std::array<TetrahedraViolation, static_cast<std::size_t>(last) + 1> of_kind_;
};

/// The subject of a check, and the list of its findings.
struct Subject {
    const TetrahedralMesh& made;
    const Mesh& mesh;
    const Volumes& volumes;
    bool whole; ///< the outside is there, up to a box
    Findings& findings;

    /// Whether tetrahedra have to touch a triangle.
    [[nodiscard]] bool needs_faces(std::size_t triangle) const {
        const auto& [front, back] = volumes.of_sides[triangle];
        return whole || front != 0 || back != 0;
    }
};

constexpr std::uint32_t none = UINT32_MAX;

} // namespace terrane::tetrahedra::detail
