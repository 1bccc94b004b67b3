// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/detail/cell_faces.hpp>

#include <algorithm>
#include <span>
#include <tuple>

#include <terrane/algorithms/mesh/face_sides.hpp>
#include <terrane/algorithms/tetrahedra/detail/cuts.hpp>
#include <terrane/kernel/polynomials.hpp>

namespace terrane::tetrahedra::detail {
namespace {

/// A face of a tetrahedron, by its places in ascending order.
struct CellFace {
    Triangle key{};
    std::uint32_t cell = 0;
    bool even = false; ///< the tetrahedron is in front of the key
};

/// A face of the list, by its places in ascending order.
struct ListedFace {
    Triangle key{};
    std::uint32_t face = 0;
    bool even = false; ///< the face is wound like the key
};

/// Sorts three numbers; returns whether that is an even permutation.
bool sort_corners(Triangle& t) {
    bool even = true;
    const auto order = [&](std::size_t i, std::size_t j) {
        if (t[i] <= t[j]) return;
        std::swap(t[i], t[j]);
        even = !even;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return even;
}

/// Returns the faces of all tetrahedra, sorted by key: by a counting sort for the first corner.
std::vector<CellFace> sorted_faces(const TetrahedralMesh& made, const Places& places) {
    std::vector<CellFace> all;
    all.reserve(4 * made.tetrahedra.size());
    std::vector<std::size_t> starts(made.vertices.size() + 1);
    for (std::uint32_t t = 0; t < made.tetrahedra.size(); ++t)
        for (const auto& [i, j, k] : corners_of_side) {
            const auto corners = places.of(made.tetrahedra[t]);
            CellFace face{{corners[i], corners[j], corners[k]}, t, false};
            face.even = sort_corners(face.key);
            ++starts[face.key[0] + 1];
            all.push_back(face);
        }
    for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
    std::vector<CellFace> sorted(all.size());
    auto next = starts;
    for (const CellFace& face : all) sorted[next[face.key[0]]++] = face;
    for (std::size_t v = 0; v + 1 < starts.size(); ++v)
        std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(starts[v]),
                  sorted.begin() + static_cast<std::ptrdiff_t>(starts[v + 1]),
                  [](const CellFace& a, const CellFace& b) {
                      return std::tie(a.key, a.cell) < std::tie(b.key, b.cell);
                  });
    return sorted;
}

/// Returns the listed faces but the second ones of twins, sorted.
std::vector<ListedFace> sorted_list(const TetrahedralMesh& made, const Places& places) {
    std::vector<bool> behind(made.faces.size());
    for (const auto& [front, back] : made.twins) behind[back] = true;
    std::vector<ListedFace> list;
    for (std::uint32_t f = 0; f < made.faces.size(); ++f) {
        if (behind[f]) continue;
        ListedFace face{places.of(made.faces[f]), f, false};
        face.even = sort_corners(face.key);
        list.push_back(face);
    }
    std::sort(list.begin(), list.end(), [](const ListedFace& a, const ListedFace& b) {
        return std::tie(a.key, a.face) < std::tie(b.key, b.face);
    });
    return list;
}

/// The least box around the nodes in use.
struct Bounds {
    Point3 low, high;

    explicit Bounds(const TetrahedralMesh& made) {
        bool first = true;
        for (const auto& corners : made.tetrahedra)
            for (const std::uint32_t v : corners) {
                const Point3& p = made.vertices[v];
                if (first) low = high = p;
                first = false;
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
    }
    [[nodiscard]] bool on_side(const Point3& a, const Point3& b, const Point3& c) const {
        const auto all_at = [&](double Point3::*i, const Point3& corner) {
            return a.*i == corner.*i && b.*i == corner.*i && c.*i == corner.*i;
        };
        for (const auto i : {&Point3::x, &Point3::y, &Point3::z})
            if (all_at(i, low) || all_at(i, high)) return true;
        return false;
    }
    [[nodiscard]] Exact six_volumes() const {
        return Exact(6) * (Exact(high.x) - Exact(low.x)) * (Exact(high.y) - Exact(low.y)) *
               (Exact(high.z) - Exact(low.z));
    }
};

class FaceCheck {
public:
    FaceCheck(const Subject& subject, const Places& places) :
        subject_(subject), places_(places), box_(subject.made), cuts_(subject, places),
        faces_at_(subject.mesh.triangles.size()), six_volumes_(subject.volumes.measures.size()) {}

