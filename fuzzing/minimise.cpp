// SPDX-License-Identifier: MIT
#include <terrane/fuzzing/minimise.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <utility>

#include <sys/wait.h>
#include <unistd.h>

namespace terrane::fuzzing {

namespace {

/// Returns simpler numbers near x, the simplest first.
std::vector<double> simpler(double x) {
    std::vector<double> tries{0, 1, -1, std::round(x), std::trunc(x / 2)};
    for (int digits = 1; digits < 16; ++digits) {
        char text[40];
        std::snprintf(text, sizeof text, "%.*g", digits, x);
        tries.push_back(std::strtod(text, nullptr));
    }
    return tries;
}

std::size_t length(double x) {
    char text[40];
    return static_cast<std::size_t>(std::to_chars(text, text + sizeof text, x).ptr - text);
}

/// Tells whether a is simpler than b: it has fewer digits, or as many and is nearer to zero.
bool is_simpler(double a, double b) {
    return length(a) < length(b) || (length(a) == length(b) && std::fabs(a) < std::fabs(b));
}

/// Merges points at equal places, to the sign of zeros, and drops unused ones. The points of the triangles do not change.
Part compacted(const Part& part) {
    Part result{{}, part.triangles};
    std::map<std::array<std::uint64_t, 3>, std::uint32_t> index; // by the bits of the coordinates
    for (Triangle& t : result.triangles)
        for (std::uint32_t& v : t) {
            const Point p = part.points[v];
            std::array<std::uint64_t, 3> bits{};
            static_assert(sizeof bits == sizeof p);
            std::memcpy(bits.data(), &p, sizeof bits);
            const auto [at, is_new] =
                index.try_emplace(bits, static_cast<std::uint32_t>(result.points.size()));
            if (is_new) result.points.push_back(p);
            v = at->second;
        }
    return result;
}

/// Returns the points that no triangle has, in order.
std::vector<std::uint32_t> unused_points(const Part& part) {
    std::vector<bool> used(part.points.size(), false);
    for (const Triangle& t : part.triangles)
        for (const std::uint32_t v : t) used[v] = true;
    std::vector<std::uint32_t> unused;
    for (std::uint32_t v = 0; v < used.size(); ++v)
        if (!used[v]) unused.push_back(v);
    return unused;
}

/// Removes points that no triangle has; they are in order.
void drop_points(Part& part, const std::vector<std::uint32_t>& dropped) {
    std::vector<Point> left;
    std::vector<std::uint32_t> index;
    for (std::uint32_t v = 0; v < part.points.size(); ++v) {
        index.push_back(static_cast<std::uint32_t>(left.size()));
        if (!std::binary_search(dropped.begin(), dropped.end(), v)) left.push_back(part.points[v]);
    }
    for (Triangle& t : part.triangles)
        for (std::uint32_t& v : t) v = index[v];
    part.points = left;
}

/// Leaves out pairs of triangles at a corner that face opposite ways; tells whether there were any.
bool cancel_opposites(std::vector<Triangle>& triangles, std::uint32_t corner) {
    std::vector<Triangle> at_corner, left;
    for (const Triangle& t : triangles)
        (std::find(t.begin(), t.end(), corner) == t.end() ? left : at_corner).push_back(t);
    const auto is_opposite = [](const Triangle& t, Triangle other) {
        std::swap(other[0], other[1]);
        for (unsigned turns = 0; turns < 3 && t != other; ++turns)
            std::rotate(other.begin(), other.begin() + 1, other.end());
        return t == other;
    };
    while (!at_corner.empty()) {
        const Triangle t = at_corner.back();
        at_corner.pop_back();
        const auto found = std::find_if(at_corner.begin(), at_corner.end(),
                                        [&](const Triangle& u) { return is_opposite(t, u); });
        if (found == at_corner.end())
            left.push_back(t);
        else
            at_corner.erase(found);
    }
    const bool any = left.size() < triangles.size();
    if (any) triangles = left;
    return any;
}

class Minimiser {
public:
    Minimiser(Soup soup, const Fails& fails) : best_(std::move(soup)), fails_(fails) {}

