# SPDX-License-Identifier: Apache-2.0
# expect: CAS_011_left
#
# Two of the roundings alone may come to more.
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
  -> |CAS_011_left| <= 0x1p-9 /\ |CAS_011_square| <= 0x1p-5 }
