// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/surfaces/dxf.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/cosine_and_sine.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/io/surfaces/detail/point_numbering.hpp>
#include <terrane/io/surfaces/parts.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

/// A group of an entity: its code and its value, which is a number for codes of coordinates,
/// counts and flags.
struct Group {
    std::int64_t code;
    std::string_view text;
    double number = 0;
};

/// An entity with its groups.
struct Entity {
    std::string_view type;
    std::size_t line = 0;
    std::vector<Group> groups;

    [[nodiscard]] bool has(std::int64_t code) const {
        return std::ranges::find(groups, code, &Group::code) != groups.end();
    }
    [[nodiscard]] double number(std::int64_t code, double otherwise = 0) const {
        const auto found = std::ranges::find(groups, code, &Group::code);
        return found == groups.end() ? otherwise : found->number;
    }
    [[nodiscard]] std::string text(std::int64_t code) const {
        const auto found = std::ranges::find(groups, code, &Group::code);
        return std::string(found == groups.end() ? std::string_view() : found->text);
    }
    [[nodiscard]] unsigned flags(std::int64_t code) const {
        const double flags = number(code);
        return flags >= 0 && flags < 65536 ? static_cast<unsigned>(flags) : 0;
    }
    /// The point whose coordinates have the codes `first`, first + 10 and first + 20.
    [[nodiscard]] Point3 point(std::int64_t first) const {
        return {number(first), number(first + 10), number(first + 20)};
    }
};

/// A face, or a block that is inserted.
struct Item {
    std::string layer;
    std::vector<Point3> corners;
    std::string block{}; ///< of an insert
    Entity insert{};
};

/// Where an insert puts a point: sums of the axes times its coordinates.
struct Placement {
    Point3 origin{0, 0, 0};
    std::array<Point3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

    [[nodiscard]] Point3 operator()(const Point3& p) const {
        const auto sum = [&](double Point3::*c) {
            return origin.*c + axes[0].*c * p.x + axes[1].*c * p.y + axes[2].*c * p.z;
        };
        return {sum(&Point3::x), sum(&Point3::y), sum(&Point3::z)};
    }
    /// Returns where this puts what another one has placed.
    [[nodiscard]] Placement after(const Placement& inner) const {
        Placement both{(*this)(inner.origin), {}};
        for (std::size_t k = 0; k < 3; ++k) {
            const Point3 end = (*this)(inner.axes[k]);
            both.axes[k] = {end.x - origin.x, end.y - origin.y, end.z - origin.z};
        }
        return both;
    }
};

Point3 unit_vector(const Point3& p) {
    const double size = length(p);
    return {p.x / size, p.y / size, p.z / size};
}

/// Returns the axes in which an entity with this direction of extrusion states its coordinates.
/// Source: Autodesk, DXF Reference, arbitrary axis algorithm.
std::array<Point3, 3> axes_along(const Point3& extrusion) {
    if (extrusion == Point3{0, 0, 1}) return Placement{}.axes;
    const Point3 z = unit_vector(extrusion);
    const bool steep = std::fabs(z.x) < 1.0 / 64 && std::fabs(z.y) < 1.0 / 64;
    const Point3 x = unit_vector(cross(steep ? Point3{0, 1, 0} : Point3{0, 0, 1}, z));
    return {x, cross(z, x), z};
}

class DxfReader {
public:
    DxfReader(std::string_view contents, std::string_view source, std::string_view name) :
        in_(contents, source), name_(name), is_binary_(contents.starts_with("AutoCAD Binary DXF")),
        most_placed_(contents.size()) {}

    Result<std::vector<Surface>> read() {
        if (is_binary_)
            return in_.file_error(ErrorCode::unsupported,
                                  "binary DXF is not read; save it as ASCII");
        if (auto trouble = read_entities()) return *trouble;
        if (auto trouble = place(entities_, {}, "", 0)) return *trouble;
        std::vector<Surface> surfaces;
        for (Layer& layer : layers_) {
            Surface& surface = surfaces.emplace_back();
            surface.name = layer.part.name;
            surface.vertices = layer.points.take();
            surface.flawed_faces = divide_faces(surface.vertices, layer.part);
            surface.triangles = std::move(layer.part.triangles);
        }
        if (surfaces.empty())
            return in_.file_error(ErrorCode::nothing_to_do,
                                  "there is no face: no 3DFACE, polyface, polygon mesh or MESH");
        return surfaces;
    }

private:
    struct Layer {
        FilePart part;
        PointNumbering points;
    };

