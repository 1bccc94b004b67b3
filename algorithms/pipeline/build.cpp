// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/pipeline/build.hpp>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/model/known_arrange_within.hpp>
#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/model/seal_rules.hpp>
#include <terrane/algorithms/pipeline/detail/kept_results.hpp>
#include <terrane/algorithms/pipeline/detail/loosening.hpp>
#include <terrane/algorithms/pipeline/detail/refinement.hpp>
#include <terrane/algorithms/pipeline/known_build.hpp>

namespace terrane {
namespace {

using pipeline::detail::bad_places;
using pipeline::detail::BadPlaces;
using pipeline::detail::bytes_of;
using pipeline::detail::improved_from;
using pipeline::detail::key_of;
using pipeline::detail::loosen;
using pipeline::detail::Loosened;
using pipeline::detail::refinement_shares;
using pipeline::detail::scaled;
using pipeline::detail::tetrahedra_from;

RoundingOptions rounding_of(const Project& project) {
    return {.max_rounds = project.max_rounds, .check = project.check, .max_move = project.max_move};
}

Error refused(std::string sentence) {
    return {ErrorCode::improper_contact, std::move(sentence), ""};
}

/// Returns the error that keeps preprocessed surfaces from being used.
Error flaw_of(const Preprocessed& done) {
    if (done.filled)
        for (const NumberedHole& hole : done.filled->holes)
            if (!hole.refused.empty())
                return refused(fmt::format("hole {} of {} is left open: {}", hole.number,
                                           done.filled->surfaces[hole.task].label, hole.refused));
    if (!done.contacts.empty())
        return refused(fmt::format("the filling of hole {} meets other triangles improperly",
                                   done.contacts.front().hole));
    return refused("the stack of layers is no conforming mesh of doubles in order");
}

/// Runs the stages of one call of build().
class Builder {
public:
    Builder(const Project& project, BuildInput input, KnownTriangles* known, const Run& run,
            const BuildObserver& observer, const StageStore& store) :
        project_(project),
        input_(std::move(input)), known_(known), run_(run), observer_(observer), store_(store) {}

    Result<Built> operator()() {
        built_.given = with_values(input_.surfaces);
        for (const Status& sound :
             {check_column(project_.column), check_column(project_.column, infos_with_boundary())})
            if (!sound) return at_key(project_, sound.error().place, sound.error());
        if (auto sound = check_improvement(); !sound) return sound.error();
        const bool preprocessing = !project_.fill.empty() || project_.layers;
        if (auto done = stage(BuildStage::preprocess, preprocessing, &Builder::preprocess_surfaces);
            !done)
            return done.error();
        if (!built_.preprocessed.good() && project_.last > BuildStage::preprocess)
            return flaw_of(built_.preprocessed);
        if (auto done = stage(BuildStage::arrange, true, &Builder::arrange_surfaces); !done)
            return done.error();
        if (!built_.arranged.rounded.conforming && project_.last > BuildStage::arrange)
            return refused(fmt::format("{} pairs of triangles still meet improperly in doubles",
                                       built_.arranged.rounded.report.contacts.size()));
        if (auto done = stage(BuildStage::improve, project_.improve.has_value(),
                              &Builder::improve_in_rounds);
            !done)
            return done.error();
        if (!built_.flaws.empty()) return built_.flaws.front();
        if (auto done = stage(BuildStage::blocks, true, &Builder::find_blocks); !done)
            return done.error();
        if (auto done = stage(BuildStage::tetrahedra, !project_.outputs.tetrahedra.empty(),
                              &Builder::fill_with_tetrahedra);
            !done)
            return done.error();
        return std::move(built_);
    }

private:
    /// The results of a round of improve_in_rounds().
    struct Round {
        unsigned number = 0;
        std::vector<std::vector<LocalSize>> refinements; ///< that led to it
        BadPlaces places;
        LoosenedVertices loosened;
        std::optional<ImprovedAndMeasured> improved;
        std::optional<Model> model;
        std::optional<FilledBlocks> filled;
    };

    Status stage(BuildStage which, bool wanted, Status (Builder::*work)()) {
        if (!wanted || which > project_.last) return Done{};
        if (observer_.begins) observer_.begins(which);
        if (auto done = (this->*work)(); !done) return done;
        if (observer_.ended) observer_.ended(which, built_);
        return Done{};
    }

    Status preprocess_surfaces() {
        auto done = preprocess(project_, input_.surfaces, run_);
        if (!done) return done.error();
        built_.preprocessed = std::move(*done);
        return Done{};
    }

