// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::detail {

/// The spelling of each Role in files, indexed by its number.
inline constexpr std::array<std::string_view, 4> role_names{"unknown", "horizon", "fault",
                                                            "boundary"};

/// Returns names for formats without quotes. Blanks, control characters, '#' and '\' become '_', an
/// empty name becomes "surface", and repeated names are told apart by the endings _2, _3, ...
[[nodiscard]] std::vector<std::string> plain_names(const std::vector<SurfaceInfo>& surfaces);

/// Returns names for formats with double quotes. Control characters become blanks, '"' becomes an
/// apostrophe; empty and repeated names are changed as by plain_names.
[[nodiscard]] std::vector<std::string> quotable_names(const std::vector<SurfaceInfo>& surfaces);

/// Returns names for Abaqus, which does not distinguish upper and lower case. They consist of
/// capital letters, digits and '_', begin with a letter, and have at most 60 characters before the
/// ending of a repeated name.
[[nodiscard]] std::vector<std::string> label_names(const std::vector<SurfaceInfo>& surfaces);

/// Returns the name on one line: control characters become blanks.
[[nodiscard]] std::string one_line(std::string_view name);

/// Notes that a file has values with this name on points or triangles. Coordinates, normals, the arrays
/// of Terrane's own files, repetitions and more than 64 names are not noted.
void note_values(std::string_view name, std::vector<std::string>& names);

/// Makes names of one word, for input files of simulators and for names of files. Letters, digits,
/// '-' and characters beyond ASCII are kept; the characters between them become one '_'. A word
/// begins with no digit, since programs take such names for numbers, and has at most 200 bytes
/// before the ending _2, _3, ... that tells it from an earlier one, also from one with other
/// capital letters: some file systems do not distinguish these.
class WordNames {
public:
    /// Returns the word for a name: `kind` where nothing of it can be kept, and after `kind` and '_'
    /// where it begins with a digit.
    std::string add(std::string_view name, std::string_view kind);

private:
    std::set<std::string> taken_; ///< in small letters
};

} // namespace terrane::detail
