// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/vtk.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>
#include <optional>

#include <fmt/format.h>
#include <zlib.h>

#include <terrane/io/meshes/detail/groups.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/xml.hpp>

namespace terrane {

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

void append_plain(std::string& out, const Bytes& bytes) {
    const std::vector<std::uint64_t> header{bytes.size()};
    append_base64(out, bytes_of(header) + bytes);
}

/// Writes the elements of one VTK file.
class VtkWriter {
public:
    explicit VtkWriter(bool compress) : compress_(compress) {}

    void begin_file(std::string_view type) {
        has_strings_ = type == "PolyData";
        out_ = fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" "
                           "byte_order=\"LittleEndian\" header_type=\"UInt64\"{}>\n<{}>\n",
                           type, compress_ ? " compressor=\"vtkZLibDataCompressor\"" : "", type);
    }
    void text(std::string_view line) { out_.append(line).append("\n"); }

    template <class T>
    void array(std::string_view name, const std::vector<T>& values, int components = 1) {
        out_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" {}"
                            "format=\"binary\">\n",
                            type_name(T()), xml_escaped(name), components,
                            in_field_ ? fmt::format("NumberOfTuples=\"{}\" ", values.size()) : "");
        if (compress_)
            append_compressed(out_, bytes_of(values));
        else
            append_plain(out_, bytes_of(values));
        out_ += "\n</DataArray>\n";
    }

    /// Writes strings as VTK does: the codes of their characters, each string ended by a 0. In
    /// grids they are arrays of codes, as meshio reads no grid with arrays of strings.
    void strings(std::string_view name, const std::vector<std::string_view>& values) {
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
                                name, values.size(), lines);
        else
            out_ += fmt::format("<DataArray type=\"UInt8\" Name=\"{}\" NumberOfTuples=\"{}\" "
                                "format=\"ascii\">\n{}</DataArray>\n",
                                name, count, lines);
    }

    void field(const std::vector<SurfaceInfo>& surfaces,
               const IndexLists<std::uint32_t>& surfaces_of, std::string_view name_of_names,
               std::span<const std::string> further_names) {
        text("<FieldData>");
        in_field_ = true;
        std::vector<std::string_view> names, roles;
        for (const auto& surface : surfaces) {
            names.push_back(surface.name);
            roles.push_back(detail::role_names[static_cast<std::size_t>(surface.role)]);
        }
        strings("surface_name", names);
        strings("surface_role", roles);
        if (surfaces_of.values.size() > surfaces_of.size()) {
            array("surfaces_offset", as<std::int64_t>(surfaces_of.offsets));
            array("surfaces", as<std::int64_t>(surfaces_of.values));
        }
        if (!further_names.empty())
            strings(name_of_names, {further_names.begin(), further_names.end()});
        in_field_ = false;
        text("</FieldData>");
    }

    void points(const std::vector<Point3>& vertices) {
        std::vector<double> values;
        values.reserve(vertices.size() * 3);
        for (const auto& p : vertices) values.insert(values.end(), {p.x, p.y, p.z});
        text("<Points>");
        array("Points", values, 3);
        text("</Points>");
    }

    void further(std::span<const CellArray> cells) {
        for (const auto& cell : cells)
            std::visit([&](const auto& values) { array(cell.name, values); }, cell.values);
    }

    std::string end_file(std::string_view type) {
        out_ += fmt::format("</Piece>\n</{}>\n</VTKFile>\n", type);
        return std::move(out_);
    }

    template <class To, class From>
    static std::vector<To> as(const std::vector<From>& values) {
        return std::vector<To>(values.begin(), values.end());
    }

private:
    static std::string_view type_name(double) { return "Float64"; }
    static std::string_view type_name(std::int32_t) { return "Int32"; }
    static std::string_view type_name(std::int64_t) { return "Int64"; }
    static std::string_view type_name(std::uint8_t) { return "UInt8"; }

    std::string out_;
    bool compress_;
    bool in_field_ = false;
    bool has_strings_ = true; ///< whether strings are arrays of strings
};

/// Appends the first value of each list; -1 for an empty list.
void append_first(std::vector<std::int32_t>& out, const IndexLists<std::uint32_t>& lists) {
    for (std::size_t i = 0; i < lists.size(); ++i)
        out.push_back(lists[i].empty() ? -1 : static_cast<std::int32_t>(lists[i][0]));
}

void append_counts(std::vector<std::int32_t>& out, const IndexLists<std::uint32_t>& lists) {
    for (std::size_t i = 0; i < lists.size(); ++i)
        out.push_back(static_cast<std::int32_t>(lists[i].size()));
}

/// Appends count, 2 * count, ...
void append_offsets(std::vector<std::int64_t>& out, std::size_t cells, std::int64_t count) {
    for (std::size_t i = 0; i < cells; ++i) out.push_back((out.empty() ? 0 : out.back()) + count);
}

template <class Cell>
void append_corners(std::vector<std::int64_t>& out, const std::vector<Cell>& cells) {
    for (const auto& cell : cells) out.insert(out.end(), cell.begin(), cell.end());
}

