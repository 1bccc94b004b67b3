// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Builds the model of a project from its surfaces. Holes are filled, horizons put in order,
// surfaces extended to the boundary of a volume of interest, sealed, arranged, cut by it, rounded
// and improved, blocks found and filled with tetrahedra; each optional step happens if the project
// asks for it. The caller reads and writes the files:
//
//   // io/project.hpp
//   const auto project = terrane::read_project("project.json");
//   auto inputs = terrane::read_inputs(*project);
//   const auto built = terrane::build(*project, std::move(inputs->build));
//
// Each mesh that is made is proven conforming once, and searched for volumes once.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

namespace terrane {

// Preprocesses the surfaces of a project before they are arranged: fills holes, then puts horizons
// in order.

/// The reports of preprocess().
struct Preprocessed {
    std::optional<FillWork> filled{};   ///< where the project has "fill"
    std::vector<NewContact> contacts{}; ///< of fillings with other triangles of their surface
    std::vector<Layer> order{};         ///< the layers of the project, from the top down
    std::optional<Layered> layered{};   ///< their stack, if filling succeeded

    /// Tells whether the surfaces can be used: no wanted hole stays open, no filling meets other
    /// triangles, and the stack of layers is conforming and in order.
    [[nodiscard]] bool good() const;
};

/// Fills the holes and orders the layers of a project. Replaced surfaces keep their names and
/// roles. A triangle in which layers coincide belongs to each of them. If filling fails, layers
/// stay unchanged. Errors: bad_option, with the key, for a name that no surface has or that two
/// entries share; those of find_border_loops, fill_holes and stack_layers.
Result<Preprocessed> preprocess(const Project& project, std::vector<Surface>& surfaces,
                                const Run& run = {});

/// The surfaces in the files of a project.
struct BuildInput {
    std::vector<Surface> surfaces{}; ///< with the names and roles that the project gives them
    std::vector<Surface> boundary{}; ///< of the volume of interest; empty: there is none
    std::vector<StatedBlock>
        stated_blocks{}; ///< that the files state, by the surfaces; without use
                         ///< where layers are put in order
};

/// The result of one round that makes triangles smaller where tetrahedra are bad.
struct RefinementRound {
    std::size_t triangles = 0;  ///< of the improved mesh
    std::size_t tetrahedra = 0; ///< that are left, without the outside if that is not wanted
    std::size_t bad = 0;        ///< of these: with a dihedral angle below bad_angle
    std::size_t apart = 0;      ///< of these: apart from such angles of the surfaces, see
                                ///< BadTetrahedron::is_at_input_angle
    std::size_t misshapen = 0;  ///< others, with a mean ratio below misshapen_ratio, see
                                ///< misshapen_tetrahedra()
};

/// The vertices of simplified surfaces that were moved once more where tetrahedra were bad.
struct LoosenedVertices {
    std::size_t count = 0;
    double farthest = 0; ///< how far one of them moved at most
};

/// The model of a project, and the result of each stage.
struct Built {
    std::vector<Surface>
        given{}; ///< the surfaces of the input that have values, at their places; others
                 ///< are empty. None: no surface has any
    Preprocessed preprocessed{};       ///< filled holes and ordered layers; empty: none asked for
    std::vector<std::string> labels{}; ///< per surface of the mesh: its name, made unique
    Arranged arranged{};               ///< the arrangement and its rounded mesh
    std::optional<ImprovedAndMeasured> improved{}; ///< where the project asks for it
    std::vector<Error>
        flaws{}; ///< what keeps the improved mesh from being used, with the keys of options to
                 ///< change
    std::vector<RefinementRound> rounds{}; ///< with tetrahedra.refine_bad: the first is the one
                                           ///< without; empty: not asked for
    LoosenedVertices loosened{};           ///< with improve.resolution: of the improved mesh
    std::size_t kept_round = 0;            ///< whose results these are
    std::optional<Model> model{};          ///< where blocks were found
    std::optional<FilledBlocks> filled{};  ///< where the project has outputs.tetrahedra
};

/// Callbacks that follow the progress of build(), which calls them from its caller's thread.
struct BuildObserver {
    std::function<void(BuildStage)> begins{};              ///< called before a stage
    std::function<void(BuildStage, const Built&)> ended{}; ///< after it, with the results so far
    std::function<void(BuildStage)> taken{};               ///< within a stage whose result was kept
};

/// Keeps results of stages that take long, `improve` and `tetrahedra`, for another call of build()
/// with the same inputs. A result is bytes under a key, a hash of all that decides it. A store must return
/// only bytes that build() kept under this key, unchanged: measures in them are believed. A mesh that is taken
/// is proven conforming again, and tetrahedra are checked again; a result that fails is made anew.
struct StageStore {
    /// Returns the bytes that were kept under a key, or none.
    std::function<std::optional<std::string>(BuildStage, const std::string& key)> find{};
    /// Keeps the bytes under a key.
    std::function<void(BuildStage, const std::string& key, const std::string& bytes)> keep{};
};

/// Takes the values of surfaces, and returns the surfaces that had some, as Built::given.
std::vector<Surface> with_values(std::vector<Surface>& surfaces);

/// Returns the values on a mesh of the arranged or improved surfaces, or a part of it, per surface. A vertex at the
/// place of a given one has its value; others are linear in the input triangle that contains it, or in the nearest.
std::vector<SurfaceValues> values_on(const Built& built, const Mesh& mesh);
/// Returns the values on the faces of tetrahedra that were built.
std::vector<SurfaceValues> values_on(const Built& built, const TetrahedralMesh& tetrahedra);
/// Returns the values on the mesh of layers; or else on concatenate() of the surfaces with holes.
std::vector<SurfaceValues> values_on_preprocessed(const Built& built);

/// Returns the name of a stage for people: "mend", "arrange", "improve", "blocks", "tetrahedra".
std::string_view name_of(BuildStage stage);

/// Returns how the surfaces of a project are arranged. Errors: bad_option for a name in seal_of that no surface has.
Result<ArrangeWithinOptions> arranging_of(const Project& project,
                                          std::span<const Surface> surfaces);

/// Returns the tetrahedra that a project asks for; errors about them name the project's keys.
TetrahedraRequest request_of(const Project& project);

/// Builds the model of a project, up to the stage project.last. Errors: those of the stages; bad_option, with
/// "source: key", for a name in the project that no surface has, before work is done; improper_contact if
/// preprocessing failed (see Preprocessed::good) or the rounded mesh is not conforming, unless that is the last stage; the first of Built::flaws: the observer then has the results so far. Violations found by the checks of tetrahedra are not an error: see filled->report.
Result<Built> build(const Project& project, BuildInput input, const Run& run = {},
                    const BuildObserver& observer = {}, const StageStore& store = {});

} // namespace terrane
