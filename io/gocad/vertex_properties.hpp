// SPDX-License-Identifier: LGPL-3.0-or-later
//
// PROPERTIES of the vertices of GOCAD's objects.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

/// The values of vertices: what the header says of them, and the numbers behind the coordinates.
class VertexProperties {
public:
    /// Takes a line of the header. Once there is a vertex such lines have no effect.
    void read_header(std::string_view keyword, std::string_view line);
    /// Takes the numbers behind the coordinates of a vertex. Missing ones are no values.
    void read_vertex(const LineParser& in, Tokens tokens);
    /// Gives a surface with these vertices the arrays, and the names of those that are too many.
    void end(Surface& surface) const;
    /// Gives a surface the names alone.
    void end_unread(Surface& surface) const;

private:
    void begin();

    std::vector<std::string> names_, sizes_, units_, no_data_; ///< words of the header
    std::vector<ValueArray> described_;                        ///< without numbers
    std::size_t width_ = 0, vertices_ = 0;
    std::vector<double> numbers_; ///< per vertex: width_ numbers
    bool is_any_ = false;
};

} // namespace terrane::detail
