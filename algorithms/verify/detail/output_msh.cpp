// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The writers of output.hpp for MSH 4.1 and 2.2.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>

namespace terrane::verifier {

namespace {

/// Cells that the file keeps together.
struct Group {
    std::uint64_t tag = 0;
    std::vector<std::uint64_t> physical; ///< tags of what they belong to
    Numbers cells;                       ///< ascending
};

/// Writes both versions.
class MshWriter {
public:
    MshWriter(Comparison& out, const ExpectedTetrahedra& expected) :
        out_(out), expected_(expected), claim_(expected.claim), sides_(cut_sides(claim_)) {
        for (std::uint32_t t = 0; t < claim_.tetrahedra.size(); ++t)
            blocks_[claim_.block_of[t]].push_back(t);
    }

    void write_41() {
        write_start("4.1");
        const auto faces = face_groups();
        const auto volumes = volume_groups();
        out_ << "$Entities\n0 0 " << faces.size() << " " << volumes.size() << "\n";
        write_entities(faces, claim_.faces);
        write_entities(volumes, claim_.tetrahedra);
        out_ << "$EndEntities\n";
        if (!volumes.empty())
            write_nodes("3 ", volumes[0]);
        else if (!faces.empty())
            write_nodes("2 ", faces[0]);
        const std::size_t count = claim_.tetrahedra.size() + claim_.faces.size();
        out_ << "$Elements\n"
             << volumes.size() + faces.size() << " " << count << " 1 " << count << "\n";
        write_elements(volumes, claim_.tetrahedra, "3 ", " 4 ", 1);
        write_elements(faces, claim_.faces, "2 ", " 2 ", claim_.tetrahedra.size() + 1);
        out_ << "$EndElements\n";
        write_periodic_41(faces);
    }

    void write_22() {
        write_start("2.2");
        out_ << "$Nodes\n" << claim_.vertices.size() << "\n";
        for (std::size_t v = 0; v < claim_.vertices.size(); ++v)
            out_ << v + 1 << " " << claim_.vertices[v] << "\n";
        out_ << "$EndNodes\n$Elements\n"
             << claim_.tetrahedra.size() + expected_.surfaces_of.values.size() << "\n";
        for (std::size_t t = 0; t < claim_.tetrahedra.size(); ++t)
            write_element(" 4 2 ", block_tag(claim_.block_of[t]), claim_.tetrahedra[t]);
        for (std::size_t f = 0; f < claim_.faces.size(); ++f)
            for (const std::uint32_t s : expected_.surfaces_of[f])
                write_element(" 2 2 ", surface_tag(s, sides_[f]), claim_.faces[f]);
        out_ << "$EndElements\n";
        write_periodic_22();
    }

private:
    /// The tag of a surface, or of one of its sides at a cut.
    [[nodiscard]] std::uint64_t surface_tag(std::uint32_t surface, std::int32_t side) const {
        if (side == 0) return surface + 1U;
        return expected_.surfaces.size() + 2 * std::uint64_t(surface) +
               static_cast<std::uint64_t>(side);
    }

    /// The tag of a block as a physical volume, which no surface has.
    [[nodiscard]] std::uint64_t block_tag(std::uint32_t block) const {
        return 3 * expected_.surfaces.size() + block + 1;
    }

    // --- The start of both versions -------------------------------------------------------------

    void write_start(std::string_view version) {
        out_ << "$MeshFormat\n" << version << " 0 8\n$EndMeshFormat\n";
        const auto names = distinct_names(expected_.surfaces, make_quotable);
        std::map<std::uint64_t, std::string> split; // sides of cuts
        for (std::uint32_t f = 0; f < claim_.faces.size(); ++f)
            if (sides_[f] != 0)
                for (const std::uint32_t s : expected_.surfaces_of[f])
                    split[surface_tag(s, sides_[f])] =
                        names[s] + (sides_[f] == 1 ? " front" : " back");
        out_ << "$PhysicalNames\n" << names.size() + split.size() + blocks_.size() << "\n";
        for (std::size_t s = 0; s < names.size(); ++s)
            out_ << "2 " << s + 1 << " \"" << names[s] << "\"\n";
        for (const auto& [tag, name] : split) out_ << "2 " << tag << " \"" << name << "\"\n";
        for (const auto& [block, cells] : blocks_)
            out_ << "3 " << block_tag(block) << " \""
                 << name_of_block(block, expected_.block_names[block]) << "\"\n";
        out_ << "$EndPhysicalNames\n";
    }

    // --- MSH 4.1 ---------------------------------------------------------------------------------

    /// Returns the faces of the same surfaces on the same side of a cut.
    [[nodiscard]] std::vector<Group> face_groups() const {
        std::map<std::pair<Numbers, std::int32_t>, Numbers> faces_of;
        for (std::uint32_t f = 0; f < claim_.faces.size(); ++f) {
            const auto surfaces = expected_.surfaces_of[f];
            faces_of[{{surfaces.begin(), surfaces.end()}, sides_[f]}].push_back(f);
        }
        std::vector<Group> groups;
        std::uint64_t next = expected_.surfaces.size() + 1;
        for (const auto& [key, faces] : faces_of) {
            const auto& [surfaces, side] = key;
            Group group{surfaces.size() == 1 && side == 0 ? surfaces[0] + 1U : next++, {}, faces};
            for (const std::uint32_t s : surfaces) group.physical.push_back(surface_tag(s, side));
            groups.push_back(std::move(group));
        }
        return groups;
    }