    Status arrange_surfaces() {
        auto options = arranging_of(project_, input_.surfaces);
        if (!options) return options.error();
        auto &surfaces = input_.surfaces, &boundary = input_.boundary;
        auto arranged =
            known_ != nullptr
                ? arrange_within(std::move(surfaces), std::move(boundary), *options, *known_, run_)
                : arrange_within(std::move(surfaces), std::move(boundary), *options, run_);
        if (!arranged) return arranged.error();
        built_.arranged = std::move(*arranged);
        built_.labels = unique_labels(infos_of(built_.arranged.surfaces));
        return Done{};
    }

    [[nodiscard]] std::vector<SurfaceInfo> infos_with_boundary() const {
        auto infos = infos_of(input_.surfaces);
        const auto boundary = infos_of(input_.boundary);
        infos.insert(infos.end(), boundary.begin(), boundary.end());
        return infos;
    }

    /// Sets the edge lengths of surfaces that the project names.
    Status set_lengths(std::span<const SurfaceInfo> surfaces,
                       const std::vector<std::string>& labels, ImproveOptions& options) const {
        const auto& wanted = project_.improve->edge_length_of;
        if (!wanted.empty()) options.edge_length_of.resize(surfaces.size());
        for (const auto& [name, length] : wanted) {
            const auto found = surfaces_called(name, surfaces, labels);
            if (found.empty())
                return at_key(project_, "improve.edge_length_of." + name,
                              not_called("surface", name, labels));
            for (const std::uint32_t s : found) options.edge_length_of[s] = length;
        }
        return Done{};
    }

    /// Checks by the surfaces as they were read whether they can be improved as the project asks.
    [[nodiscard]] Status check_improvement() const {
        if (!project_.improve) return Done{};
        const ProjectImprove& wanted = *project_.improve;
        const auto infos = infos_with_boundary();
        ImproveOptions options = wanted.options;
        if (auto set = set_lengths(infos, unique_labels(infos), options); !set) return set;
        if (wanted.resolution.length == 0 && wanted.resolution.dissolve)
            return at_key(project_, "improve.dissolve", "needs improve.resolution");
        if (auto sound = check_improvable(input_.surfaces, options); !sound)
            return at_key(project_, "improve." + sound.error().place, sound.error());
        return Done{};
    }

    [[nodiscard]] const ConformingMesh& rounded() const {
        return *built_.arranged.rounded.conforming;
    }

    /// Improves the mesh; again, with smaller triangles where tetrahedra are bad or misshapen, as
    /// often as the project says. Each round refines the best one so far, which counts at last: then
    /// blocks and tetrahedra are there, too. They are also if the surfaces were simplified, since
    /// vertices move where tetrahedra are bad.
    Status improve_in_rounds() {
        if (auto done = improve_best(); !done) return done;
        built_.flaws = flaws_of_improved();
        return Done{};
    }

    Status improve_best() {
        if (auto done = prepare_improvement(); !done) return done;
        if (auto done = improve_mesh(); !done) return done;
        const unsigned rounds =
            project_.outputs.tetrahedra.empty() ? 0 : project_.tetrahedra.refine_bad;
        if (rounds == 0) return is_loosened() ? find_blocks_and_fill() : Done{};
        std::optional<Round> best;
        std::size_t failed = 0; // rounds since the best one
        for (unsigned round = 0;; ++round) {
            if (auto done = find_blocks_and_fill(); !done) return done;
            Round now = take_round(round);
            const bool is_best = !best || is_better(round, best->number);
            failed = is_best ? 0 : failed + 1;
            if (is_best) best = std::move(now);
            const auto& sizes = best->places.sizes;
            if (round == rounds || sizes.empty() || failed == refinement_shares.size()) break;
            improve_options_.refinements = best->refinements;
            improve_options_.refinements.push_back(
                scaled(sizes, refinement_shares[failed], smallest()));
            if (auto done = improve_mesh(); !done) return done;
        }
        built_.kept_round = best->number;
        built_.loosened = best->loosened;
        built_.improved = std::move(best->improved);
        built_.model = std::move(best->model);
        built_.filled = std::move(best->filled);
        return Done{};
    }

    [[nodiscard]] bool is_better(unsigned round, unsigned than) const {
        const auto badness = [&](unsigned r) {
            const RefinementRound& of = built_.rounds[r];
            return std::tuple(of.apart, of.bad, of.misshapen);
        };
        return badness(round) < badness(than);
    }

    /// Tells whether vertices of surfaces may move for the sake of tetrahedra.
    [[nodiscard]] bool is_loosened() const {
        return project_.tetrahedra.move_vertices && built_.improved &&
               built_.improved->improved.report.sides_kept &&
               !project_.outputs.tetrahedra.empty() && project_.tetrahedra.options.optimise;
    }

    Status find_blocks_and_fill() {
        if (auto done = find_blocks(); !done) return done;
        return fill_with_tetrahedra();
    }

