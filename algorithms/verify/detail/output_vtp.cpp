// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The reader of output.hpp for VTP.
#include <terrane/algorithms/verify/detail/output.hpp>
#include <terrane/algorithms/verify/detail/vtk_scanner.hpp>

namespace terrane::verifier {

namespace {

/// Reads the holes of the triangles, and the means of the expected errors of their corners.
void expect_expected_errors(VtkScanner& in, const FilledClaim& filled) {
    std::vector<double> means;
    for (const auto& [a, b, c] : filled.triangles)
        means.push_back((filled.deviation[a] + filled.deviation[b] + filled.deviation[c]) / 3);
    in.array("interpolated",
             std::vector<std::int32_t>(filled.interpolated.begin(), filled.interpolated.end()));
    in.array("deviation", means);
}

} // namespace

void compare_vtp(std::string_view contents, const ExpectedMesh& expected) {
    const WrittenMesh& mesh = expected.mesh;
    VtkScanner in(contents);
    in.begin("PolyData");
    in.field_data(expected.surfaces, mesh.surfaces_of);
    in.expect("<Piece NumberOfPoints=\"" + std::to_string(mesh.vertices.size()) +
              "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
              "NumberOfPolys=\"" +
              std::to_string(mesh.triangles.size()) + "\">");
    in.expect("<CellData Scalars=\"surface\">");
    in.array("surface", first_of(mesh.surfaces_of));
    in.array("surface_count", counts_of(mesh.surfaces_of));
    if (mesh.regions_of.size() != 0) in.array("region", first_of(mesh.regions_of));
    if (mesh.parents_of.size() != 0) in.array("parent", first_of(mesh.parents_of));
    for (const CellNumbers& cells : expected.cells) in.array(cells.name, cells.values);
    if (mesh.filled != nullptr) expect_expected_errors(in, *mesh.filled);
    in.expect("</CellData>");
    in.points(mesh.vertices);
    std::vector<std::int64_t> corners, ends;
    for (const Triangle& t : mesh.triangles) {
        corners.insert(corners.end(), t.begin(), t.end());
        ends.push_back(static_cast<std::int64_t>(corners.size()));
    }
    in.expect("<Polys>");
    in.array("connectivity", corners);
    in.array("offsets", ends);
    in.expect("</Polys>");
    in.end("PolyData");
}

} // namespace terrane::verifier
