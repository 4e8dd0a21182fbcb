# SPDX-License-Identifier: Apache-2.0
# goals: 2
#
# What rounding does to the fence's test (CAS-011), operation by operation as in `is_side_near` and
# `near_sides` of src/flight/cascade.c and in keel_cascade_init, in single precision; `rnd=` rounds
# each operation to nearest, ties to even. tests/tools/test_cascade_fence.py compares the texts. L is
# the reach, x the position and v the speed towards a side, A, T and twice_braking those of the
# configuration. Goals: CAS_011_left, by how much L - x' as computed is off, in m; CAS_011_square, by
# how much (v + A T)^2 is, in m^2/s^2. The product of the former with twice_braking is off by 2^-24
# of itself.
@rnd = float<ieee_32, ne>;
L = rnd(L_);
x = rnd(x_);
v = rnd(v_);
A = rnd(A_);
T = rnd(T_);
gain rnd= A * T;
half rnd= 0.5 * gain;
left rnd= (L - x) - T * (v + half);
fastest rnd= v + gain;
square rnd= fastest * fastest;
CAS_011_left = left - ((L - x) - T * (v + 0.5 * (A * T)));
CAS_011_square = square - (v + A * T) * (v + A * T);
{ |L| <= 0x1p+14 /\ |x| <= 0x1p+14 /\ |v| <= 0x1p+7 /\ |A| <= 0x1p+6 /\ |T| <= 0x1p+2
  -> |CAS_011_left| <= 0x1p-8 /\ |CAS_011_square| <= 0x1p-5 }
