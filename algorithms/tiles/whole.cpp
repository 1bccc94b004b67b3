// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Steps that need the whole model: it is gathered in the first tile.
#include <numeric>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

namespace terrane::tiles {

using namespace detail;

namespace {

/// Sends home vertices and triangles to the first tile. Their numbers ascend with the tiles.
Status send_home(Tile& b, Inbox&, Outbox& out) {
    for (const Point3& p : b.home_points) out.put(0, 0, p);
    for (const Triangle& t : b.home_triangles) out.put(0, 1, t);
    return Done{};
}

/// Makes surfaces of what all homes sent.
std::vector<Surface> take_surfaces(const Tile& b, Inbox& in) {
    const auto points = in.all<Point3>(0);
    const auto triangles = in.all<Triangle>(1);
    std::vector<Surface> surfaces(b.entries.size());
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        Surface& surface = surfaces[s];
        surface.name = name_of_surface(b, s);
        surface.role = static_cast<Role>(b.entries[s].role);
        const std::uint32_t first = b.first_vertex[s];
        surface.vertices.assign(points.begin() + first, points.begin() + b.first_vertex[s + 1]);
        surface.triangles.assign(triangles.begin() + b.first_triangle[s],
                                 triangles.begin() + b.first_triangle[s + 1]);
        for (Triangle& t : surface.triangles)
            for (std::uint32_t& v : t) v -= first;
    }
    return surfaces;
}

TilePiece whole_piece(const RoundedMesh& rounded) {
    TilePiece piece;
    piece.mesh = rounded.mesh;
    piece.vertex_ids.resize(piece.mesh.vertices.size());
    piece.triangle_ids.resize(piece.mesh.triangles.size());
    std::iota(piece.vertex_ids.begin(), piece.vertex_ids.end(), 0U);
    std::iota(piece.triangle_ids.begin(), piece.triangle_ids.end(), 0U);
    return piece;
}

/// The numbers of a report that other processes learn.
struct ReportedNumbers {
    bool clean = false;
    unsigned rounds = 0;
    std::size_t naive_contacts = 0;
    double surface_deviation = 0, max_move = 0;
};

} // namespace

Result<RepairedWhole> repair_in_one_process(Supersteps& tiles, const Run& run) {
    RepairedWhole whole;
    if (auto sent = tiles.step("gather", send_home); !sent) return sent.error();
    const auto repair = [&](Tile& b, Inbox& in, Outbox& out) -> Status {
        if (b.index != 0) return Done{};
        auto surfaces = take_surfaces(b, in);
        const auto exact = arrange(surfaces, {}, run);
        if (!exact) return exact.error();
        surfaces = {};
        auto rounded = round_to_doubles(*exact, {}, run);
        if (!rounded) return rounded.error();
        whole.piece = whole_piece(*rounded);
        whole.report = std::move(rounded->report);
        const RoundingReport& r = whole.report;
        out.put_to_all(0, ReportedNumbers{r.clean, r.rounds, r.naive_contacts, r.surface_deviation,
                                          r.max_move});
        return Done{};
    };
    if (auto done = tiles.step("repair", repair); !done) return done.error();
    const auto learn = [&](Tile& b, Inbox& in, Outbox&) -> Status {
        in.take<ReportedNumbers>(0, [&](std::uint32_t, const ReportedNumbers& n) {
            if (b.index == 0) return;
            whole.report.clean = n.clean;
            whole.report.rounds = n.rounds;
            whole.report.naive_contacts = n.naive_contacts;
            whole.report.surface_deviation = n.surface_deviation;
            whole.report.max_move = n.max_move;
        });
        return Done{};
    };
    if (auto done = tiles.step("repair", learn); !done) return done.error();
    return whole;
}

} // namespace terrane::tiles