    [[nodiscard]] std::vector<Group> volume_groups() const {
        std::vector<Group> groups;
        for (const auto& [block, cells] : blocks_)
            groups.push_back({block + 1U, {block_tag(block)}, cells});
        return groups;
    }

    void write_entities(const std::vector<Group>& groups, const auto& cells) {
        for (const Group& group : groups) {
            Point3 low = claim_.vertices[cells[group.cells[0]][0]], high = low;
            for (const std::uint32_t cell : group.cells)
                for (const std::uint32_t node : cells[cell]) {
                    const Point3& p = claim_.vertices[node];
                    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
                }
            out_ << group.tag << " " << low << " " << high << " " << group.physical.size();
            for (const std::uint64_t tag : group.physical) out_ << " " << tag;
            out_ << " 0\n";
        }
    }

    /// Writes all nodes, which belong to one entity.
    void write_nodes(std::string_view dimension, const Group& entity) {
        const std::size_t count = claim_.vertices.size();
        out_ << "$Nodes\n1 " << count << " 1 " << count << "\n"
             << dimension << entity.tag << " 0 " << count << "\n";
        for (std::size_t v = 0; v < count; ++v) out_ << v + 1 << "\n";
        for (const Point3& p : claim_.vertices) out_ << p << "\n";
        out_ << "$EndNodes\n";
    }

    void write_elements(const std::vector<Group>& groups, const auto& cells,
                        std::string_view dimension, std::string_view type, std::uint64_t first) {
        for (const Group& group : groups) {
            out_ << dimension << group.tag << type << group.cells.size() << "\n";
            for (const std::uint32_t cell : group.cells) {
                out_ << first + cell;
                write_nodes_of(cells[cell]);
            }
        }
    }

    void write_nodes_of(const auto& cell) {
        for (const std::uint32_t node : cell) out_ << " " << node + std::uint64_t(1);
        out_ << "\n";
    }

    /// Writes the nodes behind each cut with those at the same points in front of it.
    void write_periodic_41(const std::vector<Group>& faces) {
        if (claim_.twins.empty()) return;
        std::vector<std::uint64_t> tag_of(claim_.faces.size());
        for (const Group& group : faces)
            for (const std::uint32_t f : group.cells) tag_of[f] = group.tag;
        std::map<std::pair<std::uint64_t, std::uint64_t>, std::set<Edge>> pairs_of;
        for (const auto& [front, back] : claim_.twins)
            add_pairs(claim_, front, back, pairs_of[{tag_of[front], tag_of[back]}]);
        out_ << "$Periodic\n" << pairs_of.size() << "\n";
        for (const auto& [tags, pairs] : pairs_of) {
            out_ << "2 " << tags.second << " " << tags.first << "\n0\n";
            write_pairs(pairs);
        }
        out_ << "$EndPeriodic\n";
    }

    void write_pairs(const std::set<Edge>& pairs) {
        out_ << pairs.size() << "\n";
        for (const auto& [front, back] : pairs)
            out_ << back + std::uint64_t(1) << " " << front + std::uint64_t(1) << "\n";
    }

    // --- MSH 2.2 ---------------------------------------------------------------------------------

    /// Writes an element, numbered from 1 on; `type` also has the number of its tags.
    void write_element(std::string_view type, std::uint64_t tag, const auto& nodes) {
        out_ << ++elements_ << type << tag << " " << tag;
        write_nodes_of(nodes);
    }

    void write_periodic_22() {
        std::map<std::uint32_t, std::set<Edge>> pairs_of; // per surface
        for (const auto& [front, back] : claim_.twins)
            for (const std::uint32_t s : expected_.surfaces_of[front])
                add_pairs(claim_, front, back, pairs_of[s]);
        std::erase_if(pairs_of, [](const auto& entry) { return entry.second.empty(); });
        if (pairs_of.empty()) return;
        out_ << "$Periodic\n" << pairs_of.size() << "\n";
        for (const auto& [surface, pairs] : pairs_of) {
            out_ << "2 " << surface_tag(surface, 2) << " " << surface_tag(surface, 1) << "\n";
            write_pairs(pairs);
        }
        out_ << "$EndPeriodic\n";
    }

    Comparison& out_;
    const ExpectedTetrahedra& expected_;
    const TetrahedraClaim& claim_;
    const std::vector<std::int32_t> sides_;   ///< per face
    std::map<std::uint32_t, Numbers> blocks_; ///< the tetrahedra of each block that has some
    std::uint64_t elements_ = 0;              ///< written so far; MSH 2.2 only
};

} // namespace

void write_msh(Comparison& out, const ExpectedTetrahedra& expected) {
    MshWriter(out, expected).write_41();
}

void write_msh22(Comparison& out, const ExpectedTetrahedra& expected) {
    MshWriter(out, expected).write_22();
}

} // namespace terrane::verifier
