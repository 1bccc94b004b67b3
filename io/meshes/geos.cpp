// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/geos.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/io/meshes/detail/side_sets.hpp>
#include <terrane/io/meshes/detail/vtk_writer.hpp>
#include <terrane/io/text/xml.hpp>

namespace terrane {

using namespace detail;

namespace {

/// Returns first, first + 1, ...
std::vector<std::int64_t> numbers_from(std::size_t first, std::size_t count) {
    std::vector<std::int64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), static_cast<std::int64_t>(first));
    return numbers;
}

/// The nodes of one side of a surface, or of all of it.
struct PointSet {
    std::string name;
    std::vector<std::uint32_t> nodes;
};

std::vector<PointSet> point_sets(const TetrahedralMesh& mesh, const NamedParts& parts) {
    const auto faces = faces_of_surfaces(mesh);
    std::vector<bool> is_split(mesh.surfaces.size(), false);
    for (const auto& twins : mesh.twins)
        for (const auto s : mesh.surfaces_of[twins[0]]) is_split[s] = true;
    std::vector<PointSet> sets;
    for (std::size_t s = 0; s < faces.size(); ++s) {
        if (faces[s].empty()) continue;
        sets.push_back({parts.surfaces[s], nodes_of_faces(mesh, nullptr, faces[s])});
        for (const SideSet& set : parts.side_sets)
            if (is_split[s] && set.surface == s && set.side != CutSide::none)
                sets.push_back({set.name, nodes_of_faces(mesh, nullptr, set.faces)});
    }
    return sets;
}

/// Lists what the numbers of the array `attribute` stand for.
std::string list_of_attributes(const NamedParts& parts, const std::vector<SurfaceGroup>& groups) {
    std::string list = "attribute of tetrahedra:\n";
    for (const auto& block : parts.blocks) list += fmt::format("{} {}\n", block.block, block.name);
    list += "attribute of triangles:\n";
    for (const auto& group : groups) {
        list += fmt::format("{}", group.tag);
        for (const auto s : group.surfaces)
            list += fmt::format(" {}{}", parts.surfaces[s], ending_of(group.side));
        list += '\n';
    }
    return list;
}

std::string main_file(const TetrahedralMesh& mesh, const NamedParts& parts, bool compress) {
    const auto groups = surface_groups(mesh.surfaces_of, mesh.surfaces.size(), cut_sides(mesh));
    const auto count = mesh.tetrahedra.size() + mesh.faces.size();
    std::vector<std::int32_t> attribute(mesh.block_of.begin(), mesh.block_of.end());
    for (const auto tag : group_tags(groups, mesh.faces.size()))
        attribute.push_back(static_cast<std::int32_t>(tag));
    VtkWriter out(compress);
    out.begin_file("UnstructuredGrid");
    out.comment(list_of_attributes(parts, groups));
    out.begin_piece(mesh.vertices.size(), count);
    out.text("<PointData GlobalIds=\"GLOBAL_IDS_POINTS\">");
    out.array("GLOBAL_IDS_POINTS", numbers_from(0, mesh.vertices.size()), 1, true);
    for (const auto& set : point_sets(mesh, parts)) {
        std::vector<std::int64_t> mask(mesh.vertices.size(), 0);
        for (const auto v : set.nodes) mask[v] = 1;
        out.array(set.name, mask);
    }
    out.text("</PointData>\n<CellData GlobalIds=\"GLOBAL_IDS_CELLS\" Scalars=\"attribute\">");
    out.array("GLOBAL_IDS_CELLS", numbers_from(0, count), 1, true);
    out.array("attribute", attribute);
    out.text("</CellData>");
    out.points(mesh.vertices);
    std::vector<std::int64_t> corners, offsets;
    append_nodes(corners, mesh.tetrahedra);
    append_nodes(corners, mesh.faces);
    append_offsets(offsets, mesh.tetrahedra.size(), 4);
    append_offsets(offsets, mesh.faces.size(), 3);
    std::vector<std::uint8_t> types(mesh.tetrahedra.size(), vtk_tetrahedron);
    types.resize(count, vtk_triangle);
    out.cells(corners, offsets, types);
    return out.end_file("UnstructuredGrid");
}

/// The nodes at each place of a cut.
class Places {
public:
    explicit Places(const TetrahedralMesh& mesh) : sets_(mesh.vertices.size()) {
        for (const auto& [front, back] : mesh.twins)
            for (std::size_t k = 0; k < 3; ++k) {
                sets_.join(mesh.faces[front][k], mesh.faces[back][k]);
                nodes_.push_back(mesh.faces[front][k]);
                nodes_.push_back(mesh.faces[back][k]);
            }
        sort_unique(nodes_);
        for (const auto v : nodes_) by_place_.emplace_back(sets_.find(v), v);
        std::sort(by_place_.begin(), by_place_.end());
    }
    std::uint32_t of(std::uint32_t node) { return sets_.find(node); } ///< its lowest node
    /// Returns all nodes there, ascending.
    [[nodiscard]] std::vector<std::uint32_t> nodes_at(std::uint32_t place) const {
        std::vector<std::uint32_t> all;
        auto at = std::lower_bound(by_place_.begin(), by_place_.end(), std::pair(place, 0U));
        for (; at != by_place_.end() && at->first == place; ++at) all.push_back(at->second);
        return all;
    }

private:
    DisjointSets sets_;
    std::vector<std::uint32_t> nodes_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_place_; ///< {place, node}, sorted
};

