// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The writer of output.hpp for Abaqus.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include <terrane/algorithms/verify/detail/edges.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>

namespace terrane::verifier {

namespace {

/// Makes a name a label: at most 60 capital letters, digits and '_', of which a letter is first.
void make_label(std::string& name) {
    constexpr std::size_t most = 60;
    name.resize(std::min(name.size(), most));
    for (char& c : name)
        if (c >= 'a' && c <= 'z')
            c = static_cast<char>(c - 'a' + 'A');
        else if (!(c >= 'A' && c <= 'Z') && !(c >= '0' && c <= '9'))
            c = '_';
    if (name.empty()) name = "SURFACE";
    if (name[0] < 'A' || name[0] > 'Z') name = "S" + name;
}

class InpWriter {
public:
    InpWriter(Comparison& out, const ExpectedTetrahedra& expected) :
        out_(out), expected_(expected), claim_(expected.claim),
        names_(distinct_names(expected.surfaces, make_label)) {}

    void write() {
        out_ << "*HEADING\nTerrane\n*NODE\n";
        for (std::size_t v = 0; v < claim_.vertices.size(); ++v) {
            const Point3& p = claim_.vertices[v];
            out_ << v + 1 << ", " << p.x << ", " << p.y << ", " << p.z << "\n";
        }
        if (claim_.tetrahedra.empty()) return write_triangles();
        write_tetrahedra();
        for (std::uint32_t s = 0; s < names_.size(); ++s) write_surface(s);
    }

private:
    /// Writes what follows the number of an element, and ends the line.
    void write_nodes(const auto& nodes) {
        for (const std::uint32_t n : nodes) out_ << ", " << n + std::uint64_t(1);
        out_ << "\n";
    }

    /// Writes a set, 16 numbers on a line.
    void write_set(const auto& members) {
        std::size_t left = members.size();
        for (const std::uint32_t n : members) {
            const bool ends = --left == 0 || (members.size() - left) % 16 == 0;
            out_ << n + std::uint64_t(1) << (ends ? "\n" : ", ");
        }
    }

    /// Writes the faces as elements, which all surfaces of a mesh are.
    void write_triangles() {
        out_ << "*ELEMENT, TYPE=S3\n";
        std::vector<Numbers> elements(names_.size());
        for (std::uint32_t f = 0; f < claim_.faces.size(); ++f) {
            out_ << f + 1U;
            write_nodes(claim_.faces[f]);
            for (const std::uint32_t s : expected_.surfaces_of[f]) elements[s].push_back(f);
        }
        for (std::size_t s = 0; s < names_.size(); ++s) {
            if (elements[s].empty()) continue;
            out_ << "*ELSET, ELSET=" << names_[s] << "\n";
            write_set(elements[s]);
        }
    }

    void write_tetrahedra() {
        std::map<std::uint32_t, Numbers> blocks; // the tetrahedra of each block that has some
        for (std::uint32_t t = 0; t < claim_.tetrahedra.size(); ++t)
            blocks[claim_.block_of[t]].push_back(t);
        std::vector<SurfaceInfo> called;
        for (std::uint32_t b = 0; b <= blocks.rbegin()->first; ++b) {
            const std::string& name = expected_.block_names[b];
            called.push_back({name.empty() ? name_of_block(b, "") : name, Role::unknown});
        }
        const auto labels = distinct_names(called, make_label);
        for (const auto& [block, tetrahedra] : blocks) {
            out_ << "** " << name_of_block(block, expected_.block_names[block])
                 << "\n*ELEMENT, TYPE=C3D4, ELSET=" << labels[block] << "\n";
            for (const std::uint32_t t : tetrahedra) {
                out_ << t + 1U;
                write_nodes(claim_.tetrahedra[t]);
            }
        }
        static constexpr std::array<Triangle, 4> corners{
            {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}}; // of S1 to S4, seen from inside
        for (std::uint32_t t = 0; t < claim_.tetrahedra.size(); ++t)
            for (std::uint32_t side = 0; side < 4; ++side) {
                const auto& [i, j, k] = corners[side];
                const auto& v = claim_.tetrahedra[t];
                sides_[with_least_first({v[i], v[j], v[k]})] = {t, side};
            }
    }

    /// Writes the nodes of a surface, the sides of tetrahedra in front of it and behind it, and the
    /// pairs of nodes at a cut.
    void write_surface(std::uint32_t surface) {
        std::set<std::uint32_t> nodes;
        Numbers faces;
        for (std::uint32_t f = 0; f < claim_.faces.size(); ++f)
            if (std::ranges::count(expected_.surfaces_of[f], surface) > 0) {
                faces.push_back(f);
                nodes.insert(claim_.faces[f].begin(), claim_.faces[f].end());
            }
        if (faces.empty()) return;
        out_ << "*NSET, NSET=" << names_[surface] << "\n";
        write_set(nodes);
        write_sides(surface, faces, "_FRONT");
        write_sides(surface, faces, "_BACK");
        std::set<Edge> pairs;
        for (const auto& [front, back] : claim_.twins)
            if (std::ranges::count(expected_.surfaces_of[front], surface) > 0)
                add_pairs(claim_, front, back, pairs);
        if (pairs.empty()) return;
        for (const std::size_t side : {0, 1}) {
            Numbers ends;
            for (const Edge& pair : pairs) ends.push_back(pair[side]);
            out_ << "*NSET, NSET=" << names_[surface] << "_PAIRS"
                 << (side == 0 ? "_FRONT" : "_BACK") << ", UNSORTED\n";
            write_set(ends);
        }
    }

    void write_sides(std::uint32_t surface, const Numbers& faces, std::string_view ending) {
        bool begun = false;
        for (const std::uint32_t f : faces) {
            Triangle face = claim_.faces[f];
            if (ending == "_BACK") std::swap(face[1], face[2]);
            const auto side = sides_.find(with_least_first(face));
            if (side == sides_.end()) continue;
            if (!std::exchange(begun, true))
                out_ << "*SURFACE, TYPE=ELEMENT, NAME=" << names_[surface] << ending << "\n";
            out_ << side->second[0] + std::uint64_t(1) << ", S" << side->second[1] + 1U << "\n";
        }
    }

    Comparison& out_;
    const ExpectedTetrahedra& expected_;
    const TetrahedraClaim& claim_;
    std::vector<std::string> names_; ///< labels of surfaces
    std::map<Triangle, std::array<std::uint32_t, 2>>
        sides_; ///< tetrahedron, side; seen from inside
};

} // namespace

void write_inp(Comparison& out, const ExpectedTetrahedra& expected) {
    InpWriter(out, expected).write();
}

} // namespace terrane::verifier
