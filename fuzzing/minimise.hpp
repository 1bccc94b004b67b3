// SPDX-License-Identifier: MIT
//
// Reduces a mesh with which something fails to few triangles and simple numbers.
#pragma once

#include <terrane/fuzzing/meshes.hpp>

namespace terrane::fuzzing {

/// Tells whether a mesh still fails, in the same way as at first.
using Fails = std::function<bool(const Soup&)>;

/// Returns the smallest mesh that it finds: without any one of its triangles, with any edge contracted, or with any
/// number replaced by some simpler ones (fewer digits, or nearer to 0), it does not fail. Parts keep their places, and may
/// become empty. `fails(soup)` holds; it is called some thousand times for a hundred triangles.
Soup minimise(Soup soup, const Fails& fails);

/// Runs `holds` in a process of its own, and tells whether it returns false, crashes, or does not end within the limit:
/// so crashes and hangs can be reduced, too. The process has no standard error. POSIX only.
bool fails_apart(const std::function<bool()>& holds, unsigned seconds);

} // namespace terrane::fuzzing
