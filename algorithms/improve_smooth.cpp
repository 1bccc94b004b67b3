// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Smoothing by trapezium drawing.
#include <terrane/algorithms/improve_operations.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace terrane::improving {
namespace {

constexpr double least_gain = 1e-2;   ///< share of the sum of 1 / q that a move must take away
constexpr double shake_share = 0.2;   ///< of the wanted length
constexpr double square_shape = 0.86; ///< q of half a square is 0.83

/// Where trapezium drawing puts the vertex.
Point3 drawn(const WorkMesh& mesh, std::uint32_t v) {
    const Point3& p = mesh.points[v];
    Point3 sum{};
    for (const std::uint32_t t : mesh.star[v]) {
        const Triangle& c = mesh.triangles[t];
        const std::size_t i = c[0] == v ? 0 : c[1] == v ? 1 : 2;
        const Point3 &a = mesh.points[c[(i + 1) % 3]], &b = mesh.points[c[(i + 2) % 3]];
        const Point3 base = minus(b, a);
        const Point3 to_middle{(a.x + b.x) / 2 - p.x, (a.y + b.y) / 2 - p.y, (a.z + b.z) / 2 - p.z};
        const double square = dot(base, base);
        const double share = square > 0 ? dot(to_middle, base) / square : 0;
        sum = {sum.x + share * base.x, sum.y + share * base.y, sum.z + share * base.z};
    }
    const auto count = static_cast<double>(mesh.star[v].size());
    return {p.x + sum.x / count, p.y + sum.y / count, p.z + sum.z / count};
}

/// The mean of the neighbours.
Point3 centre(const WorkMesh& mesh, std::uint32_t v) {
    Point3 sum{};
    for (const std::uint32_t t : mesh.star[v])
        for (const std::uint32_t c : mesh.triangles[t])
            if (c != v)
                sum = {sum.x + mesh.points[c].x, sum.y + mesh.points[c].y,
                       sum.z + mesh.points[c].z};
    const auto count = 2 * static_cast<double>(mesh.star[v].size());
    return {sum.x / count, sum.y / count, sum.z / count};
}

/// Sum of 1 / q, and the largest of them.
struct Badness {
    double sum = 0, largest = 0;
};

Badness badness_at(const WorkMesh& mesh, std::uint32_t v) {
    Badness badness;
    for (const std::uint32_t t : mesh.star[v]) {
        const double one = 1 / shape_of(mesh, mesh.triangles[t]);
        badness.sum += one;
        badness.largest = std::max(badness.largest, one);
    }
    return badness;
}

constexpr double endless = std::numeric_limits<double>::infinity();

/// Whether both would be less than the limits with the vertex at p; none of 1 / q is less than 1.
bool is_below(WorkMesh& mesh, std::uint32_t v, const Point3& p, const Badness& limits) {
    const Point3 old = mesh.points[v];
    mesh.points[v] = p;
    auto left = static_cast<double>(mesh.star[v].size());
    double sum = 0;
    bool is = true;
    for (const std::uint32_t t : mesh.star[v]) {
        const double one = 1 / shape_of(mesh, mesh.triangles[t]);
        sum += one;
        left -= 1;
        is = sum + left < limits.sum && one < limits.largest;
        if (!is) break;
    }
    mesh.points[v] = old;
    return is;
}

/// Moves one inner vertex after another, where that brings it below limits.
class Mover {
public:
    explicit Mover(Workshop& shop) : shop_(shop) {}

    void look_at(std::uint32_t v) {
        WorkMesh& mesh = shop_.mesh;
        v_ = v;
        change_.clear();
        change_.in_place = true;
        change_.removed = mesh.star[v];
        for (const std::uint32_t t : change_.removed) change_.add(mesh.triangles[t], t);
        before_ = badness_at(mesh, v);
    }
    /// Before any move.
    [[nodiscard]] const Point3& facing() {
        if (change_.facing.empty()) set_facing(shop_.mesh, change_);
        return change_.facing[0].second;
    }

    [[nodiscard]] const Badness& before() const { return before_; }

