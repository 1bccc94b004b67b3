// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sheets and curves of a mesh, by which the verifier compares two meshes of the same surfaces.
//
// - A sheet consists of the triangles with the same surfaces and the same regions.
// - A curve edge has other than two triangles, or two of different sheets, or is an intersection
//   edge. Its label is the list of the sheets of its triangles, and whether it is an intersection
//   edge.
// - A corner is a vertex at which other than two curve edges meet, or two with different labels.
// - A fan consists of triangles at a vertex that are connected by edges there. Where several fans meet,
//   there is a corner, too.
// - A chain is a sequence of curve edges from corner to corner, or a closed one without corners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

/// Gives equal values equal numbers, in the order in which they come.
template <class Value>
class Numbering {
public:
    std::uint32_t operator()(const Value& value) {
        return number_of_.try_emplace(value, static_cast<std::uint32_t>(number_of_.size()))
            .first->second;
    }
    [[nodiscard]] const std::map<Value, std::uint32_t>& all() const { return number_of_; }

private:
    std::map<Value, std::uint32_t> number_of_;
};

using SheetName = std::array<Numbers, 2>;    ///< surfaces, regions
using CurveLabel = std::pair<Numbers, bool>; ///< sheets, intersection edge or not
/// A corner, and the sheets of each of the fans of triangles that meet there.
using PointClass = std::pair<std::uint32_t, std::vector<Numbers>>;
using CurveClass = std::array<std::uint32_t, 3>; ///< label, and the corners at the ends

/// The numbers of sheets, labels and corners that two meshes share.
struct SharedNumbers {
    Numbering<SheetName> sheets;
    Numbering<CurveLabel> labels;
    Numbering<Point3> corners;
};

/// A mesh with its attributes.
struct LabelledMesh {
    const std::vector<Point3>& vertices;
    const std::vector<Triangle>& triangles;
    const IndexLists<std::uint32_t>& surfaces_of;
    const IndexLists<std::uint32_t>& regions_of;
    const std::vector<Edge>& intersection_edges;
};

/// How a sheet is connected.
struct SheetShape {
    std::int64_t characteristic = 0; ///< vertices - edges + triangles
    std::size_t components = 0;      ///< connected across edges that are no curve edges
    bool oriented = true;            ///< no two triangles use an edge, no curve edge, in the same
                                     ///< direction

    friend bool operator==(const SheetShape&, const SheetShape&) = default;
};

/// The sheets and curves of a mesh.
struct Sheets {
    Numbers sheet_of;                                   ///< per triangle
    std::vector<Numbers> triangles;                     ///< per sheet
    std::vector<SheetShape> shapes;                     ///< per sheet
    std::map<CurveClass, std::size_t> chains;           ///< number of chains of a class
    std::map<CurveClass, std::vector<Triangle>> curves; ///< edges {a, b, b} of these chains
    std::map<std::uint32_t, Numbers> sheets_of_label;   ///< the sheets at a curve edge
    std::map<PointClass, std::size_t> points;           ///< vertices with several fans of triangles
    std::size_t intersection_edges = 0;                 ///< that are edges of the mesh
};

/// Finds the sheets and curves. Precondition: all indices are in range; each triangle has as many
/// regions as surfaces. Cost: O(n log n).
Sheets find_sheets(const LabelledMesh& mesh, SharedNumbers& numbers);

} // namespace terrane::verifier
