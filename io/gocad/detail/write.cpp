// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/gocad/detail/write.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/gocad/gocad.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane {

namespace detail {

std::string in_gocad_quotes(std::string_view name) {
    const auto text = one_line(name);
    const bool plain = !text.empty() && trimmed(text).size() == text.size() &&
                       text.find_first_of("\"{}") == std::string::npos;
    return plain ? text : '"' + text + '"';
}

void append_gocad_header(std::string& out, std::string_view type, std::string_view name,
                         std::string_view in_model, std::string_view unit) {
    out += "GOCAD ";
    out += type;
    out += " 1\nHEADER {\nname: ";
    out += in_gocad_quotes(name);
    if (!in_model.empty()) out += "\nname_in_model_list: " + in_gocad_quotes(in_model);
    out += "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n";
    if (!unit.empty()) out += fmt::format("AXIS_UNIT \"{0}\" \"{0}\" \"{0}\"\n", unit);
    out += "ZPOSITIVE Elevation\nEND_ORIGINAL_COORDINATE_SYSTEM\n";
}

void append_gocad_role(std::string& out, Role role) {
    switch (role) {
    case Role::horizon:
        out += "GEOLOGICAL_TYPE top\n";
        break;
    case Role::fault:
        out += "GEOLOGICAL_TYPE fault\n";
        break;
    case Role::boundary:
        out += "GEOLOGICAL_TYPE boundary\n";
        break;
    case Role::unknown:
        break;
    }
}

void append_gocad_vertex(std::string& out, std::uint64_t id, const Point3& place) {
    out += "VRTX ";
    append_number(out, id);
    out += ' ';
    append_point(out, place);
    out += '\n';
}

} // namespace detail

using namespace detail;

namespace {

std::string quoted_word(std::string_view word) {
    std::string text = one_line(word);
    std::ranges::replace(text, '"', '\'');
    const bool plain = !text.empty() && text.find_first_of(" {}") == std::string::npos;
    return plain ? text : '"' + text + '"';
}

/// Returns the number that stands for no value: that of the array, or one that no value is.
double number_without_value(const ValueArray& array) {
    double none = array.no_data.value_or(-99999);
    const auto* const numbers = std::get_if<std::vector<double>>(&array.numbers);
    while (!array.no_data && numbers && std::ranges::count(*numbers, none) > 0) none *= 10;
    return none;
}

/// Writes the values of a surface on its vertices.
class PropertyWriter {
public:
    explicit PropertyWriter(std::span<const ValueArray> arrays) {
        for (const ValueArray& array : arrays)
            if (!array.on_triangles)
                arrays_.push_back(&array), none_.push_back(number_without_value(array));
    }

    void append_header(std::string& out) const {
        if (arrays_.empty()) return;
        std::string names = "PROPERTIES", none = "NO_DATA_VALUES", sizes = "ESIZES",
                    units = "UNITS";
        for (std::size_t a = 0; a < arrays_.size(); ++a) {
            names += " " + quoted_word(arrays_[a]->name);
            none += ' ';
            append_number(none, none_[a]);
            sizes += fmt::format(" {}", arrays_[a]->components);
            units += " " + (arrays_[a]->unit.empty() ? std::string("none")
                                                     : quoted_word(arrays_[a]->unit));
        }
        out += names + '\n' + none + '\n' + sizes + '\n' + units + '\n';
    }

    void append_vertex(std::string& out, std::size_t v, const Point3& place) const {
        if (arrays_.empty()) return append_gocad_vertex(out, v + 1, place);
        out += "PVRTX ";
        append_number(out, std::uint64_t(v) + 1);
        out += ' ';
        append_point(out, place);
        for (std::size_t a = 0; a < arrays_.size(); ++a)
            for (std::size_t c = 0; c < arrays_[a]->components; ++c) {
                const std::size_t i = v * arrays_[a]->components + c;
                out += ' ';
                if (has_no_data(*arrays_[a], i))
                    append_number(out, none_[a]);
                else
                    append_value(out, *arrays_[a], i);
            }
        out += '\n';
    }

private:
    std::vector<const ValueArray*> arrays_;
    std::vector<double> none_; ///< per array: stands for no value
};

void append_tface(std::string& out, const std::vector<Point3>& vertices,
                  const std::vector<Triangle>& triangles, const PropertyWriter& properties) {
    out += "TFACE\n";
    for (std::size_t i = 0; i < vertices.size(); ++i) properties.append_vertex(out, i, vertices[i]);
    for (const auto& triangle : triangles) {
        out += "TRGL";
        for (const auto vertex : triangle) {
            out += ' ';
            append_number(out, std::uint64_t(vertex) + 1);
        }
        out += '\n';
    }
    out += "END\n";
}

} // namespace

std::string to_gocad(const Mesh& mesh, std::span<const SurfaceValues> values) {
    std::vector<std::vector<Triangle>> triangles_of(mesh.surfaces.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const auto surface : mesh.surfaces_of[i])
            triangles_of[surface].push_back(mesh.triangles[i]);
    std::string out;
    Submesh subset(mesh.vertices);
    for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) {
        const auto vertices = subset.cut(triangles_of[s]);
        append_gocad_header(out, "TSurf", mesh.surfaces[s].name);
        append_gocad_role(out, mesh.surfaces[s].role);
        const PropertyWriter properties(s < values.size() ? std::span(values[s])
                                                          : std::span<const ValueArray>());
        properties.append_header(out);
        append_tface(out, vertices, triangles_of[s], properties);
    }
    return out;
}

} // namespace terrane
