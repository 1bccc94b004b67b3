// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/detail/lists.hpp>

#include <algorithm>

#include <terrane/algorithms/mesh/validation.hpp>

namespace terrane::tetrahedra::detail {
namespace {

class ListCheck {
public:
    explicit ListCheck(const Subject& subject) : subject_(subject) {}

    bool operator()() {
        check_lengths();
        if (usable_) check_mesh();
        if (usable_) check_made();
        return usable_;
    }

private:
    template <class... T>
    void unusable(fmt::format_string<T...> sentence, T&&... values) {
        subject_.findings.add(TetrahedraDefect::unusable_lists, sentence,
                              std::forward<T>(values)...);
        usable_ = false;
    }
    template <class Cells>
    void check_indices(const Cells& cells, std::size_t count, const char* what) {
        for (std::size_t i = 0; i < cells.size(); ++i)
            for (const std::uint32_t index : cells[i])
                if (index >= count)
                    return unusable("{} {} names number {} of {}", what, i, index, count);
    }
    template <class Numbers>
    void check_numbers(const Numbers& numbers, std::size_t count, const char* what) {
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (numbers[i] >= count)
                return unusable("{} {} names number {} of {}", what, i, numbers[i], count);
    }

    void check_lengths() {
        const auto& [made, mesh, volumes, whole, findings] = subject_;
        if (made.block_of.size() != made.tetrahedra.size())
            unusable("{} tetrahedra have {} blocks", made.tetrahedra.size(), made.block_of.size());
        if (made.face_triangle.size() != made.faces.size() ||
            made.surfaces_of.size() != made.faces.size())
            unusable("{} faces have {} triangles and {} lists of surfaces", made.faces.size(),
                     made.face_triangle.size(), made.surfaces_of.size());
        if (volumes.of_sides.size() != mesh.triangles.size() ||
            mesh.surfaces_of.size() != mesh.triangles.size())
            unusable("{} triangles have {} pairs of volumes and {} lists of surfaces",
                     mesh.triangles.size(), volumes.of_sides.size(), mesh.surfaces_of.size());
        if (volumes.measures.empty()) unusable("there is no volume, not even the outside");
    }

    void check_mesh() {
        const auto& [made, mesh, volumes, whole, findings] = subject_;
        check_indices(volumes.of_sides, volumes.measures.size(), "the sides of triangle");
        if (const Status sound = validate_areas(mesh.vertices, mesh.triangles); !sound)
            unusable("the mesh: {}", sound.error().message());
    }

    void check_made() {
        const TetrahedralMesh& made = subject_.made;
        check_indices(made.tetrahedra, made.vertices.size(), "tetrahedron");
        check_indices(made.faces, made.vertices.size(), "face");
        check_indices(made.twins, made.faces.size(), "twins");
        check_numbers(made.block_of, subject_.volumes.measures.size(), "the block of tetrahedron");
        for (std::size_t f = 0; f < made.faces.size(); ++f)
            if (made.face_triangle[f] != none &&
                made.face_triangle[f] >= subject_.mesh.triangles.size())
                return unusable("face {} names triangle {} of {}", f, made.face_triangle[f],
                                subject_.mesh.triangles.size());
        const auto bad = std::find_if_not(made.vertices.begin(), made.vertices.end(), is_finite);
        if (bad != made.vertices.end())
            unusable("node {} is not finite", bad - made.vertices.begin());
    }

    const Subject& subject_;
    bool usable_ = true;
};

} // namespace

bool check_lists(const Subject& subject) {
    return ListCheck(subject)();
}

void check_attributes(const Subject& subject) {
    const auto& [made, mesh, volumes, whole, findings] = subject;
    std::vector<SurfaceInfo> expected = mesh.surfaces;
    if (whole) expected.push_back({"box", Role::boundary});
    if (made.surfaces != expected)
        findings.add(TetrahedraDefect::wrong_attributes,
                     "the {} surfaces of the tetrahedra are not the {} of the mesh{}",
                     made.surfaces.size(), mesh.surfaces.size(), whole ? " and the box" : "");
    if (made.block_count != volumes.measures.size())
        findings.add(TetrahedraDefect::wrong_attributes, "{} blocks, but {} volumes",
                     made.block_count, volumes.measures.size());
}

} // namespace terrane::tetrahedra::detail
