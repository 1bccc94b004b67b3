// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stacks random layers and judges the results by what the documentation promises, in rationals:
//   order       no layer is anywhere above one that is higher in the order. For each pair of
//               triangles of two layers whose projections have a common area, heights are compared
//               at the corners of the common polygon;
//   definition  at each place a horizon gives way to the nearest harder ones that exist there,
//               above and below it. At random places the height of each layer is compared with the
//               one computed from the input alone;
//   moves       no horizon is said to move by more than all heights span;
//   certificate the verifier accepts the certificate of the stack.
// The horizons are flat, plane, wavy or on a lattice of heights, with steps; they cover all, a
// rectangle, scattered cells, or all but a hole; some are identical to parts of others.
//   stacks random COUNT [FIRST_SEED [FOLDER]]             FOLDER takes the stacks that fail
//   stacks file FILE.obj MIN_THICKNESS NAME=HARDNESS ...  from the top down
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "oracles/clipped.hpp"
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/files.hpp>

namespace {

using namespace terrane;
using namespace oracles;

struct Stack {
    std::vector<Surface> surfaces; ///< from the top down
    std::vector<Layer> order;      ///< of all of them
    double thickness = 0;
};

// ---- Random stacks -----------------------------------------------------------------------------

class Generator {
public:
    explicit Generator(std::uint64_t seed) : random_(seed) {}

    Stack operator()() {
        Stack stack;
        const double gap = std::array{0.15, 0.4, 1.0}[below(3)];
        const unsigned count = 2 + below(5);
        for (unsigned i = 0; i < count; ++i) {
            Surface s = !stack.surfaces.empty() && below(4) == 0
                            ? copy_of(stack.surfaces[below(stack.surfaces.size())])
                            : horizon(-gap * i);
            s.name = "h" + std::to_string(i);
            stack.order.push_back({SurfaceId(i), static_cast<double>(below(7))});
            stack.surfaces.push_back(std::move(s));
        }
        stack.thickness = std::array{0.0, 0.0, 0.0, 0.125, 0.3}[below(5)];
        return stack;
    }

private:
    unsigned below(std::size_t n) { return static_cast<unsigned>(random_() % n); }
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }

    std::function<double(double, double)> heights(double level, unsigned kind) {
        if (kind == 0) return [=](double, double) { return level; };
        const double a = between(0.1, 0.8), b = between(0.1, 0.8), p = between(0, 6),
                     q = between(0, 6), k = between(0.2, 1.2), l = between(0.2, 1.2);
        if (kind == 1)
            return [=](double x, double y) { return level + (a - b) * x / 4 + (p - 3) * y / 15; };
        if (kind == 2) {
            const double floor = std::floor(level);
            const auto known = std::make_shared<std::map<std::pair<double, double>, double>>();
            return [=, this](double x, double y) {
                const auto [at, added] = known->try_emplace({x, y}, 0);
                if (added) at->second = floor + below(3) - 1;
                return at->second;
            };
        }
        return [=](double x, double y) {
            return level + a * std::sin(k * x + p) + b * std::cos(l * y + q);
        };
    }

    /// Chooses cells of an n x n grid.
    std::set<std::array<unsigned, 2>> domain(unsigned n) {
        std::set<std::array<unsigned, 2>> cells;
        const unsigned kind = below(5), i0 = below(n), j0 = below(n), i1 = i0 + below(n - i0),
                       j1 = j0 + below(n - j0);
        const double share = between(0.3, 0.9);
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j) {
                const bool chosen = kind == 0   ? i >= i0 && i <= i1 && j >= j0 && j <= j1
                                    : kind == 1 ? between(0, 1) < share
                                    : kind == 2 ? n < 3 || i != i0 || j != j0
                                                : true;
                if (chosen) cells.insert({i, j});
            }
        if (cells.empty()) cells.insert({0, 0});
        return cells;
    }

    Surface horizon(double level) {
        Surface s;
        const unsigned n = 1 + below(5), kind = below(5);
        const auto z = heights(level, kind);
        const double x0 = std::array{0.0, 0.0, 2.5, between(0, 4)}[below(4)],
                     step = below(3) > 0 ? (10 - x0) / n : between(0.5, 1) * 10 / n,
                     throw_ = n > 1 ? std::array{0.0, 0.0, 1.0, between(0.2, 1.5)}[below(4)] : 0,
                     jitter = kind == 2 || below(2) == 0 ? 0 : 0.25 * step;
        const unsigned split = n > 1 ? 1 + below(n - 1) : 0;
        std::map<std::array<unsigned, 2>, Point3> nodes;
        for (unsigned i = 0; i <= n; ++i)
            for (unsigned j = 0; j <= n; ++j) {
                const double x = x0 + i * step + between(-jitter, jitter),
                             y = j * 10.0 / n + between(-jitter, jitter);
                nodes[{i, j}] = {x, y, z(x, y)};
            }
        std::map<std::array<unsigned, 3>, std::uint32_t> known;
        for (const auto& [i, j] : domain(n)) {
            const unsigned side = throw_ != 0 && i >= split ? 1 : 0;
            const auto vertex = [&](unsigned u, unsigned v) {
                const auto [at, added] =
                    known.try_emplace({u, v, side}, static_cast<std::uint32_t>(s.vertices.size()));
                if (added) {
                    s.vertices.push_back(nodes[{u, v}]);
                    s.vertices.back().z += side * throw_;
                }
                return at->second;
            };
            const auto a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                       d = vertex(i, j + 1);
            const bool first = below(2) == 0;
            s.triangles.push_back(first ? Triangle{a, b, c} : Triangle{a, b, d});
            s.triangles.push_back(first ? Triangle{a, c, d} : Triangle{b, c, d});
        }
        return s;
    }

    /// Copies most triangles of another horizon, and moves some of its vertices.
    Surface copy_of(const Surface& other) {
        Surface s{"", other.role, other.vertices, {}};
        for (const Triangle& t : other.triangles)
            if (below(5) > 0) s.triangles.push_back(t);
        if (s.triangles.empty()) s.triangles = other.triangles;
        const double shift = below(2) == 0 ? 0 : between(-0.6, 0.6);
        for (Point3& p : s.vertices)
            if (p.x > 5) p.z += shift;
        return s;
    }

    std::mt19937_64 random_;
};

