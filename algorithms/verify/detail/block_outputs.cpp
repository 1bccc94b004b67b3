// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/block_outputs.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <terrane/algorithms/verify/detail/block_files.hpp>
#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra_files.hpp>

namespace terrane::verifier {

/// The data that all files of a folder with blocks need.
struct Folder {
    WrittenMesh mesh;
    std::vector<BlockSides> sides;
    BlockParts parts;
};

namespace {

// --- Blocks -------------------------------------------------------------------------------------

std::vector<BlockSides> sides_of(const BlocksClaim& claim, std::size_t triangles) {
    std::vector<BlockSides> sides(triangles);
    for (std::size_t s = 0; s < claim.shells.size(); ++s)
        for (const std::uint32_t side : claim.shells[s])
            sides[side / 2][side % 2] = claim.block_of_shell[s];
    return sides;
}

Folder make_folder(const Certificate& certificate) {
    Folder folder{rounded_mesh(certificate).value(), {}, {}};
    folder.sides = sides_of(*certificate.blocks(), folder.mesh.triangles.size());
    folder.parts = find_parts(folder.mesh, folder.sides);
    return folder;
}

const Folder& folder_of(const Certificate& certificate, std::shared_ptr<const Folder>& kept) {
    if (!kept) kept = std::make_shared<Folder>(make_folder(certificate));
    return *kept;
}

std::vector<std::int32_t> as_cells(const Numbers& numbers) {
    return {numbers.begin(), numbers.end()};
}

/// Returns the values of some triangles.
std::vector<std::int32_t> cells_of(const Numbers& numbers, const Numbers& triangles) {
    std::vector<std::int32_t> cells;
    for (const std::uint32_t t : triangles) cells.push_back(static_cast<std::int32_t>(numbers[t]));
    return cells;
}

/// Returns N of "...start_N.format"; none if the name is another one.
std::optional<std::uint32_t> number_in(std::string_view name, std::string_view start,
                                       std::string_view format) {
    const std::string end = "." + std::string(format);
    const std::size_t at = name.rfind(start);
    if (at == std::string_view::npos || !name.ends_with(end)) return std::nullopt;
    if (at > 0 && name[at - 1] != '/') return std::nullopt;
    name.remove_prefix(at + start.size());
    name.remove_suffix(end.size());
    std::uint32_t number = 0;
    const auto [after, code] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (code != std::errc() || std::to_string(number) != name) return std::nullopt;
    return number;
}

constexpr auto all_blocks = "blocks.vtp", all_interfaces = "interfaces.vtp";

bool is_called(std::string_view name, std::string_view file) {
    return name == file || name.ends_with("/" + std::string(file));
}

/// Numbers the surfaces of the triangles alone; returns these surfaces.
std::vector<SurfaceInfo> own_surfaces(PartMesh& part, std::span<const SurfaceInfo> all) {
    const std::set<std::uint32_t> used(part.surfaces_of.values.begin(),
                                       part.surfaces_of.values.end());
    std::map<std::uint32_t, std::uint32_t> number;
    std::vector<SurfaceInfo> own;
    for (const std::uint32_t s : used) {
        number.emplace(s, static_cast<std::uint32_t>(own.size()));
        own.push_back(all[s]);
    }
    for (std::uint32_t& s : part.surfaces_of.values) s = number.at(s);
    return own;
}

/// Compares with a part, or with many; `cells` come before those that all parts have.
std::string compare_part(std::string_view contents, const Folder& folder,
                         const CertifiedOutput& output, std::span<const SurfaceInfo> surfaces,
                         const PartMesh& part, std::vector<CellNumbers> cells = {}) {
    const WrittenMesh mesh{part.vertices,   part.triangles,   part.regions_of,
                           part.parents_of, part.surfaces_of, true};
    cells.push_back({"triangle", as_cells(part.numbers)});
    cells.push_back({"interface", cells_of(folder.parts.interface_of, part.numbers)});
    cells.push_back({"patch", cells_of(folder.parts.patch_of, part.numbers)});
    return difference(contents, output.format, {mesh, surfaces, std::move(cells)});
}

/// Compares with a block or an interface alone, of which VTP names only its own surfaces.
std::string compare_single(std::string_view contents, const Folder& folder,
                           const CertifiedOutput& output, PartMesh part) {
    if (output.format != "vtp")
        return compare_part(contents, folder, output, output.surfaces, part);
    const auto surfaces = own_surfaces(part, output.surfaces);
    return compare_part(contents, folder, output, surfaces, part);
}

std::string compare_all_blocks(std::string_view contents, const Folder& folder,
                               const CertifiedOutput& output) {
    Numbers part_of;
    const PartMesh part = all_blocks_mesh(folder.mesh, folder.sides, folder.parts, part_of);
    return compare_part(contents, folder, output, output.surfaces, part,
                        {{"block", as_cells(part_of)}});
}

std::string compare_result(std::string_view contents, const Folder& folder,
                           const CertifiedOutput& output) {
    std::vector<std::int32_t> front, back;
    for (const BlockSides& sides : folder.sides) {
        front.push_back(static_cast<std::int32_t>(sides[0]));
        back.push_back(static_cast<std::int32_t>(sides[1]));
    }
    return difference(contents, output.format,
                      {folder.mesh,
                       output.surfaces,
                       {{"volume_front", std::move(front)},
                        {"volume_back", std::move(back)},
                        {"interface", as_cells(folder.parts.interface_of)},
                        {"patch", as_cells(folder.parts.patch_of)}}});
}

/// Returns the format of the parts among the outputs of a certificate; empty: they are together.
std::string part_format(const Certificate& certificate) {
    for (const CertifiedOutput& output : certificate.outputs) {
        if (number_in(output.name, "interfaces/interface_", output.format)) return output.format;
        if (is_called(output.name, all_interfaces)) return "";
    }
    return "vtp";
}

/// Returns the names of all files of a folder with these blocks, relative to it.
std::set<std::string> file_names(const Folder& folder, const std::string& part_format) {
    std::set<std::string> names{"model.json", "result.vtp"};
    if (part_format.empty()) {
        names.insert({all_blocks, all_interfaces});
        return names;
    }
    const auto add = [&](const std::string& start, std::size_t number) {
        names.insert(start + std::to_string(number) + "." + part_format);
    };
    for (std::size_t i = 0; i < folder.parts.interfaces.size(); ++i) {
        add("interfaces/interface_", i);
        const auto [low, high] = folder.parts.interfaces[i].blocks;
        if (low == high) continue;
        for (const std::uint32_t block : {low, high})
            if (block > 0) add("blocks/block_", block);
    }
    return names;
}

std::string compare_model(std::string_view contents, const Certificate& certificate,
                          const Folder& folder, const CertifiedOutput& output,
                          OutputVerdict& verdict) {
    verdict.check = OutputCheck::numbers;
    ModelLists lists{folder.mesh,  folder.parts, output.surfaces,
                     folder.sides, {},           part_format(certificate)};
    for (const std::string& volume : certificate.blocks()->volumes)
        lists.volumes.push_back(nearest_double(mpq_class(volume)));
    try {
        compare_model_json(contents, lists);
    } catch (const Difference& difference) {
        return difference.place + ": " + difference.sentence;
    }
    return "";
}

// --- Tetrahedra ---------------------------------------------------------------------------------

using TetrahedraReader = void (*)(std::string_view, const ExpectedTetrahedra&);

constexpr std::array<std::pair<std::string_view, TetrahedraReader>, 3> tetrahedra_readers{
    {{"vtu", compare_vtu}, {"msh", compare_msh}, {"msh22", compare_msh22}}};

ExpectedTetrahedra expected_tetrahedra(const Certificate& certificate,
                                       const CertifiedOutput& output) {
    const TetrahedraClaim& claim = *certificate.tetrahedra();
    const auto of_triangles =
        surfaces_of_parents(certificate, certificate.rounded.value().parents_of);
    const Numbers box{static_cast<std::uint32_t>(surface_count(certificate))};
    ExpectedTetrahedra expected{claim, output.surfaces, {}};
    for (const std::uint32_t t : claim.triangle_of)
        if (t == no_number)
            expected.surfaces_of.push_back(box);
        else
            expected.surfaces_of.push_back(of_triangles[t]);
    return expected;
}

} // namespace

void check_folder_files(const Certificate& certificate, Violations& found) {
    const auto& outputs = certificate.outputs;
    if (outputs.empty()) return;
    const auto refute = [&](const std::string& what) {
        found.push_back({Rule::R21_output, {}, what});
    };
    const auto model = std::ranges::find_if(
        outputs, [](const CertifiedOutput& o) { return is_called(o.name, "model.json"); });
    if (model == outputs.end()) return refute("no output is the model.json of a folder");
    const auto folder =
        model->name.substr(0, model->name.size() - std::string("model.json").size());
    auto missing = file_names(make_folder(certificate), part_format(certificate));
    for (const CertifiedOutput& output : outputs)
        if (!output.name.starts_with(folder) ||
            missing.erase(output.name.substr(folder.size())) == 0)
            return refute("the output " + output.name +
                          " is no file of the folder, or there twice");
    if (!missing.empty()) refute("the file " + folder + *missing.begin() + " is no output");
}

std::string compare_block_file(std::string_view contents, const Certificate& certificate,
                               const CertifiedOutput& output, std::shared_ptr<const Folder>& kept,
                               OutputVerdict& verdict) {
    if (output.surfaces.size() != surface_count(certificate))
        return "another number of surfaces than in the inputs";
    verdict.renamed = renamed_surfaces(certificate, output);
    const Folder& folder = folder_of(certificate, kept);
    if (is_called(output.name, "model.json") && output.format == "json")
        return compare_model(contents, certificate, folder, output, verdict);
    if (is_called(output.name, "result.vtp") && output.format == "vtp")
        return compare_result(contents, folder, output);
    if (is_called(output.name, all_blocks) && output.format == "vtp")
        return compare_all_blocks(contents, folder, output);
    if (is_called(output.name, all_interfaces) && output.format == "vtp")
        return compare_part(
            contents, folder, output, output.surfaces,
            all_interfaces_mesh(folder.mesh, folder.sides, folder.parts.interfaces));
    if (output.format == "vtp" || output.format == "obj") {
        if (const auto b = number_in(output.name, "blocks/block_", output.format);
            b && *b > 0 && folder.parts.around.contains(*b))
            return compare_single(contents, folder, output,
                                  block_mesh(folder.mesh, folder.sides, folder.parts, *b));
        if (const auto i = number_in(output.name, "interfaces/interface_", output.format);
            i && *i < folder.parts.interfaces.size())
            return compare_single(
                contents, folder, output,
                interface_mesh(folder.mesh, folder.sides, folder.parts.interfaces[*i]));
    }
    return "no file of a folder with blocks has this name and format";
}

std::string compare_tetrahedra_file(std::string_view contents, const Certificate& certificate,
                                    const CertifiedOutput& output,
                                    std::shared_ptr<const Folder>& /*kept*/,
                                    OutputVerdict& verdict) {
    const bool box = certificate.tetrahedra()->box;
    if (output.surfaces.size() != surface_count(certificate) + (box ? 1 : 0))
        return "another number of surfaces than in the inputs, with the box";
    if (box && output.surfaces.back() != SurfaceInfo{"box", Role::boundary})
        return "the last surface is not the box";
    verdict.renamed = renamed_surfaces(certificate, output);
    const auto reader = std::ranges::find(tetrahedra_readers, output.format,
                                          [](const auto& entry) { return entry.first; });
    if (reader == tetrahedra_readers.end()) {
        verdict.check = OutputCheck::hash_only;
        return "";
    }
    try {
        reader->second(contents, expected_tetrahedra(certificate, output));
    } catch (const Difference& difference) {
        return difference.place + ": " + difference.sentence;
    }
    return "";
}

} // namespace terrane::verifier
