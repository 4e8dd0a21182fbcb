# expect: REF_010_square
# witness: z = -1, a = 0, b = 0, c = 0x1p-24, m = 0x1p-24, p = 0x1p-24
#
# Half of what the roundings amount to.
k = 4913933 * 0x1p-24;
t2 = (1 + z) / 2;
g = (1 + c) * (1 + m) * (1 + p) - 1;
h = (1 + a) * (1 + b) - 1;
f = 1 - k * t2;
f1 = (1 - k * t2 * (1 + h)) * (1 + g);
REF_010_square = f1 * f1 - f * f;
{ |z| <= 0x1p+0 /\ |a| <= 0x1p-24 /\ |b| <= 0x1p-24 /\ |c| <= 0x1p-24 /\ |m| <= 0x1p-24 /\
  |p| <= 0x1p-24
  -> |REF_010_square| <= 0x4.0p-24 }
REF_010_square -> (f * g - k * t2 * h * (1 + g)) * (f1 + f);
