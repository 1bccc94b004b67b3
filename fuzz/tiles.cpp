// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: an arrangement in tiles is that of one process: the same digest, doubles, triangles,
// parents and regions, also where tiles leave the doubles to one process. Volumes in
// tiles, and their names, are those of the joined mesh. The work to find what is near the triangles that are in the
// way, and the memory for it, do not grow faster than the triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "property.hpp"

#include "support/differences.hpp"
#include "support/pieces_joined.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/tiles/local_supersteps.hpp>
#include <terrane/algorithms/tiles/names_in_tiles.hpp>
#include <terrane/algorithms/tiles/volumes_in_tiles.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::fuzz {

namespace {

using namespace tiles;

/// The findings of one process.
struct Whole {
    const Arrangement& exact;
    std::string digest;
    Result<RoundedMesh> rounded;

    [[nodiscard]] bool is_clean() const { return rounded && rounded->report.clean; }
};

std::string volumes_flaw(Supersteps& tiles, const TiledReport& report) {
    const auto volumes = find_volumes_in_tiles(tiles);
    if (!volumes) return "volumes in tiles: " + volumes.error().message();
    const auto names = name_volumes_in_tiles(tiles);
    if (!names) return "names in tiles: " + names.error().message();
    const auto mesh = test_support::pieces_joined(tiles, report);
    if (!mesh) return mesh.error().message();
    const auto expected = find_volumes(*mesh);
    if (!expected) return "volumes: " + expected.error().message();
    if (volumes->measures != expected->measures || volumes->total != expected->total)
        return "tiles find other volumes";
    const auto sides_agree = tiles.visit([&](Tile& b) -> Status {
        const TilePiece piece = piece_of(b);
        for (std::size_t t = 0; t < piece.triangle_ids.size(); ++t)
            if (piece.volumes_of_sides[t] != expected->of_sides[piece.triangle_ids[t]])
                return Error{};
        return Done{};
    });
    if (!sides_agree) return "tiles find other volumes beside a triangle";
    const Structure structure = build_structure(*mesh, *expected);
    if (!std::ranges::equal(*names, structure.blocks, {}, {}, &ModelBlock::name))
        return "tiles name the volumes otherwise";
    return "";
}

/// What tiles leave to one process.
std::string flaw_of_left(const Whole& whole, Supersteps& tiles) {
    const auto left = repair_in_one_process(tiles);
    if (!left || !whole.rounded) {
        const bool says_so =
            !left && !whole.rounded && left.error().code == whole.rounded.error().code;
        return says_so ? "" : "what tiles leave is refused, or not, by one process alone";
    }
    if (left->report.clean != whole.is_clean()) return "what tiles leave ends otherwise";
    Mesh mesh = left->piece.mesh;
    return test_support::difference(mesh, whole.rounded->mesh);
}

std::string work_flaw(const Work& total, std::uint64_t triangles) {
    // Attempts to move the input do the same work again; without one, near_boxes was 37 per triangle at the most.
    if (total.near_boxes > 1'000 * (triangles + 100)) return "too many boxes are compared";
    if (total.memory > 10'000 * (triangles + 100)) return "too much memory is needed";
    return "";
}

std::string flaw_of_tiles(std::span<const Surface> surfaces, const Whole& whole,
                          Supersteps& tiles) {
    const std::vector<Surface> files(surfaces.begin(), surfaces.end());
    const auto report =
        arrange_in_tiles(tiles, test_support::reader_of(files), {files.size(), true});
    if (!report) {
        const bool says_so = !whole.rounded && whole.rounded.error().code == report.error().code;
        return says_so ? "" : report.error().message();
    }
    if (report->digest != whole.digest) return "another digest";
    if (auto what = work_flaw(report->total, whole.exact.triangles.size()); !what.empty())
        return what;
    if (!report->clean) return flaw_of_left(whole, tiles);
    if (!whole.rounded) return "one process says " + whole.rounded.error().message();
    if (!whole.is_clean()) return "one process finds no conforming mesh";
    const RoundedMesh& rounded = *whole.rounded;
    const auto mesh = test_support::pieces_joined(tiles, *report);
    if (!mesh) return mesh.error().message();
    if (const auto what = test_support::difference(*mesh, rounded.mesh); !what.empty())
        return "another mesh: " + what;
    if (report->regions != rounded.regions.size()) return "another number of regions";
    if (report->intersection_edges != rounded.mesh->intersection_edges.size())
        return "another number of intersection edges";
    return volumes_flaw(tiles, *report);
}

/// Numbers from bytes, and after the last one from a sequence that they begin.
class Numbers {
public:
    explicit Numbers(Bytes& bytes) : bytes_(bytes) {}

    unsigned below(unsigned count) {
        if (!bytes_.empty()) state_ = state_ * 257 + bytes_.byte();
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return static_cast<unsigned>(state_ >> 33U) % count;
    }

private:
    Bytes& bytes_;
    std::uint64_t state_ = 0;
};

/// Makes up to 104 triangles on a lattice of few spacings of the doubles, far from the origin. They cross in
/// thousands of places, which are in few doubles.
Soup heap(Bytes& bytes) {
    constexpr std::array<double, 4> places{1e6, 4.2e6, -0x1p40, 1.0 / 3};
    std::array<double, 3> at{};
    for (double& x : at) x = places[bytes.below(4)];
    const double largest = std::max({std::fabs(at[0]), std::fabs(at[1]), std::fabs(at[2])});
    const double spacing =
        std::ldexp(std::nextafter(largest, HUGE_VAL) - largest, bytes.between(0, 4));
    const unsigned range = 2 + bytes.below(6), triangles = 8 * (1 + bytes.below(13));
    Soup soup(1 + bytes.below(3));
    Numbers numbers(bytes);
    for (unsigned t = 0; t < triangles; ++t) {
        std::array<fuzzing::Point, 3> corners{};
        for (fuzzing::Point& p : corners)
            p = {at[0] + spacing * numbers.below(range), at[1] + spacing * numbers.below(range),
                 at[2] + spacing * numbers.below(range)};
        add_triangle(soup[t % soup.size()], corners);
    }
    return soup;
}

/// Tells whether all points are within 64 spacings of the largest coordinate.
bool is_in_few_doubles(std::span<const Surface> surfaces) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    double largest = 0;
    for (const Surface& s : surfaces)
        for (const Point3& p : s.vertices) {
            const std::array<double, 3> x{p.x, p.y, p.z};
            for (unsigned k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], x[k]);
                high[k] = std::max(high[k], x[k]);
                largest = std::max(largest, std::fabs(x[k]));
            }
        }
    const double most = 64 * (std::nextafter(largest, infinity) - largest);
    return std::ranges::all_of(std::array{0, 1, 2},
                               [&](int k) { return high[k] - low[k] <= most; });
}

} // namespace

Soup input(Bytes& bytes) {
    constexpr unsigned for_heap = 0x10; // which no frame of a soup needs
    Bytes ahead = bytes;
    if (ahead.byte() / 16 % 4 != for_heap / 16) return fuzzing::soup(bytes, 24);
    bytes = ahead;
    return heap(bytes);
}

std::string flaw(std::span<const Surface> surfaces) {
    // Larger arrangements take seconds to round. Those in few doubles do not, as most triangles collapse.
    const std::size_t most_triangles = is_in_few_doubles(surfaces) ? 12'000 : 300;
    const auto exact = arrange(surfaces);
    if (!exact) return exact.error().message();
    if (exact->triangles.size() > most_triangles) return "";
    const Whole whole{*exact, canonical_digest(surfaces, *exact), round_to_doubles(*exact)};
    const Run run;
    for (const std::size_t count : {2, 5}) {
        LocalSupersteps tiles({count, {}}, run);
        if (const auto what = flaw_of_tiles(surfaces, whole, tiles); !what.empty())
            return what + ", in " + std::to_string(count) + " tiles";
    }
    return "";
}

} // namespace terrane::fuzz
