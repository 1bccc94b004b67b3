// SPDX-License-Identifier: LGPL-3.0-or-later
#include "forge_subjects.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/io/block_certificate.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/certify.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/meshes/gmsh.hpp>
#include <terrane/io/meshes/vtk.hpp>

#include "forge_meaning.hpp"
#include "report.hpp"
#include "support/block_folder.hpp"

namespace terrane::fuzz {

namespace {

constexpr std::size_t most_triangles = 60;

template <class T>
T needed(Result<T> result) {
    if (!result) fail("no base model: " + result.error().message());
    return std::move(result).value();
}

/// The arrangement that the producer makes of an OBJ file, before its kind matters.
struct Arranged {
    Subject subject;
    std::vector<InputRecord> records;
    Arrangement exact;
    RoundedMesh rounded;
};

std::optional<Arranged> arranged(std::string_view obj) {
    Arranged a;
    auto surfaces = parse_surfaces(obj, "input.obj", Format::obj);
    if (!surfaces) return std::nullopt;
    std::size_t count = 0;
    for (const Surface& surface : *surfaces) count += surface.triangles.size();
    if (count > most_triangles) return std::nullopt;
    a.subject.surfaces = std::move(surfaces).value();
    a.subject.files = {input_file(obj, a.subject.surfaces)};
    a.records = {{"input.obj", a.subject.files[0].sha256, a.subject.files[0].bytes,
                  a.subject.surfaces.size()}};
    auto exact = arrange(a.subject.surfaces);
    if (!exact || exact->triangles.size() > 4 * most_triangles) return std::nullopt;
    a.exact = std::move(exact).value();
    auto rounded = round_to_doubles(a.exact);
    if (!rounded) return std::nullopt;
    a.rounded = std::move(rounded).value();
    return a;
}

OutputRecord add_output(Subject& subject, const std::string& name, const std::string& format,
                        std::string contents, const std::vector<SurfaceInfo>& surfaces) {
    subject.contents.push_back(std::move(contents));
    return record_output(subject.contents.back(), name, format, surfaces);
}

void parse(Subject& subject, const std::string& text) {
    auto parsed = parse_certificate(text, "certificate");
    if (!parsed) fail("a certificate that can't be parsed: " + parsed.error().message());
    subject.certificate = std::move(parsed).value();
}

// --- Models -------------------------------------------------------------------------------------

/// A tetrahedron with a right-angled corner.
Surface corner(const std::string& name, const Point3& at, double size) {
    Surface s{name, Role::unknown, {}, {}};
    s.vertices = {
        at, {at.x + size, at.y, at.z}, {at.x, at.y + size, at.z}, {at.x, at.y, at.z + size}};
    s.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return s;
}

Surface triangle(const std::string& name, const Point3& a, const Point3& b, const Point3& c) {
    return {name, Role::unknown, {a, b, c}, {{0, 1, 2}}};
}

/// A wavy grid of n x n squares without those from `low` to `high` in both directions.
Surface grid(const std::string& name, int n, double height, int low, int high) {
    Surface s{name, Role::unknown, {}, {}};
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            s.vertices.push_back(
                {static_cast<double>(i), static_cast<double>(j),
                 std::round(64 * height * std::sin(0.8 * i) * std::cos(0.6 * j)) / 64});
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            if (i >= low && i < high && j >= low && j < high) continue;
            const auto a = static_cast<std::uint32_t>(i * (n + 1) + j);
            const auto b = a + static_cast<std::uint32_t>(n) + 1;
            s.triangles.push_back({a, b, b + 1});
            s.triangles.push_back({a, b + 1, a + 1});
        }
    return s;
}

using Model3 = std::vector<Surface>;

/// A body in a body, a sheet that pierces the outer one, and a body apart.
Model3 nested() {
    return {corner("outer", {0, 0, 0}, 8), corner("inner", {1, 1, 1}, 1),
            triangle("sheet", {-1, 2, 1}, {9, 3, 1.5}, {2, -1, 5}), corner("apart", {20, 0, 0}, 1)};
}

/// Bodies that share a side, and one that touches a corner.
Model3 touching() {
    return {corner("a", {0, 0, 0}, 2),
            corner("b", {0, 0, 0}, -2),
            corner("c", {2, 0, 0}, 1),
            {"d",
             Role::unknown,
             {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, -3}},
             {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}}};
}

// --- Kinds --------------------------------------------------------------------------------------

