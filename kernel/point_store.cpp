// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/kernel/point_store.hpp>

#include <limits>
#include <utility>

#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/predicates.hpp>
#include <terrane/kernel/twofold.hpp>

namespace terrane {

using polynomial::cartesian;
using polynomial::One;

/// One slot per constructed point; filled once, by whichever thread needs it first.
struct PointStore::Cache {
    std::vector<std::atomic<const ExactPoint*>> slots;

    explicit Cache(std::size_t n) : slots(n) {}
    ~Cache() {
        for (const auto& s : slots) delete s.load();
    }
    Cache(const Cache&) = delete;
    Cache& operator=(const Cache&) = delete;
};

PointStore::PointStore(std::vector<Point3> input) : input_(std::move(input)) {}
PointStore::PointStore() = default;
PointStore::~PointStore() = default;
PointStore::PointStore(PointStore&&) noexcept = default;
PointStore& PointStore::operator=(PointStore&&) noexcept = default;

PointStore::PointStore(const PointStore& other) :
    input_(other.input_), constructed_(other.constructed_), enclosures_(other.enclosures_),
    cache_(std::make_unique<Cache>(constructed_.size())) {}

PointStore& PointStore::operator=(const PointStore& other) {
    if (this != &other) *this = PointStore(other);
    return *this;
}

Construction PointStore::construction(PointIndex p) const {
    if (!is_input(p)) return constructed_[p - input_.size()];
    Construction how;
    how.v[0] = p;
    return how;
}

void PointStore::append(std::span<const Construction> constructions, const Share& share) {
    const std::size_t before = constructed_.size();
    constructed_.insert(constructed_.end(), constructions.begin(), constructions.end());
    enclosures_.resize(constructed_.size());
    const auto enclose = [&](std::size_t first, std::size_t last) {
        const UpwardRounding guard;
        for (std::size_t k = first; k < last; ++k)
            enclosures_[before + k] = make_enclosure(constructions[k]);
    };
    if (share)
        share(constructions.size(), enclose);
    else
        enclose(0, constructions.size());
    auto grown = std::make_unique<Cache>(constructed_.size());
    for (std::size_t k = 0; k < before; ++k)
        grown->slots[k].store(cache_->slots[k].exchange(nullptr));
    cache_ = std::move(grown);
}

void PointStore::keep_constructed(std::span<const PointIndex> kept) {
    auto cache = std::make_unique<Cache>(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const std::size_t from = kept[k] - input_.size();
        constructed_[k] = constructed_[from];
        enclosures_[k] = enclosures_[from];
        cache->slots[k].store(cache_->slots[from].exchange(nullptr));
    }
    constructed_.resize(kept.size());
    enclosures_.resize(kept.size());
    cache_ = std::move(cache);
}

namespace {

// Wide enough to make predicates fail that a correctly rounded point would let succeed; without an
// end where the intervals overflowed.
bool is_wide(const Enclosure& e) {
    for (unsigned k = 0; k < 3; ++k) {
        const double size = std::max(std::fabs(e.low[k]), std::fabs(e.high[k]));
        if (!std::isfinite(size) || !(e.high[k] - e.low[k] <= 0x1p-46 * size)) return true;
    }
    return false;
}

template <class W>
Enclosure divide(const polynomial::Coordinates<Interval, W>& c, const Interval& w) {
    const Interval x = c.x / w, y = c.y / w, z = c.z / w;
    return {{x.inf(), y.inf(), z.inf()}, {x.sup(), y.sup(), z.sup()}};
}

// The doubles next below and above `nearest` enclose what was rounded to it.
Enclosure around(const Point3& nearest) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto below = [](double d) { return std::nextafter(d, -infinity); };
    const auto above = [](double d) { return std::nextafter(d, infinity); };
    return {{below(nearest.x), below(nearest.y), below(nearest.z)},
            {above(nearest.x), above(nearest.y), above(nearest.z)}};
}

// Intervals leave zeros of either sign, files should not show them.
Point3 with_positive_zeros(const Point3& p) {
    const auto positive = [](double d) { return d == 0 ? 0 : d; };
    return {positive(p.x), positive(p.y), positive(p.z)};
}

Point3 round(const ExactPoint& p) {
    return with_positive_zeros(
        {nearest_quotient(p.x, p.w), nearest_quotient(p.y, p.w), nearest_quotient(p.z, p.w)});
}

/// The nearest doubles where numbers of about 106 bits leave no doubt.
std::optional<Point3> round_quickly(std::span<const Point3> input, const Construction& how) {
    const ToNearest mode;
    const auto at = [&](std::uint32_t v) -> const Point3& { return input[v]; };
    const auto h = polynomial::construct<Twofold>(how, at);
    const Point3& base = input[how.v[0]];
    const auto x = (Twofold(base.x) + h.x / h.w).nearest();
    const auto y = (Twofold(base.y) + h.y / h.w).nearest();
    const auto z = (Twofold(base.z) + h.z / h.w).nearest();
    if (!x || !y || !z) return std::nullopt;
    return Point3{*x, *y, *z};
}

ExactPoint construct_exactly(std::span<const Point3> input, const Construction& how) {
    const auto at = [&](std::uint32_t v) -> const Point3& { return input[v]; };
    auto h = polynomial::construct<Exact>(how, at);
    if (exact_sign(h.w) == Sign::Negative) h = {-h.x, -h.y, -h.z, -h.w};
    const Point3& base = input[how.v[0]];
    return {h.x + Exact(base.x) * h.w, h.y + Exact(base.y) * h.w, h.z + Exact(base.z) * h.w, h.w};
}

} // namespace