    // --- Entities --------------------------------------------------------------------------------

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

    MaybeError read_entities() {
        for (;;) {
            const auto pair = next_pair();
            if (!pair) return pair.error();
            if (!*pair) break;
            if (code_ == 0) {
                if (auto trouble = take_entity()) return trouble;
                if (value_ == "EOF") return std::nullopt;
                entity_ = {value_, in_.number(), {}};
            } else if (auto trouble = read_group()) {
                return trouble;
            }
        }
        if (section_ == "ENTITIES" && entity_.type != "ENDSEC")
            return in_.error(ErrorCode::bad_syntax, "the file ends within the section ENTITIES");
        return std::nullopt;
    }

    MaybeError read_group() {
        if (entity_.type == "SECTION" && code_ == 2) section_ = value_;
        if (section_ != "ENTITIES" && section_ != "BLOCKS") return std::nullopt;
        constexpr std::array<std::string_view, 7> used{"3DFACE", "POLYLINE", "VERTEX", "MESH",
                                                       "INSERT", "BLOCK",    "SECTION"};
        if (std::ranges::find(used, entity_.type) == used.end()) return std::nullopt;
        Group& group = entity_.groups.emplace_back(Group{code_, value_});
        const bool has_number = (code_ >= 10 && code_ < 100) || (code_ >= 210 && code_ < 240);
        return has_number ? in_.read_number(value_, group.number) : std::nullopt;
    }

    /// Adds the entity that was read to what the file or a block has.
    MaybeError take_entity() {
        const std::string_view type = entity_.type;
        if (type == "ENDSEC") section_ = {};
        if (section_ != "ENTITIES" && section_ != "BLOCKS") return std::nullopt;
        if (type == "BLOCK") {
            block_ = entity_.text(2);
            base_of_[block_] = entity_.point(10);
        }
        if (type == "ENDBLK") block_ = {};
        if (type == "3DFACE") return take_face();
        if (type == "MESH") return take_mesh();
        if (type == "INSERT") items().push_back({entity_.text(8), {}, entity_.text(2), entity_});
        if (type == "POLYLINE") {
            polyline_ = entity_;
            vertices_.clear();
        }
        if (type == "VERTEX") vertices_.push_back(entity_);
        if (type == "SEQEND" && polyline_.type == "POLYLINE") {
            const Entity polyline = std::exchange(polyline_, {});
            if ((polyline.flags(70) & 64U) != 0) return take_polyface(polyline);
            if ((polyline.flags(70) & 16U) != 0) return take_polygon_mesh(polyline);
        }
        return std::nullopt;
    }

    std::vector<Item>& items() { return section_ == "BLOCKS" ? blocks_[block_] : entities_; }

    MaybeError take_face() {
        Item face{entity_.text(8), {}};
        for (std::int64_t corner = 0; corner < 3; ++corner) {
            if (!entity_.has(10 + corner) || !entity_.has(20 + corner))
                return in_.error_at(
                    entity_.line, ErrorCode::bad_syntax,
                    fmt::format("corner {} of the 3DFACE has no x and y", corner + 1));
            face.corners.push_back(entity_.point(10 + corner));
        }
        const bool has_fourth = entity_.has(13) || entity_.has(23) || entity_.has(33);
        if (has_fourth && entity_.point(13) != face.corners[2])
            face.corners.push_back(entity_.point(13));
        items().push_back(std::move(face));
        return std::nullopt;
    }

