# SPDX-License-Identifier: Apache-2.0
# expect: CAS_011_left
# witness: L_ = 0x1.ffa27p+13, x_ = -0x1.ff8afep+13, v_ = -0x1.d479f4p+6, A_ = 0x1.b087fep+5, T_ = 0x1.ec2696p+1
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