std::optional<Error> check_lengths(std::span<const CellArray> cells, std::size_t count) {
    for (const auto& cell : cells) {
        const auto size = std::visit([](const auto& values) { return values.size(); }, cell.values);
        if (size != count)
            return Error{
                ErrorCode::bad_option,
                fmt::format("cell array {} has {} values for {} cells", cell.name, size, count),
                ""};
    }
    return std::nullopt;
}

template <class Fill>
std::vector<std::int32_t> filled(Fill fill) {
    std::vector<std::int32_t> values;
    fill(values);
    return values;
}

void write_triangle_data(VtkWriter& out, const Mesh& mesh) {
    out.array("surface", filled([&](auto& v) { append_first(v, mesh.surfaces_of); }));
    out.array("surface_count", filled([&](auto& v) { append_counts(v, mesh.surfaces_of); }));
    if (mesh.regions_of.size() != 0)
        out.array("region", filled([&](auto& v) { append_first(v, mesh.regions_of); }));
    if (mesh.parents_of.size() != 0)
        out.array("parent", filled([&](auto& v) { append_first(v, mesh.parents_of); }));
}

void write_tetrahedron_data(VtkWriter& out, const TetrahedralMesh& mesh) {
    const auto count = mesh.tetrahedra.size();
    const auto faces = mesh.faces.size();
    auto region = VtkWriter::as<std::int32_t>(mesh.region_of);
    region.resize(count + faces, -1);
    out.array("region", region);
    std::vector<std::int32_t> surface(count, -1), surface_count(count, 0), parent(count, -1);
    append_first(surface, mesh.surfaces_of);
    append_counts(surface_count, mesh.surfaces_of);
    for (const auto triangle : mesh.face_triangle)
        parent.push_back(static_cast<std::int32_t>(triangle)); // UINT32_MAX becomes -1
    out.array("surface", surface);
    out.array("surface_count", surface_count);
    out.array("parent", parent);
    if (mesh.twins.empty()) return;
    std::vector<std::int32_t> twin(count + faces, -1);
    for (const auto& [front, back] : mesh.twins) {
        twin[count + front] = static_cast<std::int32_t>(count + back);
        twin[count + back] = static_cast<std::int32_t>(count + front);
    }
    out.array("twin", twin);
    out.array("cut_side", filled([&](auto& v) {
                  v.resize(count);
                  for (const auto side : detail::cut_sides(mesh))
                      v.push_back(static_cast<std::int32_t>(side));
              }));
}

} // namespace

Result<std::string> to_vtp(const Mesh& mesh, bool compress, std::span<const CellArray> cells,
                           std::span<const std::string> block_names) {
    if (auto trouble = check_lengths(cells, mesh.triangles.size())) return *trouble;
    VtkWriter out(compress);
    out.begin_file("PolyData");
    out.field(mesh.surfaces, mesh.surfaces_of, "block_name", block_names);
    out.text(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                         "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">",
                         mesh.vertices.size(), mesh.triangles.size()));
    out.text("<CellData Scalars=\"surface\">");
    write_triangle_data(out, mesh);
    out.further(cells);
    out.text("</CellData>");
    out.points(mesh.vertices);
    std::vector<std::int64_t> corners, offsets;
    append_corners(corners, mesh.triangles);
    append_offsets(offsets, mesh.triangles.size(), 3);
    out.text("<Polys>");
    out.array("connectivity", corners);
    out.array("offsets", offsets);
    out.text("</Polys>");
    return out.end_file("PolyData");
}

Result<std::string> to_vtu(const TetrahedralMesh& mesh, bool compress,
                           std::span<const CellArray> cells,
                           std::span<const std::string> region_names) {
    const auto count = mesh.tetrahedra.size() + mesh.faces.size();
    if (auto trouble = check_lengths(cells, count)) return *trouble;
    VtkWriter out(compress);
    out.begin_file("UnstructuredGrid");
    out.field(mesh.surfaces, mesh.surfaces_of, "region_name", region_names);
    out.text(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", mesh.vertices.size(),
                         count));
    out.text("<CellData Scalars=\"region\">");
    write_tetrahedron_data(out, mesh);
    out.further(cells);
    out.text("</CellData>");
    out.points(mesh.vertices);
    constexpr std::uint8_t vtk_triangle = 5, vtk_tetrahedron = 10;
    std::vector<std::int64_t> corners, offsets;
    append_corners(corners, mesh.tetrahedra);
    append_corners(corners, mesh.faces);
    append_offsets(offsets, mesh.tetrahedra.size(), 4);
    append_offsets(offsets, mesh.faces.size(), 3);
    std::vector<std::uint8_t> types(mesh.tetrahedra.size(), vtk_tetrahedron);
    types.resize(count, vtk_triangle);
    out.text("<Cells>");
    out.array("connectivity", corners);
    out.array("offsets", offsets);
    out.array("types", types);
    out.text("</Cells>");
    return out.end_file("UnstructuredGrid");
}

} // namespace terrane