    /// Adds a face of numbered vertices, which count from 0.
    MaybeError add(const std::string& layer, std::size_t line, const std::vector<Point3>& points,
                   const std::vector<std::int64_t>& numbers) {
        Item face{layer, {}};
        for (const std::int64_t number : numbers) {
            if (number < 0 || number >= static_cast<std::int64_t>(points.size()))
                return in_.error_at(line, ErrorCode::bad_index,
                                    fmt::format("a face names a vertex that does not exist: there "
                                                "are {}",
                                                points.size()));
            face.corners.push_back(points[static_cast<std::size_t>(number)]);
        }
        items().push_back(std::move(face));
        return std::nullopt;
    }

    static std::int64_t integer(double number) {
        return std::fabs(number) < 1e15 ? static_cast<std::int64_t>(number) : -1;
    }

    MaybeError take_polyface(const Entity& polyline) {
        std::vector<Point3> points;
        for (const Entity& v : vertices_)
            if ((v.flags(70) & 64U) != 0) points.push_back(v.point(10));
        for (const Entity& v : vertices_) {
            if ((v.flags(70) & 192U) != 128U) continue;
            std::vector<std::int64_t> numbers; // negative where the edge is not drawn
            for (std::int64_t code = 71; code <= 74; ++code)
                if (const auto n = integer(v.number(code)); n != 0)
                    numbers.push_back(std::abs(n) - 1);
            if (numbers.size() < 3) continue; // a point or an edge
            const std::string layer = v.has(8) ? v.text(8) : polyline.text(8);
            if (auto trouble = add(layer, v.line, points, numbers)) return trouble;
        }
        return std::nullopt;
    }

    MaybeError take_polygon_mesh(const Entity& polyline) {
        const unsigned flags = polyline.flags(70);
        const bool is_smooth = (flags & 4U) != 0;
        const auto rows = integer(polyline.number(is_smooth ? 73 : 71));
        const auto columns = integer(polyline.number(is_smooth ? 74 : 72));
        std::vector<Point3> points;
        for (const Entity& v : vertices_)
            if (!is_smooth || (v.flags(70) & 16U) == 0) points.push_back(v.point(10));
        const auto count = static_cast<std::int64_t>(points.size());
        if (rows < 2 || columns < 2 || rows > count || columns > count || rows * columns != count)
            return in_.error_at(
                polyline.line, ErrorCode::bad_syntax,
                fmt::format("a polygon mesh of {} times {} vertices has {}", rows, columns, count));
        const auto last_row = (flags & 1U) != 0 ? rows : rows - 1;
        const auto last_column = (flags & 32U) != 0 ? columns : columns - 1;
        for (std::int64_t i = 0; i < last_row; ++i)
            for (std::int64_t j = 0; j < last_column; ++j) {
                const auto next_row = (i + 1) % rows * columns, next = (j + 1) % columns;
                if (auto trouble =
                        add(polyline.text(8), polyline.line, points,
                            {i * columns + j, i * columns + next, next_row + next, next_row + j}))
                    return trouble;
            }
        return std::nullopt;
    }

    /// Takes the faces of a MESH as they are given, without its subdivision.
    MaybeError take_mesh() {
        std::vector<Point3> points;
        std::vector<std::int64_t> numbers; // of corners, behind their count
        std::int64_t left = -1;            // entries of the list of faces; -1: it has not begun
        for (const Group& group : entity_.groups) {
            if (group.code == 10 && left < 0) points.push_back({group.number, 0, 0});
            if (group.code == 20 && left < 0 && !points.empty()) points.back().y = group.number;
            if (group.code == 30 && left < 0 && !points.empty()) points.back().z = group.number;
            if (group.code == 93) left = integer(group.number);
            if (group.code != 90 || left <= 0) continue;
            --left;
            numbers.push_back(integer(group.number));
            if (numbers.size() !=
                static_cast<std::size_t>(std::max<std::int64_t>(numbers[0], 0)) + 1)
                continue;
            numbers.erase(numbers.begin());
            if (auto trouble = add(entity_.text(8), entity_.line, points, numbers)) return trouble;
            numbers.clear();
        }
        return std::nullopt;
    }

    // --- Faces -----------------------------------------------------------------------------------