    /// On the surface above or below `to`.
    bool move(const Point3& to, const Badness& limits) {
        WorkMesh& mesh = shop_.mesh;
        const Point3 old = mesh.points[v_];
        if (!is_below(mesh, v_, to, limits)) return false; // mostly
        const auto place = shop_.reference.above(to, facing(), mesh.hint_of[change_.removed[0]]);
        if (!place || !is_below(mesh, v_, place->point, limits)) return false;
        change_.moved = v_;
        change_.before = old;
        mesh.points[v_] = place->point;
        if (shop_.guard.apply(change_) != Verdict::allowed) {
            mesh.points[v_] = old;
            return false;
        }
        before_ = badness_at(mesh, v_);
        ++shop_.moves;
        return true;
    }

private:
    Workshop& shop_;
    std::uint32_t v_ = 0;
    Change change_;
    Badness before_;
};

Point3 between(const Point3& a, const Point3& b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}

bool smooth_vertex(Workshop& shop, Mover& mover, std::uint32_t v) {
    mover.look_at(v);
    const Badness better{mover.before().sum * (1 - least_gain), endless};
    const Point3 from = shop.mesh.points[v];
    const Point3 to = drawn(shop.mesh, v);
    // A triangle slides the vertex along its base only, which is half of a way on the mean.
    if (mover.move(between(from, to, 2.0), better)) return true;
    return mover.move(between(from, to, 1.0), better) ||
           mover.move(between(from, centre(shop.mesh, v), 0.5), better);
}

/// Eight directions in the plane across the normal; steps that are halved.
bool lift_vertex(Workshop& shop, Mover& mover, std::uint32_t v) {
    mover.look_at(v);
    Point3 n = mover.facing();
    const double size = std::sqrt(dot(n, n));
    if (!(size > 0)) return false;
    n = {n.x / size, n.y / size, n.z / size};
    Point3 u = std::fabs(n.x) < 0.6 ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0});
    const double across = std::sqrt(dot(u, u));
    u = {u.x / across, u.y / across, u.z / across};
    const Point3 w = cross(n, u);
    bool moved = false;
    double step = shop.mesh.sizes[v] / 4;
    for (unsigned halving = 0; halving < 4; ++halving, step /= 2)
        for (unsigned k = 0; k < 8; ++k) {
            const double angle = k * std::acos(-1.0) / 4;
            const double c = step * std::cos(angle), s = step * std::sin(angle);
            const Point3& p = shop.mesh.points[v];
            const Badness better{endless, mover.before().largest * (1 - least_gain)};
            moved = mover.move(
                        {p.x + c * u.x + s * w.x, p.y + c * u.y + s * w.y, p.z + c * u.z + s * w.z},
                        better) ||
                    moved;
        }
    return moved;
}

/// Each coordinate in [-1, 1), from the number alone.
Point3 scattered(std::uint32_t v) {
    std::uint64_t h = v * 0x9E3779B97F4A7C15ULL;
    const auto next = [&] {
        h ^= h >> 31U;
        h *= 0xBF58476D1CE4E5B9ULL;
        h ^= h >> 29U;
        return static_cast<double>(h >> 11U) * 0x1p-52 - 1;
    };
    const double x = next(), y = next(), z = next();
    return {x, y, z};
}

/// Inner vertices that `wanted` names: those in one patch first.
template <class Wanted, class Work>
std::size_t for_inner(Workshop& shop, const Wanted& wanted, const Work& work) {
    std::size_t count = 0;
    std::vector<std::uint32_t> rest;
    const WorkMesh& mesh = shop.mesh;
    for (std::uint32_t v = 0; v < mesh.kinds.size(); ++v) {
        if (mesh.kinds[v] != VertexKind::inner || !wanted(v)) continue;
        if (shop.run.stop.stop_requested()) return count;
        if (shop.guard.in_one_patch(mesh.star[v]))
            count += work(v);
        else
            rest.push_back(v);
    }
    for (const std::uint32_t v : rest) {
        if (shop.run.stop.stop_requested()) return count;
        count += work(v);
    }
    return count;
}

} // namespace

std::size_t smooth(Workshop& shop) {
    Mover mover(shop);
    ++shop.mesh.now;
    shop.smoothed_at.resize(shop.mesh.kinds.size(), 0);
    const auto is_new = [&](std::uint32_t v) {
        return shop.mesh.changed_since(v, shop.smoothed_at[v]);
    };
    return for_inner(shop, is_new, [&](std::uint32_t v) {
        const bool moved = smooth_vertex(shop, mover, v);
        shop.smoothed_at[v] = moved ? 0 : ++shop.mesh.now;
        return moved;
    });
}

std::size_t shake(Workshop& shop) {
    Mover mover(shop);
    const auto is_square = [&](std::uint32_t v) {
        return std::all_of(shop.mesh.star[v].begin(), shop.mesh.star[v].end(),
                           [&](std::uint32_t t) {
                               return shape_of(shop.mesh, shop.mesh.triangles[t]) < square_shape;
                           });
    };
    return for_inner(shop, is_square, [&](std::uint32_t v) {
        mover.look_at(v);
        const double size = shake_share * shop.mesh.sizes[v];
        const Point3& p = shop.mesh.points[v];
        const auto off = scattered(v);
        return mover.move({p.x + size * off.x, p.y + size * off.y, p.z + size * off.z},
                          {endless, 2});
    });
}

std::size_t lift_worst(Workshop& shop, double below) {
    Mover mover(shop);
    ++shop.mesh.now;
    shop.lifted_at.resize(shop.mesh.kinds.size(), 0);
    const auto is_bad = [&](std::uint32_t v) {
        return shop.mesh.changed_since(v, shop.lifted_at[v]) &&
               std::any_of(shop.mesh.star[v].begin(), shop.mesh.star[v].end(),
                           [&](std::uint32_t t) {
                               return shape_of(shop.mesh, shop.mesh.triangles[t]) < below;
                           });
    };
    return for_inner(shop, is_bad, [&](std::uint32_t v) {
        const bool moved = lift_vertex(shop, mover, v);
        shop.lifted_at[v] = moved ? 0 : ++shop.mesh.now;
        return moved;
    });
}

} // namespace terrane::improving
