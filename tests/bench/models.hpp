// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The inputs of all benchmarks, each made once.
#pragma once

#include <string>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace bench {

struct Model {
    std::vector<terrane::Surface> surfaces;
    std::vector<terrane::Point3> points;      ///< of all surfaces
    std::vector<terrane::Triangle> triangles; ///< of all surfaces, indices into points
    std::vector<std::uint32_t> groups;        ///< per triangle: its surface
    std::vector<terrane::Box> boxes;          ///< per triangle
};

/// Returns the model "pair1_7k", "pair1_68k", "pair1_680k", "pair1_6800k", likewise for pair2,
/// "nonuniform1", "nonuniform2", "rectangles_100", "rectangles_1000", "balls_160k", "loft_20k",
/// "extrusion_20k", "fans_1000k" or "thread_1000k"; any other name is that of a file. The model is kept
/// until another one is asked for. Throws std::runtime_error for a file that can't be read.
const Model& model(const std::string& name);

} // namespace bench