    /// Adds the faces of the file or of a block where they are placed. What is on layer 0 in a block is
    /// on the layer of its insert.
    MaybeError place(const std::vector<Item>& items, const Placement& placement,
                     const std::string& outer, int depth) {
        for (const Item& item : items) {
            const std::string& layer = outer.empty() || item.layer != "0" ? item.layer : outer;
            if (!item.insert.type.empty()) {
                if (auto trouble = place_insert(item, placement, layer, depth)) return trouble;
                continue;
            }
            if (auto trouble = count_placed()) return trouble;
            Layer& to = layer_named(layer.empty() ? std::string(name_) : layer);
            corners_.clear();
            for (const Point3& p : item.corners) {
                const Point3 at = depth == 0 ? p : placement(p);
                if (!is_finite(at))
                    return in_.file_error(ErrorCode::bad_number,
                                          "an INSERT puts a corner at no place, or beyond the "
                                          "largest double");
                corners_.push_back(to.points.number(at));
            }
            append_face(corners_, to.part);
        }
        return std::nullopt;
    }

    MaybeError place_insert(const Item& item, const Placement& placement, const std::string& layer,
                            int depth) {
        constexpr int deepest = 32;
        const auto block = blocks_.find(item.block);
        if (block == blocks_.end()) return std::nullopt; // without faces
        if (depth == deepest)
            return in_.error_at(item.insert.line, ErrorCode::unsupported,
                                "blocks are inserted in each other more than 32 times");
        const Entity& e = item.insert;
        const auto axes = axes_along(
            {e.number(210), e.number(220), e.number(230, e.has(210) || e.has(220) ? 0 : 1)});
        const Placement out{{0, 0, 0}, axes};
        const auto [c, s] = cosine_and_sine(e.number(50));
        const double sx = e.number(41, 1), sy = e.number(42, 1), sz = e.number(43, 1);
        const auto columns = std::max<std::int64_t>(integer(e.number(70, 1)), 1);
        const auto rows = std::max<std::int64_t>(integer(e.number(71, 1)), 1);
        const Point3 base = base_of_[item.block], at = e.point(10);
        for (std::int64_t row = 0; row < rows; ++row)
            for (std::int64_t column = 0; column < columns; ++column) {
                if (auto trouble = count_placed()) return trouble;
                const double u = static_cast<double>(column) * e.number(44);
                const double v = static_cast<double>(row) * e.number(45);
                Placement turned{{at.x + c * u - s * v, at.y + s * u + c * v, at.z},
                                 {{{c * sx, s * sx, 0}, {-s * sy, c * sy, 0}, {0, 0, sz}}}};
                turned.origin = turned({-base.x, -base.y, -base.z});
                if (auto trouble =
                        place(block->second, placement.after(out.after(turned)), layer, depth + 1))
                    return trouble;
            }
        return std::nullopt;
    }

    MaybeError count_placed() {
        if (++placed_ <= most_placed_) return std::nullopt;
        return in_.file_error(ErrorCode::unsupported,
                              "blocks that are inserted again and again make more faces than the "
                              "file has bytes");
    }

    Layer& layer_named(const std::string& name) {
        const auto [at, added] = layer_of_.try_emplace(name, layers_.size());
        if (added) layers_.push_back({{name}, {}});
        return layers_[at->second];
    }

    LineParser in_;
    std::string_view name_;
    bool is_binary_;
    std::int64_t code_ = 0;
    std::string_view value_;
    std::string_view section_;
    Entity entity_;                ///< that is read
    Entity polyline_;              ///< whose vertices are read
    std::vector<Entity> vertices_; ///< and the faces of a polyface
    std::string block_;            ///< that is read
    std::map<std::string, Point3> base_of_;
    std::vector<Item> entities_;
    std::map<std::string, std::vector<Item>> blocks_;
    std::size_t most_placed_, placed_ = 0; ///< faces and inserts
    std::vector<std::uint32_t> corners_;
    std::vector<Layer> layers_;
    std::map<std::string, std::size_t> layer_of_;
};

} // namespace

Result<std::vector<Surface>> read_dxf(std::string_view contents, std::string_view source,
                                      std::string_view name) {
    return DxfReader(contents, source, name).read();
}

} // namespace terrane
