// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/structure/build_structure.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

#include "handles.hpp"
#include "structure.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

py::list to_list(const std::vector<ModelLine>& lines) {
    return rows(
        lines, &ModelLine::kind, [](const ModelLine& l) { return owned(l.vertices); },
        [](const ModelLine& l) { return owned(l.patches); }, &ModelLine::surfaces,
        &ModelLine::corners, &ModelLine::length);
}

py::list to_list(const std::vector<ModelBlock>& blocks) {
    return rows(blocks, &ModelBlock::name, &ModelBlock::unit, &ModelBlock::age, &ModelBlock::above,
                &ModelBlock::below, &ModelBlock::beside, &ModelBlock::interfaces,
                &ModelBlock::inner_interfaces, &ModelBlock::neighbours, &ModelBlock::volume,
                &ModelBlock::area);
}

/// Refuses the volumes of something else, whose numbers name no triangles of this.
void require_fitting(const Volumes& volumes, std::size_t triangles) {
    if (volumes.of_sides.size() != triangles)
        refuse("the volumes are those of " + std::to_string(volumes.of_sides.size()) +
                   " triangles, not of " + std::to_string(triangles),
               "volumes");
}

py::array locate(const MeshPointer& mesh, const VolumesPointer& volumes, const py::array& points,
                 const HowToRun& how) {
    require_fitting(*volumes, mesh->mesh->triangles.size());
    const auto places = std::make_shared<const std::vector<Point3>>(copied<Point3>(points));
    for (std::size_t i = 0; i < places->size(); ++i)
        if (!is_finite((*places)[i]))
            refuse(ErrorCode::bad_number, "is not finite", "points[" + std::to_string(i) + "]");
    return owned(run_stage(how, [mesh, volumes, places](const Run& run) {
        return locate_points(*places, mesh->mesh, *volumes, run);
    }));
}

template <class Whole>
std::vector<std::string> exact_measures(const std::shared_ptr<Whole>& whole,
                                        const VolumesPointer& volumes, const HowToRun& how) {
    if constexpr (std::is_same_v<Whole, Arrangement>)
        require_fitting(*volumes, whole->triangles.size());
    else
        require_fitting(*volumes, whole->mesh->triangles.size());
    return run_stage(how, [whole, volumes](const Run&) {
        if constexpr (std::is_same_v<Whole, Arrangement>)
            return exact_volumes(*whole, *volumes).measures;
        else
            return exact_volumes(*whole->mesh, *volumes).measures;
    });
}

VolumesPointer volumes_of(const py::array& of_sides, const py::array& measures, double total) {
    auto made = std::make_shared<Volumes>();
    made->of_sides = copied<std::array<std::uint32_t, 2>>(of_sides);
    made->measures = copied<double>(measures);
    made->total = total;
    if (made->measures.empty())
        refuse(ErrorCode::bad_index, "there must be a measure of the outside", "");
    for (const auto& sides : made->of_sides)
        for (const std::uint32_t side : sides)
            if (side >= made->measures.size())
                refuse(ErrorCode::bad_index, "there is no volume " + std::to_string(side),
                       "of_sides");
    return made;
}

py::list points_in(const MeshPointer& mesh, const VolumesPointer& volumes, const HowToRun& how) {
    require_fitting(*volumes, mesh->mesh->triangles.size());
    const auto points = run_stage(
        how, [mesh, volumes](const Run& run) { return block_points(mesh->mesh, *volumes, run); });
    return rows(points, &BlockPoint::place, &BlockPoint::block);
}

} // namespace

py::dict to_dict(const Structure& s) {
    const auto triangles = [](const auto& part) { return owned(part.triangles); };
    const auto corners = rows(s.corners, &ModelCorner::vertex, &ModelCorner::lines);
    const auto patches =
        rows(s.patches, &ModelPatch::interface, triangles, &ModelPatch::lines, &ModelPatch::area);
    const auto interfaces = rows(s.interfaces, &ModelInterface::volumes, &ModelInterface::surfaces,
                                 &ModelInterface::patches, triangles, &ModelInterface::area);
    return py::dict("corners"_a = corners, "lines"_a = to_list(s.lines), "patches"_a = patches,
                    "interfaces"_a = interfaces, "blocks"_a = to_list(s.blocks),
                    "patch_of"_a = owned(s.patch_of), "interface_of"_a = owned(s.interface_of));
}

void bind_volumes(py::module_& module) {
    py::class_<Volumes, VolumesPointer> bound(module, "Volumes");
    bound.def(py::init(&volumes_of), "of_sides"_a, "measures"_a, "total"_a);
    arrays_of(bound, std::identity())
        .add("of_sides", &Volumes::of_sides)
        .add("measures", &Volumes::measures);
    bound.def_readonly("total", &Volumes::total);
    module.def(
        "volumes_of_mesh",
        [](const MeshPointer& mesh, const HowToRun& how) {
            return std::make_shared<Volumes>(
                run_stage(how, [mesh](const Run& run) { return find_volumes(*mesh->mesh, run); }));
        },
        "mesh"_a, "how"_a);
    module.def(
        "volumes_of_arrangement",
        [](const ArrangementPointer& a, const HowToRun& how) {
            return std::make_shared<Volumes>(
                run_stage(how, [a](const Run& run) { return find_volumes(*a, run); }));
        },
        "arrangement"_a, "how"_a);
    module.def("exact_volumes_of_mesh", &exact_measures<MeshHandle>, "mesh"_a, "volumes"_a,
               "how"_a);
    module.def("exact_volumes_of_arrangement", &exact_measures<Arrangement>, "arrangement"_a,
               "volumes"_a, "how"_a);
    module.def("locate", &locate, "mesh"_a, "volumes"_a, "points"_a, "how"_a);
    module.def("block_points", &points_in, "mesh"_a, "volumes"_a, "how"_a);
    module.def(
        "structure",
        [](const MeshPointer& mesh, const VolumesPointer& volumes, const HowToRun& how) {
            require_fitting(*volumes, mesh->mesh->triangles.size());
            return to_dict(run_stage(how, [mesh, volumes](const Run& run) {
                return build_structure(mesh->mesh, *volumes, run);
            }));
        },
        "mesh"_a, "volumes"_a, "how"_a);
}

} // namespace terrane::python
