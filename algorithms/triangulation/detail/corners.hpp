// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace terrane::triangulation::detail {

/// Returns the corner that follows corner i of a triangle.
constexpr unsigned next(unsigned i) {
    return i == 2 ? 0 : i + 1;
}

/// Returns the corner that precedes corner i of a triangle.
constexpr unsigned previous(unsigned i) {
    return i == 0 ? 2 : i - 1;
}

} // namespace terrane::triangulation::detail
