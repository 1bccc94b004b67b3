// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/detail/vtk_xml_file.hpp>

#include <algorithm>
#include <bit>
#include <new>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace terrane::detail {
namespace {

std::string without_blanks(std::string_view text) {
    std::string kept;
    for (const char c : text)
        if (!is_blank(c) && c != '\n') kept += c;
    return kept;
}

} // namespace

MaybeError VtkXmlFile::open(pugi::xml_node& data) {
    if (auto trouble = parse()) return trouble;
    if (auto trouble = read_header()) return trouble;
    data = root_.child(std::string(type_).c_str());
    if (data) return std::nullopt;
    return error(root_, ErrorCode::bad_syntax, fmt::format("there is no element {}", type_));
}

std::string VtkXmlFile::place(std::ptrdiff_t offset) const {
    const auto end =
        std::min(contents_.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    const auto line = 1 + std::count(contents_.begin(),
                                     contents_.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    return fmt::format("{}:{}", source_, line);
}
Error VtkXmlFile::error(const pugi::xml_node& at, ErrorCode code, std::string what) const {
    return {code, std::move(what), place(at.offset_debug())};
}

/// Parses the file but its appended data, which need not be XML.
MaybeError VtkXmlFile::parse() {
    const auto appended = contents_.find("<AppendedData");
    std::string text(contents_.substr(0, appended));
    if (appended != std::string_view::npos) {
        const auto tag_end = contents_.find('>', appended);
        const auto start = contents_.find('_', tag_end);
        if (start == std::string_view::npos)
            return Error{ErrorCode::bad_syntax, "the appended data have no beginning",
                         place(static_cast<std::ptrdiff_t>(appended))};
        const auto tag = contents_.substr(appended, tag_end - appended);
        appended_is_base64_ = tag.find("base64") != std::string_view::npos;
        appended_ = contents_.substr(start + 1);
        if (appended_is_base64_)
            appended_text_ = without_blanks(appended_.substr(0, appended_.find('<')));
        text += "</VTKFile>";
    }
    const auto parsed = document_.load_buffer(text.data(), text.size());
    if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (!parsed)
        return Error{ErrorCode::bad_syntax,
                     std::string("this is not well-formed XML: ") + parsed.description(),
                     place(parsed.offset)};
    root_ = document_.child("VTKFile");
    if (!root_) return Error{ErrorCode::bad_syntax, "there is no element VTKFile", place(0)};
    return std::nullopt;
}

MaybeError VtkXmlFile::read_header() {
    const std::string_view type = root_.attribute("type").value();
    if (type != type_)
        return error(root_, ErrorCode::unsupported,
                     fmt::format("the file has {}; only {} is read", shown(type), type_));
    const std::string_view name = root_.attribute("compressor").value();
    const auto compressor = vtk_compressor(name);
    if (!compressor)
        return error(root_, ErrorCode::unsupported,
                     fmt::format("{} is not read by this build", shown(name)));
    encoding_.compressor = *compressor;
    const std::string_view order = root_.attribute("byte_order").value();
    encoding_.order = order == "BigEndian" ? std::endian::big : std::endian::little;
    const std::string_view header = root_.attribute("header_type").value();
    encoding_.wide_headers = header == "UInt64";
    return std::nullopt;
}

/// Decodes the bytes of an array that is not text.
MaybeError VtkXmlFile::bytes_of(const pugi::xml_node& array, std::string& bytes) {
    const std::string_view format = array.attribute("format").value();
    std::optional<std::string> flaw;
    if (format == "appended") {
        const auto offset = array.attribute("offset").as_ullong(UINT64_MAX);
        const std::string_view text =
            appended_is_base64_ ? std::string_view(appended_text_) : appended_;
        flaw = offset > text.size()
                   ? "the array begins beyond the appended data"
                   : decode_vtk(text, appended_is_base64_, offset, encoding_, bytes, used_);
    } else {
        const auto text = without_blanks(array.child_value());
        flaw = decode_vtk(text, true, 0, encoding_, bytes, used_);
    }
    // Arrays that share their data would make the work grow faster than the file.
    if (!flaw && used_ > 2 * contents_.size() + 64) flaw = "the data of the arrays overlap";
    if (flaw) return error(array, ErrorCode::bad_syntax, *flaw);
    return std::nullopt;
}

MaybeError VtkXmlFile::append_value(const pugi::xml_node& array, std::string_view token,
                                    Integers& values) const {
    if (parse_integer(token, values.emplace_back())) return std::nullopt;
    return error(array, ErrorCode::bad_number, shown(token) + " is not an integer");
}
MaybeError VtkXmlFile::append_value(const pugi::xml_node& array, std::string_view token,
                                    std::vector<double>& values) const {
    const auto state = parse_double(token, values.emplace_back());
    if (state != NumberState::not_a_number) return std::nullopt; // the user of the array judges
    return error(array, ErrorCode::bad_number, shown(token) + " is not a number");
}

template <class Number>
MaybeError VtkXmlFile::numbers_of(const pugi::xml_node& array, std::vector<Number>& values) {
    values.clear();
    if (std::string_view(array.attribute("format").value()) == "ascii") {
        std::string text = array.child_value();
        std::replace(text.begin(), text.end(), '\n', ' ');
        used_ += text.size();
        Tokens tokens(text);
        for (auto token = tokens.next(); !token.empty(); token = tokens.next())
            if (auto trouble = append_value(array, token, values)) return trouble;
        return std::nullopt;
    }
    std::string bytes;
    if (auto trouble = bytes_of(array, bytes)) return trouble;
    const std::string_view type = array.attribute("type").value();
    if (auto flaw = convert_vtk(bytes, type, encoding_.order, values))
        return error(array, ErrorCode::bad_syntax, *flaw);
    return std::nullopt;
}

MaybeError VtkXmlFile::values_of(const pugi::xml_node& array, Integers& values) {
    return numbers_of(array, values);
}

MaybeError VtkXmlFile::values_of(const pugi::xml_node& array, std::vector<double>& values) {
    return numbers_of(array, values);
}

MaybeError VtkXmlFile::strings_of(const pugi::xml_node& array, std::vector<std::string>& strings) {
    Integers codes;
    if (std::string_view(array.attribute("format").value()) == "ascii") {
        if (auto trouble = values_of(array, codes)) return trouble;
    } else {
        std::string bytes;
        if (auto trouble = bytes_of(array, bytes)) return trouble;
        codes.assign(bytes.begin(), bytes.end());
    }
    std::string text;
    for (const std::int64_t code : codes) {
        if (code != 0)
            text += static_cast<char>(code & 255);
        else
            strings.push_back(std::exchange(text, {}));
    }
    return std::nullopt;
}

pugi::xml_node VtkXmlFile::array_named(const pugi::xml_node& parent, std::string_view name) {
    for (const pugi::xml_node array : parent.children())
        if (name == array.attribute("Name").value()) return array;
    return {};
}

} // namespace terrane::detail
