// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/legacy_vtk.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <terrane/io/meshes/detail/parts.hpp>
#include <terrane/io/meshes/detail/vtk_data.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

/// A type of number in legacy files: its name there and in XML files, and its size in bytes.
struct LegacyType {
    std::string_view name, xml_name;
    std::size_t size;
};

constexpr std::array<LegacyType, 13> legacy_types{{
    {"float", "Float32", 4},
    {"double", "Float64", 8},
    {"char", "Int8", 1},
    {"unsigned_char", "UInt8", 1},
    {"short", "Int16", 2},
    {"unsigned_short", "UInt16", 2},
    {"int", "Int32", 4},
    {"unsigned_int", "UInt32", 4},
    {"long", "Int64", 8},
    {"unsigned_long", "UInt64", 8},
    {"vtkIdType", "Int32", 4},
    {"vtktypeint64", "Int64", 8},
    {"vtktypeint32", "Int32", 4},
}};

class LegacyVtkReader {
public:
    LegacyVtkReader(std::string_view contents, std::string_view source, std::string_view name) :
        contents_(contents), source_(source), name_(name) {}

    Result<std::vector<Surface>> read() {
        if (auto trouble = read_header()) return *trouble;
        for (auto keyword = token(); !keyword.empty(); keyword = token()) {
            const std::string section = lower(keyword);
            if (section == "cell_data" || section == "point_data")
                break; // the geometry is complete
            if (auto trouble = read_section(section)) return *trouble;
        }
        if (auto trouble = make_triangles()) return *trouble;
        std::vector<FilePart> parts;
        if (fields_.contains("surface_name")) {
            if (auto trouble = divide(parts)) return *trouble;
        } else {
            parts.push_back({std::string(name_), Role::unknown, std::move(triangles_)});
        }
        auto surfaces = surfaces_of_parts(vertices_, std::move(parts));
        if (surfaces.empty())
            return Error{ErrorCode::nothing_to_do, "there is no triangle", std::string(source_)};
        return surfaces;
    }

private:
    /// Cells of one section: where each ends in the list of corners.
    struct Cells {
        std::size_t at = 0; ///< of the section, for messages
        std::vector<std::int64_t> corners, ends;
    };

    [[nodiscard]] Error error(ErrorCode code, std::string what) const {
        return error_at(token_at_, code, std::move(what));
    }
    [[nodiscard]] Error error_at(std::size_t at, ErrorCode code, std::string what) const {
        if (binary_) return {code, std::move(what), fmt::format("{}, byte {}", source_, at)};
        const auto end = contents_.begin() + static_cast<std::ptrdiff_t>(at);
        return {code, std::move(what),
                fmt::format("{}:{}", source_, 1 + std::count(contents_.begin(), end, '\n'))};
    }

    static bool is_space(char c) { return is_blank(c) || c == '\n'; }

    /// Takes the next word; empty at the end.
    std::string_view token() {
        while (at_ < contents_.size() && is_space(contents_[at_])) ++at_;
        token_at_ = at_;
        while (at_ < contents_.size() && !is_space(contents_[at_])) ++at_;
        return contents_.substr(token_at_, at_ - token_at_);
    }

    /// Takes the rest of the line.
    std::string_view line() {
        token_at_ = at_;
        const auto end = std::min(contents_.find('\n', at_), contents_.size());
        const auto text = contents_.substr(at_, end - at_);
        at_ = std::min(end + 1, contents_.size());
        return trimmed(text);
    }

    MaybeError read_header() {
        if (!lower(line()).starts_with("# vtk datafile version"))
            return error(ErrorCode::bad_syntax, "the first line is not \"# vtk DataFile Version\"");
        line(); // the title
        const auto encoding = lower(token());
        if (encoding != "ascii" && encoding != "binary")
            return error(ErrorCode::bad_syntax, "the third line is neither ASCII nor BINARY");
        const auto keyword = lower(token());
        if (keyword != "dataset") return error(ErrorCode::bad_syntax, "DATASET is needed here");
        const auto kind = token();
        if (lower(kind) != "polydata")
            return error(ErrorCode::unsupported,
                         fmt::format("the file has {}; only POLYDATA is read", shown(kind)));
        binary_ = encoding == "binary";
        return std::nullopt;
    }

    MaybeError read_section(const std::string& section) {
        if (section == "points") return read_points();
        if (section == "polygons") return read_cells(polygons_.emplace_back());
        if (section == "triangle_strips") return read_cells(strips_.emplace_back());
        if (section == "vertices" || section == "lines") {
            Cells unused;
            return read_cells(unused);
        }
        if (section == "metadata") {
            line();
            while (at_ < contents_.size() && !line().empty()) {
            }
            return std::nullopt;
        }
        if (section == "field") return read_field();
        return error(ErrorCode::bad_syntax,
                     fmt::format("{} is no section of POLYDATA", shown(section)));
    }

