// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Models from surfaces: reading them, build_model(), its blocks, interfaces, leaks and tetrahedra, writing
// and certifying the results, and checking triangles. advanced.hpp has the stages one by one. What the
// headers in algorithms/verify declare is in a library of its own, terrane::verify.
#pragma once

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/certify.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/project.hpp>
#include <terrane/io/results.hpp>
