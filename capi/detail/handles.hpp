// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The types behind the opaque handles of the C interface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/judge/judge.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/regions/regions.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/selection/selection.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/capi/arrangement.h>
#include <terrane/capi/base.h>
#include <terrane/capi/certificate.h>
#include <terrane/capi/mesh.h>
#include <terrane/capi/model.h>
#include <terrane/capi/project.h>
#include <terrane/capi/reconstruction.h>
#include <terrane/capi/sealing.h>
#include <terrane/capi/selection.h>
#include <terrane/capi/structure.h>
#include <terrane/capi/surfaces.h>
#include <terrane/capi/tetrahedra.h>
#include <terrane/capi/verification.h>
#include <terrane/io/files.hpp>

namespace terrane::capi::detail {

/// The types of handles, as numbers that no handle has by chance.
enum class Kind : std::uint64_t {
    run = 0x7465727261000001,
    surfaces,
    check_report,
    arrangement,
    cut,
    mesh,
    regions,
    improved,
    sealed,
    extended,
    volumes,
    structure,
    model,
    holes,
    layered,
    tetrahedra,
    verdict,
    built,
    simplified,
    error,
    mesh_judgement,
    selected,
};

/// The base of handles: their type comes first in memory.
template <Kind K>
struct Handle {
    static constexpr Kind own_kind = K;
    Kind kind = K;
    bool is_whole = false; ///< handed out to be freed; false for a part of another handle
};

/// The identity that two handles share if one was made from the other.
using Origin = std::shared_ptr<const char>;

} // namespace terrane::capi::detail

/// A code, a sentence and a place.
struct terrane_error : terrane::capi::detail::Handle<terrane::capi::detail::Kind::error> {
    terrane_code code = TERRANE_OK;
    std::string sentence{}, place{}, message{};
};

struct terrane_run : terrane::capi::detail::Handle<terrane::capi::detail::Kind::run> {
    unsigned threads = 1;
    std::stop_source stop{};
    terrane_progress progress = nullptr;
    void* progress_user = nullptr;
    terrane_timing timing = nullptr;
    void* timing_user = nullptr;
};

struct terrane_surfaces : terrane::capi::detail::Handle<terrane::capi::detail::Kind::surfaces> {
    std::vector<terrane::Surface> list{};
};

struct terrane_check_report
    : terrane::capi::detail::Handle<terrane::capi::detail::Kind::check_report> {
    terrane::CheckReport report{};
    std::vector<terrane_contact> contacts{};
};

struct terrane_arrangement
    : terrane::capi::detail::Handle<terrane::capi::detail::Kind::arrangement> {
    explicit terrane_arrangement(terrane::Arrangement made);

    /// Returns the vertices as doubles, which are computed when they are first asked for.
    const std::vector<terrane::Point3>& vertices() const;

    std::shared_ptr<const terrane::Arrangement> exact;
    terrane::capi::detail::Origin identity;

private:
    mutable std::mutex mutex_{};
    mutable bool computed_ = false;
    mutable std::vector<terrane::Point3> vertices_{};
};

struct terrane_cut : terrane::capi::detail::Handle<terrane::capi::detail::Kind::cut> {
    explicit terrane_cut(terrane::Arrangement inside) : arrangement(std::move(inside)) {}

    terrane_arrangement arrangement;
    std::vector<terrane_surface_cut> surfaces{};
};

struct terrane_mesh : terrane::capi::detail::Handle<terrane::capi::detail::Kind::mesh> {
    terrane_mesh() = default;
    explicit terrane_mesh(const terrane::ConformingMesh& proven) :
        mesh(proven.mesh()), proof(proven) {}
    terrane_mesh(terrane::RoundedMesh made, terrane::capi::detail::Origin made_from);

    terrane::SharedMesh mesh{};
    std::optional<terrane::ConformingMesh> proof{};
    std::optional<terrane::RoundedMesh> rounded{}; ///< what rounding made; it shares the mesh
    terrane::capi::detail::Origin origin{};        ///< the arrangement that was rounded; null: none
    terrane_rounding_report report{};
    std::vector<terrane_contact> contacts{};
};

struct terrane_regions : terrane::capi::detail::Handle<terrane::capi::detail::Kind::regions> {
    explicit terrane_regions(terrane::Regions found);

    std::vector<terrane_region> array{};
    terrane::IndexLists<std::uint32_t> neighbours{};
    terrane::IndexLists<std::uint32_t> of_triangles{};
};

struct terrane_improved : terrane::capi::detail::Handle<terrane::capi::detail::Kind::improved> {
    explicit terrane_improved(terrane::Improved made, const terrane_mesh& before);

    terrane::Improved improved;
    terrane::SharedMesh before; ///< the mesh that was improved
    terrane_mesh mesh;
    terrane_improve_report report{};
};

struct terrane_simplified : terrane::capi::detail::Handle<terrane::capi::detail::Kind::simplified> {
    explicit terrane_simplified(terrane::Simplified made, const terrane_mesh& before);

    terrane::AtResolution at; ///< the mesh before, and the joined places
    terrane_surfaces surfaces{};
    terrane_arrangement arrangement;
    terrane_mesh mesh;
    std::vector<std::uint32_t> block_before;
};

