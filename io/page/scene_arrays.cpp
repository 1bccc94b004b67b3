// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Defines decimate() and packed() of scene.hpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include <terrane/io/page/scene.hpp>

namespace terrane::page {
namespace {

/// Coordinates are stored in 24 bits, which single precision holds exactly.
constexpr double most_steps = (1U << 24U) - 1;

/// Returns (to - from) / by, even where the difference is beyond the largest double.
double quotient(double from, double to, double by) {
    const double difference = to - from;
    return std::isfinite(difference) ? difference / by : to / by - from / by;
}

/// The box round all points.
struct Bounds {
    Point3 least{HUGE_VAL, HUGE_VAL, HUGE_VAL}, largest{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    void add(const std::vector<Point3>& points) {
        for (const Point3& p : points) {
            least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
            largest = {std::max(largest.x, p.x), std::max(largest.y, p.y),
                       std::max(largest.z, p.z)};
        }
    }
    /// Returns a share of the longest edge; 0 without points.
    [[nodiscard]] double extent_by(double parts) const {
        return std::max({quotient(least.x, largest.x, parts), quotient(least.y, largest.y, parts),
                         quotient(least.z, largest.z, parts), 0.0});
    }
};

/// Returns for each vertex the first vertex in the same cell of a grid.
std::vector<std::uint32_t> first_in_cell(const std::vector<Point3>& vertices, const Bounds& box,
                                         double cell) {
    std::unordered_map<std::uint64_t, std::uint32_t> first;
    std::vector<std::uint32_t> result(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        const auto along = [&](double x, double least) {
            return static_cast<std::uint64_t>(quotient(least, x, cell)) & 0x1fffffU;
        };
        const std::uint64_t key = along(vertices[v].x, box.least.x) << 42U |
                                  along(vertices[v].y, box.least.y) << 21U |
                                  along(vertices[v].z, box.least.z);
        result[v] = first.try_emplace(key, v).first->second;
    }
    return result;
}

bool is_collapsed(const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Replaces corners and drops triangles and segments that collapse, part by part and line by line.
void join_vertices(Scene& scene, const std::vector<std::uint32_t>& first) {
    std::size_t kept = 0;
    for (ScenePart& part : scene.parts) {
        const std::size_t begin = std::exchange(part.first, kept);
        for (std::size_t t = begin; t < begin + part.count; ++t) {
            Triangle triangle = scene.triangles[t];
            for (std::uint32_t& v : triangle) v = first[v];
            if (!is_collapsed(triangle)) scene.triangles[kept++] = triangle;
        }
        part.count = kept - part.first;
    }
    scene.triangles.resize(kept);
    kept = 0;
    for (SceneLine& line : scene.lines) {
        const std::size_t begin = std::exchange(line.first, kept);
        for (std::size_t s = begin; s < begin + line.count; ++s) {
            const Edge edge{first[scene.segments[s][0]], first[scene.segments[s][1]]};
            if (edge[0] != edge[1]) scene.segments[kept++] = edge;
        }
        line.count = kept - line.first;
    }
    scene.segments.resize(kept);
}

std::size_t left_after(const Scene& scene, const std::vector<std::uint32_t>& first) {
    return static_cast<std::size_t>(
        std::count_if(scene.triangles.begin(), scene.triangles.end(), [&](const Triangle& t) {
            return !is_collapsed({first[t[0]], first[t[1]], first[t[2]]});
        }));
}

/// Numbers vertices in the order in which `cells` use them first, renames them in `cells` and
/// `others`, and drops the rest.
template <class Cells, class Others>
void renumber(std::vector<Point3>& vertices, Cells& cells, Others& others) {
    constexpr std::uint32_t none = UINT32_MAX;
    std::vector<std::uint32_t> number_of(vertices.size(), none);
    std::vector<Point3> used;
    const auto rename = [&](auto& lists) {
        for (auto& list : lists)
            for (std::uint32_t& v : list) {
                if (number_of[v] == none) {
                    number_of[v] = static_cast<std::uint32_t>(used.size());
                    used.push_back(vertices[v]);
                }
                v = number_of[v];
            }
    };
    rename(cells);
    rename(others);
    vertices = std::move(used);
}

Json points_packed(const std::vector<Point3>& points, const Bounds& box, double step,
                   Arrays& arrays) {
    std::vector<std::uint32_t> values;
    values.reserve(3 * points.size());
    const auto steps = [&](double x, double least) {
        return static_cast<std::uint32_t>(
            std::lround(std::min(quotient(least, x, step), most_steps)));
    };
    for (const Point3& p : points)
        values.insert(values.end(),
                      {steps(p.x, box.least.x), steps(p.y, box.least.y), steps(p.z, box.least.z)});
    return arrays.add(values, 3);
}

template <class Cells>
Json cells_packed(const Cells& cells, Arrays& arrays) {
    std::vector<std::uint32_t> values;
    values.reserve(3 * cells.size());
    for (const auto& cell : cells) values.insert(values.end(), cell.begin(), cell.end());
    return arrays.add(values);
}

} // namespace

void decimate(Scene& scene, std::size_t most) {
    if (scene.triangles.size() <= most) return;
    Bounds box;
    box.add(scene.vertices);
    double area = 0;
    for (const ScenePart& part : scene.parts) area += part.area;
    // About two triangles remain for each cell that a surface goes through.
    double cell = std::max(std::sqrt(area / static_cast<double>(most)), box.extent_by(2e6));
    auto first = first_in_cell(scene.vertices, box, cell);
    while (left_after(scene, first) > most) {
        cell *= 1.25;
        first = first_in_cell(scene.vertices, box, cell);
    }
    join_vertices(scene, first);
    scene.cell = cell;
}

Json packed(Scene scene, Arrays& arrays) {
    renumber(scene.vertices, scene.triangles, scene.segments);
    Bounds box;
    box.add(scene.vertices);
    box.add(scene.nodes);
    if (scene.vertices.empty() && scene.nodes.empty()) box = {{0, 0, 0}, {0, 0, 0}};
    const double step =
        box.extent_by(1) > 0 // a share of the least numbers may be 0
            ? std::max(box.extent_by(most_steps), std::numeric_limits<double>::denorm_min())
            : 1;
    Json json;
    json["parts"] = Json::array();
    for (const ScenePart& part : scene.parts)
        json["parts"].push_back({{"surfaces", part.surfaces},
                                 {"blocks", part.blocks ? Json(*part.blocks) : Json()},
                                 {"first", part.first},
                                 {"count", part.count},
                                 {"area", part.area},
                                 {"filled", part.filled}});
    json["lines"] = Json::array();
    for (const SceneLine& line : scene.lines)
        json["lines"].push_back({{"kind", line.kind},
                                 {"surfaces", line.surfaces},
                                 {"length", line.length},
                                 {"first", line.first},
                                 {"count", line.count}});
    json["view"] = {{"origin", Json::array({box.least.x, box.least.y, box.least.z})},
                    {"step", step},
                    {"triangles", scene.given},
                    {"drawn", scene.triangles.size()},
                    {"cell", scene.cell},
                    {"tetrahedra_left_out", scene.left_out}};
    json["arrays"] = {{"vertices", points_packed(scene.vertices, box, step, arrays)},
                      {"triangles", cells_packed(scene.triangles, arrays)},
                      {"segments", cells_packed(scene.segments, arrays)},
                      {"nodes", points_packed(scene.nodes, box, step, arrays)},
                      {"tetrahedra", cells_packed(scene.tetrahedra, arrays)},
                      {"blocks", arrays.add(scene.block_of)}};
    return json;
}

} // namespace terrane::page
