// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/pvtp.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/tiles/pieces.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/meshes/cell_array.hpp>
#include <terrane/io/meshes/detail/vtk_data.hpp>
#include <terrane/io/meshes/detail/vtk_writer.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/xml.hpp>

namespace terrane {

namespace fs = std::filesystem;
using namespace detail;

namespace {

constexpr std::string_view node_ids = "GlobalNodeIds", element_ids = "GlobalElementIds";
constexpr std::string_view cell_arrays[] = {"surface", "surface_count", "region", "parent"};
constexpr std::string_view side_arrays[] = {"volume_front", "volume_back"};

std::vector<std::int32_t> firsts(const IndexLists<std::uint32_t>& lists) {
    std::vector<std::int32_t> values;
    for (std::size_t i = 0; i < lists.size(); ++i)
        values.push_back(lists[i].empty() ? -1 : static_cast<std::int32_t>(lists[i][0]));
    return values;
}

std::vector<std::int64_t> wide(const std::vector<std::uint32_t>& values) {
    return {values.begin(), values.end()};
}

/// Reads a piece, which to_vtp_piece() wrote. Other programs write pieces otherwise.
class PieceReader {
public:
    explicit PieceReader(std::string_view contents) : contents_(contents) {}

    Result<tiles::TilePiece> operator()() {
        const auto parsed = document_.load_buffer(contents_.data(), contents_.size());
        if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
        const pugi::xml_node root = document_.child("VTKFile"), data = root.child("PolyData"),
                             piece = data.child("Piece");
        if (!parsed || !piece) return flaw("this is no piece in VTK's XML format PolyData");
        const std::string_view compressor = root.attribute("compressor").value();
        if (!compressor.empty()) encoding_.compressor = VtkCompressor::zlib; // as it is written
        encoding_.wide_headers =
            std::string_view(root.attribute("header_type").value()) == "UInt64";
        read_surfaces(data.child("FieldData"));
        read_points(piece);
        read_cells(data, piece);
        if (flaw_) return flaw(*flaw_);
        return std::move(out_);
    }

private:
    static Error flaw(std::string sentence) {
        return {ErrorCode::bad_syntax, std::move(sentence), ""};
    }
    void note(std::string sentence) {
        if (!flaw_) flaw_ = std::move(sentence);
    }

    static pugi::xml_node named(const pugi::xml_node& parent, std::string_view name) {
        for (const pugi::xml_node array : parent.children())
            if (name == array.attribute("Name").value()) return array;
        return {};
    }

    template <class Number>
    std::vector<Number> values(const pugi::xml_node& array, std::string_view name) {
        std::vector<Number> numbers;
        if (!array) {
            note(fmt::format("a piece has no array {}", name));
            return numbers;
        }
        std::string text = array.child_value(), bytes;
        std::erase_if(text, [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; });
        auto trouble = decode_vtk(text, true, 0, encoding_, bytes, used_);
        if (!trouble && used_ > 2 * contents_.size() + 64) trouble = "the data of arrays overlap";
        if (!trouble)
            trouble = convert_vtk(bytes, array.attribute("type").value(), encoding_.order, numbers);
        if (trouble) note(fmt::format("array {}: {}", name, *trouble));
        return numbers;
    }

    std::vector<std::uint32_t> numbers(const pugi::xml_node& array, std::string_view name) {
        const auto all = values<std::int64_t>(array, name);
        std::vector<std::uint32_t> narrow;
        narrow.reserve(all.size());
        for (const std::int64_t value : all) {
            if (value < 0 || value > INT32_MAX)
                return note(fmt::format("array {} has the value {}", name, value)),
                       std::vector<std::uint32_t>();
            narrow.push_back(static_cast<std::uint32_t>(value));
        }
        return narrow;
    }

    /// Reads strings as character codes, each string ended by a 0.
    static std::vector<std::string> strings(const pugi::xml_node& array) {
        std::vector<std::string> all;
        std::string text;
        for (const char* at = array.child_value(); *at != '\0';) {
            char* end = nullptr;
            const long code = std::strtol(at, &end, 10);
            if (end == at) break;
            at = end;
            if (code != 0)
                text += static_cast<char>(code & 255);
            else
                all.push_back(std::exchange(text, {}));
        }
        return all;
    }

    void read_surfaces(const pugi::xml_node& field) {
        const auto names = strings(named(field, "surface_name")),
                   roles = strings(named(field, "surface_role"));
        if (names.empty()) note("a piece has no names of surfaces");
        for (std::size_t s = 0; s < names.size(); ++s) {
            SurfaceInfo& info = out_.mesh.surfaces.emplace_back();
            info.name = names[s];
            for (std::size_t r = 0; r < role_names.size(); ++r)
                if (s < roles.size() && roles[s] == role_names[r]) info.role = Role(r);
        }
    }

