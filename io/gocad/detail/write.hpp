// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Functions that the writers of GOCAD's objects share.
#pragma once

#include <string>
#include <string_view>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::detail {

/// Returns a name on one line, in quotes where it could not be read back without them.
[[nodiscard]] std::string in_gocad_quotes(std::string_view name);

/// Appends the first lines of an object, with its name and a coordinate system with z up.
/// `in_model`: its name in the lists of a model; `unit`: of the coordinates; empty: none.
void append_gocad_header(std::string& out, std::string_view type, std::string_view name,
                         std::string_view in_model = {}, std::string_view unit = {});

/// Appends the line with the role of a surface, if it has one.
void append_gocad_role(std::string& out, Role role);

/// Appends "VRTX id x y z".
void append_gocad_vertex(std::string& out, std::uint64_t id, const Point3& place);

} // namespace terrane::detail
