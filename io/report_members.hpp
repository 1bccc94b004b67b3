// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names the members of reports for statistics, model.json and Python, see Described. docs/reference/statistics.md
// says what they mean.
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/described.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/optimisation/optimise.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/tiles/tile.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

namespace terrane {

void describe(const auto& visit, const PairCounts& c) {
    visit("tested", c.tested, "in_patches", c.in_patches, "separated", c.separated, "unmoved",
          c.unmoved, "apart", c.apart);
}

void describe(const auto& visit, const RoundingReport& r) {
    visit("iterations", r.rounds, "surface_deviation", r.surface_deviation, "max_allowed",
          r.max_allowed, "sufficient_limit", r.sufficient_limit, "vanished_length",
          r.vanished_length, "max_move", r.max_move, "arranged_again", r.arranged_again,
          "deviation", r.deviation, "moves", r.moves, "verified", r.clean, "naive_contacts",
          r.naive_contacts, "contacts", r.contacts.size(), "moved_input_vertices",
          r.moved_input_vertices, "merged_vertices", r.merged_vertices, "collapsed_triangles",
          r.collapsed_triangles, "surfaces_with_vanished_regions", r.vanished_regions.size(),
          "vanished", r.vanished.size());
}

void describe(const auto& visit, const Spread& s) {
    visit("min", s.min, "mean", s.mean, "max", s.max, "percentiles_1_5_50_95_99", s.percentiles);
}

void describe(const auto& visit, const QualityReport& q) {
    visit("triangles", q.triangles, "q", q.q, "share_above_08", q.share_above_08, "smallest_angle",
          q.smallest_angle, "largest_angle", q.largest_angle, "edge_length", q.edge_length,
          "histogram", q.histogram);
}

void describe(const auto& visit, const ImproveReport& r) {
    visit("passes", r.passes, "splits", r.splits, "collapses", r.collapses, "swaps", r.swaps,
          "moves", r.moves, "refused_contact", r.refused_contact, "refused_deviation",
          r.refused_deviation, "refused_shape", r.refused_shape, "corners", r.corners, "curves",
          r.curves, "sheets", r.sheets, "attempts", r.attempts, "least_quality", r.least_quality,
          "thin_triangles", r.thin_triangles, "held_blocks", r.held_blocks);
}

void describe(const auto& visit, const LeftAlone& l) {
    visit("distance", l.distance, "place", l.place, "reason", l.reason);
}

void describe(const auto& visit, const ChangedBlock& b) {
    visit("block", b.block, "volume", b.volume, "parts", b.parts, "into", b.into);
}

void describe(const auto& visit, const SimplifyReport& r) {
    visit("length", r.resolution, "max_move", r.max_move, "corners", r.corners, "curves", r.curves,
          "surfaces", r.sheets, "divided", r.divided, "rounds", r.rounds, "attempts", r.attempts);
}

void describe(const auto& visit, const WorstShapes& w) {
    visit("quality", w.quality, "least_angle", w.least_angle, "largest_angle", w.largest_angle);
}

void describe(const auto& visit, const OptimiseReport& r) {
    visit("passes", r.passes, "removed_edges", r.removed_edges, "removed_faces", r.removed_faces,
          "moved", r.moved, "on_surfaces", r.loosened, "contracted", r.contracted, "inserted",
          r.inserted, "remeshed", r.remeshed, "left", r.left, "untried", r.untried, "effort",
          r.effort, "cut_short", r.is_cut_short, "before", r.before, "after", r.after);
}

void describe(const auto& visit, const GapBreak& b) {
    visit("low", b.low, "high", b.high, "distance", b.distance, "gaps", b.gaps, "length", b.length);
}

void describe(const auto& visit, const SealChoice& c) {
    visit("edge_length", c.edge_length, "widest", c.widest, "breaks", c.breaks, "distance",
          c.distance);
}

void describe(const auto& visit, const SealTrial& t) {
    visit("distance", t.distance, "blocks", t.blocks, "small", t.small, "changes", t.changes,
          "triangles", t.triangles, "length", t.length, "left", t.left);
}

constexpr std::string_view name_of(SealKind kind) {
    return kind == SealKind::extended ? "extended" : "trimmed";
}

void describe(const auto& visit, const SealChange& c) {
    visit("kind", c.kind, "surface", c.surface, "length", c.length, "distance", c.largest, "place",
          c.place, "triangles", c.triangles);
}

void describe(const auto& visit, const OpenGap& g) {
    visit("from", g.from, "to", g.to, "reason", g.reason, "edges", g.edges, "length", g.length,
          "distance", g.width, "place", g.place);
}

void describe(const auto& visit, const SealRule& r) {
    std::vector<SurfaceId> surfaces{r.surface};
    if (r.other) surfaces.push_back(*r.other);
    visit("surfaces", surfaces, "distance", r.distance);
}

void describe(const auto& visit, const OpenBorder& b) {
    visit("surface", b.surface, "length", b.length, "place", b.place);
}

void describe(const auto& visit, const BorderGap& g) {
    visit("surface", g.surface, "length", g.length, "least", g.least, "largest", g.largest, "place",
          g.place);
}

void describe(const auto& visit, const FreeBorder& b) {
    visit("line", b.line, "surfaces", b.surfaces, "length", b.length, "closed", b.closed, "gaps",
          b.gaps);
}

void describe(const auto& visit, const Leak& l) {
    visit("from", l.from, "to", l.to, "borders", l.borders, "length", l.length, "least", l.least,
          "largest", l.largest, "place", l.place);
}

void describe(const auto& visit, const RefinementRound& r) {
    visit("triangles", r.triangles, "tetrahedra", r.tetrahedra, "bad", r.bad, "apart", r.apart,
          "misshapen", r.misshapen);
}

void describe(const auto& visit, const LoosenedVertices& v) {
    visit("count", v.count, "farthest", v.farthest);
}

void describe(const auto& visit, const ModelShare& m) {
    visit("model", m.model, "weight", m.weight, "height", m.height, "deviation", m.deviation);
}

void describe(const auto& visit, const FillReport& r) {
    visit("interpolated", r.interpolated, "area", r.area, "data", r.data, "expected_error",
          r.expected_error, "validated_error", r.validated_error, "model", r.model, "models",
          r.models);
}

namespace tiles {

void describe(const auto& visit, const Work& w) {
    visit("read", w.homes, "faces", w.faces, "own_faces", w.owned, "candidates", w.candidates,
          "improper_contacts", w.improper, "divided", w.divided, "predicates", w.predicates,
          "constructed_points", w.constructed, "triangles", w.triangles, "pairs_of_doubles",
          w.rounded_pairs, "near_boxes", w.near_boxes, "messages", w.messages, "bytes", w.bytes,
          "memory", w.memory);
}

} // namespace tiles

} // namespace terrane
