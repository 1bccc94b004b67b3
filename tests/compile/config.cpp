// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiles as it is; must not with -ffast-math.
#include <terrane/kernel/config.hpp>
