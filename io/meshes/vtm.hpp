// SPDX-License-Identifier: LGPL-3.0-or-later
//
// VTK XML: vtkMultiBlockDataSet (.vtm), a list of files with names. ParaView opens it as one tree.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace terrane {

/// A file of a group.
struct NamedFile {
    std::string name; ///< shown to people
    std::string file; ///< relative to the folder of the .vtm
};

/// Files that are shown together.
struct FileGroup {
    std::string name;             ///< shown to people
    std::vector<NamedFile> files; ///< in order
};

/// Returns the contents of a .vtm.
std::string to_vtm(std::span<const FileGroup> groups);

} // namespace terrane
