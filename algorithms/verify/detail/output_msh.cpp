// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The readers of tetrahedra_files.hpp for MSH 4.1 and 2.2.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <terrane/algorithms/verify/detail/line_scanner.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra_files.hpp>

namespace terrane::verifier {

namespace {

/// Returns the names as the file has them: on one line, without quotes, not empty, all different.
std::vector<std::string> quoted_names(std::span<const SurfaceInfo> surfaces) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    std::map<std::string, unsigned> next;
    for (const SurfaceInfo& surface : surfaces) {
        std::string base = surface.name;
        for (char& c : base)
            if (const auto code = static_cast<unsigned char>(c); c == '"')
                c = '\'';
            else if (code < 32 || code == 127)
                c = ' ';
        if (base.empty()) base = "surface";
        std::string name = base;
        unsigned& number = next.try_emplace(base, 2).first->second;
        while (!taken.insert(name).second) name = base + "_" + std::to_string(number++);
        names.push_back(std::move(name));
    }
    return names;
}

/// Cells that the file keeps together.
struct Group {
    std::uint64_t tag = 0;
    std::vector<std::uint64_t> physical; ///< tags of what they belong to
    Numbers cells;                       ///< ascending
};

/// Reads both versions.
class MshReader {
public:
    MshReader(std::string_view contents, const ExpectedTetrahedra& expected) :
        in_(contents), expected_(expected), claim_(expected.claim), sides_(cut_sides(claim_)) {
        for (std::uint32_t t = 0; t < claim_.tetrahedra.size(); ++t)
            blocks_[claim_.block_of[t]].push_back(t);
    }

    void read_41() {
        read_start("4.1");
        const auto faces = face_groups();
        const auto volumes = volume_groups();
        in_.expect("$Entities");
        in_.expect("0 0 " + text(faces.size()) + " " + text(volumes.size()));
        read_entities(faces, claim_.faces);
        read_entities(volumes, claim_.tetrahedra);
        in_.expect("$EndEntities");
        read_nodes_41(volumes[0]);
        const std::size_t count = claim_.tetrahedra.size() + claim_.faces.size();
        in_.expect("$Elements");
        in_.expect(text(volumes.size() + faces.size()) + " " + text(count) + " 1 " + text(count));
        read_elements(volumes, claim_.tetrahedra, "3 ", " 4 ", 1);
        read_elements(faces, claim_.faces, "2 ", " 2 ", claim_.tetrahedra.size() + 1);
        in_.expect("$EndElements");
        read_periodic_41(faces);
        in_.end();
    }

    void read_22() {
        read_start("2.2");
        in_.expect("$Nodes");
        in_.expect(text(claim_.vertices.size()));
        for (std::size_t v = 0; v < claim_.vertices.size(); ++v) {
            in_.next();
            expect_number(v + 1);
            in_.expect_point(claim_.vertices[v]);
            in_.end_line();
        }
        in_.expect("$EndNodes");
        read_elements_22();
        read_periodic_22();
        in_.end();
    }

private:
    void expect_number(std::uint64_t number) {
        if (in_.integer() != number) in_.fail(text(number) + " is needed");
    }
    [[nodiscard]] std::uint64_t surface_count() const { return expected_.surfaces.size(); }

    /// The tag of a surface, or of one of its sides at a cut.
    [[nodiscard]] std::uint64_t surface_tag(std::uint32_t surface, std::int32_t side) const {
        if (side == 0) return surface + 1U;
        return surface_count() + 2 * std::uint64_t(surface) + static_cast<std::uint64_t>(side);
    }

    /// The tag of a block as a physical volume, which no surface has.
    [[nodiscard]] std::uint64_t block_tag(std::uint32_t block) const {
        return 3 * surface_count() + block + 1;
    }

    // --- The start of both versions -------------------------------------------------------------

    void read_start(const std::string& version) {
        in_.expect("$MeshFormat");
        in_.expect(version + " 0 8");
        in_.expect("$EndMeshFormat");
        const auto names = quoted_names(expected_.surfaces);
        std::map<std::uint64_t, std::string> split; // sides of cuts
        for (std::uint32_t f = 0; f < claim_.faces.size(); ++f)
            if (sides_[f] != 0)
                for (const std::uint32_t s : expected_.surfaces_of[f])
                    split[surface_tag(s, sides_[f])] =
                        names[s] + (sides_[f] == 1 ? " front" : " back");
        in_.expect("$PhysicalNames");
        in_.expect(text(names.size() + split.size() + blocks_.size()));
        for (std::size_t s = 0; s < names.size(); ++s)
            in_.expect("2 " + text(s + 1) + " \"" + names[s] + "\"");
        for (const auto& [tag, name] : split) in_.expect("2 " + text(tag) + " \"" + name + "\"");
        for (const auto& [block, cells] : blocks_) read_block_name(block);
        in_.expect("$EndPhysicalNames");
    }

