// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace terrane {

/// One of the files that hold a mesh together, for formats of several files.
struct PartOfMesh {
    std::string file;     ///< its name in the folder of the first; empty: the first itself
    std::string contents; ///< all bytes
};

/// The files of a mesh; the first is the one that the user named.
using SeveralFiles = std::vector<PartOfMesh>;

} // namespace terrane
