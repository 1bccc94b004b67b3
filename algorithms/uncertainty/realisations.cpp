// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/uncertainty/realisations.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/pipeline/known_build.hpp>
#include <terrane/algorithms/uncertainty/detail/fault_plane.hpp>
#include <terrane/algorithms/uncertainty/detail/fault_slip.hpp>
#include <terrane/algorithms/uncertainty/detail/map_values.hpp>
#include <terrane/algorithms/uncertainty/gaussian_field.hpp>
#include <terrane/algorithms/uncertainty/random_stream.hpp>
#include <terrane/algorithms/uncertainty/shared_places.hpp>

namespace terrane {
namespace {

using uncertainty::detail::FaultPlane;
using uncertainty::detail::MapValues;
using uncertainty::detail::SlipShares;

constexpr double degree = 0.017453292519943295; ///< in radians

Motion motion_of(const Surface& surface) {
    if (surface.role == Role::fault) return Motion::across;
    return surface.role == Role::boundary ? Motion::none : Motion::vertical;
}

/// An entry of the project with the surfaces of one name.
struct Mover {
    ProjectUncertainty entry;
    std::size_t number = 0;                        ///< of the entry in the project
    std::string stream;                            ///< name of its random numbers
    std::vector<std::uint32_t> surfaces{};         ///< that it moves
    FaultPlane plane{};                            ///< of all of them together
    std::vector<std::vector<double>> deviations{}; ///< per surface and vertex: of the field
    std::vector<SlipShares> slips{};               ///< of faults with a throw: what it moves
};

Variogram variogram_of(const ProjectField& field) {
    Variogram v;
    v.model = VariogramModel::gaussian;
    if (field.model == "spherical") v.model = VariogramModel::spherical;
    if (field.model == "exponential") v.model = VariogramModel::exponential;
    if (field.model == "matern") v.model = VariogramModel::matern;
    v.range = field.range;
    v.exponent = field.smoothness;
    v.angle = 90 - field.azimuth; // an azimuth is measured from y, clockwise
    v.ratio = field.ratio;
    v.sill = 1;
    return v;
}

Error without_deviation(const Project& project, std::size_t entry) {
    return at_key(project, fmt::format("uncertainty[{}].field.sd", entry),
                  "kriging is for surfaces in which the key fill fills holes by kriging");
}

/// Returns the motion of a point by an entry, apart from the throw of faults.
Point3 moved_by(const Mover& mover, Motion motion, const Point3& p, double along,
                const std::array<double, 3>& turns) {
    const Point3& c = mover.plane.centre;
    if (motion == Motion::vertical)
        return {0, 0, along + turns[0] * (p.x - c.x) + turns[1] * (p.y - c.y)};
    const Point3 turned = mover.plane.turned(minus(p, c), turns[2]);
    const Point3& n = mover.plane.normal;
    return {along * n.x + turned.x, along * n.y + turned.y, along * n.z + turned.z};
}

} // namespace

struct Realisations::State {
    Project project;
    BuildInput input;
    std::vector<Motion> motions;
    std::vector<Mover> movers;
    std::unique_ptr<SharedPlaces> places;
    KnownTriangles known{}; ///< of the surfaces that do not move

