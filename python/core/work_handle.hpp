// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>

#include <terrane/algorithms/reconstruction/fill.hpp>

namespace terrane::python {

/// Surfaces with their filled holes, kept for reports.
using WorkPointer = std::shared_ptr<FillWork>;

} // namespace terrane::python