    /// Reads the name of a block, of which only the number is compared.
    void read_block_name(std::uint32_t block) {
        const std::string start = "3 " + text(block_tag(block)) + " \"" +
                                  (block == 0 ? "outside" : "block " + text(block));
        const std::string_view line = in_.next();
        const std::string_view rest =
            line.starts_with(start) ? line.substr(start.size()) : std::string_view();
        const bool named = block > 0 && rest.starts_with(": ") && rest.ends_with('"') &&
                           rest.find('"') == rest.size() - 1;
        if (rest != "\"" && !named) in_.fail("\"" + start + "\" is needed");
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
        std::uint64_t next = surface_count() + 1;
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

    template <class Cells>
    void read_entities(const std::vector<Group>& groups, const Cells& cells) {
        for (const Group& group : groups) {
            Point3 low = claim_.vertices[cells[group.cells[0]][0]], high = low;
            for (const std::uint32_t cell : group.cells)
                for (const std::uint32_t node : cells[cell]) {
                    const Point3& p = claim_.vertices[node];
                    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
                }
            in_.next();
            expect_number(group.tag);
            in_.expect_point(low);
            in_.expect_point(high);
            expect_number(group.physical.size());
            for (const std::uint64_t tag : group.physical) expect_number(tag);
            expect_number(0);
            in_.end_line();
        }
    }

    void read_nodes_41(const Group& volume) {
        const std::string count = text(claim_.vertices.size());
        in_.expect("$Nodes");
        in_.expect("1 " + count + " 1 " + count);
        in_.expect("3 " + text(volume.tag) + " 0 " + count);
        for (std::size_t v = 0; v < claim_.vertices.size(); ++v) in_.expect(text(v + 1));
        for (const Point3& p : claim_.vertices) {
            in_.next();
            in_.expect_point(p);
            in_.end_line();
        }
        in_.expect("$EndNodes");
    }

    template <class Cells>
    void read_elements(const std::vector<Group>& groups, const Cells& cells,
                       const std::string& dimension, const std::string& type, std::uint64_t first) {
        for (const Group& group : groups) {
            std::string header = dimension;
            header.append(text(group.tag)).append(type).append(text(group.cells.size()));
            in_.expect(header);
            for (const std::uint32_t cell : group.cells) {
                in_.next();
                expect_number(first + cell);
                for (const std::uint32_t node : cells[cell]) expect_number(node + std::uint64_t(1));
                in_.end_line();
            }
        }
    }

    /// Reads the nodes behind each cut with those at the same points in front of it.
    void read_periodic_41(const std::vector<Group>& faces) {
        if (claim_.twins.empty()) return;
        std::vector<std::uint64_t> tag_of(claim_.faces.size());
        for (const Group& group : faces)
            for (const std::uint32_t f : group.cells) tag_of[f] = group.tag;
        std::map<std::pair<std::uint64_t, std::uint64_t>, std::set<Edge>> pairs_of;
        for (const auto& [front, back] : claim_.twins)
            add_pairs(front, back, pairs_of[{tag_of[front], tag_of[back]}]);
        in_.expect("$Periodic");
        in_.expect(text(pairs_of.size()));
        for (const auto& [tags, pairs] : pairs_of) {
            in_.expect("2 " + text(tags.second) + " " + text(tags.first));
            in_.expect("0");
            read_pairs(pairs);
        }
        in_.expect("$EndPeriodic");
    }

    void add_pairs(std::uint32_t front, std::uint32_t back, std::set<Edge>& pairs) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (claim_.faces[front][k] != claim_.faces[back][k])
                pairs.insert({claim_.faces[front][k], claim_.faces[back][k]});
    }

    void read_pairs(const std::set<Edge>& pairs) {
        in_.expect(text(pairs.size()));
        for (const auto& [front, back] : pairs)
            in_.expect(text(back + std::uint64_t(1)) + " " + text(front + std::uint64_t(1)));
    }

    // --- MSH 2.2 ---------------------------------------------------------------------------------

    void read_elements_22() {
        std::uint64_t count = claim_.tetrahedra.size() + expected_.surfaces_of.values.size();
        in_.expect("$Elements");
        in_.expect(text(count));
        std::uint64_t number = 0;
        const auto element = [&](std::uint64_t type, std::uint64_t tag, const auto& nodes) {
            in_.next();
            for (const std::uint64_t n : {++number, type, std::uint64_t(2), tag, tag})
                expect_number(n);
            for (const std::uint32_t node : nodes) expect_number(node + std::uint64_t(1));
            in_.end_line();
        };
        for (std::size_t t = 0; t < claim_.tetrahedra.size(); ++t)
            element(4, block_tag(claim_.block_of[t]), claim_.tetrahedra[t]);
        for (std::size_t f = 0; f < claim_.faces.size(); ++f)
            for (const std::uint32_t s : expected_.surfaces_of[f])
                element(2, surface_tag(s, sides_[f]), claim_.faces[f]);
        in_.expect("$EndElements");
    }

    void read_periodic_22() {
        std::map<std::uint32_t, std::set<Edge>> pairs_of; // per surface
        for (const auto& [front, back] : claim_.twins)
            for (const std::uint32_t s : expected_.surfaces_of[front])
                add_pairs(front, back, pairs_of[s]);
        std::erase_if(pairs_of, [](const auto& entry) { return entry.second.empty(); });
        if (pairs_of.empty()) return;
        in_.expect("$Periodic");
        in_.expect(text(pairs_of.size()));
        for (const auto& [surface, pairs] : pairs_of) {
            in_.expect("2 " + text(surface_tag(surface, 2)) + " " + text(surface_tag(surface, 1)));
            read_pairs(pairs);
        }
        in_.expect("$EndPeriodic");
    }

    LineScanner in_;
    const ExpectedTetrahedra& expected_;
    const TetrahedraClaim& claim_;
    const std::vector<std::int32_t> sides_;   ///< per face
    std::map<std::uint32_t, Numbers> blocks_; ///< the tetrahedra of each block that has some
};

} // namespace

void compare_msh(std::string_view contents, const ExpectedTetrahedra& expected) {
    MshReader(contents, expected).read_41();
}

void compare_msh22(std::string_view contents, const ExpectedTetrahedra& expected) {
    MshReader(contents, expected).read_22();
}

} // namespace terrane::verifier
