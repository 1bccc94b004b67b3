// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The objects of a GOCAD file, before they are converted to surfaces or a model. read_tsurf is
// defined in detail/tsurf.cpp, all other functions in gocad_objects.cpp.
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
    std::string name_in_model;              ///< empty if the header has none
    std::vector<std::uint32_t> part_begins; ///< first triangle of each TFACE block
    std::string units;                      ///< AXIS_UNIT; empty if there is none
    bool in_system = false;                 ///< while its coordinate system is read
    std::size_t line = 0;                   ///< number of its first line
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
        std::vector<std::int64_t> sides; ///< ids of parts, with the sign of the side
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
    std::map<std::string, std::size_t> others; ///< number of objects of each other type
};

/// Reads all objects of a file. Fails if no line begins with GOCAD.
[[nodiscard]] MaybeError read_gocad_file(LineParser& in, GocadFile& file);

/// Reads a TSurf, whose first line is the current one, up to its END.
[[nodiscard]] MaybeError read_tsurf(LineParser& in, TsurfObject& object);

/// Reads a Model3d, whose first line is the current one, up to its END.
[[nodiscard]] MaybeError read_model3d(LineParser& in, ModelObject& model);

/// The names in the header of an object.
struct GocadNames {
    std::string name;
    std::string name_in_model;
};

/// Reads "HEADER { key:value ... }", whose first line is the current one, up to the }. If the } is
/// missing it stops at the first keyword that cannot be in a block and returns true; the line of
/// the keyword is then the current one.
bool read_block(LineParser& in, GocadNames& names);

/// Removes the blanks and one pair of quotes around a text.
[[nodiscard]] std::string unquoted(std::string_view text);

/// Returns the role for a GEOLOGICAL_TYPE or the feature type of a TFACE.
[[nodiscard]] Role role_of_feature(std::string_view feature);

/// Returns the error about an object without END that begins at `line`.
[[nodiscard]] Error no_end(const LineParser& in, std::size_t line);

} // namespace terrane::detail
