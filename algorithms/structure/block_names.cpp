// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/block_names.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/structure/block_contacts.hpp>
#include <terrane/algorithms/structure/detail/block_units.hpp>
#include <terrane/algorithms/structure/detail/constants.hpp>

namespace terrane {

using namespace structure;
using namespace structure::detail;

namespace {

/// Describes blocks by the surfaces around them.
class BlockDescriptions {
public:
    BlockDescriptions(std::span<const SurfaceInfo> surfaces,
                      std::vector<std::vector<BlockContact>> contacts) :
        surfaces_(surfaces),
        labels_(unique_labels(surfaces)), contacts_(std::move(contacts)) {
        for (auto& of_block : contacts_) // by size, which does not depend on the last digits
            std::ranges::sort(of_block, {}, [&](const BlockContact& c) {
                return std::tuple(-static_cast<float>(c.area), labels_[c.surface]);
            });
    }

    [[nodiscard]] std::span<const BlockContact> contacts(std::size_t block) const {
        return contacts_[block];
    }

    /// Returns the name by the surfaces above and below; else by those on the sides.
    [[nodiscard]] std::string name(std::size_t block) const {
        const auto& around = contacts_[block];
        if (around.empty()) return "too thin for doubles";
        std::string name;
        const auto add = [&](const std::string& phrase) {
            if (!phrase.empty()) name += (name.empty() ? "" : ", ") + phrase;
        };
        add(listed(around, BlockPosition::below));
        add(listed(around, BlockPosition::above));
        for (const BlockContact& c : around)
            if (c.position == BlockPosition::inside && !is_boundary(c)) add(phrase(c));
        if (!name.empty()) return name;
        for (const BlockContact& c : around)
            if (!is_boundary(c)) return phrase(c);
        return "inside the boundary";
    }

    /// Lengthens the names of blocks that have the same one by a surface at which most of them
    /// differ. Returns whether there is such a surface.
    bool tell_apart(std::span<const std::uint32_t> blocks, std::vector<std::string>& names) const {
        using Phrases = std::map<std::uint32_t, std::string>; // by block
        std::map<std::uint32_t, std::pair<Phrases, float>> surfaces;
        for (const std::uint32_t b : blocks)
            for (const BlockContact& c : contacts_[b])
                if (!is_boundary(c)) {
                    auto& [phrases, area] = surfaces[c.surface];
                    phrases[b] = phrase(c);
                    area += static_cast<float>(c.area);
                }
        std::tuple<std::size_t, float> best{1, 0.F};
        std::uint32_t chosen = 0;
        for (const auto& [s, entry] : surfaces) {
            std::set<std::string> different;
            for (const auto& [b, text] : entry.first) different.insert(text);
            const bool some_lack_it = entry.first.size() < blocks.size();
            const std::tuple found{different.size() + (some_lack_it ? 1 : 0), entry.second};
            if (std::get<0>(found) < 2 || found < best) continue;
            if (found == best && labels_[chosen] < labels_[s]) continue;
            best = found;
            chosen = s;
        }
        if (std::get<0>(best) < 2) return false;
        for (const auto& [b, text] : surfaces[chosen].first) names[b] += ", " + text;
        return true;
    }

private:
    [[nodiscard]] bool is_boundary(const BlockContact& c) const {
        return surfaces_[c.surface].role == Role::boundary;
    }

    [[nodiscard]] static std::string place(const BlockContact& c) {
        switch (c.position) {
        case BlockPosition::below:
            return "below ";
        case BlockPosition::above:
            return "above ";
        case BlockPosition::inside:
            return "inside ";
        case BlockPosition::around:
            return "around ";
        default:
            return std::string(c.direction) + " of ";
        }
    }

    [[nodiscard]] std::string phrase(const BlockContact& c) const {
        return place(c) + labels_[c.surface];
    }