// ---- Judging -----------------------------------------------------------------------------------

using Triangles = std::vector<Corners>; ///< upward

Triangles upward_triangles(const std::vector<Point3>& vertices,
                           const std::vector<Triangle>& triangles) {
    Triangles all;
    for (const Triangle& t : triangles)
        if (const auto c = upward({vertices[t[0]], vertices[t[1]], vertices[t[2]]}))
            all.push_back(*c);
    return all;
}

std::array<double, 6> bounds(const Corners& c) {
    const auto [x0, x1] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [y0, y1] = std::minmax({c[0].y, c[1].y, c[2].y});
    const auto [z0, z1] = std::minmax({c[0].z, c[1].z, c[2].z});
    return {x0, x1, y0, y1, z0, z1};
}

/// Returns the edges of a single triangle, in the projection.
std::vector<std::array<Point3, 2>> borders(const Triangles& triangles) {
    std::map<std::array<std::array<double, 3>, 2>, int> count;
    for (const Corners& c : triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const Point3 &p = c[i], &q = c[(i + 1) % 3];
            std::array<double, 3> a{p.x, p.y, p.z}, b{q.x, q.y, q.z};
            ++count[{std::min(a, b), std::max(a, b)}];
        }
    std::vector<std::array<Point3, 2>> found;
    for (const auto& [e, n] : count)
        if (n == 1)
            found.push_back({Point3{e[0][0], e[0][1], e[0][2]}, Point3{e[1][0], e[1][1], e[1][2]}});
    return found;
}

/// Tells whether the polygon is a sliver over the line of a step: a border passes along all of it.
bool is_over_step(const std::vector<Exact2>& polygon, const Triangles& upper,
                  const Triangles& lower) {
    constexpr double width = 2e-14; // coordinates go up to 10 or so
    for (const Triangles* layer : {&upper, &lower})
        for (const auto& [a, b] : borders(*layer)) {
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            bool along = true;
            for (const Exact2& p : polygon) {
                const mpq_class across = turn(flat(a), flat(b), p);
                const double beside = std::fabs(across.get_d()) / length,
                             from_a = std::hypot(p.x.get_d() - a.x, p.y.get_d() - a.y),
                             from_b = std::hypot(p.x.get_d() - b.x, p.y.get_d() - b.y);
                along = along && beside < width && std::max(from_a, from_b) < length + width;
            }
            if (along) return true;
        }
    return false;
}

/// Returns by how much `lower` is above `upper` at most; 0 where it is nowhere above. Over the
/// lines of steps, which rounding widens to slivers, anything goes.
mpq_class out_of_order(const Triangles& upper, const Triangles& lower) {
    mpq_class worst = 0;
    std::vector<std::array<double, 6>> boxes;
    for (const Corners& t : lower) boxes.push_back(bounds(t));
    for (const Corners& s : upper) {
        const auto a = bounds(s);
        for (std::size_t k = 0; k < lower.size(); ++k) {
            const auto& b = boxes[k];
            if (b[5] <= a[4] || b[0] >= a[1] || b[1] <= a[0] || b[2] >= a[3] || b[3] <= a[2])
                continue;
            const auto polygon = common(s, lower[k]);
            if (area(polygon) == 0) continue;
            mpq_class here = 0;
            for (const Exact2& p : polygon) {
                const mpq_class depth = height(lower[k], p) - height(s, p);
                if (depth > here) here = depth;
            }
            if (here > worst && !is_over_step(polygon, upper, lower)) worst = here;
        }
    }
    return worst;
}

