// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Moves the surfaces of a project by their stated uncertainty. A realisation has a number, from 1 on;
// number 0 is the model as it was given. Each random number comes from a stream that the seed, the number
// of the realisation, the name of the surface or group, and the kind of motion name, so that any realisation can
// be made again alone, and is the same on every machine and in every order (random_stream.hpp).
//
// Horizons, and surfaces without role, move along z; faults move along their mean normal; boundaries only with
// surfaces that share points with them (shared_places.hpp). Surfaces of one name move alike.
//   field  a random field (gaussian_field.hpp) times the standard deviation: of the map for horizons,
//          of space for faults
//   shift  the whole surface
//   tilt   a slope along x and one along y, about the centre of area
//   dip    a turn of a fault about the horizontal line in its mean plane through its centre of area
//   throw  horizons above a fault, abreast of it, go down, by less with the distance
// Motions of one surface are added. Cost of a realisation: field_waves cosines per vertex.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/pipeline/project.hpp>

namespace terrane {

/// A project whose surfaces are read, and its holes filled, once for all realisations.
class Realisations {
public:
    /// `maps`: per entry of project.uncertainty the surface whose z are standard deviations; none: it has
    /// none. Errors: bad_option with the key, for a name that no surface has or that two entries
    /// share, and for a motion that the surface cannot have; those of preprocess(); improper_contact where
    /// holes can't be filled.
    static Result<Realisations> prepare(Project project, BuildInput input,
                                        const std::vector<std::optional<Surface>>& maps,
                                        const Run& run = {});
    ~Realisations();
    Realisations(Realisations&&) noexcept;
    Realisations& operator=(Realisations&&) noexcept;

    /// Returns the project of every realisation: holes are filled already, and nothing is uncertain.
    [[nodiscard]] const Project& project() const;
    /// Returns the input of build() for a realisation.
    [[nodiscard]] BuildInput input_of(std::uint64_t seed, std::uint64_t number) const;
    /// Builds a realisation. What surfaces that do not move have in common is found once.
    [[nodiscard]] Result<Built> build(std::uint64_t seed, std::uint64_t number,
                                      const Run& run = {}) const;

private:
    struct State;
    explicit Realisations(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

} // namespace terrane