Enclosure PointStore::make_enclosure(const Construction& how) const {
    const auto at = [&](std::uint32_t v) -> const Point3& { return input_[v]; };
    const auto h = polynomial::construct<Interval>(how, at);
    if (certain_sign(h.w).value_or(Sign::Zero) != Sign::Zero) {
        const Point3& base = input_[how.v[0]];
        const Interval x = h.x / h.w + base.x, y = h.y / h.w + base.y, z = h.z / h.w + base.z;
        const Enclosure e{{x.inf(), y.inf(), z.inf()}, {x.sup(), y.sup(), z.sup()}};
        if (!is_wide(e)) return e;
    }
    if (const auto quick = round_quickly(input_, how)) return around(*quick);
    return around(round(make_exact(how)));
}

ExactPoint PointStore::make_exact(const Construction& how) const {
    return construct_exactly(input_, how);
}

const ExactPoint& PointStore::cached_exact(std::size_t k) const {
    auto& slot = cache_->slots[k];
    if (const ExactPoint* ready = slot.load(std::memory_order_acquire)) return *ready;
    const ExactPoint* mine = new ExactPoint(make_exact(constructed_[k]));
    const ExactPoint* expected = nullptr;
    if (slot.compare_exchange_strong(expected, mine, std::memory_order_acq_rel)) return *mine;
    delete mine;
    return *expected;
}

ExactPoint PointStore::exact(PointIndex p) const {
    if (!is_input(p)) return cached_exact(p - input_.size());
    const Point3& q = input_[p];
    return {Exact(q.x), Exact(q.y), Exact(q.z), Exact(1)};
}

Point3 PointStore::nearest(PointIndex p) const {
    if (is_input(p)) return input_[p];
    const Enclosure& e = enclosures_[p - input_.size()];
    if (e.low == e.high) return with_positive_zeros({e.low[0], e.low[1], e.low[2]});
    if (const auto quick = round_quickly(input_, constructed_[p - input_.size()])) return *quick;
    return round(cached_exact(p - input_.size()));
}

Enclosure PointStore::enclosure(PointIndex p) const {
    if (!is_input(p)) return enclosures_[p - input_.size()];
    const Point3& q = input_[p];
    return {{q.x, q.y, q.z}, {q.x, q.y, q.z}};
}