    [[nodiscard]] double smallest() const { return improve_options_.smallest; }

    Round take_round(unsigned number) {
        BadPlaces places = bad_places(built_.filled->tetrahedra, smallest());
        built_.rounds.push_back({built_.improved->improved.mesh->triangles.size(),
                                 built_.filled->tetrahedra.tetrahedra.size(), places.bad,
                                 places.apart, places.misshapen});
        return {number,
                improve_options_.refinements,
                std::move(places),
                built_.loosened,
                std::exchange(built_.improved, std::nullopt),
                std::exchange(built_.model, std::nullopt),
                std::exchange(built_.filled, std::nullopt)};
    }

    /// Reads how to improve the mesh and simplifies the surfaces, once for all rounds: another time,
    /// distances would be measured from surfaces that are simplified already.
    Status prepare_improvement() {
        const ProjectImprove& wanted = *project_.improve;
        ImproveOptions& options = improve_options_;
        options = wanted.options;
        options.check = project_.check;
        if (auto set = set_lengths(rounded()->surfaces, built_.labels, options); !set) return set;
        return simplify_surfaces();
    }

    /// Simplifies the surfaces, if the project states a resolution.
    Status simplify_surfaces() {
        const Resolution& wanted = project_.improve->resolution;
        if (wanted.length == 0) return Done{};
        auto done =
            simplify_to(wanted, improve_options_, rounding_of(project_), built_.arranged, run_);
        if (!done && done.error().code == ErrorCode::bad_option)
            return at_key(project_, "improve." + done.error().place, done.error());
        return done;
    }

    Status improve_mesh() {
        const ImproveOptions& options = improve_options_;
        const std::string key = key_for([&] { return key_of(rounded(), options); });
        if (const auto kept = found(BuildStage::improve, key)) {
            auto improved = improved_from(*kept, rounded(), options, run_);
            if (!improved) return improved.error();
            if ((built_.improved = std::move(*improved))) return taken(BuildStage::improve);
        }
        auto improved = improve_and_measure(rounded(), options, run_);
        if (!improved) return improved.error();
        built_.improved = std::move(*improved);
        if (store_.keep) store_.keep(BuildStage::improve, key, bytes_of(*built_.improved));
        return Done{};
    }

    /// Says why the improved mesh can't be used.
    [[nodiscard]] std::vector<Error> flaws_of_improved() const {
        std::vector<Error> flaws;
        const auto add = [&](const char* sentence) {
            flaws.push_back(at_key(project_, "improve.max_deviation", sentence));
        };
        const auto& simplified = built_.arranged.simplified;
        if (!built_.improved->improved.report.sides_kept)
            add("a small piece came to lie beyond a surface near it, so the blocks would not be "
                "the "
                "same; try a smaller value");
        if (!built_.improved->is_near_back())
            add("not all of each surface as it was is shown to be near enough to the improved one; "
                "try another value");
        if (simplified && !is_within_resolution(*simplified, built_.improved->improved.mesh, run_))
            add("not all of each surface is shown to be within the resolution of what it was; try "
                "a "
                "smaller value");
        return flaws;
    }

    Status find_blocks() {
        if (built_.model) return Done{}; // since improve_in_rounds()
        const Arrangement& exact = built_.arranged.exact;
        BlockNaming naming{.column = project_.column};
        if (!project_.layers) naming.stated = input_.stated_blocks;
        auto model = built_.improved
                         ? make_model(exact, rounded(), built_.improved->improved, run_, naming)
                         : make_model(exact, rounded(), run_, naming);
        if (!model) return model.error();
        built_.model = std::move(*model);
        return Done{};
    }

    Status fill_with_tetrahedra() {
        if (built_.filled) return Done{}; // since improve_in_rounds()
        const TetrahedraRequest request = request_of(project_);
        const std::string key = key_for([&] { return key_of(*built_.model, request); });
        if (const auto kept = found(BuildStage::tetrahedra, key))
            if (auto mesh = tetrahedra_from(*kept)) {
                if (auto done = fill_with(request, std::move(*mesh)); !done) return done;
                if (built_.filled->report.violations.empty()) return taken(BuildStage::tetrahedra);
                built_.filled.reset();
            }
        auto made = make_tetrahedra(*built_.model, request, run_);
        if (!made) return made.error();
        if (store_.keep) store_.keep(BuildStage::tetrahedra, key, bytes_of(*made));
        return fill_with(request, std::move(*made));
    }

