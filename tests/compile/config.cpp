// SPDX-License-Identifier: LGPL-3.0-or-later
// This file compiles, but must not compile with -ffast-math.
#include <terrane/kernel/config.hpp>
