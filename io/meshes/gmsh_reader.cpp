// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/gmsh_reader.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <terrane/io/meshes/detail/vtk_cells.hpp>
#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr std::int64_t msh_triangle = 2, msh_quadrilateral = 3; // types of elements
constexpr std::int64_t msh_tetrahedron = 4, msh_tetrahedron_10 = 11;
/// Triangles and quadrilaterals of higher order; their sides are curved.
constexpr std::array<std::int64_t, 13> curved_types{9,  10, 16, 20, 21, 22, 23,
                                                    24, 25, 36, 37, 38, 39};
/// The limit of physical groups of an entity keeps the triangles linear in the size of the file.
constexpr std::int64_t most_groups = 64;

class MshReader {
public:
    MshReader(std::string_view contents, std::string_view source, std::string_view name) :
        in_(contents, source), name_(name),
        has_element_data_(contents.find("$ElementData") != std::string_view::npos) {}

    Result<std::vector<Surface>> read() {
        if (auto trouble = read_sections()) return *trouble;
        auto surfaces = surfaces_of_parts(vertices_, parts(), values_, arrays_);
        if (surfaces.empty())
            return in_.file_error(ErrorCode::nothing_to_do, "there is no triangle");
        return surfaces;
    }

    Result<LabelledTetrahedra> read_tetrahedra() {
        for_tetrahedra_ = true;
        if (auto trouble = read_sections()) return *trouble;
        if (tetrahedra_.tetrahedra.empty())
            return in_.file_error(ErrorCode::nothing_to_do, "there is no tetrahedron");
        tetrahedra_.vertices = std::move(vertices_);
        return std::move(tetrahedra_);
    }

private:
    MaybeError read_sections() {
        if (!next()) return in_.file_error(ErrorCode::nothing_to_do, "the file is empty");
        if (word_ != "$MeshFormat")
            return in_.error(ErrorCode::bad_syntax, "the first line is not $MeshFormat");
        if (auto trouble = read_format()) return trouble;
        while (next())
            if (auto trouble = read_section(std::string(word_))) return trouble;
        return std::nullopt;
    }

    /// A physical surface, or an entity without one; physical surfaces come first.
    struct Key {
        bool is_entity = false;
        std::int64_t tag = 0;
        bool operator<(const Key& other) const {
            return is_entity != other.is_entity ? other.is_entity : tag < other.tag;
        }
    };

    /// Goes to the next line that is not blank and takes its first word.
    bool next() {
        while (in_.next()) {
            tokens_ = Tokens(in_.line());
            word_ = tokens_.next();
            if (!word_.empty()) return true;
        }
        word_ = {};
        return false;
    }

    MaybeError need_line(std::string_view section) {
        if (next()) return std::nullopt;
        return in_.error(ErrorCode::bad_syntax, fmt::format("the file ends within {}", section));
    }

