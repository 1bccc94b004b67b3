// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/kernel/nearest.hpp>

#include <gmp.h>
#include <mpfr.h>

namespace terrane {
namespace {

// An integer whose life is scoped.
struct Integer {
    mpz_t z;
    Integer() { mpz_init(z); }
    ~Integer() { mpz_clear(z); }
    Integer(const Integer&) = delete;
    Integer& operator=(const Integer&) = delete;
};

// Exact numbers are dyadic: numerator / 2^k.
struct Rational {
    mpq_t q;
    explicit Rational(const Exact& e) {
        mpq_init(q);
        e.export_to_mpq_t(q);
    }
    ~Rational() { mpq_clear(q); }
    Rational(const Rational&) = delete;
    Rational& operator=(const Rational&) = delete;
};

// A double is 53 bits; MPFR rounds to these, within double's range of exponents.
double round_to_double(const Integer& quotient, bool inexact, mpfr_exp_t exponent) {
    // The quotient has at least 64 bits: a set lowest bit stands for all that was cut off.
    Integer sticky;
    mpz_set(sticky.z, quotient.z);
    if (inexact) mpz_setbit(sticky.z, 0);
    const mpfr_exp_t low = mpfr_get_emin(), high = mpfr_get_emax();
    mpfr_set_emin(-1073);
    mpfr_set_emax(1024);
    mpfr_t f;
    mpfr_init2(f, 53);
    int ternary = mpfr_set_z_2exp(f, sticky.z, exponent, MPFR_RNDN);
    ternary = mpfr_check_range(f, ternary, MPFR_RNDN);
    mpfr_subnormalize(f, ternary, MPFR_RNDN);
    const double result = mpfr_get_d(f, MPFR_RNDN);
    mpfr_clear(f);
    mpfr_set_emin(low);
    mpfr_set_emax(high);
    return result;
}

} // namespace

double nearest_quotient(const Exact& numerator, const Exact& denominator) {
    if (exact_sign(numerator) == Sign::Zero) return 0;
    const Rational above(numerator), below(denominator);
    Integer n, d;
    mpz_mul(n.z, mpq_numref(above.q), mpq_denref(below.q));
    mpz_mul(d.z, mpq_denref(above.q), mpq_numref(below.q));
    const bool negative = (mpz_sgn(n.z) < 0) != (mpz_sgn(d.z) < 0);
    mpz_abs(n.z, n.z);
    mpz_abs(d.z, d.z);
    const auto bits = [](const Integer& i) { return static_cast<long>(mpz_sizeinbase(i.z, 2)); };
    // Shift so that the integer quotient has 66 or 67 bits, its lowest one free for stickiness.
    const long shift = 67 - (bits(n) - bits(d));
    if (shift > 0) mpz_mul_2exp(n.z, n.z, static_cast<mp_bitcnt_t>(shift));
    if (shift < 0) mpz_mul_2exp(d.z, d.z, static_cast<mp_bitcnt_t>(-shift));
    Integer quotient, rest;
    mpz_tdiv_qr(quotient.z, rest.z, n.z, d.z);
    const double result = round_to_double(quotient, mpz_sgn(rest.z) != 0, -shift);
    return negative ? -result : result;
}

} // namespace terrane
