// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/exodus.hpp>

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/io/meshes/detail/netcdf.hpp>
#include <terrane/io/meshes/detail/side_sets.hpp>

namespace terrane {

using namespace detail;

namespace {

/// The side in Exodus of each side of a tetrahedron (face_sides.hpp).
constexpr std::array<std::int32_t, 4> exodus_sides{4, 1, 2, 3};

struct NodeSet {
    std::size_t tag = 0;
    std::string name;
    std::vector<std::uint32_t> nodes;
};

/// Adds the two sets of nodes at one place, in the order of the pairs.
void add_pair_sets(std::size_t tag, const std::vector<NodePair>& pairs, const std::string& name,
                   NamedParts& parts, std::vector<NodeSet>& sets) {
    if (pairs.empty()) return;
    for (const std::size_t side : {0, 1}) {
        const std::string ending = side == 0 ? "_pairs_front" : "_pairs_back";
        NodeSet set{tag + side, parts.names.add(name + ending, "surface"), {}};
        for (const NodePair& pair : pairs) set.nodes.push_back(pair[side]);
        sets.push_back(std::move(set));
    }
}

/// Returns the nodes on a line along these edges.
std::vector<std::uint32_t> nodes_of_edges(const TetrahedralMesh& mesh, const EdgeNodes* nodes,
                                          const std::vector<Edge>& edges,
                                          std::span<const std::uint32_t> faces) {
    std::vector<std::uint32_t> all;
    for (const auto face : faces)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = mesh.faces[face][k], b = mesh.faces[face][(k + 1) % 3];
            if (!std::binary_search(edges.begin(), edges.end(),
                                    Edge{std::min(a, b), std::max(a, b)}))
                continue;
            all.insert(all.end(), {a, b});
            if (nodes) all.push_back(nodes->of_faces[face][k]);
        }
    sort_unique(all);
    return all;
}

std::vector<NodeSet> find_node_sets(const TetrahedralMesh& mesh, const EdgeNodes* nodes,
                                    NamedParts& parts) {
    const auto faces = faces_of_surfaces(mesh);
    const auto pairs = nodes ? node_pairs(mesh, *nodes) : node_pairs(mesh);
    const auto ends = buried_edges(mesh);
    const auto count = mesh.surfaces.size();
    std::vector<NodeSet> sets;
    for (std::size_t s = 0; s < count; ++s) {
        if (faces[s].empty()) continue;
        const auto& name = parts.surfaces[s];
        sets.push_back({s + 1, name, nodes_of_faces(mesh, nodes, faces[s])});
        for (const SideSet& side : parts.side_sets)
            if (!pairs[s].empty() && side.surface == s && side.side != CutSide::none)
                sets.push_back({side.tag, side.name, nodes_of_faces(mesh, nodes, side.faces)});
        add_pair_sets(3 * count + 2 * s + 1, pairs[s], name, parts, sets);
        if (mesh.surfaces[s].role != Role::fault || ends[s].empty()) continue;
        sets.push_back({5 * count + s + 1, parts.names.add(name + "_edges", "surface"),
                        nodes_of_edges(mesh, nodes, ends[s], faces[s])});
    }
    return sets;
}

/// Writes one file; the names of dimensions and variables are those of the reference.
class ExodusWriter {
public:
    ExodusWriter(const TetrahedralMesh& mesh, const EdgeNodes* nodes,
                 std::span<const std::string> block_names) :
        mesh_(mesh),
        nodes_(nodes), parts_(named_parts(mesh, block_names)),
        node_sets_(find_node_sets(mesh, nodes, parts_)) {}

    Result<std::string> operator()() {
        for (const auto& block : parts_.blocks) widen(block.name);
        for (const auto& set : parts_.side_sets) widen(set.name);
        for (const auto& set : node_sets_) widen(set.name);
        begin();
        coordinates();
        blocks();
        side_sets();
        node_sets();
        return file_.contents();
    }

private:
    void widen(const std::string& name) { width_ = std::max(width_, name.size() + 1); }

    void begin() {
        constexpr float version = 5.1F;
        file_.attribute("api_version", version);
        file_.attribute("version", version);
        file_.attribute("floating_point_word_size", 8);
        file_.attribute("file_size", 1); // one array per coordinate
        file_.attribute("maximum_name_length", static_cast<std::int32_t>(width_ - 1));
        file_.attribute("int64_status", 0);
        file_.attribute("title", "Terrane");
        constexpr std::size_t most_of_string = 32, most_of_line = 80;
        file_.dimension("len_string", most_of_string + 1);
        file_.dimension("len_line", most_of_line + 1);
        length_of_name_ = file_.dimension("len_name", width_);
        const auto time = file_.dimension("time_step", 0);
        file_.numbers("time_whole", {time}, {});
    }

