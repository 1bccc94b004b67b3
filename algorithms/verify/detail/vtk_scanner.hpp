// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Follows the elements of VTK's XML files as Terrane writes them, for the readers of output.hpp and
// tetrahedra_files.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/verify/detail/line_scanner.hpp>

namespace terrane::verifier {

/// All functions throw a Difference if the text goes on otherwise.
class VtkScanner {
public:
    explicit VtkScanner(std::string_view contents) : in_(contents) {}

    /// Reads the first lines of a file of this type: "PolyData".
    void begin(const std::string& type);
    /// Reads the last lines.
    void end(const std::string& type);
    void expect(std::string_view line) { in_.expect(line); }
    /// Reads the names and roles of surfaces, and the surfaces of cells if some have several.
    void field_data(std::span<const SurfaceInfo> surfaces,
                    const IndexLists<std::uint32_t>& surfaces_of);
    void points(const std::vector<Point3>& vertices);
    /// Reads an array, which must have these values, bit for bit.
    template <class T>
    void array(const std::string& name, const std::vector<T>& expected, int components = 1);

private:
    void end_field_data();
    void strings(const std::string& name, const std::vector<std::string_view>& values);
    [[nodiscard]] std::string plain(std::string_view text, std::size_t size) const;
    [[nodiscard]] std::string inflated(std::string_view text, std::size_t size) const;

    LineScanner in_;
    bool compressed_ = false;
    bool in_field_ = false;
    bool has_strings_ = true; ///< whether strings are arrays of strings
};

/// Returns the first number of each list, as cell arrays have it; -1 for none.
std::vector<std::int32_t> first_of(const IndexLists<std::uint32_t>& lists);
/// Returns the length of each list.
std::vector<std::int32_t> counts_of(const IndexLists<std::uint32_t>& lists);

} // namespace terrane::verifier
