// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/detail/vtk_writer.hpp>

#include <bit>
#include <cmath>
#include <cstring>
#include <new>
#include <variant>

#include <fmt/format.h>
#include <zlib.h>

#include <terrane/io/text/names.hpp>
#include <terrane/io/text/values.hpp>
#include <terrane/io/text/xml.hpp>

namespace terrane::detail {

static_assert(std::endian::native == std::endian::little, "the arrays are written as they lie");

namespace {

using Bytes = std::string;

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
    Bytes bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

void append_base64(std::string& out, std::string_view bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
        };
        const unsigned group = byte(0) << 16 | byte(1) << 8 | byte(2);
        out += digits[group >> 18];
        out += digits[group >> 12 & 63];
        out += i + 1 < bytes.size() ? digits[group >> 6 & 63] : '=';
        out += i + 2 < bytes.size() ? digits[group & 63] : '=';
    }
}

Bytes deflated(std::string_view bytes) {
    uLongf size = compressBound(bytes.size());
    Bytes result(size, '\0');
    const int code = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 1);
    if (code != Z_OK) throw std::bad_alloc(); // the only way it can fail with a buffer this large
    result.resize(size);
    return result;
}

/// Appends the header {number of blocks, block size, size of the last block, compressed sizes...}
/// and the compressed blocks.
void append_compressed(std::string& out, std::string_view bytes) {
    constexpr std::size_t block = std::size_t(1) << 20;
    std::vector<std::uint64_t> header{(bytes.size() + block - 1) / block, block,
                                      bytes.size() % block};
    Bytes blocks;
    for (std::size_t i = 0; i < bytes.size(); i += block) {
        const auto compressed = deflated(bytes.substr(i, block));
        header.push_back(compressed.size());
        blocks += compressed;
    }
    append_base64(out, bytes_of(header));
    append_base64(out, blocks);
}

void append_plain(std::string& out, std::string_view bytes) {
    const std::vector<std::uint64_t> header{bytes.size()};
    append_base64(out, bytes_of(header).append(bytes));
}

template <class To, class From>
std::vector<To> as(const std::vector<From>& values) {
    std::vector<To> converted;
    converted.reserve(values.size());
    for (const From value : values) converted.push_back(static_cast<To>(value));
    return converted;
}

} // namespace

void VtkWriter::begin_file(std::string_view type, std::string_view attributes) {
    has_strings_ = type == "PolyData";
    out_ += fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" "
                        "byte_order=\"LittleEndian\" header_type=\"UInt64\"{}>\n<{}{}>\n",
                        type, compress_ ? " compressor=\"vtkZLibDataCompressor\"" : "", type,
                        attributes);
}

void VtkWriter::comment(std::string_view lines) {
    std::string said;
    for (const char c : lines) { // "--" would end it
        if (c == '-' && !said.empty() && said.back() == '-') said += ' ';
        said += c;
    }
    text("<!--\n" + said + "-->");
}

void VtkWriter::begin_array(std::string_view name, std::string_view type, std::size_t size,
                            int components, bool ids) {
    out_ += fmt::format("<DataArray type=\"{}\" {}Name=\"{}\" NumberOfComponents=\"{}\" {}"
                        "format=\"binary\">\n",
                        type, ids ? "IdType=\"1\" " : "", xml_escaped(name), components,
                        in_field_ ? fmt::format("NumberOfTuples=\"{}\" ", size) : "");
}

void VtkWriter::end_array(std::string_view bytes) {
    if (compress_)
        append_compressed(out_, bytes);
    else
        append_plain(out_, bytes);
    out_ += "\n</DataArray>\n";
}

void VtkWriter::strings(std::string_view name, const std::vector<std::string_view>& values) {
    std::string lines;
    std::size_t count = 0;
    for (const auto value : values) {
        for (const char c : value)
            if (c != '\0') {
                lines += fmt::format("{} ", static_cast<unsigned char>(c));
                ++count;
            }
        lines += "0\n";
        ++count;
    }
    if (has_strings_)
        out_ += fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" "
                            "format=\"ascii\">\n{}</Array>\n",
                            xml_escaped(name), values.size(), lines);
    else
        out_ += fmt::format("<DataArray type=\"UInt8\" Name=\"{}\" NumberOfTuples=\"{}\" "
                            "format=\"ascii\">\n{}</DataArray>\n",
                            xml_escaped(name), count, lines);
}