    /// Lists the surfaces to which the block has this position: "below A and B".
    [[nodiscard]] std::string listed(std::span<const BlockContact> around,
                                     BlockPosition position) const {
        double all = 0;
        std::vector<std::string> names;
        std::string start;
        for (const BlockContact& c : around)
            if (c.position == position && !is_boundary(c)) all += c.area;
        for (const BlockContact& c : around) {
            if (c.position != position || is_boundary(c)) continue;
            if (c.area < block_name_constants.least_share * all) continue;
            if (names.size() == block_name_constants.most_listed) break;
            start = place(c);
            names.push_back(labels_[c.surface]);
        }
        if (names.empty()) return {};
        std::sort(names.begin(), names.end());
        std::string text = start + names.front();
        for (std::size_t i = 1; i < names.size(); ++i) text += " and " + names[i];
        return text;
    }

    std::span<const SurfaceInfo> surfaces_;
    std::vector<std::string> labels_;
    std::vector<std::vector<BlockContact>> contacts_; ///< per block, the largest first
};

/// Adds surfaces to equal names, in rounds, until all differ or none helps.
void tell_apart(const BlockDescriptions& descriptions, std::vector<std::string>& names) {
    for (std::size_t round = 0; round < block_name_constants.most_added; ++round) {
        std::map<std::string, std::vector<std::uint32_t>> called;
        for (std::uint32_t b = 1; b < names.size(); ++b) called[names[b]].push_back(b);
        bool changed = false;
        for (const auto& [name, blocks] : called)
            if (blocks.size() > 1 && descriptions.tell_apart(blocks, names)) changed = true;
        if (!changed) return;
    }
}

/// Adds numbers to names that are met again.
void number_equals(std::vector<std::string>& names) {
    std::set<std::string> taken;
    std::map<std::string, unsigned> next_number;
    for (std::string& name : names) {
        const std::string start = name;
        unsigned& number = next_number.try_emplace(start, 2).first->second;
        while (!taken.insert(name).second) name = start + ", " + std::to_string(number++);
    }
}

std::string at_block(const std::vector<std::string>& names, std::size_t block) {
    return block < names.size() ? one_line(names[block]) : std::string();
}

} // namespace

std::vector<std::string>
structure::names_by_contacts(std::span<const SurfaceInfo> surfaces,
                             std::vector<std::vector<BlockContact>> contacts) {
    const std::size_t count = contacts.size();
    const BlockDescriptions descriptions(surfaces, std::move(contacts));
    std::vector<std::string> names{"outside"};
    for (std::size_t b = 1; b < count; ++b) names.push_back(descriptions.name(b));
    tell_apart(descriptions, names);
    number_equals(names);
    return names;
}

void name_blocks(const Mesh& mesh, const Volumes& volumes, const GivenNames& given,
                 Structure& structure) {
    const StandardArithmetic guard;
    const BlockDescriptions descriptions(mesh.surfaces, find_contacts(mesh, volumes));
    const ColumnInMesh column(given.column, mesh);
    std::vector<std::string> names{"outside"};
    for (std::size_t b = 1; b < structure.blocks.size(); ++b) {
        ModelBlock& block = structure.blocks[b];
        std::set<std::uint32_t> inside;
        for (const std::uint32_t i : block.inner_interfaces)
            inside.insert(structure.interfaces[i].surfaces.begin(),
                          structure.interfaces[i].surfaces.end());
        const std::vector<std::uint32_t> ends_inside(inside.begin(), inside.end());
        const auto units = column.units_of(descriptions.contacts(b), ends_inside);
        block.unit = units ? column.name_of(*units) : at_block(given.layers, b);
        block.age = units ? column.age_of(*units) : std::nullopt;
        std::string name = units ? block.unit : at_block(given.stated, b);
        names.push_back(name.empty() ? descriptions.name(b) : std::move(name));
    }
    tell_apart(descriptions, names);
    number_equals(names);
    for (std::size_t b = 0; b < names.size(); ++b) structure.blocks[b].name = std::move(names[b]);
}

} // namespace terrane
