// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/column.hpp>

#include <utility>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/io/project.hpp>

namespace terrane::cli {

void add_column(CLI::App& command, std::string& file) {
    command
        .add_option("--column", file,
                    "Stratigraphic column: names blocks by their units, given from the top down "
                    "with the horizons at their bases")
        ->type_name("FILE.json");
}

Result<BlockNaming> naming_of(const std::string& column_file, const Inputs& inputs) {
    BlockNaming naming{.stated = inputs.stated_blocks};
    if (column_file.empty()) return naming;
    auto column = read_column(column_file);
    if (!column) return column.error();
    if (const auto sound = check_column(*column, infos_of(inputs.surfaces)); !sound)
        return Error{sound.error().code, sound.error().sentence,
                     column_file + ": " + sound.error().place};
    naming.column = std::move(*column);
    return naming;
}

} // namespace terrane::cli
