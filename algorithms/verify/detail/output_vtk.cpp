// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The writers of output.hpp for VTK's XML files. Versions of zlib compress the same bytes otherwise,
// so compressed arrays are decompressed and compared then; all around them is compared as it stands.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include <zlib.h>

#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>
#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

namespace {

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::size_t base64_size(std::size_t bytes) {
    return (bytes + 2) / 3 * 4;
}

std::string in_base64(std::string_view bytes) {
    std::string text;
    text.reserve(base64_size(bytes.size()));
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        look_for_stop();
        unsigned group = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            group = group << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
        for (const unsigned shift : {18U, 12U, 6U, 0U}) text += digits[group >> shift & 63U];
    }
    std::fill_n(text.rbegin(), (3 - bytes.size() % 3) % 3, '=');
    return text;
}

/// Returns the first `size` bytes that a text stands for, if it is base64.
std::string from_base64(std::string_view text, std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i + 4 <= text.size(); i += 4) {
        look_for_stop();
        unsigned group = 0;
        for (const char c : text.substr(i, 4))
            group = group << 6U | (static_cast<unsigned>(digits.find(c)) & 63U);
        for (const unsigned shift : {16U, 8U, 0U}) bytes += static_cast<char>(group >> shift);
    }
    bytes.resize(size);
    return bytes;
}

std::string_view bytes_of(const auto& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()),
            numbers.size() * sizeof(*numbers.data())};
}

template <class T>
constexpr std::string_view type_name() {
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
    return sizeof(T) == 4 ? "Int32" : "Int64";
}

using Cells = std::vector<std::int32_t>;

/// Returns the first number of each list; -1 for none.
Cells first_of(const IndexLists<std::uint32_t>& lists) {
    Cells values;
    for (std::size_t i = 0; i < lists.size(); ++i)
        values.push_back(lists[i].empty() ? -1 : static_cast<std::int32_t>(lists[i].front()));
    return values;
}

Cells counts_of(const IndexLists<std::uint32_t>& lists) {
    Cells values;
    for (std::size_t i = 0; i < lists.size(); ++i)
        values.push_back(static_cast<std::int32_t>(lists[i].size()));
    return values;
}

class VtkWriter {
public:
    VtkWriter(Comparison& out, std::string_view type) : out_(out), type_(type) {
        out_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
             << "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"";
        compressed_ = out_.rest().starts_with(' ');
        out_ << (compressed_ ? " compressor=\"vtkZLibDataCompressor\">\n<" : ">\n<") << type
             << ">\n";
    }

    /// Writes the names and roles of surfaces, the surfaces of cells if some have several, and the
    /// names of blocks if there are any.
    void field_data(std::span<const SurfaceInfo> surfaces,
                    const IndexLists<std::uint32_t>& surfaces_of,
                    std::span<const std::string> block_names) {
        out_ << "<FieldData>\n";
        std::vector<std::string_view> names, roles;
        for (const SurfaceInfo& surface : surfaces) {
            names.push_back(surface.name);
            roles.push_back(name_of(surface.role));
        }
        strings("surface_name", names);
        strings("surface_role", roles);
        if (surfaces_of.values.size() > surfaces_of.size()) {
            field("surfaces_offset", surfaces_of.offsets);
            field("surfaces", surfaces_of.values);
        }
        if (!block_names.empty()) strings("block_name", {block_names.begin(), block_names.end()});
        out_ << "</FieldData>\n";
    }

    template <class T>
    void array(std::string_view name, const std::vector<T>& values, unsigned components = 1,
               const std::string& tuples = "") {
        out_ << "<DataArray type=\"" << type_name<T>() << "\" Name=\"" << name
             << "\" NumberOfComponents=\"" << components << "\" " << tuples
             << "format=\"binary\">\n";
        const std::string_view bytes = bytes_of(values);
        if (compressed_) {
            inflated(name, bytes);
        } else {
            const std::array<std::uint64_t, 1> size{bytes.size()};
            out_ << in_base64(std::string(bytes_of(size)).append(bytes));
        }
        out_ << "\n</DataArray>\n";
    }

    void points(const std::vector<Point3>& vertices) {
        std::vector<double> values;
        for (const Point3& p : vertices) values.insert(values.end(), {p.x, p.y, p.z});
        out_ << "<Points>\n";
        array("Points", values, 3);
        out_ << "</Points>\n";
    }

