// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include <terrane/io/files.hpp>
#include <terrane/io/meshes/msh_values.hpp>

namespace terrane {

std::vector<std::string> values_left_out(Format format, std::span<const SurfaceValues> values) {
    const bool has_both = format == Format::ply || format == Format::vtp || format == Format::vtu ||
                          format == Format::vtk;
    const bool is_msh = format == Format::msh || format == Format::msh22;
    std::vector<std::string> names;
    for (const SurfaceValues& of_surface : values)
        for (const ValueArray& array : of_surface)
            if (!has_both && !(format == Format::gocad && !array.on_triangles) &&
                !(is_msh && fits_msh(array)) && std::ranges::find(names, array.name) == names.end())
                names.push_back(array.name);
    return names;
}

} // namespace terrane
