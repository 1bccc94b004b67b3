// SPDX-License-Identifier: LGPL-3.0-or-later
//
// find_nesting of blocks.hpp.
//
// A component divides space into parts, each with one shell as its border. Let r be a point of
// another component, and let w be the winding numbers of shells around it, where a shell is wound
// outward as seen from its part. If r is in a bounded part, w is 1 for its shell and -1 for the
// outermost; else w is 0 for all. The parts that contain a component are nested, as components have
// at most vertices in common; so the innermost belongs to the component that is itself in most
// parts of others.
//
// r is a point inside of a triangle T of its component. For this component itself, r is moved up
// along the ray a little, to a place in front of T or behind it. Moving rays aside changes no winding number, as r
// is on no other triangle.
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/rays.hpp>

namespace terrane::verifier {

namespace {

/// Collects what the rays say.
class Locator {
public:
    Locator(const ExactMesh& mesh, const Shells& shells) :
        mesh_(mesh), shells_(shells), around_(shells.sides_of.size()) {
        nesting_.outermost.assign(shells.sides_of.size(), false);
        nesting_.around.assign(shells.sides_of.size(), no_number);
    }

    Nesting operator()() {
        cast_all();
        for (std::uint32_t s = 0; s < around_.size(); ++s) {
            std::size_t deepest = 0;
            for (const std::uint32_t candidate : around_[s])
                if (const std::size_t depth = depth_of(candidate) + 1; depth > deepest) {
                    deepest = depth;
                    nesting_.around[s] = candidate;
                }
        }
        return std::move(nesting_);
    }

private:
    /// The number of components around the one of a shell.
    [[nodiscard]] std::size_t depth_of(std::uint32_t shell) const {
        return around_[outermost_of_.at(shells_.component_of[shell])].size();
    }

    void cast_all() {
        std::map<std::uint32_t, std::size_t> shell_count; // per component
        for (const std::uint32_t c : shells_.component_of) ++shell_count[c];
        Numbers closed; // triangles of components with bounded parts
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            if (shell_count.at(shells_.component_of[shells_.of_side[2 * t]]) > 1)
                closed.push_back(t);
        std::array<std::optional<Rays>, 3> rays; // per axis
        for (const auto& [triangle, count] : shell_count) {
            const std::size_t axis = axis_of(triangle);
            if (!rays[axis]) rays[axis].emplace(mesh_, closed, axis);
            std::map<std::uint32_t, int> winding;
            for (const auto& [passed, side] : rays[axis]->cast(centroid_of(mesh_, triangle))) {
                winding[shells_.of_side[2 * passed + 1]] += side; // the ray leaves what is behind
                winding[shells_.of_side[2 * passed]] -= side;
            }
            take(triangle, winding);
        }
    }

    [[nodiscard]] std::size_t axis_of(std::uint32_t triangle) const {
        return projection_axis(mesh_.planes[triangle]).value_or(2);
    }

    /// Takes the winding numbers of shells around a point of a component, whose lowest triangle is given.
    void take(std::uint32_t triangle, const std::map<std::uint32_t, int>& winding) {
        // The moved point is in front of its triangle if the normal points up.
        const int up = sgn(mesh_.planes[triangle][axis_of(triangle)]);
        std::uint32_t outermost = shells_.of_side[2 * triangle + (up > 0 ? 0 : 1)];
        Numbers around;
        for (const auto& [shell, number] : winding) {
            const bool own = shells_.component_of[shell] == triangle;
            if (own && number < 0) outermost = shell;
            if (!own && number > 0) around.push_back(shell);
        }
        nesting_.outermost[outermost] = true;
        outermost_of_[triangle] = outermost;
        around_[outermost] = std::move(around);
    }

    const ExactMesh& mesh_;
    const Shells& shells_;
    std::vector<Numbers> around_;                         ///< per outermost shell: all around it
    std::map<std::uint32_t, std::uint32_t> outermost_of_; ///< per component
    Nesting nesting_;
};

} // namespace

Nesting find_nesting(const ExactMesh& mesh, const Shells& shells) {
    return Locator(mesh, shells)();
}

} // namespace terrane::verifier