    Status find_movers(const Project& full);
    Status add_movers(const Project& full, std::size_t entry, std::vector<bool>& taken);
    Status find_deviations(const Project& full, const Preprocessed& done,
                           const std::vector<std::optional<Surface>>& maps);
    void add_motion(const Mover& mover, const std::string& name,
                    std::vector<std::vector<Point3>>& own) const;
};

Status Realisations::State::add_movers(const Project& full, std::size_t entry,
                                       std::vector<bool>& taken) {
    const ProjectUncertainty& u = full.uncertainty[entry];
    const auto key = [&](const char* name) {
        return fmt::format("uncertainty[{}].{}", entry, name);
    };
    const auto infos = infos_of(input.surfaces);
    const auto labels = unique_labels(infos);
    auto found = surfaces_called(u.surface, infos, labels);
    for (const Role role : {Role::horizon, Role::fault})
        if (found.empty() && u.surface == (role == Role::fault ? "fault" : "horizon"))
            for (std::uint32_t s = 0; s < infos.size(); ++s)
                if (infos[s].role == role) found.push_back(s);
    if (found.empty())
        return at_key(full, key("surface"), not_called("surface", u.surface, labels));
    const std::size_t first = movers.size();
    for (const std::uint32_t s : found) {
        if (taken[s]) return at_key(full, key("surface"), labels[s] + " is in an entry before");
        taken[s] = true;
        if (motions[s] == Motion::none)
            return at_key(full, key("surface"), labels[s] + " is a boundary, which stays");
        const bool is_fault = motions[s] == Motion::across;
        if (is_fault && u.tilt > 0)
            return at_key(full, key("tilt"), labels[s] + " is a fault: state dip instead");
        if (!is_fault && (u.dip > 0 || u.slip > 0))
            return at_key(full, key(u.dip > 0 ? "dip" : "throw"),
                          labels[s] + " is no fault; its role can be set in surfaces");
        const auto same = std::find_if(
            movers.begin() + static_cast<std::ptrdiff_t>(first), movers.end(),
            [&](const Mover& m) { return infos[m.surfaces[0]].name == infos[s].name; });
        if (same != movers.end())
            same->surfaces.push_back(s);
        else
            movers.push_back({u, entry, u.group.empty() ? infos[s].name : u.group, {s}});
    }
    return Done{};
}

Status Realisations::State::find_movers(const Project& full) {
    std::vector<bool> taken(input.surfaces.size());
    for (std::size_t i = 0; i < full.uncertainty.size(); ++i)
        if (auto added = add_movers(full, i, taken); !added) return added;
    for (Mover& mover : movers) {
        mover.plane = FaultPlane(input.surfaces, mover.surfaces);
        if (mover.entry.slip == 0) continue;
        for (std::uint32_t s = 0; s < input.surfaces.size(); ++s)
            if (motions[s] == Motion::vertical)
                mover.slips.push_back(uncertainty::detail::slip_shares(
                    input.surfaces, mover.surfaces, mover.plane, mover.entry.reach, SurfaceId(s)));
    }
    return Done{};
}

/// Finds the standard deviation of each vertex that a field moves.
Status Realisations::State::find_deviations(const Project& full, const Preprocessed& done,
                                            const std::vector<std::optional<Surface>>& maps) {
    for (Mover& mover : movers) {
        if (!mover.entry.field) continue;
        const std::size_t entry = mover.number;
        const ProjectField& field = *mover.entry.field;
        std::optional<MapValues> map;
        if (entry < maps.size() && maps[entry]) map.emplace(*maps[entry]);
        for (const std::uint32_t s : mover.surfaces) {
            const auto& points = input.surfaces[s].vertices;
            auto& deviations = mover.deviations.emplace_back(points.size(), field.sd.value_or(0));
            if (map) {
                for (std::size_t v = 0; v < points.size(); ++v) {
                    deviations[v] = map->at(points[v].x, points[v].y);
                    if (!(deviations[v] >= 0))
                        return at_key(full, fmt::format("uncertainty[{}].field.map", entry),
                                      "has values below 0, which are no standard deviations");
                }
            } else if (field.kriging) {
                const HoledSurface* filled = nullptr;
                if (done.filled)
                    for (const HoledSurface& h : done.filled->surfaces)
                        if (h.task.surface == s) filled = &h;
                if (filled == nullptr ||
                    std::any_of(filled->deviation.begin(), filled->deviation.end(),
                                [](double d) { return std::isnan(d); }))
                    return without_deviation(full, entry);
                deviations = filled->deviation;
            }
        }
    }
    return Done{};
}

/// Adds the motions of one entry. `name` starts the names of streams.
void Realisations::State::add_motion(const Mover& mover, const std::string& name,
                                     std::vector<std::vector<Point3>>& own) const {
    const auto stream = [&](const char* kind) {
        return RandomStream(name + mover.stream + '\0' + kind);
    };
    const ProjectUncertainty& u = mover.entry;
    const double shift = u.shift * stream("shift").normal();
    RandomStream tilts = stream("tilt");
    const double tilt_x = u.tilt * degree * tilts.normal(),
                 tilt_y = u.tilt * degree * tilts.normal();
    const std::array<double, 3> turns{tilt_x, tilt_y, u.dip / 360 * stream("dip").normal()};
    std::optional<GaussianField> field;
    if (u.field) field.emplace(variogram_of(*u.field), stream("field"));
    for (std::size_t i = 0; i < mover.surfaces.size(); ++i) {
        const std::uint32_t s = mover.surfaces[i];
        const auto& points = input.surfaces[s].vertices;
        for (std::size_t v = 0; v < points.size(); ++v) {
            const Point3& p = points[v];
            double along = shift;
            if (field && mover.deviations[i][v] > 0)
                along += mover.deviations[i][v] *
                         field->at(motions[s] == Motion::vertical ? Point3{p.x, p.y, 0} : p);
            const Point3 by = moved_by(mover, motions[s], p, along, turns);
            Point3& sum = own[s][v];
            sum = {sum.x + by.x, sum.y + by.y, sum.z + by.z};
        }
    }
    const double slip = u.slip * stream("throw").normal();
    for (const SlipShares& shares : mover.slips)
        for (std::size_t v = 0; v < shares.shares.size(); ++v)
            own[shares.surface][v].z -= slip * shares.shares[v];
}

Realisations::Realisations(std::unique_ptr<State> state) : state_(std::move(state)) {}
Realisations::~Realisations() = default;
Realisations::Realisations(Realisations&&) noexcept = default;
Realisations& Realisations::operator=(Realisations&&) noexcept = default;

const Project& Realisations::project() const {
    return state_->project;
}

Result<Realisations> Realisations::prepare(Project project, BuildInput input,
                                           const std::vector<std::optional<Surface>>& maps,
                                           const Run& run) {
    return guarded("for the surfaces", "uncertainty", [&]() -> Result<Realisations> {
        auto state = std::make_unique<State>();
        state->input = std::move(input);
        Project filling = project;
        filling.layers.reset(); // they are put in order after they have moved
        auto done = preprocess(filling, state->input.surfaces, run);
        if (!done) return done.error();
        if (!done->good())
            return Error{ErrorCode::improper_contact,
                         "holes can't be filled; terrane build says why", project.source};
        for (const Surface& s : state->input.surfaces) state->motions.push_back(motion_of(s));
        if (auto found = state->find_movers(project); !found) return found.error();
        if (auto found = state->find_deviations(project, *done, maps); !found) return found.error();
        state->places = std::make_unique<SharedPlaces>(state->input.surfaces, state->motions);
        project.fill.clear();
        project.uncertainty.clear();
        state->project = std::move(project);
        return Realisations(std::move(state));
    });
}

BuildInput Realisations::input_of(std::uint64_t seed, std::uint64_t number) const {
    BuildInput moved = state_->input;
    if (number == 0 || state_->movers.empty()) return moved;
    std::vector<std::vector<Point3>> own;
    for (const Surface& s : moved.surfaces) own.emplace_back(s.vertices.size());
    const std::string name = fmt::format("{} {} ", seed, number);
    for (const Mover& mover : state_->movers) state_->add_motion(mover, name, own);
    const auto motions = state_->places->reconciled(own);
    for (std::size_t s = 0; s < own.size(); ++s)
        for (std::size_t v = 0; v < own[s].size(); ++v) {
            const Point3& by = motions[s][v];
            if (by == Point3{}) continue; // -0 + 0 would change bits
            Point3& p = moved.surfaces[s].vertices[v];
            p = {p.x + by.x, p.y + by.y, p.z + by.z};
        }
    return moved;
}

Result<Built> Realisations::build(std::uint64_t seed, std::uint64_t number, const Run& run) const {
    return terrane::build(project(), input_of(seed, number), state_->known, run);
}

} // namespace terrane
