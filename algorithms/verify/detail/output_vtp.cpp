// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The reader of output.hpp for VTP.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

#include <zlib.h>

#include <terrane/algorithms/verify/detail/line_scanner.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>

namespace terrane::verifier {

static_assert(std::endian::native == std::endian::little, "arrays are compared as they lie");

namespace {

/// Decodes base64 in whole groups of four characters; throws a Difference through `in`.
std::string decoded(std::string_view text, const LineScanner& in) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<int, 256> value{};
    value.fill(-1);
    for (std::size_t i = 0; i < digits.size(); ++i)
        value[static_cast<unsigned char>(digits[i])] = static_cast<int>(i);
    if (text.size() % 4 != 0) in.fail("this is no base64");
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); i += 4) {
        const bool last = i + 4 == text.size();
        const std::size_t padding = !last ? 0 : text[i + 2] == '=' ? 2 : text[i + 3] == '=' ? 1 : 0;
        unsigned group = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const int digit = k >= 4 - padding ? (text[i + k] == '=' ? 0 : -1)
                                               : value[static_cast<unsigned char>(text[i + k])];
            if (digit < 0) in.fail("this is no base64");
            group = group << 6U | static_cast<unsigned>(digit);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto byte = static_cast<unsigned char>(group >> (16 - 8 * k));
            if (k < 3 - padding)
                bytes += static_cast<char>(byte);
            else if (byte != 0)
                in.fail("this is no base64");
        }
    }
    return bytes;
}

std::uint64_t number_at(const std::string& bytes, std::size_t i) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + 8 * i, 8);
    return value;
}

std::size_t base64_size(std::size_t bytes) {
    return (bytes + 2) / 3 * 4;
}

class VtpReader {
public:
    VtpReader(std::string_view contents, const ExpectedMesh& expected) :
        in_(contents), expected_(expected) {}

    void read() {
        begin();
        field_data();
        in_.expect("<Piece NumberOfPoints=\"" + std::to_string(mesh().vertices.size()) +
                   "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                   "NumberOfPolys=\"" +
                   std::to_string(mesh().triangles.size()) + "\">");
        cell_data();
        points();
        polygons();
        for (const std::string_view line : {"</Piece>", "</PolyData>", "</VTKFile>"})
            in_.expect(line);
        in_.end();
    }

private:
    [[nodiscard]] const WrittenMesh& mesh() const { return expected_.mesh; }

    void begin() {
        in_.expect("<?xml version=\"1.0\"?>");
        const std::string start = "<VTKFile type=\"PolyData\" version=\"1.0\" "
                                  "byte_order=\"LittleEndian\" header_type=\"UInt64\"";
        const std::string_view line = in_.next();
        compressed_ = line == start + " compressor=\"vtkZLibDataCompressor\">";
        if (!compressed_ && line != start + ">") in_.fail("another header is needed");
        in_.expect("<PolyData>");
    }

    void field_data() {
        in_.expect("<FieldData>");
        in_field_ = true;
        std::vector<std::string_view> names, roles;
        for (const SurfaceInfo& surface : expected_.surfaces) {
            names.push_back(surface.name);
            roles.push_back(name_of(surface.role));
        }
        strings("surface_name", names);
        strings("surface_role", roles);
        const auto& lists = expected_.mesh.surfaces_of;
        if (lists.values.size() > lists.size()) { // some triangle belongs to several surfaces
            array<std::int64_t>("surfaces_offset", {lists.offsets.begin(), lists.offsets.end()});
            array<std::int64_t>("surfaces", {lists.values.begin(), lists.values.end()});
        }
        in_field_ = false;
        in_.expect("</FieldData>");
    }

    /// The codes of the characters of each string, ended by a 0; a string has none.
    void strings(const std::string& name, const std::vector<std::string_view>& values) {
        in_.expect("<Array type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"" +
                   std::to_string(values.size()) + "\" format=\"ascii\">");
        for (const std::string_view value : values) {
            std::string line;
            for (const char c : value)
                if (c != '\0') line += std::to_string(static_cast<unsigned char>(c)) + " ";
            in_.expect(line + "0");
        }
        in_.expect("</Array>");
    }

    void cell_data() {
        in_.expect("<CellData Scalars=\"surface\">");
        std::vector<std::int32_t> counts;
        for (std::size_t t = 0; t < expected_.mesh.surfaces_of.size(); ++t)
            counts.push_back(static_cast<std::int32_t>(expected_.mesh.surfaces_of[t].size()));
        array("surface", first_of(expected_.mesh.surfaces_of));
        array("surface_count", counts);
        if (mesh().regions_of.size() != 0) array("region", first_of(mesh().regions_of));
        if (mesh().parents_of.size() != 0) array("parent", first_of(mesh().parents_of));
        in_.expect("</CellData>");
    }