    /// Reads a count. No count is larger than the file has bytes.
    MaybeError read_count(std::size_t& count) {
        std::int64_t number = 0;
        const auto word = token();
        if (!parse_integer(word, number) || number < 0)
            return error(ErrorCode::bad_syntax,
                         (word.empty() ? std::string("the end of the file") : shown(word)) +
                             " is no count");
        if (static_cast<std::uint64_t>(number) > contents_.size())
            return error(ErrorCode::bad_syntax,
                         fmt::format("{} elements are more than the file has bytes", number));
        count = static_cast<std::size_t>(number);
        return std::nullopt;
    }

    MaybeError read_type(LegacyType& type) {
        const auto word = lower(token());
        for (const LegacyType& known : legacy_types)
            if (word == lower(known.name)) {
                type = known;
                return std::nullopt;
            }
        return error(ErrorCode::unsupported, shown(word) + " is no type of number that is read");
    }

    MaybeError append_number(std::vector<double>& values) {
        const auto word = token();
        if (parse_double(word, values.emplace_back()) != NumberState::not_a_number)
            return std::nullopt;
        return no_number(word);
    }
    MaybeError append_number(std::vector<std::int64_t>& values) {
        const auto word = token();
        if (parse_integer(word, values.emplace_back())) return std::nullopt;
        return no_number(word);
    }
    [[nodiscard]] Error no_number(std::string_view word) const {
        if (word.empty()) return error(ErrorCode::bad_syntax, "the file ends within its numbers");
        return error(ErrorCode::bad_number, shown(word) + " is not such a number");
    }

    template <class Number>
    MaybeError read_numbers(std::size_t count, const LegacyType& type,
                            std::vector<Number>& values) {
        values.clear();
        if (!binary_) {
            for (std::size_t i = 0; i < count; ++i)
                if (auto trouble = append_number(values)) return trouble;
            return std::nullopt;
        }
        line(); // binary data begin after the end of the line
        token_at_ = at_;
        if (count > (contents_.size() - at_) / type.size)
            return error(
                ErrorCode::bad_syntax,
                fmt::format("{} numbers of {} bytes are more than the file has", count, type.size));
        const auto bytes = contents_.substr(at_, count * type.size);
        at_ += bytes.size();
        if (auto flaw = convert_vtk(bytes, type.xml_name, std::endian::big, values))
            return error(ErrorCode::bad_syntax, *flaw);
        return std::nullopt;
    }

    MaybeError read_points() {
        std::size_t count = 0;
        LegacyType type{};
        if (auto trouble = read_count(count)) return trouble;
        if (auto trouble = read_type(type)) return trouble;
        if (!vertices_.empty()) return error(ErrorCode::bad_syntax, "there are POINTS twice");
        if (count >= UINT32_MAX)
            return error(ErrorCode::unsupported, "there are more than 4294967294 points");
        std::vector<double> values;
        if (auto trouble = read_numbers(3 * count, type, values)) return trouble;
        for (std::size_t i = 0; i < count; ++i) {
            const Point3 p{values[3 * i], values[3 * i + 1], values[3 * i + 2]};
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                return error(
                    ErrorCode::bad_number,
                    fmt::format("point {} has a coordinate that is not a finite number", i));
            vertices_.push_back(p);
        }
        return std::nullopt;
    }

    /// Reads cells: "3 0 1 2" one after the other, or, from version 5 on, OFFSETS and CONNECTIVITY.
    MaybeError read_cells(Cells& cells) {
        cells.at = token_at_;
        std::size_t first = 0, second = 0;
        if (auto trouble = read_count(first)) return trouble;
        if (auto trouble = read_count(second)) return trouble;
        const auto before = at_;
        if (lower(token()) == "offsets") return read_offsets(first, second, cells);
        at_ = before;
        std::vector<std::int64_t> numbers;
        if (auto trouble = read_numbers(second, legacy_types[6], numbers)) return trouble;
        std::size_t at = 0;
        for (std::size_t c = 0; c < first; ++c) {
            if (at >= numbers.size() || numbers[at] < 0 ||
                static_cast<std::size_t>(numbers[at]) >= numbers.size() - at)
                return error_at(cells.at, ErrorCode::bad_index,
                                fmt::format("cell {} is not within the {} numbers", c, second));
            const auto start = numbers.begin() + static_cast<std::ptrdiff_t>(at) + 1;
            cells.corners.insert(cells.corners.end(), start, start + numbers[at]);
            cells.ends.push_back(static_cast<std::int64_t>(cells.corners.size()));
            at += 1 + static_cast<std::size_t>(numbers[at]);
        }
        return std::nullopt;
    }

    MaybeError read_offsets(std::size_t offsets, std::size_t corners, Cells& cells) {
        LegacyType type{};
        if (auto trouble = read_type(type)) return trouble;
        if (auto trouble = read_numbers(offsets, type, cells.ends)) return trouble;
        if (lower(token()) != "connectivity")
            return error(ErrorCode::bad_syntax, "CONNECTIVITY is needed here");
        if (auto trouble = read_type(type)) return trouble;
        if (auto trouble = read_numbers(corners, type, cells.corners)) return trouble;
        std::int64_t last = 0;
        for (const std::int64_t end : cells.ends) {
            if (end < last || end > static_cast<std::int64_t>(cells.corners.size()))
                return error_at(cells.at, ErrorCode::bad_index,
                                fmt::format("the offset {} is not in the data of the cells", end));
            last = end;
        }
        if (!cells.ends.empty() && cells.ends.front() == 0) cells.ends.erase(cells.ends.begin());
        return std::nullopt;
    }