struct terrane_sealed : terrane::capi::detail::Handle<terrane::capi::detail::Kind::sealed> {
    explicit terrane_sealed(terrane::Arrangement made) : arrangement(std::move(made)) {}

    terrane_surfaces surfaces{};
    terrane_arrangement arrangement;
    std::vector<terrane_seal_change> changes{};
    std::vector<terrane_closed_gap> closed{};
    std::vector<terrane_open_gap> open{};
    double left = 0;
};

struct terrane_extended : terrane::capi::detail::Handle<terrane::capi::detail::Kind::extended> {
    terrane_surfaces surfaces{};
    std::vector<terrane_extended_border> borders{};
};

struct terrane_volumes : terrane::capi::detail::Handle<terrane::capi::detail::Kind::volumes> {
    /// Returns the exact measures as fractions, which are computed when they are first asked for.
    const std::vector<std::string>& fractions() const;

    terrane::Volumes volumes{};
    std::optional<terrane::ConformingMesh> mesh{};             ///< whose volumes they are; or
    std::shared_ptr<const terrane::Arrangement> arrangement{}; ///< those of this

private:
    mutable std::mutex mutex_{};
    mutable bool computed_ = false;
    mutable std::vector<std::string> fractions_{};
};

struct terrane_structure : terrane::capi::detail::Handle<terrane::capi::detail::Kind::structure> {
    static constexpr std::size_t list_count = 15;

    explicit terrane_structure(terrane::Structure made);

    terrane::Structure structure;
    std::vector<std::uint32_t> corners{};
    std::vector<terrane_model_line> lines{};
    std::vector<terrane_model_patch> patches{};
    std::vector<terrane_model_interface> interfaces{};
    std::vector<terrane_model_block> blocks{};
    std::array<terrane::IndexLists<std::uint32_t>, list_count> lists{};
};

struct terrane_model : terrane::capi::detail::Handle<terrane::capi::detail::Kind::model> {
    explicit terrane_model(terrane::Model made);

    terrane::Model model;
    terrane_mesh mesh;
    terrane_volumes volumes{};
    terrane_structure structure;
};

struct terrane_holes : terrane::capi::detail::Handle<terrane::capi::detail::Kind::holes> {
    explicit terrane_holes(terrane::FillWork found);

    terrane::FillWork work;
    std::vector<terrane_hole> array{};
    terrane::IndexLists<std::uint32_t> borders{};
    terrane_surfaces surfaces{};
};

struct terrane_layered : terrane::capi::detail::Handle<terrane::capi::detail::Kind::layered> {
    explicit terrane_layered(terrane::Layered made);

    terrane::Layered layered;
    terrane_mesh mesh;
    std::vector<terrane_layer_report> reports{};
};

struct terrane_selected : terrane::capi::detail::Handle<terrane::capi::detail::Kind::selected> {
    explicit terrane_selected(terrane::Selected made);

    terrane::Selected selected;
    terrane_mesh mesh;
    std::vector<terrane_selected_piece> pieces{};
};

struct terrane_tetrahedra : terrane::capi::detail::Handle<terrane::capi::detail::Kind::tetrahedra> {
    explicit terrane_tetrahedra(terrane::FilledBlocks made);

    terrane::FilledBlocks filled;
    std::vector<std::string> violations{};
    std::vector<terrane_block_volume> volumes{};
};

struct terrane_verdict : terrane::capi::detail::Handle<terrane::capi::detail::Kind::verdict> {
    /// A rule that does not hold.
    struct Item {
        std::string rule, sentence;
        std::vector<std::uint32_t> elements{};
    };
    std::vector<Item> items{};
};

struct terrane_mesh_judgement
    : terrane::capi::detail::Handle<terrane::capi::detail::Kind::mesh_judgement> {
    terrane::MeshJudgement judgement{};
};

struct terrane_built : terrane::capi::detail::Handle<terrane::capi::detail::Kind::built> {
    explicit terrane_built(terrane::Arrangement exact) : arrangement(std::move(exact)) {}

    terrane_surfaces surfaces{};
    terrane_arrangement arrangement;
    std::unique_ptr<terrane_model> model{};
    std::unique_ptr<terrane_tetrahedra> tetrahedra{};
};

namespace terrane::capi::detail {

/// Returns the run of the library that stands for the caller's; null: one thread.
Run run_of(const terrane_run* run);

/// Returns contacts as C has them.
std::vector<terrane_contact> contacts_of(const std::vector<ImproperContact>& contacts);

/// Returns a mesh with its proof, which is found if there is none. Errors: improper_contact, ...
ConformingMesh proven(const terrane_mesh& mesh, const Run& run);

/// Returns how files are read: the format, if one is named, and the rest.
struct Reading {
    std::optional<Format> format{};
    ReadOptions options{};
};
Reading reading_of(const terrane_read_options* options);
terrane_read_options default_reading() noexcept;

/// Returns how files are written.
WriteOptions writing_of(const terrane_write_options* options);

/// Returns numbers of surfaces that bound a volume, which must be ascending and less than `count`.
std::vector<std::uint32_t> boundary_of(const std::uint32_t* boundary, std::size_t boundary_count,
                                       std::size_t count);

/// Writes a point into the three numbers of a struct.
inline void give_point(const Point3& from, double (&to)[3]) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

} // namespace terrane::capi::detail