    FaceResult operator()() {
        const auto faces = sorted_faces(subject_.made, places_);
        const auto list = sorted_list(subject_.made, places_);
        auto listed = list.begin();
        for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
            while (end < faces.size() && faces[end].key == faces[i].key) ++end;
            for (; listed != list.end() && listed->key < faces[i].key; ++listed) stray(*listed);
            const bool here = listed != list.end() && listed->key == faces[i].key;
            judge(std::span(faces).subspan(i, end - i), here ? &*listed : nullptr);
            for (bool first = true; listed != list.end() && listed->key == faces[i].key; ++listed) {
                if (!first) twice(*listed);
                first = false;
            }
        }
        for (; listed != list.end(); ++listed) stray(*listed);
        cuts_.finish();
        check_box();
        return {std::move(six_volumes_), lists()};
    }

private:
    using Defect = TetrahedraDefect;
    using Sides = std::array<std::uint32_t, 2>; ///< tetrahedra in front and behind, or none

    [[nodiscard]] std::string at_face(const Triangle& key) const {
        return fmt::format("the face at {}", place_text(subject_.made.vertices[key[0]]));
    }
    void stray(const ListedFace& listed) {
        subject_.findings.add(Defect::stray_face, "face {} is no face of a tetrahedron",
                              listed.face);
        const std::uint32_t triangle = subject_.made.face_triangle[listed.face];
        if (triangle != none) faces_at_[triangle].push_back(listed.face); // its cover is judged
    }
    void twice(const ListedFace& listed) {
        subject_.findings.add(Defect::stray_face, "face {} is listed twice", listed.face);
    }

    /// Judges one face of tetrahedra.
    void judge(std::span<const CellFace> cells, const ListedFace* listed) {
        const Triangle& key = cells[0].key;
        const bool wound = listed == nullptr || listed->even;
        Sides sides{none, none};
        bool crowded = false;
        for (const CellFace& c : cells) {
            std::uint32_t& side = sides[c.even == wound ? 0 : 1];
            crowded = crowded || side != none;
            side = c.cell;
        }
        if (crowded)
            subject_.findings.add(Defect::crowded_face, "{} has two tetrahedra on one side",
                                  at_face(key));
        else if (listed == nullptr)
            judge_inner(key, sides);
        else if (subject_.made.face_triangle[listed->face] == none)
            judge_on_box(key, listed->face, sides);
        else
            judge_on_triangle(listed->face, sides);
        const bool inner = cells.size() == 2 && !crowded;
        if (inner) cuts_.pass(listed == nullptr ? none : listed->face, key, sides);
        if (!inner || block(sides[0]) != block(sides[1])) add_volume(cells);
    }

    void judge_inner(const Triangle& key, const Sides& sides) {
        if (sides[0] == none || sides[1] == none)
            subject_.findings.add(Defect::open_face,
                                  "{} has one tetrahedron, {}, and is on no surface", at_face(key),
                                  sides[0] == none ? sides[1] : sides[0]);
        else if (block(sides[0]) != block(sides[1]))
            subject_.findings.add(Defect::wrong_block,
                                  "tetrahedra {} and {} are in blocks {} and {}, and no surface "
                                  "is between them",
                                  sides[0], sides[1], block(sides[0]), block(sides[1]));
    }

