// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/ply.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/bytes.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane {

using namespace detail;

namespace {

/// The limit of surfaces per face keeps the size of the surfaces linear in that of the file.
constexpr std::size_t max_surfaces = 256;

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Type> type_named(std::string_view name) {
    constexpr std::array<std::array<std::string_view, 2>, 8> names{{{"char", "int8"},
                                                                    {"uchar", "uint8"},
                                                                    {"short", "int16"},
                                                                    {"ushort", "uint16"},
                                                                    {"int", "int32"},
                                                                    {"uint", "uint32"},
                                                                    {"float", "float32"},
                                                                    {"double", "float64"}}};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (name == names[i][0] || name == names[i][1]) return static_cast<Type>(i);
    return std::nullopt;
}

std::size_t size_of(Type type) {
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

double load_as_double(Type type, const char* bytes, std::endian order) {
    switch (type) {
    case Type::int8:
        return load<std::int8_t>(bytes, order);
    case Type::uint8:
        return load<std::uint8_t>(bytes, order);
    case Type::int16:
        return load<std::int16_t>(bytes, order);
    case Type::uint16:
        return load<std::uint16_t>(bytes, order);
    case Type::int32:
        return load<std::int32_t>(bytes, order);
    case Type::uint32:
        return load<std::uint32_t>(bytes, order);
    case Type::float32:
        return load<float>(bytes, order);
    case Type::float64:
        break;
    }
    return load<double>(bytes, order);
}

/// The meaning of a property.
enum class Use { none, x, y, z, corners, surfaces, value };

struct Property {
    Type type = Type::float32;
    std::optional<Type> count_type; ///< lists only
    Use use = Use::none;
    std::size_t array = 0; ///< of a value: its array
};

constexpr std::array<NumberType, 8> number_types{
    NumberType::int8,  NumberType::uint8,  NumberType::int16,   NumberType::uint16,
    NumberType::int32, NumberType::uint32, NumberType::float32, NumberType::float64}; // per Type

/// An array that a comment of to_ply() describes: its numbers are the next properties of the element.
struct Described {
    bool on_faces = false;
    ValueArray array{};
    std::uint32_t left = 0; ///< how many properties are to follow
};

struct Element {
    std::string name;
    std::int64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    bool ascii = false;
    std::endian order = std::endian::little;
    std::vector<Element> elements;
    std::vector<SurfaceInfo> surfaces; ///< from the comments of to_ply
    std::vector<ValueArray>
        arrays; ///< other properties of vertices and faces, without their numbers
    std::vector<std::string> values; ///< names of lists among these, which are not read

    [[nodiscard]] const Element* find(std::string_view name) const {
        const auto named = [&](const Element& element) { return element.name == name; };
        const auto found = std::ranges::find_if(elements, named);
        return found == elements.end() ? nullptr : &*found;
    }
};

class HeaderReader {
public:
    HeaderReader(LineParser& in, Header& header) : in_(in), header_(header) {}

    MaybeError read() {
        if (!in_.next() || trimmed(in_.line()) != "ply")
            return in_.file_error(ErrorCode::bad_syntax,
                                  "not a PLY file: it does not begin with ply");
        bool format = false;
        while (in_.next()) {
            Tokens tokens(in_.line());
            const auto keyword = tokens.next();
            if (keyword == "end_header")
                return format ? check()
                              : in_.error(ErrorCode::bad_syntax, "there is no format line");
            format = format || keyword == "format";
            if (auto trouble = read_line(keyword, tokens)) return trouble;
        }
        return in_.error(ErrorCode::bad_syntax, "the header has no end_header");
    }

private:
    MaybeError read_line(std::string_view keyword, Tokens tokens) {
        if (keyword == "format") return read_format(tokens.next());
        if (keyword == "element") return read_element(tokens);
        if (keyword == "property") return read_property(tokens);
        if (keyword == "comment") read_comment(tokens);
        if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) return std::nullopt;
        return in_.error(ErrorCode::bad_syntax, shown(keyword) + " in the header");
    }

    MaybeError read_format(std::string_view format) {
        header_.ascii = format == "ascii";
        if (format == "binary_big_endian") header_.order = std::endian::big;
        if (header_.ascii || format == "binary_big_endian" || format == "binary_little_endian")
            return std::nullopt;
        return in_.error(ErrorCode::bad_syntax, shown(format) + " is not a format of PLY");
    }

    MaybeError read_element(Tokens tokens) {
        Element element;
        element.name = tokens.next();
        if (!parse_integer(tokens.next(), element.count) || element.count < 0)
            return in_.error(ErrorCode::bad_syntax, "element needs a name and a count");
        if (!names_.insert(element.name).second)
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("element {} is there twice", shown(element.name)));
        header_.elements.push_back(std::move(element));
        return std::nullopt;
    }

