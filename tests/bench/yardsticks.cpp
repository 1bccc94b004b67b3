// SPDX-License-Identifier: LGPL-3.0-or-later
#include "yardsticks.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <optional>

namespace bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

void add(Mesh& mesh, const terrane::Surface& s) {
    std::vector<Mesh::Vertex_index> vertices;
    for (const auto& p : s.vertices) vertices.push_back(mesh.add_vertex({p.x, p.y, p.z}));
    for (const auto& t : s.triangles) mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
}

} // namespace

struct BoxIntersection::State {
    using CgalBox = CGAL::Box_intersection_d::Box_d<double, 3>;
    std::vector<CgalBox> red, blue, given_red, given_blue;
};

BoxIntersection::BoxIntersection(const Model& m) : state_(std::make_unique<State>()) {
    const std::size_t red = m.surfaces.front().triangles.size();
    for (std::size_t i = 0; i < m.boxes.size(); ++i) {
        auto low = m.boxes[i].low, high = m.boxes[i].high;
        (i < red ? state_->red : state_->blue).emplace_back(low.data(), high.data());
    }
}
BoxIntersection::~BoxIntersection() = default;

void BoxIntersection::prepare() {
    state_->given_red = state_->red;
    state_->given_blue = state_->blue;
}

std::size_t BoxIntersection::operator()() {
    std::size_t pairs = 0;
    CGAL::box_intersection_d(state_->given_red.begin(), state_->given_red.end(),
                             state_->given_blue.begin(), state_->given_blue.end(),
                             [&](const auto&, const auto&) { ++pairs; });
    return pairs;
}

struct Corefine::State {
    Mesh red, blue;
    std::optional<Mesh> copy_red, copy_blue;
};

Corefine::Corefine(const Model& m) : state_(std::make_unique<State>()) {
    add(state_->red, m.surfaces[0]);
    add(state_->blue, m.surfaces[1]);
}
Corefine::~Corefine() = default;

void Corefine::prepare() {
    state_->copy_red.emplace(state_->red);
    state_->copy_blue.emplace(state_->blue);
}

std::size_t Corefine::operator()() {
    pmp::corefine(*state_->copy_red, *state_->copy_blue);
    return state_->copy_red->number_of_faces() + state_->copy_blue->number_of_faces();
}

struct Autorefine::State {
    Mesh mesh;
    std::optional<Mesh> copy;
};

Autorefine::Autorefine(const Model& m) : state_(std::make_unique<State>()) {
    for (const auto& s : m.surfaces) add(state_->mesh, s);
}
Autorefine::~Autorefine() = default;

void Autorefine::prepare() {
    state_->copy.emplace(state_->mesh);
}

std::size_t Autorefine::operator()() {
    pmp::experimental::autorefine(*state_->copy);
    return state_->copy->number_of_faces();
}

} // namespace bench
