// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/kernel/fraction.hpp>

#include <gmpxx.h>

namespace terrane {
namespace {

mpq_class rational(const Exact& number) {
    mpq_class q;
    number.export_to_mpq_t(q.get_mpq_t());
    return q;
}

} // namespace

std::string fraction(const Exact& numerator, const Exact& denominator, int base) {
    return mpq_class(rational(numerator) / rational(denominator)).get_str(base);
}

std::array<std::string, 3> fractions(const PointStore& points, PointIndex p, int base) {
    const ExactPoint e = points.exact(p);
    return {fraction(e.x, e.w, base), fraction(e.y, e.w, base), fraction(e.z, e.w, base)};
}

} // namespace terrane
