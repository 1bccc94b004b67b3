// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The stages of a model one by one, with all that terrane.hpp has.
#pragma once

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/intersection/contact_kind.hpp>
#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/maps/maps.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/optimisation/optimise.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/regions/regions.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/algorithms/search/method.hpp>
#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/algorithms/selection/selection.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>
#include <terrane/algorithms/structure/block_names.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>
#include <terrane/algorithms/tolerance/tolerance.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/verdict.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/io/grids/grid.hpp>
#include <terrane/kernel/point.hpp>
#include <terrane/kernel/predicate_counts.hpp>
#include <terrane/terrane.hpp>