    void read_points(const pugi::xml_node& piece) {
        const auto x = values<double>(piece.child("Points").child("DataArray"), "Points");
        for (std::size_t i = 0; i + 2 < x.size(); i += 3)
            out_.mesh.vertices.push_back({x[i], x[i + 1], x[i + 2]});
        if (!std::all_of(x.begin(), x.end(), [](double c) { return std::isfinite(c); }))
            note("a coordinate is not finite");
        out_.vertex_ids = numbers(named(piece.child("PointData"), node_ids), node_ids);
    }

    void read_cells(const pugi::xml_node& data, const pugi::xml_node& piece) {
        Mesh& mesh = out_.mesh;
        const auto corners = numbers(named(piece.child("Polys"), "connectivity"), "connectivity");
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        const auto cells = piece.child("CellData");
        out_.triangle_ids = numbers(named(cells, element_ids), element_ids);
        const auto each_alone = [&](std::string_view name) {
            IndexLists<std::uint32_t> lists;
            lists.values = numbers(named(cells, name), name);
            for (std::uint32_t k = 1; k <= lists.values.size(); ++k) lists.offsets.push_back(k);
            return lists;
        };
        mesh.regions_of = each_alone("region");
        mesh.parents_of = each_alone("parent");
        mesh.surfaces_of = each_alone("surface");
        const auto field = data.child("FieldData");
        if (named(field, "surfaces")) {
            mesh.surfaces_of.values = numbers(named(field, "surfaces"), "surfaces");
            mesh.surfaces_of.offsets = numbers(named(field, "surfaces_offset"), "surfaces_offset");
        }
        check_lists();
    }

    void check_lists() {
        const auto& lists = out_.mesh.surfaces_of;
        const bool sound = !lists.offsets.empty() && lists.offsets.front() == 0 &&
                           lists.offsets.back() == lists.values.size() &&
                           std::is_sorted(lists.offsets.begin(), lists.offsets.end());
        if (!sound) {
            note("the lists of surfaces do not fit the triangles");
            out_.mesh.surfaces_of = {};
        }
        for (const std::uint32_t s : lists.values)
            if (s >= out_.mesh.surfaces.size())
                return note(fmt::format("a triangle is of surface {}, which is not named", s));
    }

    std::string_view contents_;
    pugi::xml_document document_;
    VtkEncoding encoding_;
    std::size_t used_ = 0;
    tiles::TilePiece out_;
    std::optional<std::string> flaw_;
};

/// Returns the path of a piece, if it is in the folder of the file that names it.
Result<fs::path> path_of_piece(const fs::path& file, const std::string& source) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const auto refuse = [&](std::string_view why) {
        return Error{ErrorCode::unsupported, fmt::format("the piece {} {}", shown(source), why),
                     file.string()};
    };
    const fs::path relative(source);
    if (source.empty() || relative.is_absolute())
        return refuse("is not named by a path from the folder of the file");
    for (const auto& step : relative)
        if (step == "..") return refuse("is outside of the folder of the file");
    std::error_code failed;
    const auto real_folder = fs::canonical(folder, failed);
    if (failed) return refuse("cannot be found");
    const auto real = fs::canonical(folder / relative, failed);
    if (failed) return refuse("is missing");
    const auto [end, ignored] =
        std::mismatch(real_folder.begin(), real_folder.end(), real.begin(), real.end());
    if (end != real_folder.end()) return refuse("is outside of the folder of the file");
    return real;
}

Result<std::vector<fs::path>> paths_of_pieces(const fs::path& path) {
    const auto contents = read_file(path);
    if (!contents) return contents.error();
    pugi::xml_document document;
    const auto parsed = document.load_buffer(contents->data(), contents->size());
    if (parsed.status == pugi::status_out_of_memory) throw std::bad_alloc();
    const pugi::xml_node data = document.child("VTKFile").child("PPolyData");
    if (!parsed || !data)
        return Error{ErrorCode::bad_syntax, "this is no file in VTK's XML format PPolyData",
                     path.string()};
    std::vector<fs::path> pieces;
    std::set<fs::path> named;
    for (const pugi::xml_node piece : data.children("Piece")) {
        auto found = path_of_piece(path, piece.attribute("Source").value());
        if (!found) return found.error();
        if (!named.insert(*found).second)
            return Error{ErrorCode::bad_syntax, "a piece is named twice: " + found->string(),
                         path.string()};
        pieces.push_back(std::move(*found));
    }
    if (pieces.empty())
        return Error{ErrorCode::bad_syntax, "the file names no pieces", path.string()};
    return pieces;
}

Result<Mesh> join_pieces(const fs::path& path) {
    const auto files = paths_of_pieces(path);
    if (!files) return files.error();
    std::vector<tiles::TilePiece> pieces;
    std::size_t vertices = 0, triangles = 0;
    for (const fs::path& file : *files) {
        const auto contents = read_file(file);
        if (!contents) return contents.error();
        auto piece = PieceReader(*contents)();
        if (!piece) return Error{piece.error().code, piece.error().sentence, file.string()};
        for (const std::uint32_t id : piece->vertex_ids)
            vertices = std::max<std::size_t>(vertices, id + std::size_t{1});
        triangles += piece->triangle_ids.size();
        pieces.push_back(std::move(*piece));
    }
    std::size_t held = 0;
    for (const auto& piece : pieces) held += piece.mesh.vertices.size();
    if (vertices > held)
        return Error{ErrorCode::bad_index, "the numbers of vertices have gaps", path.string()};
    tiles::PieceJoiner joiner(vertices, triangles);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (auto added = joiner.add(pieces[k]); !added)
            return Error{added.error().code, added.error().sentence, (*files)[k].string()};
        pieces[k] = {};
    }
    auto mesh = std::move(joiner).finish();
    if (!mesh) return Error{mesh.error().code, mesh.error().sentence, path.string()};
    return mesh;
}

} // namespace

