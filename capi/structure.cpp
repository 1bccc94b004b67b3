// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/structure.h>

#include <limits>
#include <utility>

#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>

using namespace terrane::capi::detail;

terrane_structure::terrane_structure(terrane::Structure made) : structure(std::move(made)) {
    for (const terrane::ModelCorner& c : structure.corners) {
        corners.push_back(c.vertex);
        lists[TERRANE_CORNER_LINES].push_back(c.lines);
    }
    for (const terrane::ModelLine& l : structure.lines) {
        lines.push_back(
            {static_cast<std::int32_t>(l.kind), {l.corners[0], l.corners[1]}, 0, l.length});
        lists[TERRANE_LINE_VERTICES].push_back(l.vertices);
        lists[TERRANE_LINE_PATCHES].push_back(l.patches);
        lists[TERRANE_LINE_SURFACES].push_back(l.surfaces);
    }
    for (const terrane::ModelPatch& p : structure.patches) {
        patches.push_back({p.interface, 0, p.area});
        lists[TERRANE_PATCH_TRIANGLES].push_back(p.triangles);
        lists[TERRANE_PATCH_LINES].push_back(p.lines);
    }
    for (const terrane::ModelInterface& i : structure.interfaces) {
        interfaces.push_back({{i.volumes[0], i.volumes[1]}, i.area});
        lists[TERRANE_INTERFACE_SURFACES].push_back(i.surfaces);
        lists[TERRANE_INTERFACE_PATCHES].push_back(i.patches);
        lists[TERRANE_INTERFACE_TRIANGLES].push_back(i.triangles);
    }
    for (const terrane::ModelBlock& b : structure.blocks) {
        blocks.push_back(
            {b.volume, b.area, b.age.value_or(std::numeric_limits<double>::quiet_NaN())});
        lists[TERRANE_BLOCK_SURFACES_ABOVE].push_back(b.above);
        lists[TERRANE_BLOCK_SURFACES_BELOW].push_back(b.below);
        lists[TERRANE_BLOCK_SURFACES_BESIDE].push_back(b.beside);
        lists[TERRANE_BLOCK_INTERFACES].push_back(b.interfaces);
        lists[TERRANE_BLOCK_INNER_INTERFACES].push_back(b.inner_interfaces);
        lists[TERRANE_BLOCK_NEIGHBOURS].push_back(b.neighbours);
    }
}

const char* terrane_line_kind_name(int32_t kind) {
    if (kind < 0 || kind > static_cast<int>(terrane::LineKind::intersection)) return "unknown";
    return name_of(static_cast<terrane::LineKind>(kind)).data();
}

void terrane_structure_free(terrane_structure* structure) {
    release(structure);
}

const uint32_t* terrane_structure_corners(const terrane_structure* structure, size_t* count) {
    return array_of<uint32_t>(known(structure) ? &structure->corners : nullptr, count);
}

const terrane_model_line* terrane_structure_lines(const terrane_structure* structure,
                                                  size_t* count) {
    return array_of<terrane_model_line>(known(structure) ? &structure->lines : nullptr, count);
}

const terrane_model_patch* terrane_structure_patches(const terrane_structure* structure,
                                                     size_t* count) {
    return array_of<terrane_model_patch>(known(structure) ? &structure->patches : nullptr, count);
}

const terrane_model_interface* terrane_structure_interfaces(const terrane_structure* structure,
                                                            size_t* count) {
    return array_of<terrane_model_interface>(known(structure) ? &structure->interfaces : nullptr,
                                             count);
}

const terrane_model_block* terrane_structure_blocks(const terrane_structure* structure,
                                                    size_t* count) {
    return array_of<terrane_model_block>(known(structure) ? &structure->blocks : nullptr, count);
}

const char* terrane_structure_block_name(const terrane_structure* structure, size_t block) {
    if (!known(structure) || block >= structure->blocks.size()) return nullptr;
    return structure->structure.blocks[block].name.c_str();
}

const char* terrane_structure_block_unit(const terrane_structure* structure, size_t block) {
    if (!known(structure) || block >= structure->blocks.size()) return nullptr;
    return structure->structure.blocks[block].unit.c_str();
}

terrane_code terrane_structure_get_lists(const terrane_structure* structure,
                                         terrane_structure_list which, terrane_lists* lists) {
    const auto index = static_cast<std::size_t>(which);
    const bool there = known(structure) && which >= 0 && index < terrane_structure::list_count;
    return give_lists(there ? &structure->lists[index] : nullptr, lists);
}

const uint32_t* terrane_structure_patch_of(const terrane_structure* structure,
                                           size_t* triangle_count) {
    return array_of<uint32_t>(known(structure) ? &structure->structure.patch_of : nullptr,
                              triangle_count);
}

const uint32_t* terrane_structure_interface_of(const terrane_structure* structure,
                                               size_t* triangle_count) {
    return array_of<uint32_t>(known(structure) ? &structure->structure.interface_of : nullptr,
                              triangle_count);
}
