// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/kernel/point_store.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include <terrane/kernel/double_double.hpp>
#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

using polynomial::cartesian;
using polynomial::One;
using TwofoldPoint = polynomial::Coordinates<DoubleDouble, One>;

/// Per constructed point: its coordinates in DoubleDouble, and a slot for the exact ones, filled
/// once by the first thread that needs them.
struct PointStore::Cache {
    std::vector<TwofoldPoint> twofold;
    std::vector<std::atomic<const ExactPoint*>> slots;

    explicit Cache(std::size_t n) : twofold(n), slots(n) {}
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
    input_(other.input_), constructed_(other.constructed_), rounded_(other.rounded_),
    cache_(std::make_unique<Cache>(constructed_.size())) {
    if (other.cache_) cache_->twofold = other.cache_->twofold;
}

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

void PointStore::exchange(PointIndex p, PointIndex q) {
    const std::size_t i = p - input_.size(), j = q - input_.size();
    std::swap(constructed_[i], constructed_[j]);
    std::swap(rounded_[i], rounded_[j]);
    std::swap(cache_->twofold[i], cache_->twofold[j]);
    cache_->slots[i].store(cache_->slots[j].exchange(cache_->slots[i].load()));
}

void PointStore::keep_constructed(std::span<const PointIndex> kept) {
    auto cache = std::make_unique<Cache>(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const std::size_t from = kept[k] - input_.size();
        constructed_[k] = constructed_[from];
        rounded_[k] = rounded_[from];
        cache->twofold[k] = cache_->twofold[from];
        cache->slots[k].store(cache_->slots[from].exchange(nullptr));
    }
    constructed_.resize(kept.size());
    rounded_.resize(kept.size());
    cache_ = std::move(cache);
}

namespace {

/// Returns the next larger double; infinity stays infinity.
double above(double d) {
    if (d == std::numeric_limits<double>::infinity()) return d;
    const auto bits = std::bit_cast<std::int64_t>(d + 0.0); // -0 is 0
    return std::bit_cast<double>(d >= 0 ? bits + 1 : bits - 1);
}
double below(double d) {
    return -above(-d);
}

/// Returns an upper bound of half the distance between doubles of this size, and so of the error of
/// rounding to nearest.
double half_step(double d) {
    constexpr double least = std::numeric_limits<double>::denorm_min();
    return std::fabs(d) * 0x1p-53 + least;
}

// Adding 0.0 turns -0 into 0, which keeps "-0" out of files.
Point3 round_exactly(const ExactPoint& p) {
    const auto quotient = [&](const Exact& x) { return nearest_quotient(x, p.w) + 0.0; };
    return {quotient(p.x), quotient(p.y), quotient(p.z)};
}

/// Computes the point in DoubleDouble. The caller holds the default rounding mode.
TwofoldPoint twofold_point(std::span<const Point3> input, const Construction& how) {
    const auto at = [&](std::uint32_t v) -> const Point3& { return input[v]; };
    const Point3& base = input[how.v[0]];
    const auto from_base = [&](const DoubleDouble& x, const DoubleDouble& y,
                               const DoubleDouble& z) {
        return TwofoldPoint{DoubleDouble(base.x) + x, DoubleDouble(base.y) + y,
                            DoubleDouble(base.z) + z, One{}};
    };
    if (!polynomial::is_on_line(how)) {
        const auto h = polynomial::construct<DoubleDouble>(how, at);
        return from_base(h.x / h.w, h.y / h.w, h.z / h.w);
    }
    const auto [d, t, w] = polynomial::construct_on_line<DoubleDouble>(how, at);
    const DoubleDouble share = t / w; // one division instead of three
    const auto p = from_base(d.x * share, d.y * share, d.z * share);
    const auto is_settled = [](const DoubleDouble& x) {
        return x.is_double() || !x.may_be_double();
    };
    if (is_settled(p.x) && is_settled(p.y) && is_settled(p.z)) return p;
    // Dividing last may show that a coordinate is a double.
    return from_base(d.x * t / w, d.y * t / w, d.z * t / w);
}

/// Makes the weight positive and the coordinates absolute.
template <class N>
polynomial::Coordinates<N, N> on_base(polynomial::Homogeneous<N> h, bool is_negative,
                                      const Point3& base) {
    if (is_negative) h = {-h.x, -h.y, -h.z, -h.w};
    return {h.x + N(base.x) * h.w, h.y + N(base.y) * h.w, h.z + N(base.z) * h.w, h.w};
}

using TwofoldHomogeneous = polynomial::Coordinates<DoubleDouble, DoubleDouble>;

/// Computes homogeneous coordinates in DoubleDouble. The caller holds the default rounding mode.
TwofoldHomogeneous twofold_homogeneous(std::span<const Point3> input, const Construction& how) {
    const auto at = [&](std::uint32_t v) -> const Point3& { return input[v]; };
    const auto h = polynomial::construct<DoubleDouble>(how, at);
    return on_base(h, h.w.value() < 0, input[how.v[0]]);
}

Exact exact_sum(const DoubleDouble& d) {
    return d.low() == 0 ? Exact(d.value()) : Exact(d.value()) + Exact(d.low());
}

bool has_few_bits(const Point3& p) {
    const auto is_short = [](double d) { return static_cast<double>(static_cast<float>(d)) == d; };
    return is_short(p.x) && is_short(p.y) && is_short(p.z);
}

/// Returns the point if DoubleDouble holds its coordinates exactly: input coordinates of few bits
/// are common in degenerate models, and long numbers slow. Others are not tried.
std::optional<ExactPoint> construct_in_doubles(std::span<const Point3> input,
                                               const Construction& how) {
    const std::span used(how.v.begin(), polynomial::is_on_line(how) ? 2 : how.v.size());
    if (!std::all_of(used.begin(), used.end(),
                     [&](std::uint32_t v) { return has_few_bits(input[v]); }))
        return std::nullopt;
    const ToNearest mode;
    const auto h = in_twofold([&] { return twofold_homogeneous(input, how); });
    if (!h.x.is_exact() || !h.y.is_exact() || !h.z.is_exact() || !h.w.is_exact())
        return std::nullopt;
    return ExactPoint{exact_sum(h.x), exact_sum(h.y), exact_sum(h.z), exact_sum(h.w)};
}

ExactPoint construct_exactly(std::span<const Point3> input, const Construction& how) {
    if (auto quick = construct_in_doubles(input, how)) return *std::move(quick);
    const auto at = [&](std::uint32_t v) -> const Point3& { return input[v]; };
    const auto h = polynomial::construct<Exact>(how, at);
    return on_base(h, exact_sign(h.w) == Sign::Negative, input[how.v[0]]);
}

} // namespace

void PointStore::append(std::span<const Construction> constructions, const Share& share) {
    const std::size_t before = constructed_.size();
    constructed_.insert(constructed_.end(), constructions.begin(), constructions.end());
    rounded_.resize(constructed_.size());
    auto grown = std::make_unique<Cache>(constructed_.size());
    const auto round_all = [&](std::size_t first, std::size_t last) {
        const ToNearest mode;
        for (std::size_t k = before + first; k < before + last; ++k) {
            grown->twofold[k] = in_twofold([&] { return twofold_point(input_, constructed_[k]); });
            rounded_[k] = round(k, *grown);
        }
    };
    if (share)
        share(constructions.size(), round_all);
    else
        round_all(0, constructions.size());
    for (std::size_t k = 0; k < before; ++k) {
        grown->twofold[k] = cache_->twofold[k];
        grown->slots[k].store(cache_->slots[k].exchange(nullptr));
    }
    cache_ = std::move(grown);
}

/// Rounds a constructed point, in most cases the number of about 106 bits that the cache has.
PointStore::Rounded PointStore::round(std::size_t k, const Cache& cache) const {
    const auto& p = cache.twofold[k];
    const auto x = p.x.nearest(), y = p.y.nearest(), z = p.z.nearest();
    if (x && y && z) return {{*x, *y, *z}, {p.x.is_double(), p.y.is_double(), p.z.is_double()}};
    return {round_exactly(make_exact(constructed_[k])), {false, false, false}};
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

Enclosure PointStore::enclosure(PointIndex p) const {
    const Point3& q = nearest(p);
    const std::array x{q.x, q.y, q.z};
    if (is_input(p)) return {x, x};
    const auto& is_exact = rounded_[p - input_.size()].is_exact;
    Enclosure e{x, x};
    for (unsigned k = 0; k < 3; ++k)
        if (!is_exact[k]) {
            e.low[k] = below(x[k]);
            e.high[k] = above(x[k]);
        }
    return e;
}

std::array<double, 3> PointStore::rounding_errors(PointIndex p) const {
    if (is_input(p)) return {0, 0, 0};
    const auto& [n, is_exact] = rounded_[p - input_.size()];
    return {is_exact[0] ? 0 : half_step(n.x), is_exact[1] ? 0 : half_step(n.y),
            is_exact[2] ? 0 : half_step(n.z)};
}

ApproximatePoint PointStore::approximate(Axis axis, PointIndex p) const {
    const auto k = static_cast<unsigned>(axis);
    const unsigned u = (k + 1) % 3, v = (k + 2) % 3;
    const Point3& n = nearest(p);
    const std::array x{n.x, n.y, n.z};
    const auto errors = rounding_errors(p);
    return {x[u], x[v], std::max(errors[u], errors[v])};
}

PointStore::IntervalPoint PointStore::interval(PointIndex p) const {
    if (is_input(p)) return cartesian<Interval>(input_[p]);
    const Enclosure e = enclosure(p);
#ifdef TERRANE_SHADOW
    const ExactPoint exactly = exact(p);
    const auto twin = [&](const Exact& x) { return shadow::Twin(x, exactly.w); };
    return {Interval(e.low[0], e.high[0], twin(exactly.x)),
            Interval(e.low[1], e.high[1], twin(exactly.y)),
            Interval(e.low[2], e.high[2], twin(exactly.z)), One{}};
#else
    return {Interval(e.low[0], e.high[0]), Interval(e.low[1], e.high[1]),
            Interval(e.low[2], e.high[2]), One{}};
#endif
}

namespace {

// Intervals decide little that a filter of ball_filter.hpp has left, but for zeros of points that are
// doubles: callers of the predicates in a projection try these.
struct Orient2d {
    Axis axis;
    static constexpr bool tries_intervals = false;
    template <class P, class Q, class R>
    auto operator()(const P& p, const Q& q, const R& r) const {
        return polynomial::orient2d(axis, p, q, r);
    }
};
struct InCircle {
    Axis axis;
    static constexpr bool tries_intervals = false;
    template <class P, class Q, class R, class S>
    auto operator()(const P& p, const Q& q, const R& r, const S& s) const {
        return polynomial::in_circle(axis, p, q, r, s);
    }
};
struct Orient3d {
    static constexpr bool tries_intervals = true;
    template <class P, class Q, class R, class S>
    auto operator()(const P& p, const Q& q, const R& r, const S& s) const {
        return polynomial::orient3d(p, q, r, s);
    }
};

} // namespace

template <class Polynomial, class... P>
Sign PointStore::filtered(UpwardWitness upward, const Polynomial& polynomial, P... points) const {
    const auto is_exact = [&](PointIndex p) {
        return is_double(p, 0) && is_double(p, 1) && is_double(p, 2);
    };
    if (Polynomial::tries_intervals || (is_exact(points) && ...))
        if (const auto sign = certain_sign(upward, polynomial(interval(points)...))) {
            ++predicate_counts().interval;
            return *sign;
        }
    const auto twofold = [&](PointIndex p) {
        return is_input(p) ? cartesian<DoubleDouble>(input_[p])
                           : cache_->twofold[p - input_.size()];
    };
    {
        const ToNearest mode;
        if (const auto sign = in_twofold([&] { return polynomial(twofold(points)...).sign(); })) {
            ++predicate_counts().interval;
            return *sign;
        }
    }
    ++predicate_counts().exact;
    return exact_sign(polynomial(exact(points)...));
}

// Rounding to nearest is monotone: if the nearest doubles differ, the coordinates differ likewise.
std::strong_ordering PointStore::compare(unsigned k, PointIndex p, PointIndex q) const {
    constexpr std::array in_double{&Point3::x, &Point3::y, &Point3::z};
    constexpr std::array in_exact{&ExactPoint::x, &ExactPoint::y, &ExactPoint::z};
    const double x = nearest(p).*in_double[k], y = nearest(q).*in_double[k];
    if (x < y) return std::strong_ordering::less;
    if (x > y) return std::strong_ordering::greater;
    if (p == q || (is_double(p, k) && is_double(q, k))) return std::strong_ordering::equal;
    ++predicate_counts().exact;
    const auto side_of = [&](double d, PointIndex point) { // the sign of the coordinate - d
        const ExactPoint& e = cached_exact(point - input_.size());
        return exact_sign(e.*in_exact[k] - Exact(d) * e.w);
    };
    const auto of_difference = [&] {
        if (is_double(q, k)) return side_of(y, p);
        if (is_double(p, k)) return -side_of(x, q);
        const ExactPoint& e = cached_exact(p - input_.size());
        const ExactPoint& f = cached_exact(q - input_.size());
        return exact_sign(e.*in_exact[k] * f.w - f.*in_exact[k] * e.w);
    };
    return static_cast<int>(of_difference()) <=> 0;
}

std::strong_ordering PointStore::compare(PointIndex p, PointIndex q) const {
    for (unsigned k = 0; k < 3; ++k)
        if (const auto order = compare(k, p, q); order != 0) return order;
    return std::strong_ordering::equal;
}

bool PointStore::equal(PointIndex p, PointIndex q) const {
    return nearest(p) == nearest(q) && compare(p, q) == 0;
}

Sign PointStore::orient2d(UpwardWitness upward, Axis axis, PointIndex a, PointIndex b,
                          PointIndex c) const {
    if (is_input(a) && is_input(b) && is_input(c))
        return terrane::orient2d(axis, input_[a], input_[b], input_[c]);
    return filtered(upward, Orient2d{axis}, a, b, c);
}

Sign PointStore::orient3d(UpwardWitness upward, PointIndex a, PointIndex b, PointIndex c,
                          PointIndex d) const {
    if (is_input(a) && is_input(b) && is_input(c) && is_input(d))
        return terrane::orient3d(input_[a], input_[b], input_[c], input_[d]);
    return filtered(upward, Orient3d{}, a, b, c, d);
}

Sign PointStore::in_circle(UpwardWitness upward, Axis axis, PointIndex a, PointIndex b,
                           PointIndex c, PointIndex d) const {
    if (is_input(a) && is_input(b) && is_input(c) && is_input(d))
        return terrane::in_circle(axis, input_[a], input_[b], input_[c], input_[d]);
    return filtered(upward, InCircle{axis}, a, b, c, d);
}

Point3 nearest(std::span<const Point3> input, const Construction& how) {
    if (how.kind == Construction::Kind::input) return input[how.v[0]];
    return round_exactly(construct_exactly(input, how));
}

Sign PointStore::side_of_plane(UpwardWitness upward, PointIndex a, PointIndex b, PointIndex c,
                               PointIndex p) const {
    return orient3d(upward, a, b, c, p);
}

} // namespace terrane
