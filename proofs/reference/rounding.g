# goals: 2
#
# What rounding does to the stretch at the end of a stick (requirement REF-003), and to the square
# of an angle or a velocity that is rounded off (REF-010), in units of its limit squared.
#
# The end: 1 / (1 - d) is rounded (e1), its product with KEEL_REFERENCE_REACH (e2); 1 - d is a float
# as rounded. By less than 2^-22, so that the product with it is at least 1, and so is what that is
# rounded to.
end = (1 + e1) * (1 + e2) * (1 + 0x1p-22);
REF_003_end = end - (1 + 0x1p-22);
# The disc: t2 is the square of the deflection across; that square (a), its product with k (b), the
# difference from 1 (c), the product with the deflection (m) and with the limit (p) are rounded.
k = 4913933 * 0x1p-24;
t2 = (1 + z) / 2;
g = (1 + c) * (1 + m) * (1 + p) - 1;
h = (1 + a) * (1 + b) - 1;
f = 1 - k * t2;
f1 = (1 - k * t2 * (1 + h)) * (1 + g);
REF_010_square = f1 * f1 - f * f;
{ |z| <= 0x1p+0 /\ |a| <= 0x1p-24 /\ |b| <= 0x1p-24 /\ |c| <= 0x1p-24 /\ |m| <= 0x1p-24 /\
  |p| <= 0x1p-24 /\ |e1| <= 0x1p-24 /\ |e2| <= 0x1p-24
  -> |REF_003_end| <= 0x2.0001p-24 /\ |REF_010_square| <= 0x8.0p-24 }
REF_010_square -> (f * g - k * t2 * h * (1 + g)) * (f1 + f);