    /// Reads arrays that belong to the whole file, and keeps those that to_vtk() writes.
    MaybeError read_field() {
        token(); // its name
        std::size_t arrays = 0;
        if (auto trouble = read_count(arrays)) return trouble;
        for (std::size_t a = 0; a < arrays; ++a) {
            const std::string name(token());
            if (name.empty()) return no_number({});
            std::size_t components = 0, tuples = 0;
            LegacyType type{};
            if (auto trouble = read_count(components)) return trouble;
            if (auto trouble = read_count(tuples)) return trouble;
            if (auto trouble = read_type(type)) return trouble;
            if (components != 0 && tuples > contents_.size() / components)
                return error(ErrorCode::bad_syntax, "the array is longer than the file");
            std::vector<double> values;
            if (auto trouble = read_numbers(components * tuples, type, values)) return trouble;
            if (name.starts_with("surface")) fields_[name] = std::move(values);
        }
        return std::nullopt;
    }

    MaybeError make_triangles() {
        for (const Cells& cells : polygons_)
            if (auto trouble = add(cells, append_fan)) return trouble;
        for (const Cells& cells : strips_)
            if (auto trouble = add(cells, append_strip)) return trouble;
        return std::nullopt;
    }

    /// Returns the texts in an array of character codes, each ended by a 0.
    [[nodiscard]] std::vector<std::string> texts(const std::string& array) const {
        std::vector<std::string> texts;
        std::string text;
        const auto codes = fields_.find(array);
        if (codes == fields_.end()) return texts;
        for (const double code : codes->second) {
            if (code > 0 && code < 256)
                text += static_cast<char>(static_cast<unsigned char>(code));
            else
                texts.push_back(std::exchange(text, {}));
        }
        return texts;
    }

    /// Gives the triangles to the surfaces that the field arrays name.
    MaybeError divide(std::vector<FilePart>& parts) {
        const auto names = texts("surface_name"), roles = texts("surface_role");
        for (std::size_t s = 0; s < names.size(); ++s) {
            FilePart& part = parts.emplace_back();
            part.name = names[s].empty() ? std::string(name_) : names[s];
            for (std::size_t r = 0; r < role_names.size(); ++r)
                if (s < roles.size() && roles[s] == role_names[r]) part.role = Role(r);
        }
        const auto& offsets = fields_["surfaces_offset"];
        const auto& lists = fields_["surfaces"];
        bool sound = offsets.size() == triangles_.size() + 1 && offsets.front() == 0 &&
                     offsets.back() == static_cast<double>(lists.size()) &&
                     std::is_sorted(offsets.begin(), offsets.end());
        for (const double offset : offsets)
            sound = sound && offset >= 0 && offset <= static_cast<double>(lists.size());
        for (const double s : lists)
            sound = sound && s >= 0 && s < static_cast<double>(parts.size());
        if (!sound)
            return Error{ErrorCode::bad_index, "the lists of surfaces do not fit the triangles",
                         std::string(source_)};
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (auto i = static_cast<std::size_t>(offsets[t]);
                 i < static_cast<std::size_t>(offsets[t + 1]); ++i)
                parts[static_cast<std::size_t>(lists[i])].triangles.push_back(triangles_[t]);
        return std::nullopt;
    }

    template <class Append>
    MaybeError add(const Cells& cells, const Append& append) {
        std::vector<std::uint32_t> corners;
        std::int64_t start = 0;
        for (std::size_t c = 0; c < cells.ends.size(); ++c) {
            corners.clear();
            for (; start < cells.ends[c]; ++start) {
                const std::int64_t v = cells.corners[static_cast<std::size_t>(start)];
                if (v < 0 || v >= static_cast<std::int64_t>(vertices_.size()))
                    return error_at(cells.at, ErrorCode::bad_index,
                                    fmt::format("cell {} names point {}, but there are {}", c, v,
                                                vertices_.size()));
                corners.push_back(static_cast<std::uint32_t>(v));
            }
            append(corners, triangles_);
        }
        return std::nullopt;
    }

    std::string_view contents_, source_, name_;
    bool binary_ = false;
    std::size_t at_ = 0, token_at_ = 0;
    std::vector<Point3> vertices_;
    std::vector<Cells> polygons_, strips_;
    std::vector<Triangle> triangles_;
    std::map<std::string, std::vector<double>> fields_; ///< arrays that to_vtk() writes
};

} // namespace

Result<std::vector<Surface>> read_vtk(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return LegacyVtkReader(contents, source, name).read();
}

} // namespace terrane
