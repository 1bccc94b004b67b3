// SPDX-License-Identifier: LGPL-3.0-or-later
//
// VTK's XML files: their elements, and the numbers and texts of their arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/meshes/detail/vtk_data.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

using Integers = std::vector<std::int64_t>;

/// The contents of a file. What it returns are errors at the line of an element.
class VtkXmlFile {
public:
    /// `type`: of the data that are read, PolyData, UnstructuredGrid or StructuredGrid.
    VtkXmlFile(std::string_view contents, std::string_view source, std::string_view type) :
        contents_(contents), source_(source), type_(type) {}

    /// Parses the file and finds the element with its data.
    MaybeError open(pugi::xml_node& data);
    [[nodiscard]] std::string_view source() const { return source_; }
    [[nodiscard]] std::string_view type() const { return type_; }
    [[nodiscard]] Error error(const pugi::xml_node& at, ErrorCode code, std::string what) const;

    /// Reads the numbers of an array.
    MaybeError values_of(const pugi::xml_node& array, Integers& values);
    MaybeError values_of(const pugi::xml_node& array, std::vector<double>& values);
    /// Reads strings, each ended by a 0.
    MaybeError strings_of(const pugi::xml_node& array, std::vector<std::string>& strings);
    static pugi::xml_node array_named(const pugi::xml_node& parent, std::string_view name);

private:
    [[nodiscard]] std::string place(std::ptrdiff_t offset) const;
    MaybeError parse();
    MaybeError read_header();
    MaybeError bytes_of(const pugi::xml_node& array, std::string& bytes);
    MaybeError append_value(const pugi::xml_node& array, std::string_view token,
                            Integers& values) const;
    MaybeError append_value(const pugi::xml_node& array, std::string_view token,
                            std::vector<double>& values) const;
    template <class Number>
    MaybeError numbers_of(const pugi::xml_node& array, std::vector<Number>& values);

    std::string_view contents_, source_, type_;
    pugi::xml_document document_;
    pugi::xml_node root_;
    VtkEncoding encoding_;
    std::string_view appended_;
    std::string appended_text_; ///< without blanks, if it is base64
    bool appended_is_base64_ = false;
    std::size_t used_ = 0; ///< bytes of the file that arrays have read
};

} // namespace terrane::detail