std::string to_vtp_piece(const tiles::TilePiece& piece, bool has_volumes) {
    const Mesh& mesh = piece.mesh;
    VtkWriter out(true);
    out.begin_file("PolyData");
    out.field(mesh.surfaces, mesh.surfaces_of, "", {});
    out.text(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                         "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">",
                         mesh.vertices.size(), mesh.triangles.size()));
    out.text(fmt::format("<PointData GlobalIds=\"{}\">", node_ids));
    out.array(node_ids, wide(piece.vertex_ids), 1, true);
    out.text("</PointData>");
    out.text(fmt::format("<CellData Scalars=\"surface\" GlobalIds=\"{}\">", element_ids));
    out.array("surface", firsts(mesh.surfaces_of));
    std::vector<std::int32_t> counts;
    for (std::size_t t = 0; t < mesh.surfaces_of.size(); ++t)
        counts.push_back(static_cast<std::int32_t>(mesh.surfaces_of[t].size()));
    out.array("surface_count", counts);
    out.array("region", firsts(mesh.regions_of));
    out.array("parent", firsts(mesh.parents_of));
    if (has_volumes)
        for (const CellArray& side : volume_cells(piece.volumes_of_sides))
            out.array(side.name, std::get<std::vector<std::int32_t>>(side.values));
    out.array(element_ids, wide(piece.triangle_ids), 1, true);
    out.text("</CellData>");
    out.points(mesh.vertices);
    std::vector<std::int64_t> corners, offsets;
    append_nodes(corners, mesh.triangles);
    append_offsets(offsets, mesh.triangles.size(), 3);
    out.text("<Polys>");
    out.array("connectivity", corners);
    out.array("offsets", offsets);
    out.text("</Polys>");
    return out.end_file("PolyData");
}

std::string to_pvtp(std::span<const std::string> pieces, bool has_volumes) {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"1.0\" "
                       "byte_order=\"LittleEndian\" header_type=\"UInt64\" "
                       "compressor=\"vtkZLibDataCompressor\">\n<PPolyData GhostLevel=\"0\">\n";
    text += fmt::format("<PPointData GlobalIds=\"{0}\">\n<PDataArray type=\"Int64\" IdType=\"1\" "
                        "Name=\"{0}\"/>\n</PPointData>\n<PCellData Scalars=\"surface\" "
                        "GlobalIds=\"{1}\">\n",
                        node_ids, element_ids);
    const auto name_array = [&](std::string_view name) {
        text += fmt::format("<PDataArray type=\"Int32\" Name=\"{}\"/>\n", name);
    };
    for (const auto name : cell_arrays) name_array(name);
    for (std::size_t side = 0; has_volumes && side < 2; ++side) name_array(side_arrays[side]);
    text += fmt::format("<PDataArray type=\"Int64\" IdType=\"1\" Name=\"{}\"/>\n</PCellData>\n"
                        "<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" "
                        "NumberOfComponents=\"3\"/>\n</PPoints>\n",
                        element_ids);
    for (const std::string& piece : pieces)
        text += fmt::format("<Piece Source=\"{}\"/>\n", xml_escaped(piece));
    return text + "</PPolyData>\n</VTKFile>\n";
}

fs::path folder_of_pieces(const fs::path& path) {
    return path.parent_path() / (path.stem().string() + "_pieces");
}

std::string name_of_piece(const fs::path& path, std::size_t piece) {
    return fmt::format("{}_{}.vtp", path.stem().string(), piece);
}

Result<Mesh> read_pvtp(const fs::path& path) {
    const auto join = [&] {
        return guard_memory(path.string(), [&] { return join_pieces(path); });
    };
    return guard_memory("", join); // the name of the place takes memory, too
}

} // namespace terrane
