// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/vtk_scanner.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include <zlib.h>

#include <terrane/algorithms/verify/detail/output.hpp>
#include <terrane/algorithms/verify/stoppable.hpp>

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
        look_for_stop();
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

template <class T>
std::string type_name() {
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
    return sizeof(T) == 4 ? "Int32" : "Int64";
}

} // namespace

void VtkScanner::begin(const std::string& type) {
    has_strings_ = type == "PolyData";
    in_.expect("<?xml version=\"1.0\"?>");
    const std::string start = "<VTKFile type=\"" + type +
                              "\" version=\"1.0\" byte_order=\"LittleEndian\" "
                              "header_type=\"UInt64\"";
    const std::string_view line = in_.next();
    compressed_ = line == start + " compressor=\"vtkZLibDataCompressor\">";
    if (!compressed_ && line != start + ">") in_.fail("another header is needed");
    in_.expect("<" + type + ">");
}

void VtkScanner::end(const std::string& type) {
    in_.expect("</Piece>");
    in_.expect("</" + type + ">");
    in_.expect("</VTKFile>");
    in_.end();
}

void VtkScanner::field_data(std::span<const SurfaceInfo> surfaces,
                            const IndexLists<std::uint32_t>& surfaces_of) {
    in_.expect("<FieldData>");
    in_field_ = true;
    std::vector<std::string_view> names, roles;
    for (const SurfaceInfo& surface : surfaces) {
        names.push_back(surface.name);
        roles.push_back(name_of(surface.role));
    }
    strings("surface_name", names);
    strings("surface_role", roles);
    if (surfaces_of.values.size() > surfaces_of.size()) { // some cell belongs to several surfaces
        array<std::int64_t>("surfaces_offset",
                            {surfaces_of.offsets.begin(), surfaces_of.offsets.end()});
        array<std::int64_t>("surfaces", {surfaces_of.values.begin(), surfaces_of.values.end()});
    }
    in_field_ = false;
    end_field_data();
}

/// Passes the names of blocks, if there are any, which are not compared, and the end of the data.
void VtkScanner::end_field_data() {
    const std::string start = has_strings_ ? "<Array type=\"String\" Name=\"block_name\" "
                                           : "<DataArray type=\"UInt8\" Name=\"block_name\" ";
    std::string_view line = in_.next();
    if (line.starts_with(start)) {
        const std::string_view end = has_strings_ ? "</Array>" : "</DataArray>";
        for (line = in_.next(); line != end; line = in_.next())
            if (line.find_first_not_of("0123456789 ") != std::string_view::npos)
                in_.fail("codes of characters are needed");
        line = in_.next();
    }
    if (line != "</FieldData>") in_.fail("</FieldData> is needed");
}

void VtkScanner::points(const std::vector<Point3>& vertices) {
    std::vector<double> values;
    for (const Point3& p : vertices) values.insert(values.end(), {p.x, p.y, p.z});
    in_.expect("<Points>");
    array("Points", values, 3);
    in_.expect("</Points>");
}

/// Reads the codes of the characters of each string, ended by a 0; a string has none. PolyData has
/// arrays of strings, a grid has arrays of their codes.
void VtkScanner::strings(const std::string& name, const std::vector<std::string_view>& values) {
    std::vector<std::string> lines;
    std::size_t codes = 0;
    for (const std::string_view value : values) {
        std::string& line = lines.emplace_back();
        for (const char c : value)
            if (c != '\0') {
                line += std::to_string(static_cast<unsigned char>(c)) + " ";
                ++codes;
            }
        line += "0";
        ++codes;
    }
    const std::string element = has_strings_ ? "Array" : "DataArray";
    in_.expect("<" + element + " type=\"" + (has_strings_ ? "String" : "UInt8") + "\" Name=\"" +
               name + "\" NumberOfTuples=\"" +
               std::to_string(has_strings_ ? values.size() : codes) + "\" format=\"ascii\">");
    for (const std::string& line : lines) in_.expect(line);
    in_.expect("</" + element + ">");
}

