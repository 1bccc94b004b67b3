// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace terrane::triangulation::detail {

/// The corner of a triangle that follows corner i in its order.
constexpr unsigned next(unsigned i) {
    return i == 2 ? 0 : i + 1;
}

/// The corner of a triangle that corner i follows in its order.
constexpr unsigned previous(unsigned i) {
    return i == 0 ? 2 : i - 1;
}

} // namespace terrane::triangulation::detail
