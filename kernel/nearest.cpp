// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/kernel/nearest.hpp>

#include <gmp.h>
#include <mpfr.h>

namespace terrane {
namespace {

// Owner of a GMP integer.
struct Integer {
    mpz_t z;
    Integer() { mpz_init(z); }
    ~Integer() { mpz_clear(z); }
    Integer(const Integer&) = delete;
    Integer& operator=(const Integer&) = delete;
};

// Owner of a GMP fraction. Exact numbers are dyadic: numerator / 2^k.
struct Rational {
    mpq_t q;
    Rational() { mpq_init(q); }
    explicit Rational(const Exact& e) : Rational() { // if the body throws, the destructor runs
        e.export_to_mpq_t(q);
    }
    ~Rational() { mpq_clear(q); }
    Rational(const Rational&) = delete;
    Rational& operator=(const Rational&) = delete;
};

/// Sets MPFR's range of exponents in this thread; the destructor restores the previous range.
class ExponentRange {
public:
    ExponentRange(mpfr_exp_t low, mpfr_exp_t high) {
        mpfr_set_emin(low);
        mpfr_set_emax(high);
    }
    ~ExponentRange() {
        mpfr_set_emin(low_);
        mpfr_set_emax(high_);
    }
    ExponentRange(const ExponentRange&) = delete;
    ExponentRange& operator=(const ExponentRange&) = delete;

private:
    mpfr_exp_t low_ = mpfr_get_emin(), high_ = mpfr_get_emax();
};

struct Float {
    mpfr_t f;
    explicit Float(mpfr_prec_t bits) { mpfr_init2(f, bits); }
    ~Float() { mpfr_clear(f); }
    Float(const Float&) = delete;
    Float& operator=(const Float&) = delete;
};

// MPFR rounds quotient * 2^exponent to 53 bits within the exponent range of double.
double round_to_double(const Integer& quotient, bool inexact, mpfr_exp_t exponent) {
    // The quotient has at least 64 bits, so its lowest bit can stand for a remainder.
    Integer sticky;
    mpz_set(sticky.z, quotient.z);
    if (inexact) mpz_setbit(sticky.z, 0);
    const ExponentRange of_double(-1073, 1024);
    Float rounded(53);
    int ternary = mpfr_set_z_2exp(rounded.f, sticky.z, exponent, MPFR_RNDN);
    ternary = mpfr_check_range(rounded.f, ternary, MPFR_RNDN);
    mpfr_subnormalize(rounded.f, ternary, MPFR_RNDN);
    return mpfr_get_d(rounded.f, MPFR_RNDN);
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
    // The shift gives the integer quotient at least 67 bits, more than round_to_double needs.
    const long shift = 67 - (bits(n) - bits(d));
    if (shift > 0) mpz_mul_2exp(n.z, n.z, static_cast<mp_bitcnt_t>(shift));
    if (shift < 0) mpz_mul_2exp(d.z, d.z, static_cast<mp_bitcnt_t>(-shift));
    Integer quotient, rest;
    mpz_tdiv_qr(quotient.z, rest.z, n.z, d.z);
    const double result = round_to_double(quotient, mpz_sgn(rest.z) != 0, -shift);
    return negative ? -result : result;
}

} // namespace terrane
