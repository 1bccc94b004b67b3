// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/points/outline.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/points/shape_outline.hpp>
#include <terrane/io/text/json.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

using Ring = std::vector<std::array<double, 2>>;

/// Finds the one polygon of a GeoJSON text.
class GeoJsonReader {
public:
    explicit GeoJsonReader(std::string_view source) : source_(source) {}

    Result<Ring> read(std::string_view contents) {
        using State = ParsedJson::State;
        const ParsedJson parsed = parse_json_text(contents);
        if (parsed.state == State::no_json) {
            const auto end = std::min(contents.size(), parsed.byte);
            const auto line =
                1 + std::count(contents.begin(),
                               contents.begin() + static_cast<std::ptrdiff_t>(end), '\n');
            return Error{ErrorCode::bad_syntax, "this is not well-formed JSON",
                         fmt::format("{}:{}", source_, line)};
        }
        if (parsed.state == State::number_too_large)
            return Error{ErrorCode::bad_number, "a number is too large", std::string(source_)};
        if (parsed.state == State::nested_too_deeply)
            return Error{ErrorCode::bad_syntax, "lists and objects are nested too deeply",
                         std::string(source_)};
        if (auto trouble = find(parsed.value, "")) return *trouble;
        if (!ring_) return error("", ErrorCode::nothing_to_do, "there is no polygon");
        return std::move(*ring_);
    }

private:
    [[nodiscard]] Error error(const std::string& path, ErrorCode code, std::string what) const {
        return {code, std::move(what),
                path.empty() ? std::string(source_) : fmt::format("{}: {}", source_, path)};
    }
    static std::string below(const std::string& path, std::string_view key) {
        return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
    }

    static std::string text_at(const Json& json, const char* key) {
        const Json* const found = json.find(key);
        return found != nullptr && found->is_string() ? found->text() : "";
    }

    /// Looks for polygons in an object of GeoJSON. Objects nest at most a few deep.
    MaybeError find(const Json& json, const std::string& path, unsigned depth = 0) {
        if (!json.is_object() || depth > 16)
            return error(path, ErrorCode::bad_syntax, "this is no object of GeoJSON");
        const auto type = text_at(json, "type");
        const char* const list = type == "FeatureCollection"    ? "features"
                                 : type == "GeometryCollection" ? "geometries"
                                                                : nullptr;
        if (list != nullptr) {
            const Json* const members = json.find(list);
            if (members == nullptr || !members->is_array())
                return error(path, ErrorCode::bad_syntax, fmt::format("{} is missing", list));
            for (std::size_t i = 0; i < members->size(); ++i)
                if (auto trouble =
                        find((*members)[i], below(path, fmt::format("{}[{}]", list, i)), depth + 1))
                    return trouble;
            return std::nullopt;
        }
        if (type == "Feature") {
            const Json* const geometry = json.find("geometry");
            if (geometry == nullptr || geometry->is_null()) return std::nullopt;
            return find(*geometry, below(path, "geometry"), depth + 1);
        }
        return find_in_geometry(json, type, path);
    }

    MaybeError find_in_geometry(const Json& json, const std::string& type,
                                const std::string& path) {
        if (type == "Point" || type == "MultiPoint" || type == "LineString" ||
            type == "MultiLineString")
            return std::nullopt; // they bound nothing
        if (type != "Polygon" && type != "MultiPolygon")
            return error(path, ErrorCode::bad_syntax,
                         type.empty() ? std::string("it has no type")
                                      : shown(type) + " is no type of GeoJSON");
        const Json* const at = json.find("coordinates");
        const auto place = below(path, "coordinates");
        if (at == nullptr || !at->is_array())
            return error(place, ErrorCode::bad_syntax, "an array is needed");
        if (type == "Polygon") return add_polygon(*at, place);
        for (std::size_t i = 0; i < at->size(); ++i)
            if (auto trouble = add_polygon((*at)[i], fmt::format("{}[{}]", place, i)))
                return trouble;
        return std::nullopt;
    }

    MaybeError add_polygon(const Json& rings, const std::string& path) {
        if (!rings.is_array() || rings.empty() || !rings[0].is_array())
            return error(path, ErrorCode::bad_syntax, "an array of rings is needed");
        if (rings.size() > 1)
            return error(path, ErrorCode::unsupported,
                         "the polygon has a hole; an outline is one ring");
        if (ring_)
            return error(path, ErrorCode::unsupported,
                         "this is a second polygon; an outline is one, so keep one in the file");
        Ring ring;
        for (std::size_t i = 0; i < rings[0].size(); ++i) {
            const Json& corner = rings[0][i];
            const bool sound = corner.is_array() && corner.size() >= 2 && corner[0].is_number() &&
                               corner[1].is_number();
            if (!sound || !std::isfinite(corner[0].get<double>()) ||
                !std::isfinite(corner[1].get<double>()))
                return error(fmt::format("{}[0][{}]", path, i), ErrorCode::bad_number,
                             "a corner needs two numbers");
            ring.push_back({corner[0].get<double>(), corner[1].get<double>()});
        }
        ring_ = std::move(ring);
        return std::nullopt;
    }

    std::string_view source_;
    std::optional<Ring> ring_;
};

/// Tells whether a number is one of the three with which RMS ends a line.
bool is_end_of_line(std::string_view token) {
    double value = 0;
    return parse_double(token, value) == NumberState::ok && value == 999;
}

Result<Ring> read_columns(std::string_view contents, std::string_view source) {
    Ring corners;
    bool ended = false;
    LineParser lines(contents, source);
    while (lines.next()) {
        std::string line(lines.line().substr(0, lines.line().find('#')));
        std::replace(line.begin(), line.end(), ',', ' ');
        Tokens tokens(line);
        const auto first = tokens.next();
        if (first.empty()) continue;
        const auto second = tokens.next();
        if (is_end_of_line(first) && is_end_of_line(second) && is_end_of_line(tokens.next())) {
            ended = true;
            continue;
        }
        if (ended)
            return lines.error(ErrorCode::unsupported,
                               "a second polygon begins here; an outline is one, so keep one in "
                               "the file");
        auto& p = corners.emplace_back();
        if (second.empty()) return lines.error(ErrorCode::bad_syntax, "a corner needs two numbers");
        if (auto flaw = lines.read_number(first, p[0])) return *flaw;
        if (auto flaw = lines.read_number(second, p[1])) return *flaw;
    }
    if (corners.empty()) return lines.file_error(ErrorCode::nothing_to_do, "there is no corner");
    return corners;
}

} // namespace

Result<Ring> read_outline(std::string_view contents, std::string_view source) {
    return guard_memory(source, [&]() -> Result<Ring> {
        const std::string ending = lower(source.substr(std::min(source.size(), source.rfind('.'))));
        if (ending == ".geojson" || ending == ".json") return GeoJsonReader(source).read(contents);
        if (ending == ".shp") return read_shape_outline(contents, source);
        return read_columns(contents, source);
    });
}

} // namespace terrane