ApproximatePoint PointStore::approximate(Axis axis, PointIndex p) const {
    const auto k = static_cast<unsigned>(axis);
    const unsigned u = (k + 1) % 3, v = (k + 2) % 3;
    if (is_input(p)) {
        const Point3& q = input_[p];
        const std::array<double, 3> x{q.x, q.y, q.z};
        return {x[u], x[v], 0};
    }
    const Enclosure& e = enclosures_[p - input_.size()];
    const auto middle = [&](unsigned i) { return e.low[i] + (e.high[i] - e.low[i]) / 2; };
    const double mu = middle(u), mv = middle(v);
    const double radius =
        std::max(std::max(e.high[u] - mu, mu - e.low[u]), std::max(e.high[v] - mv, mv - e.low[v]));
    return {mu, mv, radius * (1 + 0x1p-50)}; // the last factor for the roundings of differences
}

PointStore::IntervalPoint PointStore::interval(PointIndex p) const {
    if (is_input(p)) return cartesian<Interval>(input_[p]);
    const Enclosure& e = enclosures_[p - input_.size()];
    return {Interval(e.low[0], e.high[0]), Interval(e.low[1], e.high[1]),
            Interval(e.low[2], e.high[2]), One{}};
}

template <class Polynomial, class... P>
Sign PointStore::filtered(const Polynomial& polynomial, P... points) const {
    if (const auto sign = certain_sign(polynomial(interval(points)...))) {
        ++predicate_counts().interval;
        return *sign;
    }
    ++predicate_counts().exact;
    return exact_sign(polynomial(exact(points)...));
}

std::strong_ordering PointStore::compare(PointIndex p, PointIndex q) const {
    if (p == q) return std::strong_ordering::equal;
    const Enclosure a = enclosure(p), b = enclosure(q);
    for (unsigned k = 0; k < 3; ++k) {
        if (a.high[k] < b.low[k]) return std::strong_ordering::less;
        if (a.low[k] > b.high[k]) return std::strong_ordering::greater;
        if (a.low[k] == a.high[k] && b.low[k] == b.high[k]) continue; // the same double
        ++predicate_counts().exact;
        const ExactPoint e = exact(p), f = exact(q);
        const auto d = polynomial::difference(e, f);
        for (const Exact* c : {&d.x, &d.y, &d.z}) {
            const Sign s = exact_sign(*c);
            if (s != Sign::Zero)
                return s == Sign::Negative ? std::strong_ordering::less
                                           : std::strong_ordering::greater;
        }
        return std::strong_ordering::equal;
    }
    return std::strong_ordering::equal;
}

Sign PointStore::orient2d(Axis axis, PointIndex a, PointIndex b, PointIndex c) const {
    if (is_input(a) && is_input(b) && is_input(c))
        return terrane::orient2d(axis, input_[a], input_[b], input_[c]);
    return filtered([axis](const auto& p, const auto& q,
                           const auto& r) { return polynomial::orient2d(axis, p, q, r); },
                    a, b, c);
}

Sign PointStore::orient3d(PointIndex a, PointIndex b, PointIndex c, PointIndex d) const {
    if (is_input(a) && is_input(b) && is_input(c) && is_input(d))
        return terrane::orient3d(input_[a], input_[b], input_[c], input_[d]);
    return filtered([](const auto& p, const auto& q, const auto& r,
                       const auto& s) { return polynomial::orient3d(p, q, r, s); },
                    a, b, c, d);
}

Sign PointStore::in_circle(Axis axis, PointIndex a, PointIndex b, PointIndex c,
                           PointIndex d) const {
    if (is_input(a) && is_input(b) && is_input(c) && is_input(d))
        return terrane::in_circle(axis, input_[a], input_[b], input_[c], input_[d]);
    return filtered([axis](const auto& p, const auto& q, const auto& r,
                           const auto& s) { return polynomial::in_circle(axis, p, q, r, s); },
                    a, b, c, d);
}

Point3 nearest(std::span<const Point3> input, const Construction& how) {
    if (how.kind == Construction::Kind::input) return input[how.v[0]];
    return round(construct_exactly(input, how));
}

Sign PointStore::side_of_plane(PointIndex a, PointIndex b, PointIndex c, PointIndex p) const {
    return orient3d(a, b, c, p);
}

} // namespace terrane
