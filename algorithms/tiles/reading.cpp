// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reads files and shares their vertices and triangles out by number.
#include <algorithm>
#include <limits>
#include <string>

#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/tiles/detail/steps.hpp>

namespace terrane::tiles::detail {

namespace {

/// An input vertex or triangle on its way home.
struct SharedVertex {
    Point3 at{};
    std::uint32_t id = 0, unused = 0;
};
struct SharedTriangle {
    std::uint32_t id = 0;
    Triangle corners{};
};

/// Sets the tables that all tiles have.
Status make_tables(Tile& b, std::vector<SurfaceEntry> entries, std::vector<char> names) {
    // Names follow each other as the entries came; both are put into the order of the files.
    std::vector<std::size_t> start, order;
    std::size_t at = 0;
    for (const SurfaceEntry& e : entries) {
        order.push_back(start.size());
        start.push_back(at);
        at += e.name_length;
    }
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
        return std::pair(entries[i].file, entries[i].surface) <
               std::pair(entries[k].file, entries[k].surface);
    });
    std::uint64_t vertices = 0, triangles = 0;
    for (const std::size_t i : order) {
        const SurfaceEntry& e = entries[i];
        b.entries.push_back(e);
        const auto from = names.begin() + static_cast<std::ptrdiff_t>(start[i]);
        b.names.insert(b.names.end(), from, from + e.name_length);
        b.first_vertex.push_back(static_cast<std::uint32_t>(vertices));
        b.first_triangle.push_back(static_cast<std::uint32_t>(triangles));
        vertices += e.vertices;
        triangles += e.triangles;
    }
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() / 2;
    if (vertices > most || triangles > most)
        return Error{ErrorCode::unsupported, "there are more than 2147483647 vertices or triangles",
                     ""};
    b.first_vertex.push_back(static_cast<std::uint32_t>(vertices));
    b.first_triangle.push_back(static_cast<std::uint32_t>(triangles));
    return Done{};
}

} // namespace

std::uint32_t surface_of(const Tile& b, std::uint32_t triangle) {
    return static_cast<std::uint32_t>(
        std::upper_bound(b.first_triangle.begin(), b.first_triangle.end(), triangle) -
        b.first_triangle.begin() - 1);
}

std::string name_of_surface(const Tile& b, std::uint32_t surface) {
    std::size_t start = 0;
    for (std::uint32_t s = 0; s < surface; ++s) start += b.entries[s].name_length;
    return {b.names.data() + start, b.entries[surface].name_length};
}

/// Reads the files of this tile. Channel 0: entries, channel 1: their names.
Status announce(Tile& b, std::size_t files, const ReadFile& read, Outbox& out) {
    for (std::size_t file = b.index; file < files; file += b.count) {
        auto surfaces = read(file);
        if (!surfaces) return surfaces.error();
        if (auto valid = validate(*surfaces); !valid) return valid;
        std::uint32_t place = 0;
        for (Surface& s : *surfaces) {
            const SurfaceEntry entry{static_cast<std::uint32_t>(file),
                                     place++,
                                     static_cast<std::uint32_t>(s.vertices.size()),
                                     static_cast<std::uint32_t>(s.triangles.size()),
                                     static_cast<std::uint32_t>(s.role),
                                     static_cast<std::uint32_t>(s.name.size())};
            for (std::size_t to = 0; to < out.tiles(); ++to) {
                out.put(to, 0, entry);
                out.put_text(to, 1, s.name);
            }
            b.read_files.insert(b.read_files.end(), {entry.file, entry.surface});
            b.read_vertices.insert(b.read_vertices.end(), s.vertices.begin(), s.vertices.end());
            b.read_triangles.insert(b.read_triangles.end(), s.triangles.begin(), s.triangles.end());
            s = {};
        }
    }
    return Done{};
}

/// Sends what was read home. Channel 0: SharedVertex, channel 1: SharedTriangle.
Status share_out(Tile& b, Inbox& in, Outbox& out) {
    auto entries = in.all<SurfaceEntry>(0);
    if (auto made = make_tables(b, std::move(entries), in.all<char>(1)); !made) return made;
    std::size_t vertex = 0, triangle = 0;
    for (std::size_t k = 0; k < b.read_files.size(); k += 2) {
        std::size_t s = 0;
        while (b.entries[s].file != b.read_files[k] || b.entries[s].surface != b.read_files[k + 1])
            ++s;
        for (std::uint32_t v = b.first_vertex[s]; v < b.first_vertex[s + 1]; ++v)
            out.put(home_of(v, b.vertex_total(), b.count), 0,
                    SharedVertex{b.read_vertices[vertex++], v});
        for (std::uint32_t t = b.first_triangle[s]; t < b.first_triangle[s + 1]; ++t) {
            Triangle corners = b.read_triangles[triangle++];
            for (std::uint32_t& c : corners) c += b.first_vertex[s];
            out.put(home_of(t, b.triangle_total(), b.count), 1, SharedTriangle{t, corners});
        }
    }
    release(b.read_vertices);
    release(b.read_triangles);
    return Done{};
}

} // namespace terrane::tiles::detail