    MaybeError integer(std::string_view token, std::int64_t& value) const {
        if (parse_integer(token, value)) return std::nullopt;
        return in_.error(ErrorCode::bad_syntax,
                         (token.empty() ? std::string("the end of the line") : shown(token)) +
                             " is not an integer");
    }
    /// Reads the word of the line as a count. No count is larger than what is left of the file.
    MaybeError count(std::string_view token, std::size_t& value) const {
        std::int64_t number = 0;
        if (auto trouble = integer(token, number)) return trouble;
        if (number < 0 || static_cast<std::uint64_t>(number) > in_.bytes_left())
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("{} lines are more than the file has", number));
        value = static_cast<std::size_t>(number);
        return std::nullopt;
    }

    MaybeError read_format() {
        if (auto trouble = need_line("$MeshFormat")) return trouble;
        if (word_.starts_with("2"))
            version_ = 2;
        else if (word_ == "4.1")
            version_ = 4;
        else
            return in_.error(ErrorCode::unsupported,
                             fmt::format("MSH {} is not read, only 2.2 and 4.1", shown(word_)));
        if (tokens_.next() != "0")
            return in_.error(ErrorCode::unsupported,
                             "binary MSH is not read; gmsh FILE -save -o text.msh writes text");
        return end_of("$MeshFormat");
    }

    MaybeError end_of(std::string_view section) {
        const auto end = "$End" + std::string(section.substr(1));
        if (auto trouble = need_line(section)) return trouble;
        if (word_ == end) return std::nullopt;
        return in_.error(ErrorCode::bad_syntax,
                         fmt::format("expected {}, found {}", end, shown(word_)));
    }

    MaybeError read_section(const std::string& section) {
        if (section == "$PhysicalNames") {
            if (auto trouble = read_names()) return trouble;
        } else if (section == "$Entities" && version_ == 4) {
            if (auto trouble = read_entities()) return trouble;
        } else if (section == "$Nodes") {
            if (auto trouble = version_ == 2 ? read_nodes22() : read_nodes()) return trouble;
        } else if (section == "$Elements") {
            if (auto trouble = version_ == 2 ? read_elements22() : read_elements()) return trouble;
        } else if (section.starts_with("$")) {
            const auto end = "$End" + section.substr(1);
            std::vector<std::string_view> lines;
            for (; word_ != end; lines.push_back(trimmed(in_.line())))
                if (auto trouble = need_line(section)) return trouble;
            if (section.ends_with("Data") && lines.size() > 2 && lines[1].size() > 2)
                add_values(section, lines[1].substr(1, lines[1].size() - 2), lines);
            return std::nullopt;
        } else {
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("{} begins no section", shown(section)));
        }
        return end_of(section);
    }

    /// Makes values of the lines of a section of data; those that can't be read are only named.
    void add_values(std::string_view section, std::string_view name,
                    std::span<const std::string_view> lines) {
        constexpr std::size_t most_arrays = 64;
        ValueArray array{.name = std::string(name), .on_triangles = section == "$ElementData"};
        const bool is_read = (array.on_triangles || section == "$NodeData") && !for_tetrahedra_ &&
                             arrays_.size() < most_arrays && read_values(lines, array);
        const std::size_t count = array.on_triangles ? face_count_ : vertices_.size();
        if (!is_read || !add_array(std::move(array), count, arrays_)) note_values(name, values_);
    }

    /// Reads "1, name, the number of reals, reals, the number of integers, integers, data".
    bool read_values(std::span<const std::string_view> lines, ValueArray& array) {
        std::size_t at = 0;
        std::vector<std::int64_t> integers;
        for (std::size_t tags = 0; tags < 3; ++tags) {
            std::int64_t count = 0;
            if (at == lines.size() || !parse_integer(lines[at++], count) || count < 0 ||
                static_cast<std::size_t>(count) > lines.size() - at)
                return false;
            for (std::int64_t i = 0; i < count; ++i, ++at)
                if (tags == 2 && !parse_integer(lines[at], integers.emplace_back())) return false;
        }
        if (integers.size() < 2 || integers[1] < 1 || integers[1] > 9) return false;
        array.components = static_cast<std::uint32_t>(integers[1]);
        const std::size_t count = array.on_triangles ? face_count_ : vertices_.size();
        if (lines.size() - at <= count / 16) return false; // memory is linear in the file
        auto& numbers = array.numbers.emplace<0>(count * array.components, std::nan(""));
        const auto& places = array.on_triangles ? face_of_element_ : node_of_;
        for (; at + 1 < lines.size(); ++at) { // the last line is the end of the section
            Tokens tokens(lines[at]);
            std::int64_t tag = 0;
            if (!parse_integer(tokens.next(), tag)) return false;
            const auto place = places.find(tag);
            if (place == places.end()) continue; // a volume, or a line
            for (std::size_t c = 0; c < array.components; ++c)
                if (parse_double(tokens.next(), numbers[place->second * array.components + c]) ==
                    NumberState::not_a_number)
                    return false;
        }
        return true;
    }

    MaybeError read_names() {
        std::size_t names = 0;
        if (auto trouble = need_line("$PhysicalNames")) return trouble;
        if (auto trouble = count(word_, names)) return trouble;
        for (std::size_t i = 0; i < names; ++i) {
            std::int64_t dimension = 0, tag = 0;
            if (auto trouble = need_line("$PhysicalNames")) return trouble;
            if (auto trouble = integer(word_, dimension)) return trouble;
            if (auto trouble = integer(tokens_.next(), tag)) return trouble;
            auto name = tokens_.rest();
            if (name.size() < 2 || name.front() != '"' || name.back() != '"')
                return in_.error(ErrorCode::bad_syntax, "a name is needed in double quotes");
            name = name.substr(1, name.size() - 2);
            if (dimension == 2 && !name.empty()) name_of_[tag] = name;
        }
        return std::nullopt;
    }

    /// Reads which physical surfaces an entity belongs to.
    MaybeError read_entities() {
        std::array<std::size_t, 4> counts{};
        if (auto trouble = need_line("$Entities")) return trouble;
        for (std::size_t d = 0; d < 4; ++d)
            if (auto trouble = count(d == 0 ? word_ : tokens_.next(), counts[d])) return trouble;
        for (std::size_t d = 0; d < 4; ++d)
            for (std::size_t i = 0; i < counts[d]; ++i) {
                if (auto trouble = need_line("$Entities")) return trouble;
                if (d != dimension()) continue;
                if (auto trouble = read_entity()) return trouble;
            }
        return std::nullopt;
    }

    /// Of the entities that are read.
    [[nodiscard]] std::size_t dimension() const { return for_tetrahedra_ ? 3 : 2; }

    MaybeError read_entity() {
        std::int64_t tag = 0, groups = 0;
        if (auto trouble = integer(word_, tag)) return trouble;
        for (int k = 0; k < 6; ++k) tokens_.next(); // its box
        if (auto trouble = integer(tokens_.next(), groups)) return trouble;
        if (groups < 0 || groups > most_groups)
            return in_.error(
                ErrorCode::unsupported,
                fmt::format("an entity with more than {} physical groups", most_groups));
        std::vector<std::int64_t>& physical = physical_of_[tag];
        for (std::int64_t k = 0; k < groups; ++k) {
            std::int64_t group = 0;
            if (auto trouble = integer(tokens_.next(), group)) return trouble;
            if (group < 0) group = -std::max(group, -INT64_MAX); // the sign is an orientation
            if (std::find(physical.begin(), physical.end(), group) == physical.end())
                physical.push_back(group);
        }
        return std::nullopt;
    }

    MaybeError add_node(std::int64_t tag, std::string_view first) {
        Point3 p;
        if (auto trouble = in_.read_number(first, p.x)) return trouble;
        if (auto trouble = in_.read_number(tokens_.next(), p.y)) return trouble;
        if (auto trouble = in_.read_number(tokens_.next(), p.z)) return trouble;
        if (!node_of_.emplace(tag, static_cast<std::uint32_t>(vertices_.size())).second)
            return in_.error(ErrorCode::bad_index, fmt::format("there is a second node {}", tag));
        vertices_.push_back(p);
        return std::nullopt;
    }

    MaybeError read_nodes22() {
        std::size_t nodes = 0;
        if (auto trouble = need_line("$Nodes")) return trouble;
        if (auto trouble = count(word_, nodes)) return trouble;
        for (std::size_t i = 0; i < nodes; ++i) {
            std::int64_t tag = 0;
            if (auto trouble = need_line("$Nodes")) return trouble;
            if (auto trouble = integer(word_, tag)) return trouble;
            if (auto trouble = add_node(tag, tokens_.next())) return trouble;
        }
        return std::nullopt;
    }

    MaybeError read_nodes() {
        std::size_t blocks = 0, nodes = 0;
        if (auto trouble = need_line("$Nodes")) return trouble;
        if (auto trouble = count(word_, blocks)) return trouble;
        for (std::size_t b = 0; b < blocks; ++b) {
            if (auto trouble = need_line("$Nodes")) return trouble;
            tokens_.next(); // tag of the entity, whether there are parameters, how many nodes
            tokens_.next();
            if (auto trouble = count(tokens_.next(), nodes)) return trouble;
            std::vector<std::int64_t> tags(nodes);
            for (std::int64_t& tag : tags) {
                if (auto trouble = need_line("$Nodes")) return trouble;
                if (auto trouble = integer(word_, tag)) return trouble;
            }
            for (const std::int64_t tag : tags) {
                if (auto trouble = need_line("$Nodes")) return trouble;
                if (auto trouble = add_node(tag, word_)) return trouble;
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] MaybeError check_type(std::int64_t type) const {
        if (for_tetrahedra_ ||
            std::find(curved_types.begin(), curved_types.end(), type) == curved_types.end())
            return std::nullopt;
        return in_.error(ErrorCode::unsupported,
                         fmt::format("elements of type {} have curved sides; only triangles and "
                                     "quadrilaterals of the first order are read",
                                     type));
    }

    /// Reads the corners of an element from the rest of the line.
    MaybeError read_corners(std::int64_t type, std::vector<std::uint32_t>& corners) {
        corners.clear();
        for (std::int64_t k = 0; k < (for_tetrahedra_ ? 4 : type + 1); ++k) {
            std::int64_t tag = 0;
            if (auto trouble = integer(tokens_.next(), tag)) return trouble;
            const auto node = node_of_.find(tag);
            if (node == node_of_.end())
                return in_.error(
                    ErrorCode::bad_index,
                    fmt::format("the element names node {}, which does not exist", tag));
            corners.push_back(node->second);
        }
        return std::nullopt;
    }

    [[nodiscard]] bool is_wanted(std::int64_t type) const {
        if (for_tetrahedra_) return type == msh_tetrahedron || type == msh_tetrahedron_10;
        return type == msh_triangle || type == msh_quadrilateral;
    }
    MaybeError add_tetrahedron(const std::vector<std::uint32_t>& corners, std::int64_t label) {
        append_tetrahedron(corners, tetrahedra_);
        if (append_label(label, tetrahedra_)) return std::nullopt;
        return in_.error(ErrorCode::bad_number,
                         fmt::format("the tag {} is no number of 32 bits", label));
    }

    MaybeError read_elements22() {
        std::size_t elements = 0;
        std::vector<std::uint32_t> corners;
        if (auto trouble = need_line("$Elements")) return trouble;
        if (auto trouble = count(word_, elements)) return trouble;
        for (std::size_t i = 0; i < elements; ++i) {
            std::int64_t type = 0, tags = 0, physical = 0, entity = 0, unused = 0;
            if (auto trouble = need_line("$Elements")) return trouble;
            element_ = word_;
            if (auto trouble = integer(tokens_.next(), type)) return trouble;
            if (auto trouble = check_type(type)) return trouble;
            if (!is_wanted(type)) continue;
            if (auto trouble = integer(tokens_.next(), tags)) return trouble;
            for (std::int64_t k = 0; k < tags; ++k)
                if (auto trouble = integer(tokens_.next(), k == 0   ? physical
                                                           : k == 1 ? entity
                                                                    : unused))
                    return trouble;
            if (auto trouble = read_corners(type, corners)) return trouble;
            if (for_tetrahedra_) {
                if (auto trouble = add_tetrahedron(corners, physical != 0 ? physical : entity))
                    return trouble;
                continue;
            }
            append_face(corners, parts_[physical != 0 ? Key{false, physical} : Key{true, entity}],
                        next_face());
        }
        return std::nullopt;
    }

    MaybeError read_elements() {
        std::size_t blocks = 0;
        if (auto trouble = need_line("$Elements")) return trouble;
        if (auto trouble = count(word_, blocks)) return trouble;
        for (std::size_t b = 0; b < blocks; ++b)
            if (auto trouble = read_block()) return trouble;
        return std::nullopt;
    }

    MaybeError read_block() {
        std::int64_t entity = 0, type = 0;
        std::size_t elements = 0;
        if (auto trouble = need_line("$Elements")) return trouble;
        if (auto trouble = integer(tokens_.next(), entity)) return trouble;
        if (auto trouble = integer(tokens_.next(), type)) return trouble;
        if (auto trouble = count(tokens_.next(), elements)) return trouble;
        if (auto trouble = check_type(type)) return trouble;
        std::vector<FilePart*> to;
        const auto groups = physical_of_.find(entity);
        const bool grouped = groups != physical_of_.end() && !groups->second.empty();
        if (grouped && !for_tetrahedra_)
            for (const std::int64_t group : groups->second)
                to.push_back(&parts_[Key{false, group}]);
        if (to.empty() && is_wanted(type) && !for_tetrahedra_)
            to.push_back(&parts_[Key{true, entity}]);
        std::vector<std::uint32_t> corners;
        for (std::size_t i = 0; i < elements; ++i) {
            if (auto trouble = need_line("$Elements")) return trouble;
            element_ = word_;
            if (!is_wanted(type)) continue;
            if (auto trouble = read_corners(type, corners)) return trouble;
            if (for_tetrahedra_)
                if (auto trouble = add_tetrahedron(corners, grouped ? groups->second[0] : entity))
                    return trouble;
            const std::uint32_t face = for_tetrahedra_ ? 0 : next_face();
            for (FilePart* part : to) append_face(corners, *part, face);
        }
        return std::nullopt;
    }

    /// Numbers a face, whose element is the current one.
    std::uint32_t next_face() {
        std::int64_t tag = 0;
        if (has_element_data_ && parse_integer(element_, tag))
            face_of_element_.emplace(tag, face_count_);
        return face_count_++;
    }

    /// Names the surfaces, in their order.
    std::vector<FilePart> parts() {
        std::erase_if(parts_, [](const auto& entry) { return entry.second.triangles.empty(); });
        std::vector<FilePart> all;
        for (auto& [key, part] : parts_) {
            const auto named = key.is_entity ? name_of_.end() : name_of_.find(key.tag);
            part.name = name_;
            if (named != name_of_.end())
                part.name = named->second;
            else if (parts_.size() > 1)
                part.name += fmt::format(" {} {}", key.is_entity ? "entity" : "physical", key.tag);
            all.push_back(std::move(part));
        }
        return all;
    }

    LineParser in_;
    std::string_view name_;
    bool has_element_data_;
    bool for_tetrahedra_ = false;   ///< instead of surfaces
    LabelledTetrahedra tetrahedra_; ///< without vertices
    Tokens tokens_{""};
    std::string_view word_;                                         ///< the first of the line
    int version_ = 0;                                               ///< 2 or 4
    std::map<std::int64_t, std::string> name_of_;                   ///< of physical surfaces
    std::map<std::int64_t, std::vector<std::int64_t>> physical_of_; ///< per entity
    std::unordered_map<std::int64_t, std::uint32_t> node_of_;       ///< by tag
    std::vector<Point3> vertices_;
    std::string_view element_;                                        ///< tag of the current one
    std::uint32_t face_count_ = 0;                                    ///< so far
    std::unordered_map<std::int64_t, std::uint32_t> face_of_element_; ///< with element data
    std::vector<ValueArray> arrays_;                                  ///< over all nodes and faces
    std::vector<std::string> values_;                                 ///< see Surface
    std::map<Key, FilePart> parts_;
};

} // namespace

Result<std::vector<Surface>> read_msh(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return MshReader(contents, source, name).read();
}

Result<LabelledTetrahedra> read_msh_tetrahedra(std::string_view contents, std::string_view source) {
    return MshReader(contents, source, "").read_tetrahedra();
}

} // namespace terrane
