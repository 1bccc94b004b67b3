// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Arrays of VTK's legacy files: of the whole file, of its cells and of its points.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/io/meshes/detail/legacy_vtk_scanner.hpp>

namespace terrane::detail {

/// Reads the arrays of a file. Those about surfaces are kept apart, and texts among them as the codes of their
/// characters, each ended by a 0.
class LegacyVtkArrays {
public:
    explicit LegacyVtkArrays(LegacyVtkScanner& in) : in_(in) {}

    /// Reads a field of the whole file.
    MaybeError read_field() { return read_field(fields_); }
    /// Reads the arrays of cells and points, of which the first section is the current one, up to what is not known.
    MaybeError read(std::string section, std::size_t points, std::size_t cells);

    [[nodiscard]] bool has_field(const std::string& name) const { return fields_.contains(name); }
    [[nodiscard]] const std::vector<double>& field(const std::string& name) {
        return fields_[name];
    }
    [[nodiscard]] bool has_of_cells(const std::string& name) const {
        return of_cells_.contains(name);
    }
    [[nodiscard]] const std::vector<double>& of_cells(std::string_view name) {
        return of_cells_[std::string(name)];
    }
    /// Returns the texts in a field.
    [[nodiscard]] std::vector<std::string> texts(const std::string& field) const;
    /// Values over all points and cells.
    [[nodiscard]] const std::vector<ValueArray>& values() const { return values_; }
    /// Names of values that are not read.
    [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }

private:
    using Arrays = std::map<std::string, std::vector<double>>;

    MaybeError read_field(Arrays& arrays);
    MaybeError read_values(const std::string& name, std::size_t components, std::size_t tuples,
                           Arrays& arrays);
    MaybeError read_values(const std::string& name, std::size_t components, std::size_t tuples,
                           const LegacyType& type, Arrays& arrays);
    [[nodiscard]] ValueArray empty_array(const std::string& name, std::size_t components,
                                         const Arrays& arrays) const;
    void keep(ValueArray array);
    MaybeError read_array(std::size_t count, std::vector<double>& values);
    MaybeError read_sections(std::string section);
    MaybeError read_tuples(std::size_t components, std::size_t count, Arrays& arrays);
    MaybeError read_scalars(std::size_t count, Arrays& arrays);

    LegacyVtkScanner& in_;
    std::size_t points_ = 0, cells_ = 0;
    Arrays fields_, of_cells_; ///< those about surfaces
    std::vector<ValueArray> values_;
    std::vector<std::string> left_out_;
};

} // namespace terrane::detail