void VtkWriter::begin_field() {
    text("<FieldData>");
    in_field_ = true;
}

void VtkWriter::end_field() {
    in_field_ = false;
    text("</FieldData>");
}

void VtkWriter::field(const std::vector<SurfaceInfo>& surfaces,
                      const IndexLists<std::uint32_t>& surfaces_of, std::string_view name_of_names,
                      std::span<const std::string> further_names,
                      std::span<const ValueArray> values) {
    begin_field();
    std::vector<std::string_view> names, roles;
    for (const auto& surface : surfaces) {
        names.push_back(surface.name);
        roles.push_back(role_names[static_cast<std::size_t>(surface.role)]);
    }
    strings("surface_name", names);
    strings("surface_role", roles);
    if (surfaces_of.values.size() > surfaces_of.size()) {
        array("surfaces_offset", as<std::int64_t>(surfaces_of.offsets));
        array("surfaces", as<std::int64_t>(surfaces_of.values));
    }
    if (!further_names.empty())
        strings(name_of_names, {further_names.begin(), further_names.end()});
    std::vector<std::string_view> value_names, units;
    std::vector<double> no_data;
    for (const bool on_triangles : {false, true}) // as they will be written
        for (const ValueArray& array : values)
            if (array.on_triangles == on_triangles) {
                value_names.emplace_back(array.name);
                units.emplace_back(array.unit);
                no_data.push_back(array.no_data.value_or(std::nan("")));
            }
    if (!value_names.empty()) {
        strings("value_name", value_names);
        strings("value_unit", units);
        array("value_no_data", no_data);
    }
    end_field();
}

void VtkWriter::begin_piece(std::size_t points, std::size_t cells) {
    text(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", points, cells));
}

void VtkWriter::points(const std::vector<Point3>& vertices) {
    std::vector<double> values;
    values.reserve(vertices.size() * 3);
    for (const auto& p : vertices) values.insert(values.end(), {p.x, p.y, p.z});
    text("<Points>");
    array("Points", values, 3);
    text("</Points>");
}

void VtkWriter::cells(const std::vector<std::int64_t>& nodes,
                      const std::vector<std::int64_t>& offsets,
                      const std::vector<std::uint8_t>& types) {
    text("<Cells>");
    array("connectivity", nodes);
    array("offsets", offsets);
    array("types", types);
    text("</Cells>");
}

void VtkWriter::further(std::span<const CellArray> cells) {
    for (const auto& cell : cells)
        std::visit([&](const auto& values) { array(cell.name, values); }, cell.values);
}

void VtkWriter::values(std::span<const ValueArray> arrays, bool on_triangles) {
    for (const ValueArray& a : arrays) {
        if (a.on_triangles != on_triangles) continue;
        if (!a.texts.empty() && has_strings_ && a.components == 1) {
            std::vector<std::string_view> texts;
            for (const std::int64_t code : std::get<1>(a.numbers))
                texts.emplace_back(a.texts.at(static_cast<std::size_t>(code)));
            strings(a.name, texts);
            continue;
        }
        with_type(a.type, [&]<class T>(T) {
            std::visit(
                [&](const auto& numbers) {
                    array(a.name, as<T>(numbers), static_cast<int>(a.components));
                },
                a.numbers);
        });
    }
}

std::string VtkWriter::end_file(std::string_view type) {
    out_ += fmt::format("</Piece>\n</{}>\n</VTKFile>\n", type);
    return std::move(out_);
}

void append_offsets(std::vector<std::int64_t>& out, std::size_t cells, std::int64_t count) {
    for (std::size_t i = 0; i < cells; ++i) out.push_back((out.empty() ? 0 : out.back()) + count);
}

} // namespace terrane::detail