Arranged with_blocks(const Model3& surfaces, Model& model) {
    auto a = arranged(obj_text(surfaces));
    if (!a || !a->rounded.conforming) fail("no base model: it cannot be rounded");
    model = needed(make_model(a->exact, *a->rounded.conforming));
    a->subject.mesh = *model.mesh;
    a->subject.volumes = model.volumes;
    return std::move(*a);
}

Subject volumes_subject(const Model3& surfaces, const std::string& part_format) {
    Model model{*arranged(obj_text(surfaces)).value().rounded.conforming};
    Arranged a = with_blocks(surfaces, model);
    std::vector<OutputRecord> outputs;
    for (auto& [name, contents] : block_folder::folder_of(model, part_format))
        outputs.push_back(add_output(a.subject, "model/" + name, name.substr(name.rfind('.') + 1),
                                     contents, model.mesh->surfaces));
    parse(a.subject, to_certificate({a.records, a.subject.surfaces, a.exact, &a.rounded, outputs},
                                    {model, extras_of({model, std::nullopt, std::nullopt})}));
    return std::move(a.subject);
}

#ifdef TERRANE_HAS_TETGEN
Model3 body_in_body() {
    return {corner("outer", {0, 0, 0}, 8), corner("inner", {1, 1, 1}, 1)};
}

Model3 divided_body() {
    return {corner("body", {0, 0, 0}, 8), triangle("sheet", {-1, -1, 1}, {20, -1, 2}, {-1, 20, 3})};
}

Subject tetrahedra_subject(const Model3& surfaces, const TetrahedraRequest& request) {
    Model model{*arranged(obj_text(surfaces)).value().rounded.conforming};
    Arranged a = with_blocks(surfaces, model);
    const FilledBlocks filled = needed(fill_blocks(model, request));
    const TetrahedralMesh& mesh = filled.tetrahedra;
    const std::vector<OutputRecord> outputs{
        add_output(a.subject, "out.vtu", "vtu", needed(to_vtu(mesh, false, {}, filled.block_names)),
                   mesh.surfaces),
        add_output(a.subject, "out.msh", "msh", to_msh(mesh, filled.block_names), mesh.surfaces)};
    parse(a.subject, to_certificate({a.records, a.subject.surfaces, a.exact, &a.rounded, outputs},
                                    {model}, mesh));
    return std::move(a.subject);
}
#endif

Subject improved_subject(const Model3& surfaces, const ImproveOptions& options) {
    auto a = arranged(obj_text(surfaces));
    if (!a || !a->rounded.conforming) fail("no base model: it cannot be rounded");
    const auto made = needed(improve_and_measure(*a->rounded.conforming, options));
    const Mesh& mesh = made.improved.mesh;
    const std::vector<OutputRecord> outputs{add_output(
        a->subject, "out.obj", "obj", needed(format_mesh(mesh, Format::obj)), mesh.surfaces)};
    parse(a->subject,
          to_improved_certificate({a->records, a->subject.surfaces, a->exact, &a->rounded, outputs},
                                  mesh, made.improved.report.bound_of));
    return std::move(a->subject);
}

/// Returns surfaces as a file; there is no certificate yet.
Subject file_subject(const Model3& surfaces) {
    Subject s;
    const std::string obj = obj_text(surfaces);
    s.surfaces = needed(parse_surfaces(obj, "input.obj", Format::obj));
    s.files = {input_file(obj, s.surfaces)};
    return s;
}

InputRecord record_of(const InputFile& file, const std::string& name) {
    return {name, file.sha256, file.bytes, file.surfaces.size()};
}

Subject filled_subject(const Model3& surfaces, FillMethod method) {
    Subject s = file_subject(surfaces);
    const std::vector<InputRecord> records{record_of(s.files[0], "input.obj")};
    std::vector<FillTask> tasks;
    for (std::uint32_t i = 0; i < s.surfaces.size(); ++i) {
        tasks.push_back({SurfaceId(i), {}});
        tasks.back().options.method = method;
    }
    const FillWork work = needed(fill_surfaces(s.surfaces, tasks));
    std::vector<Surface> filled;
    std::vector<FilledRecord> parts;
    for (const HoledSurface& surface : work.surfaces) {
        filled.push_back(surface.filled);
        parts.push_back({&surface.filled, surface.given_vertices, surface.given_triangles,
                         surface.interpolated, surface.deviation});
    }
    const Mesh mesh = concatenate(filled);
    const std::vector<OutputRecord> outputs{
        add_output(s, "out.obj", "obj", needed(format_mesh(mesh, Format::obj)), mesh.surfaces)};
    parse(s, to_filled_certificate(records, s.surfaces, outputs, parts));
    return s;
}

// --- Layers and volumes of interest -------------------------------------------------------------

