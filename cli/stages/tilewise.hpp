// SPDX-License-Identifier: LGPL-3.0-or-later
//
// terrane arrange --memory: tiles one after the other, with states and messages in files, for
// models that are larger than memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <terrane/cli/options/files.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

/// Options of an arrangement in tiles.
struct TilewiseOptions {
    std::string memory; ///< as the user writes it: "4GiB"; empty: no limit, so no tiles
    bool digest = false, volumes = false;
    [[nodiscard]] bool wanted() const { return !memory.empty(); }
};

void add_tilewise(CLI::App& command, TilewiseOptions& options);

/// Returns the bytes of "4GiB", "512MiB", "64KiB" or a number; none for other texts, and for 0.
std::optional<std::uint64_t> bytes_of_size(std::string_view text);

/// Arranges the inputs in tiles and writes .vtp and .pvtp files. Errors: bad_option for options that
/// need the whole model; those of arrange_in_tiles; unsupported where a repair of
/// the doubles needs the whole model, and that does not fit into the memory.
ExitStatus arrange_tilewise(const FileOptions& files, const TilewiseOptions& options,
                            Session& session);

} // namespace terrane::cli
