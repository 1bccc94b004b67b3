// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks whether changes are allowed, and carries them out.
//
// Guarantee: after an allowed change a conforming mesh is still conforming, and the added triangles
// are within the tolerance of their original sheet. Improper contacts are excluded
// (1) among triangles of one injective patch, by statements (5) and (6) of
//     docs/explanation/injective-patches.md: exact predicates show that all added triangles have
//     the orientation of the patch;
// (2) between triangles that follow isolated input triangles and other sheets;
// (3) otherwise by exact tests against all triangles whose boxes overlap.
// A change sweeps the tetrahedra between the removed triangles and the corner that all added ones
// share. It is rejected if exact predicates find a vertex of another triangle in one of them; so no
// piece changes to the other side of a sheet.
// Triangles that are not added under (1) belong to no patch until the mesh is grouped again; an
// injective patch stays injective without them. A sheet that is one patch remains so: changes of
// its curves are rejected unless that is proven. Cost: the cells of a grid that the change
// overlaps, and a test per pair of overlapping boxes; nothing where (1) and (2) hold and the sheet
// is one patch, as such triangles are not in the grid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/quality/detail/borders.hpp>
#include <terrane/algorithms/quality/detail/grid.hpp>
#include <terrane/algorithms/quality/detail/least_quality.hpp>
#include <terrane/algorithms/quality/detail/reference_surface.hpp>
#include <terrane/algorithms/quality/detail/working_mesh.hpp>
#include <terrane/kernel/plane_filter.hpp>
#include <terrane/kernel/sign.hpp>

namespace terrane::quality::detail {

/// Counts of rejected changes, by reason.
struct Refusals {
    std::size_t contact = 0;   ///< triangles would meet improperly
    std::size_t deviation = 0; ///< not proven to be within the tolerance
    std::size_t shape = 0;     ///< flipped or degenerate triangles
};

enum class Outcome : std::uint8_t { allowed, contact, deviation, shape };

/// The part of the mesh that a change depends on.
struct Footprint {
    /// An injective patch whose border changes.
    struct Border {
        std::uint32_t patch = 0;
        Axis axis{}; ///< the patch is injective along it
    };
    GridBox around{};        ///< box of all added and removed triangles
    std::uint32_t patch = 0; ///< the patch of all added triangles, or no_group
    bool is_contact_free =
        false; ///< no added triangle can meet others: proven by patches and isolation
    std::vector<Border> borders; ///< of the patches whose curves change

    /// Tells whether an allowed change stays allowed after the other one, with which it shares no
    /// vertex.
    [[nodiscard]] bool is_apart(const Footprint& other) const {
        for (const Border& b : borders)
            for (const Border& c : other.borders)
                if (b.patch == c.patch && around.overlaps_along(b.axis, other.around)) return false;
        return is_contact_free || other.is_contact_free || !around.overlaps(other.around) ||
               (patch != no_group && patch == other.patch);
    }
};

/// The findings of the validator on a change.
struct CheckedChange {
    std::vector<std::uint32_t> hints;   ///< per added triangle
    std::vector<char> isolated;         ///< per added triangle: it follows isolated triangles only
    std::vector<std::uint32_t> patches; ///< per added triangle, or no_group
    std::vector<GridBox> boxes;         ///< per added triangle
    Footprint footprint{};
};

class ChangeValidator {
public:
    /// Referenced objects must outlive the validator.
    ChangeValidator(WorkMesh& mesh, const ReferenceSurface& reference) :
        mesh_(mesh), reference_(reference), borders_(mesh) {}

    /// Finds injective patches anew and renumbers triangles. Must be called first, and again when
    /// many triangles have left their patches.
    void group_again(const Run& run);

    /// Refuses from now on all changes that add a triangle of a smaller q.
    void set_least_quality(LeastQuality least) { least_quality_ = std::move(least); }
    [[nodiscard]] const LeastQuality& least_quality() const { return least_quality_; }

    /// Tells whether all triangles are in one injective patch, which makes changes to them cheap.
    [[nodiscard]] bool in_one_patch(std::span<const std::uint32_t> triangles) const;