/// Moves a surface, and tilts it along x.
Surface placed(Surface s, const Point3& by, double slope) {
    for (Point3& p : s.vertices) p = {p.x + by.x, p.y + by.y, p.z + by.z + slope * p.x};
    return s;
}

/// Three horizons: the middle one is the softest and crosses both others, the hardest ends before
/// them. A fourth surface is in no order.
Model3 crossing_horizons() {
    return {placed(grid("top", 3, 0, 3, 3), {0, 0, 1.25}, 0.125),
            placed(grid("middle", 3, 1.75, 3, 3), {0, 0, 0.5}, 0),
            placed(grid("base", 2, 0.25, 2, 2), {-0.625, 0.375, 0.25}, 0.0625),
            triangle("apart", {5, 5, 0}, {6, 5, 0}, {5, 6, 1})};
}

/// Horizons of which one faces down, and one covers a small part of the others.
Model3 partial_horizons() {
    Surface below = grid("below", 2, 0.5, 2, 2);
    for (Triangle& t : below.triangles) std::swap(t[0], t[1]);
    return {triangle("small", {0.5, 0.25, 0.75}, {1.5, 0.375, -0.5}, {0.75, 1.5, 0.5}), below,
            placed(grid("flat", 2, 0, 2, 2), {0.25, 0.125, 0.125}, 0)};
}

/// Four horizons. The two in the middle are the softest: there is room for one of them only, if
/// horizons are to be half a unit apart.
Model3 narrow_horizons() {
    return {placed(grid("top", 2, 0, 2, 2), {0, 0, 1.5}, 0),
            placed(grid("upper", 2, 0.25, 2, 2), {0, 0, 1.125}, -0.25),
            placed(grid("lower", 2, 0.5, 2, 2), {0.25, 0, 0.75}, 0.125),
            placed(grid("base", 2, 0, 1, 2), {0, 0, 0.75}, -0.0625)};
}

Subject layered_subject(const Model3& surfaces, const std::vector<double>& hardness,
                        double thickness = 0) {
    Subject s = file_subject(surfaces);
    std::vector<Layer> order;
    for (const double h : hardness)
        order.push_back({SurfaceId(static_cast<std::uint32_t>(order.size())), h});
    const Layered layered = needed(stack_layers(s.surfaces, order, {.min_thickness = thickness}));
    require(layered.is_stack(), "no base model: the layers are not in order");
    const Mesh& mesh = layered.rounded.mesh;
    const std::vector<OutputRecord> outputs{
        add_output(s, "out.obj", "obj", needed(format_mesh(mesh, Format::obj)), mesh.surfaces)};
    const std::vector<InputRecord> records{record_of(s.files[0], "input.obj")};
    parse(s, to_layered_certificate(records, s.surfaces, outputs, order, layered));
    return s;
}

/// Cuts the surfaces of a subject, and certifies that.
std::optional<Subject> cut_by(Subject s, const std::vector<Surface>& boundary,
                              const VolumeRecord& volume) {
    auto within = arrange_within(s.surfaces, boundary);
    if (!within) return std::nullopt;
    s.surfaces = within->surfaces;
    const Mesh& mesh = *within->rounded.mesh;
    const std::vector<OutputRecord> outputs{
        add_output(s, "out.obj", "obj", needed(format_mesh(mesh, Format::obj)), mesh.surfaces)};
    const std::vector<InputRecord> records{record_of(s.files[0], "input.obj")};
    parse(s, needed(to_cut_certificate(
                 {records, within->surfaces, within->exact, &within->rounded, outputs}, volume,
                 boundary.size(), {})));
    return s;
}

/// Appends what a certificate adds to the surfaces.
Model3 grown(Model3 surfaces, const SealedClaim& sealed) {
    for (std::size_t s = 0; s < surfaces.size() && s < sealed.surfaces.size(); ++s)
        for (const auto* list : {&sealed.surfaces[s].extended, &sealed.surfaces[s].sealed})
            for (const auto& corners : *list) {
                const auto v = static_cast<std::uint32_t>(surfaces[s].vertices.size());
                surfaces[s].vertices.insert(surfaces[s].vertices.end(), corners.begin(),
                                            corners.end());
                surfaces[s].triangles.push_back({v, v + 1, v + 2});
            }
    return surfaces;
}

/// A sheet that ends short of a wall, one that reaches beyond it, and the wall.
Model3 gaping() {
    return {placed(grid("short", 2, 0.25, 2, 2), {-2.0625, 0, 0}, 0.125),
            placed(grid("long", 2, 0.125, 2, 2), {-1.9375, 0.125, 1.25}, 0),
            {"wall",
             Role::unknown,
             {{0, -1, -2}, {0.0625, 3, -2}, {0, 3, 3}, {-0.03125, -1, 3}},
             {{0, 1, 2}, {0, 2, 3}}}};
}