    /// Improves and checks tetrahedra; moves vertices of improved surfaces for their sake.
    Status fill_with(TetrahedraRequest request, TetrahedralMesh made) {
        built_.loosened = {};
        std::optional<OptimiseReport> optimised;
        if (is_loosened()) {
            auto loosened = loosen(
                {built_.arranged, *built_.improved, improve_options_, *built_.model, request, made},
                run_);
            if (!loosened) return loosened.error();
            if (*loosened) {
                if (auto done = take(**loosened, made); !done) return done;
                optimised = (*loosened)->optimised;
                request.options.optimise.reset();
            }
        }
        auto filled = fill_blocks(*built_.model, request, std::move(made), run_);
        if (!filled) return filled.error();
        if (optimised) filled->optimised = optimised;
        built_.filled = std::move(*filled);
        return Done{};
    }

    /// Takes a mesh whose vertices have moved, its tetrahedra and its blocks.
    Status take(Loosened& loosened, TetrahedralMesh& made) {
        made = std::move(loosened.tetrahedra);
        if (!loosened.improved) return Done{};
        built_.improved = std::move(*loosened.improved);
        built_.loosened = loosened.moved;
        built_.model.reset();
        return find_blocks();
    }

    /// Computes a key, if results are kept.
    template <class F>
    [[nodiscard]] std::string key_for(const F& key) const {
        return store_.find || store_.keep ? key() : std::string();
    }

    [[nodiscard]] std::optional<std::string> found(BuildStage which, const std::string& key) const {
        return store_.find ? store_.find(which, key) : std::nullopt;
    }

    [[nodiscard]] Status taken(BuildStage which) const {
        if (observer_.taken) observer_.taken(which);
        return Done{};
    }

    const Project& project_;
    BuildInput input_;
    KnownTriangles* const known_; ///< of other versions of the model; nullptr: there are none
    const Run& run_;
    const BuildObserver& observer_;
    const StageStore& store_;
    ImproveOptions improve_options_; ///< of the last improvement
    Built built_;
};

} // namespace

std::string_view name_of(BuildStage stage) {
    static constexpr std::array<std::string_view, 5> names{"mend", "arrange", "improve", "blocks",
                                                           "tetrahedra"};
    return names.at(static_cast<std::size_t>(stage));
}

namespace {

Result<ArrangeWithinOptions> options_of(const Project& project, std::span<const Surface> surfaces) {
    ArrangeWithinOptions options{.arrange = {.search = project.search},
                                 .rounding = rounding_of(project),
                                 .tolerance = project.tolerance.value_or(0),
                                 .seal = project.seal.value_or(0),
                                 .seal_automatic = project.seal == 0.0,
                                 .extend = project.extend.value_or(0),
                                 .min_volume = project.min_volume == 0.0
                                                   ? small_volume_for(surfaces)
                                                   : project.min_volume.value_or(0)};
    const auto infos = infos_of(surfaces);
    const auto labels = unique_labels(infos);
    for (const auto& [name, distance] : project.seal_of) {
        const auto rules = seal_rules_for(name, distance, infos, labels);
        if (!rules) return at_key(project, "seal_of." + name, rules.error());
        options.seal_rules.insert(options.seal_rules.end(), rules->begin(), rules->end());
    }
    return options;
}

} // namespace

Result<ArrangeWithinOptions> arranging_of(const Project& project,
                                          std::span<const Surface> surfaces) {
    return guarded("for the model", "build", [&] { return options_of(project, surfaces); });
}

TetrahedraRequest request_of(const Project& project) {
    const ProjectTetrahedra& t = project.tetrahedra;
    const auto place = [&](const std::string& key) {
        return place_of_key(project, "tetrahedra." + key);
    };
    TetrahedraRequest r;
    r.options = t.options;
    const bool sized =
        t.options.edge_length || t.options.max_volume || !t.size_of.empty() || !t.size_in.empty();
    if (!t.options.radius_edge_ratio && project.improve && !sized &&
        t.options.mesher != Mesher::gmsh)
        r.options.radius_edge_ratio = improved_quality;
    for (const auto& [name, length] : t.size_of)
        r.size_of.push_back({{name, place("size_of." + name)}, length});
    for (const auto& [name, length] : t.size_in)
        r.size_in.push_back({{name, place("size_in." + name)}, length});
    for (std::size_t i = 0; i < t.split.size(); ++i)
        r.split.push_back({t.split[i], place(fmt::format("split[{}]", i))});
    r.outside = t.outside.value_or(project.volume.index() == 0);
    return r;
}

Result<Built> build(const Project& project, BuildInput input, const Run& run,
                    const BuildObserver& observer, const StageStore& store) {
    return guarded("for the model", "build", [&]() -> Result<Built> {
        return Builder(project, std::move(input), nullptr, run, observer, store)();
    });
}

Result<Built> build(const Project& project, BuildInput input, KnownTriangles& known,
                    const Run& run) {
    return guarded("for the model", "build", [&]() -> Result<Built> {
        return Builder(project, std::move(input), &known, run, {}, {})();
    });
}

} // namespace terrane