    /// Adds cells of as many corners each.
    void add_cells(const auto& cells, std::uint8_t type) {
        for (const auto& cell : cells) {
            look_for_stop();
            corners_.insert(corners_.end(), cell.begin(), cell.end());
            ends_.push_back(static_cast<std::int64_t>(corners_.size()));
            types_.push_back(type);
        }
    }

    /// Writes the cells that were added, and the end of the file.
    void end(std::string_view element) {
        out_ << "<" << element << ">\n";
        array("connectivity", corners_);
        array("offsets", ends_);
        if (type_ != "PolyData") array("types", types_);
        out_ << "</" << element << ">\n</Piece>\n</" << type_ << ">\n</VTKFile>\n";
    }

private:
    void field(std::string_view name, const auto& numbers) {
        const std::vector<std::int64_t> values(numbers.begin(), numbers.end());
        array(name, values, 1, "NumberOfTuples=\"" + std::to_string(values.size()) + "\" ");
    }

    /// Writes the codes of the characters of each string, ended by a 0; a string has none. PolyData
    /// has arrays of strings, a grid has arrays of their codes.
    void strings(std::string_view name, const std::vector<std::string_view>& values) {
        std::string lines;
        std::size_t codes = 0;
        for (const std::string_view value : values) {
            for (const char c : value)
                if (c != '\0') {
                    lines += std::to_string(static_cast<unsigned char>(c)) + " ";
                    ++codes;
                }
            lines += "0\n";
            ++codes;
        }
        const bool has_strings = type_ == "PolyData";
        const std::string_view element = has_strings ? "Array" : "DataArray";
        out_ << "<" << element << " type=\"" << (has_strings ? "String" : "UInt8") << "\" Name=\""
             << name << "\" NumberOfTuples=\"" << (has_strings ? values.size() : codes)
             << "\" format=\"ascii\">\n"
             << lines << "</" << element << ">\n";
    }

    /// Compares compressed blocks with these bytes. A header states their number, their size, the
    /// size of the last block (0 if it is as large), and the compressed size of each.
    void inflated(std::string_view name, std::string_view bytes) {
        constexpr std::size_t block = std::size_t(1) << 20;
        const std::size_t blocks = (bytes.size() + block - 1) / block;
        std::vector<std::uint64_t> header(3 + blocks);
        const std::size_t header_size = 8 * header.size();
        const std::string stated =
            from_base64(out_.rest().substr(0, base64_size(header_size)), header_size);
        std::memcpy(header.data(), stated.data(), header_size);
        header[0] = blocks;
        header[1] = block;
        header[2] = bytes.size() % block;
        out_ << in_base64(bytes_of(header));
        std::size_t packed = 0;
        for (std::size_t i = 3; i < header.size(); ++i) {
            if (header[i] > out_.rest().size()) out_.fail("the file ends too early");
            packed += header[i];
        }
        const std::string data = from_base64(out_.rest().substr(0, base64_size(packed)), packed);
        std::size_t from = 0;
        for (std::size_t i = 0; i < blocks; ++i) {
            const auto right = bytes.substr(i * block, block);
            if (inflated(std::string_view(data).substr(from, header[3 + i]), right.size()) != right)
                out_.fail("the array " + std::string(name) + " has other numbers");
            from += header[3 + i];
        }
        out_ << in_base64(data); // of which nothing was compared yet
    }

    /// Returns what a compressed block holds; empty if it does not end with its `size` bytes.
    static std::string inflated(std::string_view packed, std::size_t size) {
        look_for_stop();
        std::string bytes(size, '\0');
        uLongf full = size;
        uLong used = packed.size();
        const int code = uncompress2(reinterpret_cast<Bytef*>(bytes.data()), &full,
                                     reinterpret_cast<const Bytef*>(packed.data()), &used);
        if (code == Z_MEM_ERROR) throw std::bad_alloc(); // nothing is wrong with the file
        return code == Z_OK && full == size && used == packed.size() ? bytes : "";
    }

    Comparison& out_;
    std::string_view type_;
    bool compressed_ = false;
    std::vector<std::int64_t> corners_, ends_;
    std::vector<std::uint8_t> types_;
};

// --- VTP ----------------------------------------------------------------------------------------

