// SPDX-License-Identifier: MIT
//
// Files as other programs and people write them, for tests of readers.
#pragma once

#include <terrane/fuzzing/meshes.hpp>

namespace terrane::fuzzing {

/// Formats of files of text.
enum class TextFormat {
    obj, ///< Wavefront OBJ
    off, ///< OFF
    stl, ///< STL, text
    ply, ///< PLY, text
    ts,  ///< GOCAD TSurf
};

/// Returns a file that is allowed, but not tidy: comments, blank and indented lines, tabs, either end of line, numbers
/// in several spellings, and what the format has besides: texture coordinates, normals, colours, further properties and
/// elements, negative indices, vertices numbered from anywhere. Bytes choose. A reader must find the triangles of the
/// part in their order, with the same corners to the last bit (0 and -0 are one).
std::string dirty_file(Bytes& bytes, const Part& part, TextFormat format);

} // namespace terrane::fuzzing