    void judge_on_box(const Triangle& key, std::uint32_t face, const Sides& sides) {
        const auto& v = subject_.made.vertices;
        if (!subject_.whole || sides[0] != none || sides[1] == none ||
            !box_.on_side(v[key[0]], v[key[1]], v[key[2]]))
            subject_.findings.add(Defect::stray_face,
                                  "face {} is not on a side of the box, or not wound outward",
                                  face);
        else if (block(sides[1]) != 0)
            subject_.findings.add(Defect::wrong_block, "tetrahedron {} is on the box, in block {}",
                                  sides[1], block(sides[1]));
        const auto box = static_cast<std::uint32_t>(subject_.mesh.surfaces.size());
        check_surfaces(face, std::span(&box, 1));
    }

    void judge_on_triangle(std::uint32_t face, const Sides& sides) {
        const std::uint32_t triangle = subject_.made.face_triangle[face];
        faces_at_[triangle].push_back(face);
        const auto& expected = subject_.volumes.of_sides[triangle];
        constexpr std::array names{"in front of", "behind"};
        for (std::size_t side = 0; side < 2; ++side) {
            if (sides[side] == none) {
                if (subject_.whole || expected[side] != 0)
                    subject_.findings.add(Defect::open_face,
                                          "no tetrahedron is {} face {}, on triangle {}",
                                          names[side], face, triangle);
            } else if (block(sides[side]) != expected[side] ||
                       (!subject_.whole && expected[side] == 0)) {
                subject_.findings.add(Defect::wrong_block,
                                      "tetrahedron {} is in block {}, {} triangle {} where block "
                                      "{} is",
                                      sides[side], block(sides[side]), names[side], triangle,
                                      expected[side]);
            }
        }
        check_surfaces(face, subject_.mesh.surfaces_of[triangle]);
    }

    void check_surfaces(std::uint32_t face, std::span<const std::uint32_t> expected) {
        if (!std::ranges::equal(subject_.made.surfaces_of[face], expected))
            subject_.findings.add(Defect::wrong_attributes,
                                  "face {} does not have the surfaces of its triangle", face);
    }

    /// Adds the parts of these tetrahedra that the face makes with the origin.
    void add_volume(std::span<const CellFace> cells) {
        const auto& v = subject_.made.vertices;
        const auto& [a, b, c] = cells[0].key;
        const Exact part = six_volumes(v[a], v[b], v[c]);
        for (const CellFace& cell : cells)
            if (cell.even)
                six_volumes_[block(cell.cell)] -= part;
            else
                six_volumes_[block(cell.cell)] += part;
    }

    void check_box() {
        if (!subject_.whole) return;
        Exact sum(0.0);
        for (const Exact& part : six_volumes_) sum += part;
        if (sum != box_.six_volumes())
            subject_.findings.add(Defect::box_not_filled,
                                  "the volumes of all tetrahedra do not add up to that of the box "
                                  "from {} to {}",
                                  place_text(box_.low), place_text(box_.high));
    }

    [[nodiscard]] IndexLists<std::uint32_t> lists() const {
        IndexLists<std::uint32_t> all;
        for (const auto& faces : faces_at_) all.push_back(faces);
        return all;
    }
    [[nodiscard]] std::uint32_t block(std::uint32_t tetrahedron) const {
        return subject_.made.block_of[tetrahedron];
    }

    const Subject& subject_;
    const Places& places_;
    Bounds box_;
    CutCheck cuts_;
    std::vector<std::vector<std::uint32_t>> faces_at_; ///< per triangle
    std::vector<Exact> six_volumes_;                   ///< per volume
};

} // namespace

FaceResult check_faces(const Subject& subject, const Places& places) {
    return FaceCheck(subject, places)();
}

Exact six_volumes(const Point3& a, const Point3& b, const Point3& c) {
    const auto vector = [](const Point3& p) {
        return polynomial::Vector<Exact>{Exact(p.x), Exact(p.y), Exact(p.z)};
    };
    return dot(cross(vector(a), vector(b)), vector(c));
}

} // namespace terrane::tetrahedra::detail
