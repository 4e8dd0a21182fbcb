# SPDX-License-Identifier: Apache-2.0
# goals: 2
#
# The length of the quaternion (ATT-010): one step from any that keel_attitude_is_unit takes for one.
# The step is that of `turned_quaternion` in src/flight/attitude.c, operation by operation in single
# precision; `rnd=` rounds each of them to nearest, ties to even. tests/tools/test_attitude_norm.py
# compares the two texts. Hypotheses: G is what keel_attitude_is_unit computes of |q|^2, less 1, and is within 2^-12;
# each component is within 1 + 2^-10, as follows (keel_attitude_is_unit__finite_harness); each half
# angle is within 2^-4, to which the code clamps it. Goals: ATT_010_length, |p|^2 - 1 + 2^-14 is within
# 1.125 2^-14, which is |p|^2 from 1 - 1.30e-4 to 1 + 7.63e-6; and ATT_010_guard, the same as
# computed is within 2^-12, so that no step takes its own quaternion for a corrupted one.
#
# In exact arithmetic q (0, h) is orthogonal to q, |p|^2 = 1 + X with X = D + S + D S, and Newton's
# step leads to 1 - 3/4 X^2 + X^3/4: two of the hints, which are identities; the third is D = G less
# what rounding does to |q|^2.
@rnd = float<ieee_32, ne>;
qw = rnd(qw_);
qx = rnd(qx_);
qy = rnd(qy_);
qz = rnd(qz_);
hx = rnd(hx_);
hy = rnd(hy_);
hz = rnd(hz_);
g rnd= (qw * qw + qx * qx) + (qy * qy + qz * qz);
w rnd= qw - ((qx * hx + qy * hy) + qz * hz);
x rnd= qx + ((qw * hx + qy * hz) - qz * hy);
y rnd= qy + ((qw * hy - qx * hz) + qz * hx);
z rnd= qz + ((qw * hz + qx * hy) - qy * hx);
n rnd= (w * w + x * x) + (y * y + z * z);
r rnd= 1.5 - 0.5 * n;
pw rnd= w * r;
px rnd= x * r;
py rnd= y * r;
pz rnd= z * r;
u rnd= (pw * pw + px * px) + (py * py + pz * pz);
Mw = qw - ((qx * hx + qy * hy) + qz * hz);
Mx = qx + ((qw * hx + qy * hz) - qz * hy);
My = qy + ((qw * hy - qx * hz) + qz * hx);
Mz = qz + ((qw * hz + qx * hy) - qy * hx);
D = ((qw * qw + qx * qx) + (qy * qy + qz * qz)) - 1;
S = (hx * hx + hy * hy) + hz * hz;
M = (Mw * Mw + Mx * Mx) + (My * My + Mz * Mz);
X = D + S + D * S;
R = 1.5 - 0.5 * M;
O = (pw * pw + px * px) + (py * py + pz * pz);
P = ((Mw * R) * (Mw * R) + (Mx * R) * (Mx * R)) + ((My * R) * (My * R) + (Mz * R) * (Mz * R));
G = g - 1;
Q = (qw * qw + qx * qx) + (qy * qy + qz * qz);
ATT_010_length = (O - 1) + 0x1p-14;
ATT_010_guard = u - 1;
{ |qw| <= 0x1.004p+0 /\ |qx| <= 0x1.004p+0 /\ |qy| <= 0x1.004p+0 /\ |qz| <= 0x1.004p+0
  /\ |hx| <= 0x1p-4 /\ |hy| <= 0x1p-4 /\ |hz| <= 0x1p-4 /\ |G| <= 0x1p-12
  -> |ATT_010_length| <= 0x1.2p-14 /\ |ATT_010_guard| <= 0x1p-12 }
M -> 1 + X;
P - 1 -> X * X * (0.25 * X - 0.75);
D -> G - (g - Q);