    void points() {
        std::vector<double> values;
        for (const Point3& p : mesh().vertices) values.insert(values.end(), {p.x, p.y, p.z});
        in_.expect("<Points>");
        array("Points", values, 3);
        in_.expect("</Points>");
    }

    void polygons() {
        std::vector<std::int64_t> corners, ends;
        for (const Triangle& t : mesh().triangles) {
            corners.insert(corners.end(), t.begin(), t.end());
            ends.push_back(static_cast<std::int64_t>(corners.size()));
        }
        in_.expect("<Polys>");
        array("connectivity", corners);
        array("offsets", ends);
        in_.expect("</Polys>");
    }

    static std::vector<std::int32_t> first_of(const IndexLists<std::uint32_t>& lists) {
        std::vector<std::int32_t> values;
        for (std::size_t i = 0; i < lists.size(); ++i)
            values.push_back(static_cast<std::int32_t>(lists[i].front()));
        return values;
    }

    template <class T>
    static std::string type_name() {
        if constexpr (std::is_same_v<T, double>) return "Float64";
        return sizeof(T) == 4 ? "Int32" : "Int64";
    }

    template <class T>
    void array(const std::string& name, const std::vector<T>& expected, int components = 1) {
        in_.expect(
            "<DataArray type=\"" + type_name<T>() + "\" Name=\"" + name +
            "\" NumberOfComponents=\"" + std::to_string(components) + "\" " +
            (in_field_ ? "NumberOfTuples=\"" + std::to_string(expected.size()) + "\" " : "") +
            "format=\"binary\">");
        const std::size_t size = expected.size() * sizeof(T);
        const std::string_view text = in_.next();
        const std::string bytes = compressed_ ? inflated(text, size) : plain(text, size);
        for (std::size_t i = 0; i < expected.size(); ++i)
            if (std::memcmp(bytes.data() + i * sizeof(T), &expected[i], sizeof(T)) != 0)
                in_.fail("array " + name + ", number " + std::to_string(i) +
                         ", is not that of the certificate");
        in_.expect("</DataArray>");
    }

    [[nodiscard]] std::string plain(std::string_view text, std::size_t size) const {
        std::string bytes = decoded(text, in_);
        if (bytes.size() != 8 + size || number_at(bytes, 0) != size)
            in_.fail("the array has another length");
        return bytes.substr(8);
    }

    /// Returns the contents of compressed blocks. Before them are their number, their size, the size
    /// of the last one (0 if it is no smaller), and their compressed sizes.
    [[nodiscard]] std::string inflated(std::string_view text, std::size_t size) const {
        constexpr std::size_t block = std::size_t(1) << 20;
        const std::size_t blocks = (size + block - 1) / block;
        const std::size_t header_size = base64_size(8 * (3 + blocks));
        if (text.size() < header_size) in_.fail("the array has another length");
        const std::string header = decoded(text.substr(0, header_size), in_);
        if (number_at(header, 0) != blocks || number_at(header, 1) != block ||
            number_at(header, 2) != size % block)
            in_.fail("the array has another length");
        const std::string data = decoded(text.substr(header_size), in_);
        std::string bytes(size, '\0');
        std::size_t from = 0;
        for (std::size_t i = 0; i < blocks; ++i) {
            const std::uint64_t packed = number_at(header, 3 + i);
            if (packed > data.size() - from) in_.fail("the array has another length");
            uLongf full = std::min(block, size - i * block);
            const uLongf wanted = full;
            uLong used = packed;
            if (uncompress2(reinterpret_cast<Bytef*>(bytes.data() + i * block), &full,
                            reinterpret_cast<const Bytef*>(data.data() + from), &used) != Z_OK ||
                full != wanted || used != packed)
                in_.fail("a block can't be decompressed");
            from += packed;
        }
        if (from != data.size()) in_.fail("the array has another length");
        return bytes;
    }

    LineScanner in_;
    const ExpectedMesh& expected_;
    bool compressed_ = false;
    bool in_field_ = false;
};

} // namespace

void compare_vtp(std::string_view contents, const ExpectedMesh& expected) {
    VtpReader(contents, expected).read();
}

} // namespace terrane::verifier
