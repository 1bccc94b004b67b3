# SPDX-License-Identifier: LGPL-3.0-or-later
#
# (4) of kernel/static_filter_bounds.hpp: within the ranges, the computed bounds are normal numbers
# and nothing overflows.
#
# What underflow takes from a product is below 2^-1074. Divided by the product of the least sizes it
# is underflow_of_degree2, 3, 4, which the other files add to each product.
# In the second bound of filtered_in_circle() fewer than 2^10 products underflow. Each is multiplied by
# at most M^2 or 1 afterwards, so that smallest (1 + M^2) covers them. Those of Plane::normal_error()
# are fewer.

low2 = @low_of_degree2@;  low3 = @low_of_degree3@;  low4 = @low_of_degree4@;
high2 = @high_of_degree2@;  high3 = @high_of_degree3@;  high4 = @high_of_degree4@;

bound2 = @turn2d_factor@ * 1b-52 * low2 * low2;
bound3 = @orient3d_factor@ * 1b-52 * low3 * low3 * low3;
bound4 = @in_circle_factor@ * 1b-52 * low4 * low4 * low4 * low4;
most2 = 8 * high2 * high2;
most3 = 32 * high3 * high3 * high3;
most4 = 128 * high4 * high4 * high4 * high4;
underflow2 = @underflow_of_degree2@ * low2 * low2;
underflow3 = @underflow_of_degree3@ * low3 * low3 * low3;
underflow4 = @underflow_of_degree4@ * low4 * low4 * low4 * low4;
hidden = @ball_smallest@ * 1b-10;
hidden_by_normal = @smallest_normal_error@ * 1b-9;

{ bound2 >= 1b-1021 /\ bound3 >= 1b-1021 /\ bound4 >= 1b-1021 /\
  most2 <= 1b1023 /\ most3 <= 1b1023 /\ most4 <= 1b1023 /\
  underflow2 >= 1b-1074 /\ underflow3 >= 1b-1074 /\ underflow4 >= 1b-1074 /\
  hidden >= 1b-1074 /\ hidden_by_normal >= 1b-1074 }