/// Writes the holes of the triangles, and the means of the expected errors of their corners.
void write_expected_errors(VtkWriter& out, const FilledClaim& filled) {
    std::vector<double> means;
    for (const auto& [a, b, c] : filled.triangles)
        means.push_back((filled.deviation[a] + filled.deviation[b] + filled.deviation[c]) / 3);
    out.array("interpolated", Cells(filled.interpolated.begin(), filled.interpolated.end()));
    out.array("deviation", means);
}

} // namespace

void write_vtp(Comparison& out, const ExpectedMesh& expected) {
    const WrittenMesh& mesh = expected.mesh;
    VtkWriter vtk(out, "PolyData");
    vtk.field_data(expected.surfaces, mesh.surfaces_of, expected.block_names);
    out << "<Piece NumberOfPoints=\"" << mesh.vertices.size()
        << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\""
        << mesh.triangles.size() << "\">\n<CellData Scalars=\"surface\">\n";
    vtk.array("surface", first_of(mesh.surfaces_of));
    vtk.array("surface_count", counts_of(mesh.surfaces_of));
    if (mesh.regions_of.size() != 0) vtk.array("region", first_of(mesh.regions_of));
    if (mesh.parents_of.size() != 0) vtk.array("parent", first_of(mesh.parents_of));
    for (const CellNumbers& cells : expected.cells) vtk.array(cells.name, cells.values);
    if (mesh.filled != nullptr) write_expected_errors(vtk, *mesh.filled);
    out << "</CellData>\n";
    vtk.points(mesh.vertices);
    vtk.add_cells(mesh.triangles, 0);
    vtk.end("Polys");
}

// --- VTU ----------------------------------------------------------------------------------------

namespace {

/// Returns `first` for each tetrahedron, then the values of the faces.
Cells behind(const TetrahedraClaim& claim, std::int32_t first, const Cells& of_faces) {
    Cells cells(claim.tetrahedra.size(), first);
    cells.insert(cells.end(), of_faces.begin(), of_faces.end());
    return cells;
}

/// Returns the cell of the other face of each pair of twins; -1 for all other cells.
Cells twin_cells(const TetrahedraClaim& claim) {
    const auto count = claim.tetrahedra.size();
    Cells twin(count + claim.faces.size(), -1);
    for (const auto& [front, back] : claim.twins) {
        twin[count + front] = static_cast<std::int32_t>(count + back);
        twin[count + back] = static_cast<std::int32_t>(count + front);
    }
    return twin;
}

void write_tetrahedron_data(VtkWriter& out, const ExpectedTetrahedra& expected) {
    const TetrahedraClaim& claim = expected.claim;
    Cells blocks(claim.block_of.begin(), claim.block_of.end());
    blocks.resize(claim.tetrahedra.size() + claim.faces.size(), -1);
    out.array("block", blocks);
    out.array("surface", behind(claim, -1, first_of(expected.surfaces_of)));
    out.array("surface_count", behind(claim, 0, counts_of(expected.surfaces_of)));
    const Cells parents(claim.triangle_of.begin(), claim.triangle_of.end()); // no_number becomes -1
    out.array("parent", behind(claim, -1, parents));
    if (claim.twins.empty()) return;
    out.array("twin", twin_cells(claim));
    out.array("cut_side", behind(claim, 0, cut_sides(claim)));
}

} // namespace

std::vector<std::int32_t> cut_sides(const TetrahedraClaim& claim) {
    std::vector<std::int32_t> sides(claim.faces.size());
    for (const auto& [front, back] : claim.twins) {
        sides[front] = 1;
        sides[back] = 2;
    }
    return sides;
}

void write_vtu(Comparison& out, const ExpectedTetrahedra& expected) {
    const TetrahedraClaim& claim = expected.claim;
    constexpr std::uint8_t triangle = 5, tetrahedron = 10;
    VtkWriter vtk(out, "UnstructuredGrid");
    vtk.field_data(expected.surfaces, expected.surfaces_of, expected.block_names);
    out << "<Piece NumberOfPoints=\"" << claim.vertices.size() << "\" NumberOfCells=\""
        << claim.tetrahedra.size() + claim.faces.size() << "\">\n<CellData Scalars=\"block\">\n";
    write_tetrahedron_data(vtk, expected);
    out << "</CellData>\n";
    vtk.points(claim.vertices);
    vtk.add_cells(claim.tetrahedra, tetrahedron);
    vtk.add_cells(claim.faces, triangle);
    vtk.end("Cells");
}

} // namespace terrane::verifier
