// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/fuzzing/meshes.hpp>

namespace terrane::fuzz {

using fuzzing::Bytes;

} // namespace terrane::fuzz
