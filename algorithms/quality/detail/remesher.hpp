// SPDX-License-Identifier: LGPL-3.0-or-later
//
// One attempt at improving a mesh, from its input: the passes of the four operations.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/quality/detail/least_quality.hpp>
#include <terrane/algorithms/quality/detail/operations.hpp>
#include <terrane/algorithms/quality/detail/sizes.hpp>
#include <terrane/algorithms/quality/improve.hpp>

namespace terrane::quality::detail {

/// The input of an attempt; referenced objects must outlive it.
struct RemeshInput {
    const Mesh& mesh;
    const Features& features;
    const Sizes& sizes;
    const ReferenceSurface& reference;
    const ImproveOptions& options;
};

class Remesher {
public:
    Remesher(const RemeshInput& input, LeastQuality least, const Run& run);

    /// Makes at most `passes` passes, then improves single triangles. Reports progress from `from`
    /// to `to`.
    void operator()(unsigned passes, double from, double to);

    [[nodiscard]] const WorkMesh& mesh() const { return mesh_; }
    [[nodiscard]] const LeastQuality& least_quality() const { return validator_.least_quality(); }
    /// Finds the reason why the worst triangle can't be improved: its own shape, or what rejects
    /// all changes to it.
    WorstCause cause_of_worst();
    /// Reports passes, changes and refusals.
    void describe(ImproveReport& report) const;

private:
    [[nodiscard]] bool stopped() const { return run_.stop.stop_requested(); }
    void regroup_if_needed();
    void clean_first();
    void shorten_in_gaps();
    void shorten_at(std::span<const LocalSize> places);
    void refine(std::span<const LocalSize> places, unsigned passes);
    [[nodiscard]] std::size_t changes() const;
    bool one_pass(bool is_first, bool with_jitter);
    void alternate(bool with_jitter);
    void finish();
    void improve_bad_triangles();
    void improve_worst_triangles();
    /// Returns the first of the triangles of the least q, or none.
    [[nodiscard]] std::uint32_t worst();
    [[nodiscard]] double quality_at(std::uint32_t t) const;
    /// Returns a value just above q of the triangle, however that is computed.
    [[nodiscard]] double limit_at(std::uint32_t t) const;

    const Run& run_;
    const ImproveOptions& options_;
    WorkMesh mesh_;
    ChangeValidator validator_;
    RemeshContext context_;
    std::vector<double> qualities_; ///< per triangle: q when worst() last saw it; negative: never
    std::uint32_t measured_at_ = 0; ///< time of that
    unsigned passes_ = 0;
    double least_length_ = 0; ///< that gaps ask for
    bool tried_all_ = false;  ///< all changes for the worst triangle were tried
};

} // namespace terrane::quality::detail
