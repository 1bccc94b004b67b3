# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Plane::Determinant::estimate() of kernel/static_filter_bounds.hpp, derivation (2); PlaneFilter of
# kernel/plane_filter.hpp uses the same.
#
# The differences along each axis are divided by the largest one; x, y, z are the computed sizes.
# least: orient3d_factor 46.0001

bx = sub_rel<52>(b_x, a_x);  Bx = b_x - a_x;
by = sub_rel<52>(b_y, a_y);  By = b_y - a_y;
bz = sub_rel<52>(b_z, a_z);  Bz = b_z - a_z;
cx = sub_rel<52>(c_x, a_x);  Cx = c_x - a_x;
cy = sub_rel<52>(c_y, a_y);  Cy = c_y - a_y;
cz = sub_rel<52>(c_z, a_z);  Cz = c_z - a_z;
dx = sub_rel<52>(p_x, a_x);  Dx = p_x - a_x;
dy = sub_rel<52>(p_y, a_y);  Dy = p_y - a_y;
dz = sub_rel<52>(p_z, a_z);  Dz = p_z - a_z;

yz = mul_rel<52>(by, cz) + h1;  zy = mul_rel<52>(bz, cy) + h2;
nx = sub_rel<52>(yz, zy);  Nx = By * Cz - Bz * Cy;
zx = mul_rel<52>(bz, cx) + h3;  xz = mul_rel<52>(bx, cz) + h4;
ny = sub_rel<52>(zx, xz);  Ny = Bz * Cx - Bx * Cz;
xy = mul_rel<52>(bx, cy) + h5;  yx = mul_rel<52>(by, cx) + h6;
nz = sub_rel<52>(xy, yx);  Nz = Bx * Cy - By * Cx;

px = mul_rel<52>(nx, dx) + g1;  py = mul_rel<52>(ny, dy) + g2;  pz = mul_rel<52>(nz, dz) + g3;
pxy = add_rel<52>(px, py);
value = add_rel<52>(pxy, pz);
exact = Nx * Dx + Ny * Dy + Nz * Dz;
bound = mul_rel<52>(mul_rel<52>(mul_rel<52>(@orient3d_factor@ * 1b-52, x), y), z);

{ |Bx| <= 1 /\ |By| <= 1 /\ |Bz| <= 1 /\ |Cx| <= 1 /\ |Cy| <= 1 /\ |Cz| <= 1 /\
  |Dx| <= 1 /\ |Dy| <= 1 /\ |Dz| <= 1 /\
  |h1| <= @underflow_of_degree3@ /\ |h2| <= @underflow_of_degree3@ /\
  |h3| <= @underflow_of_degree3@ /\ |h4| <= @underflow_of_degree3@ /\
  |h5| <= @underflow_of_degree3@ /\ |h6| <= @underflow_of_degree3@ /\
  |g1| <= @underflow_of_degree3@ /\ |g2| <= @underflow_of_degree3@ /\
  |g3| <= @underflow_of_degree3@ /\
  |x - 1| <= 1b-52 /\ |y - 1| <= 1b-52 /\ |z - 1| <= 1b-52
  -> |value - exact| - bound <= 0 }

yz - By * Cz -> (mul_rel<52>(by, cz) - By * Cz) + h1;
zy - Bz * Cy -> (mul_rel<52>(bz, cy) - Bz * Cy) + h2;
nx - Nx -> (nx - (yz - zy)) + ((yz - By * Cz) - (zy - Bz * Cy));
zx - Bz * Cx -> (mul_rel<52>(bz, cx) - Bz * Cx) + h3;
xz - Bx * Cz -> (mul_rel<52>(bx, cz) - Bx * Cz) + h4;
ny - Ny -> (ny - (zx - xz)) + ((zx - Bz * Cx) - (xz - Bx * Cz));
xy - Bx * Cy -> (mul_rel<52>(bx, cy) - Bx * Cy) + h5;
yx - By * Cx -> (mul_rel<52>(by, cx) - By * Cx) + h6;
nz - Nz -> (nz - (xy - yx)) + ((xy - Bx * Cy) - (yx - By * Cx));
px - Nx * Dx -> (mul_rel<52>(nx, dx) - nx * dx) + (nx * (dx - Dx) + (nx - Nx) * Dx) + g1;
py - Ny * Dy -> (mul_rel<52>(ny, dy) - ny * dy) + (ny * (dy - Dy) + (ny - Ny) * Dy) + g2;
pz - Nz * Dz -> (mul_rel<52>(nz, dz) - nz * dz) + (nz * (dz - Dz) + (nz - Nz) * Dz) + g3;
value - exact -> (value - (pxy + pz)) + ((pxy - (px + py))
                 + ((px - Nx * Dx) + (py - Ny * Dy) + (pz - Nz * Dz)));