/// A horizon over a place: nothing, or its height; or the place is too near an edge.
struct Over {
    bool doubtful = false;
    std::optional<double> z{};
};

Over over(const Triangles& triangles, double x, double y) {
    bool doubtful = false;
    for (const Corners& t : triangles) {
        std::array<double, 3> share{};
        double whole = 0;
        for (unsigned i = 0; i < 3; ++i) {
            const Point3 &a = t[(i + 1) % 3], &b = t[(i + 2) % 3];
            share[i] = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
            whole += share[i];
        }
        const double least = *std::min_element(share.begin(), share.end());
        if (least > 1e-7)
            return {false, (share[0] * t[0].z + share[1] * t[1].z + share[2] * t[2].z) / whole};
        if (least > -1e-7) doubtful = true;
    }
    return {doubtful, std::nullopt};
}

/// Evaluates the definition, from the hardest horizon to the softest. Nothing where the place is
/// too near an edge.
std::optional<std::vector<std::optional<double>>>
defined(const Stack& stack, const std::vector<Triangles>& own, double x, double y) {
    std::vector<std::optional<double>> z;
    for (const Triangles& t : own) {
        const Over o = over(t, x, y);
        if (o.doubtful) return std::nullopt;
        z.push_back(o.z);
    }
    std::vector<std::size_t> by_hardness(stack.order.size());
    for (std::size_t i = 0; i < by_hardness.size(); ++i) by_hardness[i] = i;
    std::stable_sort(by_hardness.begin(), by_hardness.end(), [&](std::size_t a, std::size_t b) {
        return stack.order[a].hardness > stack.order[b].hardness;
    });
    std::set<std::size_t> placed; // those that exist here
    for (const std::size_t i : by_hardness) {
        if (!z[i]) continue;
        const auto below = placed.upper_bound(i);
        const bool has_above = below != placed.begin(), has_below = below != placed.end();
        const double ceiling = has_above ? *z[*std::prev(below)] : 0,
                     floor = has_below ? *z[*below] : 0;
        if (has_above) z[i] = std::min(*z[i], ceiling - stack.thickness);
        if (has_below) z[i] = std::max(*z[i], floor + stack.thickness);
        if (has_above) z[i] = std::min(*z[i], ceiling);
        placed.insert(i);
    }
    return z;
}

std::string definition_flaw(const Stack& stack, const std::vector<Triangles>& made) {
    std::vector<Triangles> own;
    for (const Layer& l : stack.order) {
        const Surface& s = stack.surfaces[l.surface];
        own.push_back(upward_triangles(s.vertices, s.triangles));
    }
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> at(0, 10);
    for (int k = 0; k < 60; ++k) {
        const double x = at(random), y = at(random);
        const auto expected = defined(stack, own, x, y);
        if (!expected) continue;
        for (std::size_t i = 0; i < made.size(); ++i) {
            const Over o = over(made[i], x, y);
            if (o.doubtful) continue;
            const auto& z = (*expected)[i];
            if (o.z.has_value() == z.has_value() && (!z || std::fabs(*o.z - *z) < 1e-8)) continue;
            return "definition: layer " + std::to_string(i) + " at " + std::to_string(x) + ", " +
                   std::to_string(y) + " is at " + (o.z ? std::to_string(*o.z) : "no height") +
                   ", not at " + (z ? std::to_string(*z) : "none");
        }
    }
    return {};
}

std::string moves_flaw(const Stack& stack, const Layered& layered) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Layer& l : stack.order)
        for (const Point3& p : stack.surfaces[l.surface].vertices) {
            low = std::min(low, p.z);
            high = std::max(high, p.z);
        }
    const double span =
        (high - low + stack.thickness * static_cast<double>(stack.order.size())) * (1 + 1e-12);
    for (const LayerReport& report : layered.reports)
        if (!(report.largest_move >= 0 && report.largest_move <= span))
            return "moves: layer " + std::to_string(report.surface) + " by " +
                   std::to_string(report.largest_move);
    return {};
}