/// A split surface: one triangle for each pair of twins.
struct Fracture {
    std::string name;
    std::vector<std::uint32_t> places; ///< sorted, unique: its points
    std::vector<Triangle> triangles;   ///< of places
};

std::vector<Fracture> fractures(const TetrahedralMesh& mesh, const NamedParts& parts,
                                Places& places) {
    std::vector<Fracture> all(mesh.surfaces.size());
    for (const auto& twins : mesh.twins)
        for (const auto s : mesh.surfaces_of[twins[0]]) {
            auto corners = mesh.faces[twins[0]];
            for (auto& v : corners) v = places.of(v);
            all[s].triangles.push_back(corners);
            all[s].places.insert(all[s].places.end(), corners.begin(), corners.end());
        }
    for (std::size_t s = 0; s < all.size(); ++s) {
        all[s].name = parts.surfaces[s];
        sort_unique(all[s].places);
    }
    std::erase_if(all, [](const Fracture& f) { return f.triangles.empty(); });
    return all;
}

std::string fracture_file(const TetrahedralMesh& mesh, const Fracture& fracture,
                          const Places& places, std::size_t first_id, bool compress) {
    std::vector<std::vector<std::uint32_t>> nodes;
    std::size_t most = 2;
    std::vector<Point3> points;
    for (const auto place : fracture.places) {
        nodes.push_back(places.nodes_at(place));
        most = std::max(most, nodes.back().size());
        points.push_back(mesh.vertices[place]);
    }
    std::vector<std::int64_t> collocated;
    for (const auto& list : nodes) {
        collocated.insert(collocated.end(), list.begin(), list.end());
        collocated.resize(collocated.size() + most - list.size(), -1);
    }
    std::vector<std::int64_t> corners, offsets;
    for (const auto& triangle : fracture.triangles)
        for (const auto place : triangle)
            corners.push_back(
                std::lower_bound(fracture.places.begin(), fracture.places.end(), place) -
                fracture.places.begin());
    append_offsets(offsets, fracture.triangles.size(), 3);
    VtkWriter out(compress);
    out.begin_file("UnstructuredGrid");
    out.begin_piece(points.size(), fracture.triangles.size());
    out.text("<PointData GlobalIds=\"GLOBAL_IDS_POINTS\">");
    out.array("GLOBAL_IDS_POINTS", numbers_from(0, points.size()), 1, true);
    out.array("collocated_nodes", collocated, static_cast<int>(most), true);
    out.text("</PointData>\n<CellData GlobalIds=\"GLOBAL_IDS_CELLS\">");
    out.array("GLOBAL_IDS_CELLS", numbers_from(first_id, fracture.triangles.size()), 1, true);
    out.text("</CellData>");
    out.points(points);
    out.cells(corners, offsets, std::vector<std::uint8_t>(fracture.triangles.size(), vtk_triangle));
    return out.end_file("UnstructuredGrid");
}

} // namespace

SeveralFiles to_geos(const TetrahedralMesh& mesh, const VtkFiles& files,
                     std::span<const std::string> block_names) {
    auto parts = named_parts(mesh, block_names);
    Places places(mesh);
    SeveralFiles all{{"", ""}};
    std::string list;
    const auto add = [&](const std::string& block, std::string contents) {
        const auto file = fmt::format("{}_{}.vtu", files.stem, block);
        list += fmt::format("<DataSet index=\"{}\" name=\"{}\" file=\"{}\"/>\n", all.size() - 1,
                            xml_escaped(block), xml_escaped(file));
        all.push_back({file, std::move(contents)});
    };
    const auto main = parts.names.add("main", "main"); // a surface may be called so
    add(main, main_file(mesh, parts, files.compress));
    std::size_t triangles = 0;
    for (const auto& fracture : fractures(mesh, parts, places)) {
        add(fracture.name, fracture_file(mesh, fracture, places, triangles, files.compress));
        triangles += fracture.triangles.size();
    }
    all[0].contents = fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" "
                                  "version=\"1.0\" byte_order=\"LittleEndian\">\n"
                                  "<vtkMultiBlockDataSet>\n{}</vtkMultiBlockDataSet>\n</VTKFile>\n",
                                  list);
    return all;
}

} // namespace terrane
