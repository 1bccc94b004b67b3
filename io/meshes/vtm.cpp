// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/vtm.hpp>

#include <cstddef>

#include <fmt/format.h>

#include <terrane/io/text/xml.hpp>

namespace terrane {

std::string to_vtm(std::span<const FileGroup> groups) {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" "
                       "version=\"1.0\" byte_order=\"LittleEndian\">\n<vtkMultiBlockDataSet>\n";
    for (std::size_t g = 0; g < groups.size(); ++g) {
        text += fmt::format("<Block index=\"{}\" name=\"{}\">\n", g, xml_escaped(groups[g].name));
        for (std::size_t i = 0; i < groups[g].files.size(); ++i)
            text += fmt::format("<DataSet index=\"{}\" name=\"{}\" file=\"{}\"/>\n", i,
                                xml_escaped(groups[g].files[i].name),
                                xml_escaped(groups[g].files[i].file));
        text += "</Block>\n";
    }
    return text + "</vtkMultiBlockDataSet>\n</VTKFile>\n";
}

} // namespace terrane
