# SPDX-License-Identifier: Apache-2.0
# expect: ATT_010_length
# witness: qw_ = 1, qx_ = 0, qy_ = 0, qz_ = 0, hx_ = 0x1p-4, hy_ = 0, hz_ = 0
#
# The length is not led back.
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
r rnd= 1.0 - 0.0 * n;
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