    /// Checks whether the change is allowed in the mesh as it is. Several threads may call this at
    /// the same time.
    Outcome check(const Change& change, CheckedChange& checked);
    /// Carries out a change that was allowed in the mesh as it is.
    void carry_out(const Change& change, const CheckedChange& checked);

    /// Counts all rejected changes.
    [[nodiscard]] Refusals refusals() const;
    /// Counts the triangles that have left their patches since they were grouped.
    [[nodiscard]] std::size_t ungrouped() const { return ungrouped_; }

private:
    /// Working memory of one thread.
    struct ThreadScratch {
        struct Tetrahedron {
            std::array<Point3, 4> corners; ///< positively oriented
            Box box;
        };
        ReferenceSurface::Search search;
        Borders::Search border_search;
        std::vector<PlaneFilter> planes;      ///< of the added triangles
        Point3 top{};                         ///< apex of the swept tetrahedra
        std::vector<Tetrahedron> swept;       ///< the tetrahedra that the change sweeps
        std::vector<std::uint32_t> not_swept; ///< per vertex: the last change that contains it or
                                              ///< has tested it
        std::vector<std::uint32_t> seen;      ///< per triangle: the last change that visited it
        std::uint32_t change = 0;
        Refusals refusals;
    };

    void find_whole_sheets();
    void fill_grid();
    Outcome check_with(const Change& change, CheckedChange& checked, ThreadScratch& scratch);
    [[nodiscard]] Corners corners_of(const Change& change, const Triangle& t) const;
    [[nodiscard]] bool shapes_hold(const Change& change, std::uint32_t patch) const;
    bool bounds_hold(const Change& change, CheckedChange& checked, ThreadScratch& scratch) const;
    void box_added(const Change& change, CheckedChange& checked) const;
    void find_footprint(const Change& change, CheckedChange& checked) const;
    [[nodiscard]] bool is_beside(const PlaneFilter& plane, const Triangle& t,
                                 const Triangle& other) const;
    [[nodiscard]] bool meet(const Change& change, const Triangle& t, const Triangle& other) const;
    void sweep(const Change& change, ThreadScratch& scratch) const;
    [[nodiscard]] bool is_swept(const Triangle& t, ThreadScratch& scratch) const;
    bool meets_properly(const Change& change, const CheckedChange& checked,
                        ThreadScratch& scratch) const;
    [[nodiscard]] Sign orientation_of(const Change& change, const Triangle& t,
                                      std::uint32_t patch) const;
    [[nodiscard]] bool keeps_orientation(const Change& change, std::uint32_t patch) const;
    bool find_patches(const Change& change, CheckedChange& checked, ThreadScratch& scratch) const;
    /// Tells whether a triangle can meet no other, by its patch and by isolation. Such triangles
    /// are not in the grid.
    [[nodiscard]] bool is_contact_free(std::uint32_t t) const {
        return mesh_.isolated[t] != 0 && is_whole_[mesh_.sheet_of[t]] != 0;
    }
    [[nodiscard]] bool is_contact_free(const Change& change, const CheckedChange& checked) const;
    void leave_patches(const Change& change, const CheckedChange& checked);

    WorkMesh& mesh_;
    const ReferenceSurface& reference_;

    std::vector<std::uint32_t> patch_of_; ///< per triangle, or no_group
    std::vector<Axis> axis_;              ///< per patch: its projection
    std::vector<Sign> orientation_;       ///< per patch: the common orientation of its triangles
                                          ///< there
    std::vector<char> is_whole_;  ///< per sheet: all its triangles are in one patch, and remain
                                  ///< there
    std::vector<GridBox> box_of_; ///< per triangle
    Borders borders_;
    TriangleGrid grid_;
    std::size_t ungrouped_ = 0;
    LeastQuality least_quality_;

    tbb::enumerable_thread_specific<ThreadScratch> scratches_;
    std::vector<std::uint32_t> numbers_; ///< of the triangles added last
};

} // namespace terrane::quality::detail