    MaybeError read_property(Tokens tokens) {
        if (header_.elements.empty())
            return in_.error(ErrorCode::bad_syntax, "a property before the first element");
        Property property;
        auto word = tokens.next();
        if (word == "list") {
            property.count_type = type_named(tokens.next());
            if (!property.count_type)
                return in_.error(ErrorCode::bad_syntax, "a list needs the type of its count");
            word = tokens.next();
        }
        const auto type = type_named(word);
        if (!type) return in_.error(ErrorCode::bad_syntax, shown(word) + " is not a type of PLY");
        property.type = *type;
        const auto name = tokens.next();
        property.use = use_of(name, property.count_type.has_value());
        Element& element = header_.elements.back();
        if (property.use == Use::none && (element.name == "vertex" || element.name == "face"))
            begin_value(name, element, property);
        element.properties.push_back(property);
        return std::nullopt;
    }

    /// Makes a property the next number of an array, which it may begin.
    void begin_value(std::string_view name, const Element& element, Property& property) {
        constexpr std::size_t most_arrays = 64; // a vertex may be in many surfaces
        const bool on_faces = element.name == "face";
        std::vector<ValueArray>& arrays = header_.arrays;
        if (property.count_type || (is_reserved(name) && described_.left == 0) ||
            (arrays.size() == most_arrays && described_.left == 0))
            return note_values(name, header_.values);
        if (described_.left == 0 || described_.on_faces != on_faces)
            described_ = {on_faces, {.name = std::string(name), .on_triangles = on_faces}, 1};
        if (described_.left == described_.array.components) {
            described_.array.type = number_types[static_cast<std::size_t>(property.type)];
            if (described_.array.type > NumberType::float32) described_.array.numbers.emplace<1>();
            arrays.push_back(described_.array);
        }
        --described_.left;
        property.use = Use::value;
        property.array = arrays.size() - 1;
    }

    [[nodiscard]] Use use_of(std::string_view name, bool list) const {
        const auto& element = header_.elements.back().name;
        if (element == "vertex" && !list) {
            if (name == "x") return Use::x;
            if (name == "y") return Use::y;
            if (name == "z") return Use::z;
        }
        if (element == "face" && list) {
            if (name == "vertex_indices" || name == "vertex_index") return Use::corners;
            if (name == "surfaces" && !header_.surfaces.empty()) return Use::surfaces;
        }
        return Use::none;
    }

    void read_comment(Tokens tokens) {
        if (tokens.next() != "terrane") return;
        const auto what = tokens.next();
        if (what == "values") return describe(tokens);
        if (what != "surface") return;
        const auto role = std::ranges::find(role_names, tokens.next());
        if (role == role_names.end()) return;
        header_.surfaces.push_back(
            {std::string(tokens.rest()), static_cast<Role>(role - role_names.begin())});
    }

    /// Reads "vertex 3 -99999 m name", the way in which to_ply() describes an array.
    void describe(Tokens tokens) {
        constexpr std::int64_t most_components = 64;
        described_ = {};
        const auto element = tokens.next();
        std::int64_t components = 0;
        if (!parse_integer(tokens.next(), components) || components < 1 ||
            components > most_components || (element != "vertex" && element != "face"))
            return;
        described_.on_faces = element == "face";
        described_.left = described_.array.components = static_cast<std::uint32_t>(components);
        described_.array.on_triangles = described_.on_faces;
        double no_data = 0;
        if (parse_double(tokens.next(), no_data) == NumberState::ok)
            described_.array.no_data = no_data;
        const auto unit = tokens.next();
        if (unit != "-") described_.array.unit = replaced_texts(unit, "%20", " ");
        described_.array.name = tokens.rest();
    }

    [[nodiscard]] MaybeError check() const {
        const auto* face = header_.find("face");
        if ((!face || face->count == 0) && header_.find("tristrips"))
            return in_.error(ErrorCode::unsupported, "triangle strips are not read");
        if (!face || face->count == 0)
            return in_.file_error(ErrorCode::nothing_to_do, "there is no face");
        if (!has(header_.find("vertex"), {Use::x, Use::y, Use::z}))
            return in_.error(ErrorCode::bad_syntax, "there is no element vertex with x, y and z");
        if (!has(face, {Use::corners}))
            return in_.error(ErrorCode::bad_syntax, "element face has no list vertex_indices");
        return std::nullopt;
    }