/// A sheet with a notch whose one side ends above the ridge of a roof.
Model3 notched() {
    return {{"notched",
             Role::unknown,
             {{0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, 0.125, 0}},
             {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 5, 4}, {0, 6, 5}}},
            {"roof",
             Role::unknown,
             {{-0.5, 0, -0.0625},
              {1.5, 0, -0.0625},
              {-0.5, 0.25, -1},
              {1.5, 0.25, -1},
              {-0.5, -0.25, -1},
              {1.5, -0.25, -1}},
             {{0, 1, 3}, {0, 3, 2}, {1, 0, 4}, {1, 4, 5}}}};
}

/// Seals and extends surfaces, in a box or not, and certifies that.
Subject sealed_subject(const Model3& surfaces, double seal, double extend,
                       const std::vector<double>& box) {
    Subject s = file_subject(surfaces);
    std::vector<Surface> boundary;
    VolumeRecord volume;
    if (!box.empty()) {
        const std::vector<Point2> corners{
            {box[0], box[1]}, {box[2], box[1]}, {box[2], box[3]}, {box[0], box[3]}};
        volume = {"prism", corners, {box[4], box[5]}};
        boundary = needed(polygon_boundary(corners, box[4], box[5]));
    }
    ArrangeWithinOptions options;
    options.seal = seal;
    options.extend = extend;
    const auto within = needed(arrange_within(s.surfaces, boundary, options));
    s.surfaces = within.surfaces;
    const Mesh& mesh = *within.rounded.mesh;
    const std::vector<OutputRecord> outputs{
        add_output(s, "out.obj", "obj", needed(format_mesh(mesh, Format::obj)), mesh.surfaces)};
    const std::vector<InputRecord> records{record_of(s.files[0], "input.obj")};
    parse(s, needed(to_cut_certificate(
                 {records, within.surfaces, within.exact, &within.rounded, outputs},
                 {box.empty() ? nullptr : &volume, boundary.size(), within.growth}, {})));
    return s;
}

/// Two horizons that cross, and a wall.
Model3 cut_surfaces() {
    return {placed(grid("first", 2, 0.5, 2, 2), {0, 0, 0}, 0.25),
            placed(grid("second", 2, 0, 2, 2), {0.125, 0, 0.5}, -0.125),
            triangle("wall", {0.75, -1, -2}, {1, 3, -2}, {0.875, 1, 3})};
}

Subject prism_subject(const std::vector<Point2>& corners, double low, double high) {
    const auto boundary = needed(polygon_boundary(corners, low, high));
    return *cut_by(file_subject(cut_surfaces()), boundary, {"prism", corners, {low, high}});
}

Subject rotated_box_subject(const RotatedBox& box) {
    const auto boundary = needed(rotated_box_boundary(box));
    return *cut_by(file_subject(cut_surfaces()), boundary, {"hexahedron", {}, {}});
}

/// The inside of surfaces in a file of their own.
Subject body_subject(const Model3& bodies) {
    const Subject file = file_subject(bodies);
    Subject s = file_subject(cut_surfaces());
    VolumeRecord volume{"surface", {}, {}, {record_of(file.files[0], "volume.obj")}, file.surfaces};
    s.files.push_back(file.files[0]);
    return *cut_by(std::move(s), needed(closed_boundary(file.surfaces)), volume);
}

} // namespace

std::optional<Subject> arrangement_subject(std::string_view obj) {
    auto a = arranged(obj);
    if (!a) return std::nullopt;
    const Mesh& mesh = *a->rounded.mesh;
    const std::vector<OutputRecord> outputs{add_output(
        a->subject, "out.obj", "obj", needed(format_mesh(mesh, Format::obj)), mesh.surfaces)};
    parse(a->subject,
          to_certificate({a->records, a->subject.surfaces, a->exact, &a->rounded, outputs}));
    return std::move(a->subject);
}