    void coordinates() {
        const auto& vertices = nodes_ ? nodes_->vertices : mesh_.vertices;
        const auto dimensions = file_.dimension("num_dim", 3);
        const auto count = file_.dimension("num_nodes", vertices.size());
        file_.texts("coor_names", {dimensions, length_of_name_},
                    std::vector<std::string>{"x", "y", "z"}, width_);
        std::vector<double> values(vertices.size());
        const auto write = [&](const char* name, double Point3::*coordinate) {
            for (std::size_t v = 0; v < vertices.size(); ++v) values[v] = vertices[v].*coordinate;
            file_.numbers(name, {count}, values);
        };
        write("coordx", &Point3::x);
        write("coordy", &Point3::y);
        write("coordz", &Point3::z);
    }

    /// Writes the numbers and names of all parts of a kind.
    template <class Parts, class Number>
    void list(const char* start, std::size_t count, const Parts& parts, const Number& number) {
        std::vector<std::int32_t> numbers;
        std::vector<std::string> names;
        for (const auto& part : parts) {
            numbers.push_back(static_cast<std::int32_t>(number(part)));
            names.push_back(part.name);
        }
        const std::vector<std::int32_t> status(numbers.size(), 1); // there are members
        file_.integers(fmt::format("{}_status", start), {count}, status);
        file_.integers(fmt::format("{}_prop1", start), {count}, numbers);
        file_.describe("name", "ID");
        file_.texts(fmt::format("{}_names", start), {count, length_of_name_}, names, width_);
    }

    void blocks() {
        file_.dimension("num_elem", mesh_.tetrahedra.size());
        const auto count = file_.dimension("num_el_blk", parts_.blocks.size());
        list("eb", count, parts_.blocks, [](const ElementBlock& block) { return block.number; });
        number_of_.resize(mesh_.tetrahedra.size());
        std::int32_t elements = 0;
        for (std::size_t b = 0; b < parts_.blocks.size(); ++b) {
            std::vector<std::int32_t> corners;
            for (const auto t : parts_.blocks[b].tetrahedra) {
                number_of_[t] = ++elements;
                for (const auto v : mesh_.tetrahedra[t]) corners.push_back(node(v));
                if (nodes_) // in the order of corners_of_edge, as the reference has it
                    for (const auto v : nodes_->of_tetrahedra[t]) corners.push_back(node(v));
            }
            const auto members = file_.dimension(fmt::format("num_el_in_blk{}", b + 1),
                                                 parts_.blocks[b].tetrahedra.size());
            const auto width =
                file_.dimension(fmt::format("num_nod_per_el{}", b + 1), nodes_ ? 10 : 4);
            file_.integers(fmt::format("connect{}", b + 1), {members, width}, corners);
            file_.describe("elem_type", nodes_ ? "TETRA10" : "TETRA");
        }
    }

    void side_sets() {
        if (parts_.side_sets.empty()) return;
        const auto count = file_.dimension("num_side_sets", parts_.side_sets.size());
        list("ss", count, parts_.side_sets, [](const SideSet& set) { return set.tag; });
        for (std::size_t i = 0; i < parts_.side_sets.size(); ++i) {
            std::vector<std::int32_t> elements, sides;
            for (const auto& side : parts_.side_sets[i].sides) {
                elements.push_back(number_of_[side.tetrahedron]);
                sides.push_back(exodus_sides[side.side]);
            }
            const auto members =
                file_.dimension(fmt::format("num_side_ss{}", i + 1), elements.size());
            file_.integers(fmt::format("elem_ss{}", i + 1), {members}, elements);
            file_.integers(fmt::format("side_ss{}", i + 1), {members}, sides);
        }
    }

    void node_sets() {
        if (node_sets_.empty()) return;
        const auto count = file_.dimension("num_node_sets", node_sets_.size());
        list("ns", count, node_sets_, [](const NodeSet& set) { return set.tag; });
        for (std::size_t i = 0; i < node_sets_.size(); ++i) {
            std::vector<std::int32_t> nodes;
            for (const auto v : node_sets_[i].nodes) nodes.push_back(node(v));
            const auto members = file_.dimension(fmt::format("num_nod_ns{}", i + 1), nodes.size());
            file_.integers(fmt::format("node_ns{}", i + 1), {members}, nodes);
        }
    }

    static std::int32_t node(std::uint32_t v) { return static_cast<std::int32_t>(v + 1); }

    const TetrahedralMesh& mesh_;
    const EdgeNodes* nodes_;
    NamedParts parts_;
    std::vector<NodeSet> node_sets_;
    NetcdfFile file_;
    std::size_t width_ = 33; ///< bytes of a name, with a 0 at its end
    std::size_t length_of_name_ = 0;
    std::vector<std::int32_t> number_of_; ///< per tetrahedron: its number in the file
};

} // namespace

Result<std::string> to_exodus(const TetrahedralMesh& mesh, std::span<const std::string> block_names,
                              const EdgeNodes* nodes) {
    return ExodusWriter(mesh, nodes, block_names)();
}

} // namespace terrane
