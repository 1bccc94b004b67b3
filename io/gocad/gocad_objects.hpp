// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The objects of a GOCAD file as they stand in it, before they become surfaces or a model.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

struct TsurfObject {
    Surface surface;
    std::string name_in_model;              ///< or empty
    std::vector<std::uint32_t> part_begins; ///< per TFACE block: its first triangle
    std::string units;                      ///< AXIS_UNIT, or empty
    bool depth = false;                     ///< ZPOSITIVE Depth
    std::size_t line = 0;                   ///< where it begins
};

struct ModelObject {
    struct Part {
        std::uint32_t id = 0;
        std::string feature;
        std::string surface;
        std::size_t line = 0;
    };
    struct Region {
        std::uint32_t id = 0;
        std::string name;
        std::vector<std::int64_t> sides; ///< part ids with sign
        std::size_t line = 0;
    };
    struct Layer {
        std::string name;
        std::vector<std::int64_t> regions;
    };
    std::string name;
    std::vector<std::string> surfaces;
    std::vector<Part> parts;
    std::vector<Region> regions;
    std::vector<Layer> layers;
    std::size_t line = 0;
};

struct GocadFile {
    std::vector<TsurfObject> tsurfs;
    std::optional<ModelObject> model;          ///< the first one
    std::map<std::string, std::size_t> others; ///< other types and how many of each
};

/// All objects of a file. Fails where no line begins with GOCAD.
[[nodiscard]] MaybeError read_gocad_file(LineParser& in, GocadFile& file);

/// The rest of a TSurf whose first line is the current one, up to its END.
[[nodiscard]] MaybeError read_tsurf(LineParser& in, TsurfObject& object);

/// The rest of a Model3d whose first line is the current one, up to its END.
[[nodiscard]] MaybeError read_model3d(LineParser& in, ModelObject& model);

/// What a header says about names.
struct GocadNames {
    std::string name;
    std::string name_in_model;
};

/// Reads "HEADER { key:value ... }" from its first line on, to the } or to a keyword that can't
/// stand in a block: then it returns true, and that line is the current one.
bool read_block(LineParser& in, GocadNames& names);

/// Without blanks and one pair of quotes around it.
[[nodiscard]] std::string unquoted(std::string_view text);

/// The role that GEOLOGICAL_TYPE or a TFACE's feature type stands for.
[[nodiscard]] Role role_of_feature(std::string_view feature);

/// The error for an object without END.
[[nodiscard]] Error no_end(const LineParser& in, std::size_t line);

} // namespace terrane::detail