    /// Tells whether the element has exactly one property for each use.
    static bool has(const Element* element, std::initializer_list<Use> uses) {
        return element && std::ranges::all_of(uses, [&](Use use) {
                   return std::ranges::count(element->properties, use, &Property::use) == 1;
               });
    }

    LineParser& in_;
    Header& header_;
    std::set<std::string> names_; ///< of the elements so far
    Described described_;         ///< the array of the next properties
};

/// Reads the values after the header one by one.
class Values {
public:
    Values(std::string_view contents, LineParser& in, const Header& header) :
        contents_(contents), in_(in), header_(header), at_(contents.size() - in.bytes_left()) {}

    MaybeError skip(Type type) {
        if (header_.ascii) return next_token();
        return advance(type);
    }

    /// Reads a value, which must be finite unless it is skipped.
    MaybeError read(Type type, double& value) {
        if (auto trouble = skip(type)) return trouble;
        if (header_.ascii) return in_.read_number(token_, value);
        value = load_as_double(type, contents_.data() + at_ - size_of(type), header_.order);
        if (std::isfinite(value)) return std::nullopt;
        at_ -= size_of(type);
        return error(ErrorCode::bad_number, "the value is not a finite number");
    }

    /// Appends a value to an array; it may be no finite number.
    MaybeError append(Type type, ValueArray& array) {
        if (auto trouble = skip(type)) return trouble;
        double value = 0;
        if (!header_.ascii)
            value = load_as_double(type, contents_.data() + at_ - size_of(type), header_.order);
        else if (parse_double(token_, value) == NumberState::not_a_number)
            return in_.read_number(token_, value);
        if (auto* const numbers = std::get_if<std::vector<double>>(&array.numbers))
            numbers->push_back(value);
        else if (std::fabs(value) <= UINT32_MAX)
            std::get<1>(array.numbers).push_back(static_cast<std::int64_t>(value));
        else
            return error(ErrorCode::bad_number,
                         fmt::format("{} is not an integer of its type", value));
        return std::nullopt;
    }

    MaybeError read_integer(Type type, std::int64_t& value) {
        double number = 0;
        if (auto trouble = read(type, number)) return trouble;
        if (number != std::floor(number) || std::fabs(number) > 1e15)
            return error(ErrorCode::bad_syntax, fmt::format("{} is not an integer", number));
        value = static_cast<std::int64_t>(number);
        return std::nullopt;
    }

    /// Tells whether only blanks are left.
    bool at_end() {
        if (!header_.ascii) return at_ == contents_.size();
        return next_token().has_value();
    }

    [[nodiscard]] Error error(ErrorCode code, std::string sentence) const {
        if (header_.ascii) return in_.error(code, std::move(sentence));
        return {code, std::move(sentence), fmt::format("{}, byte {}", in_.source(), at_)};
    }

    [[nodiscard]] std::size_t bytes_left() const {
        return header_.ascii ? in_.bytes_left() : contents_.size() - at_;
    }

private:
    MaybeError next_token() {
        for (token_ = tokens_.next(); token_.empty(); token_ = tokens_.next()) {
            if (!in_.next()) return error(ErrorCode::bad_syntax, "the file ends too early");
            tokens_ = Tokens(in_.line());
        }
        return std::nullopt;
    }

    MaybeError advance(Type type) {
        if (contents_.size() - at_ < size_of(type))
            return error(ErrorCode::bad_syntax, "the file ends too early");
        at_ += size_of(type);
        return std::nullopt;
    }

    std::string_view contents_;
    LineParser& in_;
    const Header& header_;
    std::size_t at_; ///< binary: next byte
    Tokens tokens_{""};
    std::string_view token_;
};

class PlyReader {
public:
    PlyReader(std::string_view contents, std::string_view source) :
        contents_(contents), in_(contents, source) {}

    Result<std::vector<Surface>> read(std::string_view name) {
        if (auto trouble = HeaderReader(in_, header_).read()) return *trouble;
        vertex_count_ = header_.find("vertex")->count;
        parts_.resize(std::max<std::size_t>(header_.surfaces.size(), 1));
        Values values(contents_, in_, header_);
        for (const auto& element : header_.elements)
            if (auto trouble = read_element(element, values)) return *trouble;
        if (!values.at_end())
            return values.error(ErrorCode::bad_syntax, "there is more than the header announces");
        return surfaces(name);
    }

private:
    MaybeError read_element(const Element& element, Values& values) {
        if (element.properties.empty()) return std::nullopt;
        const bool vertex = element.name == "vertex";
        const auto fit = values.bytes_left() / 3 + 1; // three numbers of a byte
        if (vertex) vertices_.reserve(std::min(static_cast<std::size_t>(element.count), fit));
        for (std::int64_t i = 0; i < element.count; ++i) {
            if (vertex) vertices_.emplace_back();
            corners_.clear();
            owners_.clear();
            for (const auto& property : element.properties)
                if (auto trouble = read_property(property, values)) return trouble;
            if (element.name != "face") continue;
            if (auto trouble = add_face(values)) return trouble;
        }
        return std::nullopt;
    }

