// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Shows at compile time that indices of different kinds cannot be mixed up, and that nothing else
// is lost: they index, compare and initialise as numbers do.
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <terrane/advanced.hpp>

#include <terrane/algorithms/sealing/border_extension.hpp>
#include <terrane/algorithms/volumes/complex.hpp>

namespace terrane {
namespace {

static_assert(sizeof(SurfaceId) == sizeof(std::uint32_t));
static_assert(std::is_trivially_copyable_v<SurfaceId>);
static_assert(SurfaceId() == SurfaceId(0) && SurfaceId(1) < SurfaceId(2));
static_assert(SurfaceId(7) == 7U && std::is_convertible_v<SurfaceId, std::uint32_t>);
static_assert(std::is_constructible_v<std::span<const SurfaceId>, std::vector<SurfaceId>&>);

// A number becomes an index only on purpose, and an index never one of another kind.
static_assert(!std::is_convertible_v<std::uint32_t, SurfaceId>);
static_assert(!std::is_convertible_v<SurfaceId, TriangleId>);
static_assert(!std::is_constructible_v<TriangleId, SurfaceId>);
static_assert(!std::is_assignable_v<TriangleId&, SurfaceId>);

template <class A, class B>
concept compares = requires(A a, B b) {
    a == b;
};
template <class A, class B>
concept orders = requires(A a, B b) {
    a < b;
};
static_assert(compares<SurfaceId, SurfaceId> && compares<SurfaceId, std::uint32_t>);
static_assert(orders<SurfaceId, SurfaceId> && orders<SurfaceId, std::uint32_t>);
static_assert(!compares<SurfaceId, TriangleId> && !orders<SurfaceId, TriangleId>);

static_assert(requires(const std::vector<int>& list, SurfaceId s) {
    list[s];
    std::to_string(s);
});

// Where a mix-up used to compile. The first assertion of each group is the control.
template <class Number>
concept is_layer = requires(Number n) {
    Layer{n, 1.0};
};
static_assert(is_layer<SurfaceId>);
static_assert(!is_layer<std::uint32_t> && !is_layer<TriangleId> && !is_layer<BlockId>);

template <class Number>
concept is_surface_size = requires(Number n) {
    SurfaceSize{n, 1.0};
};
template <class Number>
concept is_block_size = requires(Number n) {
    BlockSize{n, 1.0};
};
static_assert(is_surface_size<SurfaceId> && is_block_size<BlockId>);
static_assert(!is_surface_size<BlockId> && !is_block_size<SurfaceId>);

template <class Number>
concept is_vertex = requires(const Arrangement& a, Number n) {
    a.nearest(n);
    a.coordinates(n);
    a.construction(n);
};
static_assert(is_vertex<VertexId>);
static_assert(!is_vertex<PointIndex> && !is_vertex<TriangleId>);

template <class Number>
concept is_input_triangle = requires(const InputTriangles& inputs, Number n) {
    inputs.surface_of(n);
    inputs.first_same(n);
};
static_assert(is_input_triangle<InputTriangleId>);
static_assert(!is_input_triangle<TriangleId> && !is_input_triangle<std::uint32_t>);

template <class Block, class Interface>
concept parts = requires(const Mesh& m, const Volumes& v, const Structure& s, Block b,
                         Interface i) {
    block_part(m, v, s, b);
    interface_part(m, v, s, i);
};
static_assert(parts<BlockId, InterfaceId> && !parts<InterfaceId, BlockId>);

template <class Edge, class Number>
concept has_surface = requires(Edge e, Number n) {
    e.surface = n;
};
static_assert(has_surface<SealChange, SurfaceId> && has_surface<FillTask, SurfaceId> &&
              has_surface<OpenBorder, SurfaceId> && has_surface<Region, SurfaceId> &&
              has_surface<BorderEdge, SurfaceId>);
static_assert(!has_surface<SealChange, TriangleId> && !has_surface<FillTask, TriangleId> &&
              !has_surface<OpenBorder, TriangleId> && !has_surface<Region, TriangleId> &&
              !has_surface<BorderEdge, InputTriangleId>);

template <class Triangle, class Vertex>
concept has_side = requires(UpwardWitness upward, const volumes::TriangleComplex& sheets,
                            Triangle t, Vertex v) {
    volumes::side_of(upward, sheets, t, v);
};
static_assert(has_side<TriangleId, VertexId> && !has_side<VertexId, TriangleId>);

} // namespace
} // namespace terrane
