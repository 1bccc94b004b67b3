// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Prints the constants of filters, of numbers with running bounds, of searches and of the proof of
// separation, as they are compiled: a name and a number in Gappa's notation on each line. gappa_bounds.py puts them into the proofs
// of kernel/proofs.
#include <terrane/algorithms/rounding/detail/separation_bounds.hpp>
#include <terrane/algorithms/search/detail/stars.hpp>
#include <terrane/algorithms/search/methods.hpp>
#include <terrane/algorithms/tetrahedra/allowance.hpp>
#include <terrane/kernel/ball_filter.hpp>
#include <terrane/kernel/double_double.hpp>
#include <terrane/kernel/separation_filter.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

#include <cmath>
#include <cstdint>
#include <iostream>

namespace {

void print(const char* name, double value) {
    int exponent = 0;
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    exponent -= 53;
    for (; mantissa != 0 && mantissa % 2 == 0; mantissa /= 2) ++exponent;
    std::cout << name << ' ' << mantissa << 'b' << exponent << '\n';
}

/// 2^-1074 divided by the least product of `degree` sizes.
double underflow(const terrane::static_filter::Range& range, int degree) {
    return std::ldexp(1, -1074 - degree * std::ilogb(range.low));
}

void print_range(const char* low, const char* high, const terrane::static_filter::Range& range) {
    print(low, range.low);
    print(high, range.high);
}

} // namespace

int main() {
    using namespace terrane::static_filter;
    namespace ball = terrane::ball_filter;
    using terrane::SeparationFilter;
    static_assert(unit == 0x1p-52); // the proofs write it so
    print("turn2d_factor", turn2d_factor);
    print("orient3d_factor", orient3d_factor);
    print("in_circle_factor", in_circle_factor);
    print("projection_axis_factor", projection_axis_factor);
    print("normal_error_factor", normal_error_factor);
    print_range("low_of_degree2", "high_of_degree2", range_of_degree2);
    print_range("low_of_degree3", "high_of_degree3", range_of_degree3);
    print_range("low_of_degree4", "high_of_degree4", range_of_degree4);
    print("underflow_of_degree2", underflow(range_of_degree2, 2));
    print("underflow_of_degree3", underflow(range_of_degree3, 3));
    print("underflow_of_degree4", underflow(range_of_degree4, 4));
    print("smallest_normal_error", smallest_normal_error);
    // E is compared with a size that has been rounded.
    print("ball_turn2d_widest_rounded", ball::turn2d_widest * (1 + 0x1p-40));
    print("ball_in_circle_widest_rounded", ball::in_circle_widest * (1 + 0x1p-40));
    print("ball_turn2d_radius_factor", ball::turn2d_radius_factor);
    print("ball_in_circle_radius_factor", ball::in_circle_radius_factor);
    print("ball_in_circle_rounding_factor", ball::in_circle_rounding_factor);
    print("ball_terms_factor", ball::terms_factor);
    print("ball_slopes_factor", ball::slopes_factor);
    print("ball_second_order_factor", ball::second_order_factor);
    print("ball_smallest", ball::smallest);
    print("separation_share", SeparationFilter::share);
    print("separation_least_distance", SeparationFilter::least_distance);
    namespace lemma = terrane::rounding::detail;
    print("lemma_direction_factor", lemma::direction_factor);
    print("lemma_altitude_factor", lemma::altitude_factor);
    print("lemma_size_share", lemma::size_share);
    print("lemma_margin_factor", lemma::margin_factor);
    print("lemma_rise_factor", lemma::rise_factor);
    print("lemma_condition_factor", lemma::condition_factor);
    print("lemma_least_sine_factor", lemma::least_sine_factor);
    print("lemma_least_edge_sine", lemma::least_edge_sine);
    print("frame_error_factor", lemma::frame_error_factor);
    print("twofold_sum_factor", terrane::twofold::sum_factor);
    print("twofold_product_factor", terrane::twofold::product_factor);
    print("twofold_renormalised", terrane::twofold::renormalised);
    print("twofold_divisor_factor", terrane::twofold::divisor_factor);
    print("twofold_quotient_factor", terrane::twofold::quotient_factor);
    print("twofold_size_factor", terrane::twofold::size_factor);
    print("star_across_error", terrane::search::across_error);
    print("star_arc_error", terrane::search::arc_error);
    print("star_least_middle", terrane::search::least_middle);
    print("grid_width_share", terrane::search::grid_width_share);
    print("grid_size_share", terrane::search::grid_size_share);
    print("allowance_room", terrane::tetrahedra::rounding_room);
    return std::cout.flush() ? 0 : 1;
}