    MaybeError read_property(const Property& property, Values& values) {
        if (property.count_type) return read_list(property, values);
        switch (property.use) {
        case Use::x:
            return values.read(property.type, vertices_.back().x);
        case Use::y:
            return values.read(property.type, vertices_.back().y);
        case Use::z:
            return values.read(property.type, vertices_.back().z);
        case Use::value:
            return values.append(property.type, header_.arrays[property.array]);
        default:
            return values.skip(property.type);
        }
    }

    MaybeError read_list(const Property& property, Values& values) {
        std::int64_t count = 0;
        if (auto trouble = values.read_integer(*property.count_type, count)) return trouble;
        if (count < 0) return values.error(ErrorCode::bad_syntax, "the list has a negative length");
        for (std::int64_t i = 0; i < count; ++i)
            if (auto trouble = read_entry(property, values)) return trouble;
        return std::nullopt;
    }

    MaybeError read_entry(const Property& property, Values& values) {
        if (property.use == Use::none) return values.skip(property.type);
        const bool corner = property.use == Use::corners;
        const auto limit =
            corner ? vertex_count_ : static_cast<std::int64_t>(header_.surfaces.size());
        std::int64_t index = 0;
        if (auto trouble = values.read_integer(property.type, index)) return trouble;
        if (index < 0 || index >= limit)
            return values.error(ErrorCode::bad_index,
                                fmt::format("the face names {} {}, which does not exist: there are "
                                            "{}, counted from 0",
                                            corner ? "vertex" : "surface", index, limit));
        if (!corner && owners_.size() == max_surfaces)
            return values.error(ErrorCode::unsupported,
                                fmt::format("a face of more than {} surfaces", max_surfaces));
        (corner ? corners_ : owners_).push_back(static_cast<std::uint32_t>(index));
        return std::nullopt;
    }

    MaybeError add_face(const Values& values) {
        if (corners_.size() < 3)
            return values.error(ErrorCode::bad_syntax, "a face needs 3 corners");
        if (owners_.empty()) owners_.push_back(0);
        for (const auto owner : owners_) append_face(corners_, parts_[owner], faces_);
        ++faces_;
        return std::nullopt;
    }

    std::vector<Surface> surfaces(std::string_view name) {
        std::vector<Surface> result(parts_.size());
        std::vector<ValueArray> arrays;
        for (ValueArray& array : header_.arrays) {
            const std::size_t count = array.on_triangles ? faces_ : vertices_.size();
            const std::string found = array.name;
            if (!add_array(std::move(array), count, arrays)) note_values(found, header_.values);
        }
        Submesh subset(vertices_);
        for (std::size_t s = 0; s < parts_.size(); ++s) {
            Surface& surface = result[s];
            surface.flawed_faces = divide_faces(vertices_, parts_[s]);
            surface.arrays = arrays_of_part(parts_[s], arrays, header_.surfaces.empty());
            surface.triangles = std::move(parts_[s].triangles);
            surface.values = header_.values;
            if (header_.surfaces.empty()) {
                surface.name = name;
                continue;
            }
            surface.name = std::move(header_.surfaces[s].name);
            surface.role = header_.surfaces[s].role;
            surface.vertices = subset.cut(surface.triangles);
        }
        if (header_.surfaces.empty()) result[0].vertices = std::move(vertices_);
        return result;
    }

    std::string_view contents_;
    LineParser in_;
    Header header_;
    std::int64_t vertex_count_ = 0;
    std::vector<Point3> vertices_;
    std::uint32_t faces_ = 0;            ///< how many there are so far
    std::vector<FilePart> parts_;        ///< per surface, at least one
    std::vector<std::uint32_t> corners_; ///< of the current face
    std::vector<std::uint32_t> owners_;  ///< surfaces of the current face
};

} // namespace

Result<std::vector<Surface>> read_ply(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return PlyReader(contents, source).read(name);
}

} // namespace terrane
