// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/dxf.hpp>

#include <array>
#include <map>
#include <string>

#include <fmt/format.h>

#include <terrane/io/surfaces/detail/point_numbering.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

class DxfReader {
public:
    DxfReader(std::string_view contents, std::string_view source, std::string_view name) :
        in_(contents, source), name_(name), is_binary_(contents.starts_with("AutoCAD Binary DXF")) {
    }

    Result<std::vector<Surface>> read() {
        if (is_binary_)
            return in_.file_error(ErrorCode::unsupported,
                                  "binary DXF is not read; save it as ASCII");
        if (auto trouble = read_pairs()) return *trouble;
        std::vector<Surface> surfaces;
        for (Layer& layer : layers_) {
            Surface& surface = surfaces.emplace_back();
            surface.name = layer.name;
            surface.triangles = std::move(layer.triangles);
            surface.vertices = layer.points.take();
        }
        if (surfaces.empty()) return in_.file_error(ErrorCode::nothing_to_do, "there is no 3DFACE");
        return surfaces;
    }

private:
    struct Layer {
        std::string name;
        PointNumbering points;
        std::vector<Triangle> triangles;
    };
    struct Face {
        std::size_t line = 0;
        std::string layer;
        std::array<std::array<double, 3>, 4> corners{};
        std::array<unsigned, 4> has{}; ///< bit c: coordinate c of the corner is stated
    };

    /// Reads a group: a line with its code and one with its value. Returns false at the end.
    Result<bool> next_pair() {
        if (!in_.next()) return false;
        const auto code = trimmed(in_.line());
        if (!parse_integer(code, code_))
            return in_.error(ErrorCode::bad_syntax, shown(code) + " is no group code");
        if (!in_.next())
            return in_.error(ErrorCode::bad_syntax, "the file ends after a group code");
        value_ = trimmed(in_.line());
        return true;
    }

    MaybeError read_pairs() {
        for (;;) {
            const auto pair = next_pair();
            if (!pair) return pair.error();
            if (!*pair) break;
            if (code_ == 0) {
                if (auto trouble = end_face()) return trouble;
                names_section_ = value_ == "SECTION";
                if (value_ == "ENDSEC") in_entities_ = false;
                if (value_ == "EOF") return std::nullopt;
                in_face_ = in_entities_ && value_ == "3DFACE";
                if (in_face_) {
                    face_ = {};
                    face_.line = in_.number();
                }
            } else if (code_ == 2 && names_section_) {
                in_entities_ = value_ == "ENTITIES";
                names_section_ = false;
            } else if (in_face_) {
                if (auto trouble = read_group()) return trouble;
            }
        }
        if (in_face_ || in_entities_)
            return in_.error(ErrorCode::bad_syntax, "the file ends within the section ENTITIES");
        return std::nullopt;
    }

    MaybeError read_group() {
        if (code_ == 8) face_.layer = value_;
        if (code_ < 10 || code_ % 10 > 3 || code_ / 10 > 3) return std::nullopt;
        const auto corner = static_cast<std::size_t>(code_ % 10);
        const auto axis = static_cast<std::size_t>(code_ / 10 - 1);
        face_.has[corner] |= 1U << axis;
        return in_.read_number(value_, face_.corners[corner][axis]);
    }

    /// Adds the face that was read, if there is one.
    MaybeError end_face() {
        if (!in_face_) return std::nullopt;
        in_face_ = false;
        for (std::size_t corner = 0; corner < 3; ++corner)
            if ((face_.has[corner] & 3U) != 3U)
                return in_.error_at(
                    face_.line, ErrorCode::bad_syntax,
                    fmt::format("corner {} of the 3DFACE has no x and y", corner + 1));
        Layer& layer = layer_named(face_.layer.empty() ? std::string(name_) : face_.layer);
        std::array<std::uint32_t, 4> corners{};
        const bool has_fourth = face_.has[3] != 0 && face_.corners[3] != face_.corners[2];
        for (std::size_t k = 0; k < (has_fourth ? 4U : 3U); ++k) {
            const auto& c = face_.corners[k];
            corners[k] = layer.points.number({c[0], c[1], c[2]});
        }
        layer.triangles.push_back({corners[0], corners[1], corners[2]});
        if (has_fourth) layer.triangles.push_back({corners[0], corners[2], corners[3]});
        return std::nullopt;
    }

    Layer& layer_named(const std::string& name) {
        const auto [at, added] = layer_of_.try_emplace(name, layers_.size());
        if (added) layers_.push_back({name, {}, {}});
        return layers_[at->second];
    }

    LineParser in_;
    std::string_view name_;
    bool is_binary_;
    std::int64_t code_ = 0;
    std::string_view value_;
    bool names_section_ = false; ///< the group before was 0 SECTION
    bool in_entities_ = false, in_face_ = false;
    Face face_;
    std::vector<Layer> layers_;
    std::map<std::string, std::size_t> layer_of_;
};

} // namespace

Result<std::vector<Surface>> read_dxf(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return DxfReader(contents, source, name).read();
}

} // namespace terrane
