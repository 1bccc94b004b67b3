// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/block_outputs.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <terrane/algorithms/verify/detail/block_files.hpp>
#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/output.hpp>

namespace terrane::verifier {

/// The subject of a file of a folder with blocks.
struct FolderFile {
    enum class Subject { model, result, blocks, interfaces };
    Subject subject;
    std::string_view format;
    std::uint32_t number = no_number; ///< of the block or the interface; no_number: all are in it
};

/// The data that all files of a folder with blocks need, and its files.
struct Folder {
    WrittenMesh mesh;
    std::vector<BlockSides> sides;
    BlockParts parts;
    std::string_view part_format;            ///< empty: all blocks are in one file
    std::map<std::string, FolderFile> files; ///< by their names in the certificate
};

namespace {

using Subject = FolderFile::Subject;

// --- Blocks -------------------------------------------------------------------------------------

std::vector<BlockSides> blocks_at_sides(const BlocksClaim& claim, std::size_t triangles) {
    std::vector<BlockSides> sides(triangles);
    for (std::size_t s = 0; s < claim.shells.size(); ++s)
        for (const std::uint32_t side : claim.shells[s])
            sides[side / 2][side % 2] = claim.block_of_shell[s];
    return sides;
}

/// Returns the format of the parts among the outputs of a certificate; empty: they are together.
std::string_view part_format(const Certificate& certificate) {
    for (const CertifiedOutput& output : certificate.outputs) {
        if (output.name.ends_with("interfaces.vtp")) return "";
        if (output.format == "obj") return "obj";
    }
    return "vtp";
}

/// Names the file of a block or an interface in model.json.
std::string part_name(const std::string& kind, std::uint32_t number, std::string_view format) {
    if (format.empty()) return kind + "s.vtp";
    return kind + "s/" + kind + "_" + std::to_string(number) + "." + std::string(format);
}

/// Adds the files of a folder, whose names begin with `path`.
void add_files(const std::string& path, Folder& folder) {
    const std::string_view format = folder.part_format;
    const auto add = [&](const std::string& name, const FolderFile& file) {
        folder.files.emplace(path + name, file);
    };
    add("model.json", {Subject::model, "json"});
    add("result.vtp", {Subject::result, "vtp"});
    if (format.empty()) {
        add("blocks.vtp", {Subject::blocks, "vtp"});
        return add("interfaces.vtp", {Subject::interfaces, "vtp"});
    }
    for (const auto& [block, triangles] : folder.parts.around)
        if (block > 0) add(part_name("block", block, format), {Subject::blocks, format, block});
    for (std::uint32_t i = 0; i < folder.parts.interfaces.size(); ++i)
        add(part_name("interface", i, format), {Subject::interfaces, format, i});
}

Folder make_folder(const Certificate& certificate) {
    Folder folder{rounded_mesh(certificate).value(), {}, {}, part_format(certificate), {}};
    folder.sides = blocks_at_sides(*certificate.blocks(), folder.mesh.triangles.size());
    folder.parts = find_parts(folder.mesh, folder.sides);
    constexpr std::string_view model = "model.json";
    for (const CertifiedOutput& output : certificate.outputs)
        if (output.name == model || output.name.ends_with("/" + std::string(model))) {
            add_files(output.name.substr(0, output.name.size() - model.size()), folder);
            break;
        }
    return folder;
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

/// Compares the files of a folder.
class FolderComparison {
public:
    FolderComparison(std::string_view contents, const Folder& folder, const BlocksClaim& claim,
                     const CertifiedOutput& output, OutputCheck& check) :
        contents_(contents),
        folder_(folder), claim_(claim), names_(claim.names), surfaces_(output.surfaces),
        check_(check) {}

    std::string operator()(const FolderFile& file) const {
        switch (file.subject) {
        case Subject::model:
            return model();
        case Subject::result:
            return result();
        case Subject::blocks:
            return blocks(file);
        case Subject::interfaces:
            break;
        }
        return interfaces(file);
    }

private:
    [[nodiscard]] std::string model() const {
        ModelLists lists{folder_.mesh, folder_.parts, surfaces_, claim_.model, names_, {}, {}};
        for (const std::string& volume : claim_.volumes)
            lists.volumes.push_back(nearest_double(mpq_class(volume)));
        lists.file_of = [this](const std::string& kind, std::uint32_t number) {
            return part_name(kind, number, folder_.part_format);
        };
        return difference(contents_, lists);
    }

    [[nodiscard]] std::string result() const {
        std::vector<std::int32_t> front, back;
        for (const BlockSides& sides : folder_.sides) {
            front.push_back(static_cast<std::int32_t>(sides[0]));
            back.push_back(static_cast<std::int32_t>(sides[1]));
        }
        return difference(contents_, "vtp",
                          ExpectedMesh{folder_.mesh,
                                       surfaces_,
                                       {{"volume_front", std::move(front)},
                                        {"volume_back", std::move(back)},
                                        {"interface", as_cells(folder_.parts.interface_of)},
                                        {"patch", as_cells(folder_.parts.patch_of)}},
                                       names_},
                          check_);
    }

    [[nodiscard]] std::string blocks(const FolderFile& file) const {
        std::vector<Taken> taken;
        if (file.number != no_number) {
            take_block(folder_.sides, folder_.parts, file.number, taken);
            return part(file, taken, names_.subspan(file.number, 1));
        }
        std::vector<std::int32_t> block_of;
        for (const auto& [block, triangles] : folder_.parts.around) {
            if (block == 0) continue;
            take_block(folder_.sides, folder_.parts, block, taken);
            block_of.resize(taken.size(), static_cast<std::int32_t>(block));
        }
        return part(file, taken, names_, {{"block", std::move(block_of)}});
    }

    [[nodiscard]] std::string interfaces(const FolderFile& file) const {
        std::vector<Taken> taken;
        const auto& all = folder_.parts.interfaces;
        if (file.number != no_number) {
            const auto [low, high] = all[file.number].blocks;
            take_interface(folder_.sides, all[file.number], taken);
            return part(file, taken, std::array{names_[low], names_[high]});
        }
        for (const Interface& interface : all) take_interface(folder_.sides, interface, taken);
        return part(file, taken, names_);
    }

    /// Compares with a part, or with all parts; `cells` come before those that all parts have. VTP names only the surfaces
    /// of a single part.
    [[nodiscard]] std::string part(const FolderFile& file, const std::vector<Taken>& taken,
                                   std::span<const std::string> block_names,
                                   std::vector<CellNumbers> cells = {}) const {
        PartMesh part = part_of(folder_.mesh, taken);
        std::vector<SurfaceInfo> own;
        const bool is_single = file.format == "vtp" && file.number != no_number;
        if (is_single) own = own_surfaces(part, surfaces_);
        const WrittenMesh mesh{part.vertices,   part.triangles,   part.regions_of,
                               part.parents_of, part.surfaces_of, true};
        cells.push_back({"triangle", as_cells(part.numbers)});
        cells.push_back({"interface", cells_of(folder_.parts.interface_of, part.numbers)});
        cells.push_back({"patch", cells_of(folder_.parts.patch_of, part.numbers)});
        return difference(
            contents_, file.format,
            ExpectedMesh{mesh, is_single ? own : surfaces_, std::move(cells), block_names}, check_);
    }

    std::string_view contents_;
    const Folder& folder_;
    const BlocksClaim& claim_;
    std::span<const std::string> names_;    ///< of blocks
    std::span<const SurfaceInfo> surfaces_; ///< as the files call them
    OutputCheck& check_;
};

// --- Tetrahedra ---------------------------------------------------------------------------------

ExpectedTetrahedra expected_tetrahedra(const Certificate& certificate,
                                       const CertifiedOutput& output) {
    const TetrahedraClaim& claim = *certificate.tetrahedra();
    const auto of_triangles =
        surfaces_of_parents(certificate, certificate.rounded.value().parents_of);
    const Numbers box{static_cast<std::uint32_t>(surface_count(certificate))};
    ExpectedTetrahedra expected{claim, output.surfaces, {}, certificate.blocks()->names};
    for (const std::uint32_t t : claim.triangle_of)
        if (t == no_number)
            expected.surfaces_of.push_back(box);
        else
            expected.surfaces_of.push_back(of_triangles[t]);
    return expected;
}

} // namespace

void check_folder_files(const Certificate& certificate, Violations& found) {
    const auto refute = [&](const std::string& what) {
        found.push_back({Rule::R21_output, {}, what});
    };
    if (certificate.outputs.empty()) return;
    auto missing = make_folder(certificate).files;
    if (missing.empty()) return refute("no output is the model.json of a folder");
    for (const CertifiedOutput& output : certificate.outputs)
        if (missing.erase(output.name) == 0)
            return refute("the output " + output.name +
                          " is no file of the folder, or there twice");
    if (!missing.empty()) refute("the file " + missing.begin()->first + " is no output");
}

std::string compare_block_file(std::string_view contents, const Certificate& certificate,
                               const CertifiedOutput& output, std::shared_ptr<const Folder>& kept,
                               OutputVerdict& verdict) {
    if (output.surfaces.size() != surface_count(certificate))
        return "another number of surfaces than in the inputs";
    verdict.renamed = renamed_surfaces(certificate, output);
    if (!kept) kept = std::make_shared<Folder>(make_folder(certificate));
    const auto file = kept->files.find(output.name);
    if (file == kept->files.end() || file->second.format != output.format)
        return "no file of a folder with blocks has this name and format";
    const FolderComparison compare(contents, *kept, *certificate.blocks(), output, verdict.check);
    return compare(file->second);
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
    return difference(contents, output.format, expected_tetrahedra(certificate, output),
                      verdict.check);
}

} // namespace terrane::verifier