std::vector<Subject> subjects_of(CertificateKind kind) {
    switch (kind) {
    case CertificateKind::volumes:
        return {volumes_subject(nested(), "obj"), volumes_subject(touching(), "vtp")};
    case CertificateKind::tetrahedra:
#ifdef TERRANE_HAS_TETGEN
        return {tetrahedra_subject(body_in_body(), {}),
                tetrahedra_subject(divided_body(), {.split = {{"sheet", ""}}, .outside = false})};
#else
        return {};
#endif
    case CertificateKind::improved:
        return {improved_subject({grid("horizon", 3, 0.25, 3, 3),
                                  triangle("wall", {1.25, -1, -2}, {1.5, 5, -2}, {1.5, 2, 3})},
                                 {.edge_length = 1.2}),
                improved_subject({triangle("a", {0, 0, 0}, {8, 0, 0}, {0, 8, 0}),
                                  triangle("b", {2, 1, -2}, {2, 5, -2}, {2, 3, 2})},
                                 {.edge_length = 3.5})};
    case CertificateKind::filled:
        return {filled_subject({grid("holed", 5, 0.4, 2, 4)}, FillMethod::rbf),
                filled_subject({triangle("whole", {0, 0, 9}, {5, 0, 9}, {0, 5, 9}),
                                grid("holed", 4, 0.25, 1, 3)},
                               FillMethod::kriging)};
    case CertificateKind::layered:
        return {layered_subject(crossing_horizons(), {2, 1, 3}),
                layered_subject(partial_horizons(), {3, 1, 2}),
                layered_subject(crossing_horizons(), {2, 1, 3}, 0.25),
                layered_subject(partial_horizons(), {3, 1, 2}, 0.3),
                layered_subject(narrow_horizons(), {4, 1, 2, 5}, 0.5)};
    case CertificateKind::cut:
        return {prism_subject({{0.25, 0.5}, {1.75, 0.5}, {1.75, 1.5}, {0.25, 1.5}}, -0.5, 0.75),
                prism_subject({{0.5, 0.25}, {1.75, 1.25}, {0.25, 1.5}, {0.625, 0.875}}, -1, 0.5),
                rotated_box_subject({{1, 1, 0.25}, false, {1.25, 1, 1.5}, 20, 5, 3}),
                body_subject({corner("a", {0.25, 0.25, -0.5}, 1.5),
                              corner("b", {0.375, 0.375, -0.375}, 0.25)})};
    case CertificateKind::sealed:
        return {sealed_subject(gaping(), 0.25, 0, {}),
                sealed_subject(gaping(), 0.25, 0.5, {-1.75, 0.25, 0.1875, 1.75, -1, 2.5}),
                sealed_subject(notched(), 0.08, 0, {}),
                sealed_subject(gaping(), 0, 0.5, {-1.75, 0.25, 0.1875, 2.1875, -1, 2.5})};
    default:
        return {};
    }
}

std::vector<Surface> arranged_surfaces(const Subject& subject, const Certificate& certificate) {
    std::vector<Surface> surfaces = subject.surfaces;
    if (!certificate.cut) return surfaces;
    surfaces.resize(surfaces.size() - subject.certificate.cut->volume.boundary.size());
    if (certificate.sealed) surfaces = grown(subject.files[0].surfaces, *certificate.sealed);
    const auto& boundary = certificate.cut->volume.boundary;
    surfaces.insert(surfaces.end(), boundary.begin(), boundary.end());
    return surfaces;
}

std::optional<Subject> cut_again(const Subject& subject, const std::vector<Surface>& boundary) {
    Subject s{{subject.files[0]}, subject.surfaces, {}, {}, 0, {}, {}};
    s.surfaces.resize(s.surfaces.size() - subject.certificate.cut->volume.boundary.size());
    auto again = cut_by(std::move(s), boundary, {"hexahedron", {}, {}});
    if (again) again->deviation = again->certificate.rounded->deviation;
    return again;
}

bool write_outputs(const Subject& subject, const Certificate& certificate, Contents& contents) {
    if (certificate.outputs.size() != contents.size()) return false;
    for (std::size_t i = 0; i < contents.size(); ++i) {
        Result<std::string> text = Error{};
        if (certificate.kind() == CertificateKind::tetrahedra) {
            const auto mesh = tetrahedra_of(subject, certificate);
            if (!mesh) return false;
            const auto& names = certificate.blocks()->names;
            if (std::ranges::any_of(mesh->block_of, [&](auto b) { return b >= names.size(); }))
                return false;
            text = certificate.outputs[i].format == "vtu"
                       ? to_vtu(*mesh, false, {}, names)
                       : Result<std::string>(to_msh(*mesh, names));
        } else if (certificate.kind() != CertificateKind::volumes) {
            const auto mesh = mesh_of(subject, certificate);
            if (!mesh) return false;
            text = format_mesh(*mesh, Format::obj);
        }
        if (!text) return false;
        contents[i] = std::move(text).value();
    }
    return true;
}

} // namespace terrane::fuzz