/// Returns what the verifier says about the certificate of layers; empty if it accepts it.
std::string certificate_flaw(const Stack& stack, const Layered& layered) {
    const InputFile file = input_file("", stack.surfaces);
    const std::vector<InputRecord> records{
        {"stack.obj", file.sha256, file.bytes, stack.surfaces.size()}};
    const auto certificate = parse_certificate(
        to_layered_certificate(records, stack.surfaces, {}, stack.order, layered), "stack");
    if (!certificate) return certificate.error().message();
    const Verdict verdict = verify_certificate(std::span(&file, 1), *certificate);
    if (verdict.violations.empty()) return {};
    return "certificate: " + name_of(verdict.violations[0].rule) + ": " +
           verdict.violations[0].sentence;
}

/// Returns the promise that the stack of these layers breaks; empty if it holds.
std::string flaw(const Stack& stack) {
    const auto layered =
        stack_layers(stack.surfaces, stack.order, {.min_thickness = stack.thickness});
    if (!layered) return layered.error().message();
    if (!layered->rounded.report.clean) return "not conforming";
    const Mesh& mesh = *layered->rounded.mesh;
    std::vector<std::vector<Triangle>> triangles(stack.order.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t s : mesh.surfaces_of[t]) triangles[s].push_back(mesh.triangles[t]);
    std::vector<Triangles> made;
    for (const auto& t : triangles) made.push_back(upward_triangles(mesh.vertices, t));
    for (std::size_t i = 0; i < made.size(); ++i)
        for (std::size_t j = i + 1; j < made.size(); ++j)
            if (const mpq_class depth = out_of_order(made[i], made[j]); depth > 0) {
                char text[160];
                std::snprintf(text, sizeof text, "order: layer %zu is %.3g above layer %zu%s", j,
                              depth.get_d(), i,
                              layered->is_stack() ? "" : " (and the program says so)");
                return text;
            }
    if (!layered->is_stack()) return "order: said to be out of order, but is not";
    if (auto what = definition_flaw(stack, made); !what.empty()) return what;
    if (auto what = moves_flaw(stack, *layered); !what.empty()) return what;
    return certificate_flaw(stack, *layered);
}

int judge_file(const std::vector<std::string>& words) {
    const auto read = read_surfaces(words.at(0));
    if (!read) return std::printf("%s\n", read.error().message().c_str()), 2;
    Stack stack{read.value(), {}, std::atof(words.at(1).c_str())};
    for (std::size_t i = 2; i < words.size(); ++i) {
        const auto at = words[i].rfind('=');
        for (std::uint32_t s = 0; s < stack.surfaces.size(); ++s)
            if (stack.surfaces[s].name == words[i].substr(0, at))
                stack.order.push_back({SurfaceId(s), std::atof(words[i].c_str() + at + 1)});
    }
    const auto broken = flaw(stack);
    std::printf("%s: %s\n", words[0].c_str(), broken.empty() ? "holds" : broken.c_str());
    return broken.empty() ? 0 : 1;
}

void write_stack(const Stack& stack, const std::string& path) {
    std::FILE* const file = std::fopen(path.c_str(), "w");
    if (file == nullptr) return;
    std::size_t first = 1;
    for (const Surface& s : stack.surfaces) {
        std::fprintf(file, "g %s\n", s.name.c_str());
        for (const Point3& p : s.vertices)
            std::fprintf(file, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
        for (const Triangle& t : s.triangles)
            std::fprintf(file, "f %zu %zu %zu\n", t[0] + first, t[1] + first, t[2] + first);
        first += s.vertices.size();
    }
    std::fclose(file);
}

int judge_random(std::uint64_t count, std::uint64_t first, const std::string& folder) {
    std::uint64_t broken = 0;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const Stack stack = Generator(seed)();
        const auto what = flaw(stack);
        if (what.empty()) continue;
        ++broken;
        const auto name = std::to_string(seed);
        std::printf("stack %s: %s; %g", name.c_str(), what.c_str(), stack.thickness);
        for (const Layer& l : stack.order)
            std::printf(" %s=%g", stack.surfaces[l.surface].name.c_str(), l.hardness);
        std::printf("\n");
        std::fflush(stdout);
        if (!folder.empty()) write_stack(stack, folder + "/stack" + name + ".obj");
    }
    std::printf("%llu stacks, %llu break a promise\n", static_cast<unsigned long long>(count),
                static_cast<unsigned long long>(broken));
    return broken == 0 && count > 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    const auto number = [&](std::size_t i, std::uint64_t otherwise) {
        return words.size() > i ? std::strtoull(words[i].c_str(), nullptr, 10) : otherwise;
    };
    if (words.size() > 3 && words[0] == "file") return judge_file({words.begin() + 1, words.end()});
    if (!words.empty() && words[0] == "random")
        return judge_random(number(1, 2000), number(2, 1), words.size() > 3 ? words[3] : "");
    std::printf("stacks random COUNT [FIRST_SEED [FOLDER]]\n"
                "stacks file FILE.obj MIN_THICKNESS NAME=HARDNESS ...\n");
    return 2;
}