    Soup run() {
        for (bool again = true; again;) {
            again = compact();
            again = drop_triangles() || again;
            again = drop_unused_points() || again;
            again = contract_edges() || again;
            again = simplify_frame() || again;
            again = simplify_numbers() || again;
            again = simplify_coordinates() || again;
        }
        return best_;
    }

private:
    bool accept(const Soup& changed) {
        if (!fails_(changed)) return false;
        best_ = changed;
        return true;
    }
    /// Removes the points that no triangle has, where some of them matter: all, half of them, ..., one.
    bool drop_unused_points() {
        bool any = false;
        for (std::size_t p = 0; p < best_.size(); ++p)
            for (std::size_t piece = unused_points(best_[p]).size(); piece > 0; piece /= 2)
                for (std::size_t at = 0;;) {
                    const auto unused = unused_points(best_[p]);
                    if (at >= unused.size()) break;
                    Soup changed = best_;
                    const auto last = std::min(at + piece, unused.size());
                    drop_points(changed[p], {unused.begin() + static_cast<std::ptrdiff_t>(at),
                                             unused.begin() + static_cast<std::ptrdiff_t>(last)});
                    if (accept(changed))
                        any = true;
                    else
                        at += piece;
                }
        return any;
    }
    /// Removes pieces of all triangles of a part, of half of them, of a quarter, ..., of one triangle.
    bool drop_triangles() {
        bool any = false;
        for (std::size_t p = 0; p < best_.size(); ++p)
            for (std::size_t piece = best_[p].triangles.size(); piece > 0; piece /= 2)
                for (std::size_t at = 0; at < best_[p].triangles.size();) {
                    Soup changed = best_;
                    auto& triangles = changed[p].triangles;
                    const auto first = triangles.begin() + static_cast<std::ptrdiff_t>(at);
                    const auto count = std::min(piece, triangles.size() - at);
                    triangles.erase(first, first + static_cast<std::ptrdiff_t>(count));
                    if (is_compact_) changed[p] = compacted(changed[p]);
                    if (accept(changed))
                        any = true;
                    else
                        at += piece;
                }
        return any;
    }
    bool compact() {
        Soup changed = best_;
        for (Part& part : changed) part = compacted(part);
        const bool is_new = changed != best_;
        is_compact_ = !is_new || accept(changed);
        return is_new && is_compact_;
    }
    /// Makes two corners one, and drops the triangles that have both: closed parts remain closed.
    bool contract_edges() {
        bool any = false;
        for (std::size_t p = 0; p < best_.size(); ++p)
            for (std::size_t t = 0; t < best_[p].triangles.size(); ++t)
                for (unsigned i = 0; i < 6 && t < best_[p].triangles.size(); ++i) {
                    const Triangle& corners = best_[p].triangles[t];
                    if (contract(p, corners[i % 3], corners[(i + 1 + i / 3) % 3])) any = true;
                }
        return any;
    }
    bool contract(std::size_t p, std::uint32_t from, std::uint32_t to) {
        Soup changed = best_;
        auto& triangles = changed[p].triangles;
        for (Triangle& t : triangles) std::replace(t.begin(), t.end(), from, to);
        std::erase_if(triangles, [](const Triangle& t) {
            return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
        });
        if (triangles.size() == best_[p].triangles.size()) return false;
        Soup without = changed; // sides that came together, as those of a tetrahedron do
        if (cancel_opposites(without[p].triangles, to) && accept(without)) return true;
        return accept(changed);
    }
    /// Shifts all points, so that one is 0 along an axis, or multiplies them by a power of two, so that the largest
    /// number is 1 or more: nearly coplanar points mostly remain so.
    bool simplify_frame() {
        bool any = false;
        for (double Point::*k : {&Point::x, &Point::y, &Point::z}) {
            const auto filled = std::find_if(best_.begin(), best_.end(),
                                             [](const Part& part) { return !part.points.empty(); });
            if (filled == best_.end()) return any;
            const double by = filled->points.front().*k;
            any = accept_simpler([&](Point& p) { p.*k -= by; }) || any;
        }
        double largest = 0;
        for (const Part& part : best_)
            for (const Point& p : part.points)
                largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
        const int exponent = largest == 0 ? 0 : std::ilogb(largest);
        return accept_simpler([&](Point& p) {
                   p = {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent),
                        std::ldexp(p.z, -exponent)};
               }) ||
               any;
    }
    /// Accepts a change of all points if their numbers have fewer digits in all.
    template <class Change>
    bool accept_simpler(const Change& change) {
        std::size_t before = 0, after = 0;
        Soup changed = best_;
        for (Part& part : changed)
            for (Point& p : part.points) {
                before += length(p.x) + length(p.y) + length(p.z);
                change(p);
                after += length(p.x) + length(p.y) + length(p.z);
            }
        return after < before && accept(changed);
    }
    /// Replaces numbers everywhere, so that shared points and coplanar triangles mostly remain so.
    bool simplify_numbers() {
        std::vector<double> numbers;
        for (const Part& part : best_)
            for (const Point& p : part.points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
        std::sort(numbers.begin(), numbers.end());
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
        bool any = false;
        for (const double x : numbers)
            for (const double y : simpler(x)) {
                if (!is_simpler(y, x)) continue;
                Soup changed = best_;
                for (Part& part : changed)
                    for (Point& p : part.points)
                        for (double* each : {&p.x, &p.y, &p.z})
                            if (*each == x) *each = y;
                if (accept(changed)) {
                    any = true;
                    break;
                }
            }
        return any;
    }
    bool simplify_coordinates() {
        bool any = false;
        for (std::size_t p = 0; p < best_.size(); ++p)
            for (std::size_t v = 0; v < best_[p].points.size(); ++v)
                for (double Point::*k : {&Point::x, &Point::y, &Point::z})
                    for (const double y : simpler(best_[p].points[v].*k)) {
                        if (!is_simpler(y, best_[p].points[v].*k)) continue;
                        Soup changed = best_;
                        changed[p].points[v].*k = y;
                        if (accept(changed)) {
                            any = true;
                            break;
                        }
                    }
        return any;
    }

    Soup best_;
    const Fails& fails_;
    bool is_compact_ = false; ///< whether unused and equal points do not matter
};

} // namespace

Soup minimise(Soup soup, const Fails& fails) {
    return Minimiser(std::move(soup), fails).run();
}

bool fails_apart(const std::function<bool()>& holds, unsigned seconds) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        for (const int crash : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV})
            std::signal(crash, SIG_DFL);
        alarm(seconds);
        if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(0);
        try {
            _exit(holds() ? 0 : 1);
        } catch (...) { // which the caller of this process would catch
            _exit(1);
        }
    }
    int status = 0;
    return child > 0 && waitpid(child, &status, 0) == child &&
           !(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

} // namespace terrane::fuzzing
