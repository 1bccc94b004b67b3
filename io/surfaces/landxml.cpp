// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/landxml.hpp>

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/units.hpp>

namespace terrane {

using namespace detail;

namespace {

class LandXmlReader {
public:
    LandXmlReader(std::string_view contents, std::string_view source, std::string_view name) :
        contents_(contents), source_(source), name_(name) {}

    Result<std::vector<Surface>> read() {
        pugi::xml_document document;
        const auto parsed = document.load_buffer(contents_.data(), contents_.size());
        if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
        if (!parsed)
            return error(parsed.offset, ErrorCode::bad_syntax,
                         fmt::format("this is not well-formed XML: {}", parsed.description()));
        const auto root = document.child("LandXML");
        if (!root) return error(0, ErrorCode::bad_syntax, "there is no element LandXML");
        const CoordinateFrame frame = frame_of(root);
        std::vector<Surface> all;
        for (const pugi::xml_node surfaces : root.children("Surfaces"))
            for (const pugi::xml_node node : surfaces.children("Surface")) {
                auto read = read_surface(node);
                if (!read) return read.error();
                for (Surface& surface : *read) {
                    surface.frame = frame;
                    all.push_back(std::move(surface));
                }
            }
        if (all.empty())
            return Error{ErrorCode::nothing_to_do, "there is no face of a surface",
                         std::string(source_)};
        return all;
    }

private:
    [[nodiscard]] Error error(std::ptrdiff_t offset, ErrorCode code, std::string what) const {
        const auto end = std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(contents_));
        const auto line = 1 + std::count(contents_.begin(), contents_.begin() + end, '\n');
        return {code, std::move(what), fmt::format("{}:{}", source_, line)};
    }
    [[nodiscard]] Error error(const pugi::xml_node& at, ErrorCode code, std::string what) const {
        return error(at.offset_debug(), code, std::move(what));
    }

    /// Returns the unit and the coordinate system that the file states.
    static CoordinateFrame frame_of(const pugi::xml_node& root) {
        CoordinateFrame frame;
        const std::string_view unit =
            root.child("Units").first_child().attribute("linearUnit").value();
        frame.horizontal_unit = unit == "USSurveyFoot" ? "ftUS" : unit_named(unit);
        frame.vertical_unit = frame.horizontal_unit;
        const auto system = root.child("CoordinateSystem");
        for (const char* key : {"name", "horizontalCoordinateSystemName", "desc", "epsgCode"})
            if (const std::string_view text = system.attribute(key).value();
                frame.system.empty() && !text.empty())
                frame.system =
                    std::string_view(key) == "epsgCode" ? fmt::format("EPSG:{}", text) : text;
        return frame;
    }

    /// Reads the surface of an element, or none if it has no faces.
    Result<std::vector<Surface>> read_surface(const pugi::xml_node& node) {
        const auto definition = node.child("Definition");
        vertices_.clear();
        number_of_.clear();
        std::vector<FilePart> parts(1);
        const std::string_view name = node.attribute("name").value();
        parts[0].name = name.empty() ? name_ : name;
        for (const pugi::xml_node points : definition.children("Pnts"))
            for (const pugi::xml_node point : points.children("P"))
                if (auto trouble = read_point(point)) return *trouble;
        for (const pugi::xml_node faces : definition.children("Faces"))
            for (const pugi::xml_node face : faces.children("F"))
                if (auto trouble = read_face(face, parts[0])) return *trouble;
        return surfaces_of_parts(vertices_, std::move(parts));
    }

    MaybeError read_point(const pugi::xml_node& node) {
        std::array<double, 3> numbers{};
        Tokens tokens = tokens_of(node);
        for (double& number : numbers)
            if (const auto token = tokens.next(); parse_double(token, number) != NumberState::ok)
                return error(node, ErrorCode::bad_number,
                             "a point needs northing, easting and elevation, not " + shown(token));
        const auto [northing, easting, elevation] = numbers;
        const std::string id = node.attribute("id").value();
        const auto number = static_cast<std::uint32_t>(vertices_.size());
        if (!number_of_.emplace(id, number).second)
            return error(node, ErrorCode::bad_index, "there are two points " + shown(id));
        vertices_.push_back({easting, northing, elevation});
        return std::nullopt;
    }

    MaybeError read_face(const pugi::xml_node& node, FilePart& part) {
        if (std::string_view(node.attribute("i").value()) == "1") return std::nullopt;
        Tokens tokens = tokens_of(node);
        std::vector<std::uint32_t> corners;
        for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
            const auto found = number_of_.find(std::string(token));
            if (found == number_of_.end())
                return error(
                    node, ErrorCode::bad_index,
                    fmt::format("the face names point {}, which does not exist", shown(token)));
            corners.push_back(found->second);
        }
        if (corners.size() < 3) return error(node, ErrorCode::bad_syntax, "a face needs 3 corners");
        append_face(corners, part);
        return std::nullopt;
    }

    /// Splits the text of an element, which may have several lines.
    Tokens tokens_of(const pugi::xml_node& node) {
        text_ = node.child_value();
        std::ranges::replace(text_, '\n', ' ');
        return Tokens(text_);
    }

    std::string_view contents_, source_, name_;
    std::vector<Point3> vertices_;                             ///< of the surface
    std::unordered_map<std::string, std::uint32_t> number_of_; ///< vertex by its id
    std::string text_;
};

} // namespace

Result<std::vector<Surface>> read_landxml(std::string_view contents, std::string_view source,
                                          std::string_view name) {
    return LandXmlReader(contents, source, name).read();
}

} // namespace terrane