template <class T>
void VtkScanner::array(const std::string& name, const std::vector<T>& expected, int components) {
    in_.expect("<DataArray type=\"" + type_name<T>() + "\" Name=\"" + name +
               "\" NumberOfComponents=\"" + std::to_string(components) + "\" " +
               (in_field_ ? "NumberOfTuples=\"" + std::to_string(expected.size()) + "\" " : "") +
               "format=\"binary\">");
    const std::size_t size = expected.size() * sizeof(T);
    const std::string_view text = in_.next();
    const std::string bytes = compressed_ ? inflated(text, size) : plain(text, size);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        look_for_stop();
        const auto right = std::bit_cast<std::array<char, sizeof(T)>>(expected[i]);
        if (!std::ranges::equal(right, std::string_view(bytes).substr(i * sizeof(T), sizeof(T))))
            in_.fail("array " + name + ", number " + std::to_string(i) +
                     ", is not that of the certificate");
    }
    in_.expect("</DataArray>");
}

template void VtkScanner::array(const std::string&, const std::vector<double>&, int);
template void VtkScanner::array(const std::string&, const std::vector<std::int32_t>&, int);
template void VtkScanner::array(const std::string&, const std::vector<std::int64_t>&, int);
template void VtkScanner::array(const std::string&, const std::vector<std::uint8_t>&, int);

std::string VtkScanner::plain(std::string_view text, std::size_t size) const {
    std::string bytes = decoded(text, in_);
    if (bytes.size() != 8 + size || number_at(bytes, 0) != size)
        in_.fail("the array has another length");
    return bytes.substr(8);
}

/// Returns the contents of compressed blocks. Before them are their number, their size, the size
/// of the last one (0 if it is no smaller), and their compressed sizes.
std::string VtkScanner::inflated(std::string_view text, std::size_t size) const {
    constexpr std::size_t block = std::size_t(1) << 20;
    const std::size_t blocks = (size + block - 1) / block;
    const std::size_t header_size = base64_size(8 * (3 + blocks));
    if (text.size() < header_size) in_.fail("the array has another length");
    const std::string header = decoded(text.substr(0, header_size), in_);
    if (header.size() != 8 * (3 + blocks) || number_at(header, 0) != blocks ||
        number_at(header, 1) != block || number_at(header, 2) != size % block)
        in_.fail("the array has another length");
    const std::string data = decoded(text.substr(header_size), in_);
    std::string bytes(size, '\0');
    std::size_t from = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
        look_for_stop();
        const std::uint64_t packed = number_at(header, 3 + i);
        if (packed > data.size() - from) in_.fail("the array has another length");
        uLongf full = std::min(block, size - i * block);
        const uLongf wanted = full;
        uLong used = packed;
        const int code = uncompress2(reinterpret_cast<Bytef*>(bytes.data() + i * block), &full,
                                     reinterpret_cast<const Bytef*>(data.data() + from), &used);
        if (code == Z_MEM_ERROR) throw std::bad_alloc(); // nothing is wrong with the file
        if (code != Z_OK || full != wanted || used != packed)
            in_.fail("a block can't be decompressed");
        from += packed;
    }
    if (from != data.size()) in_.fail("the array has another length");
    return bytes;
}

std::vector<std::int32_t> first_of(const IndexLists<std::uint32_t>& lists) {
    std::vector<std::int32_t> values;
    for (std::size_t i = 0; i < lists.size(); ++i)
        values.push_back(lists[i].empty() ? -1 : static_cast<std::int32_t>(lists[i].front()));
    return values;
}

std::vector<std::int32_t> counts_of(const IndexLists<std::uint32_t>& lists) {
    std::vector<std::int32_t> values;
    for (std::size_t i = 0; i < lists.size(); ++i)
        values.push_back(static_cast<std::int32_t>(lists[i].size()));
    return values;
}

} // namespace terrane::verifier
