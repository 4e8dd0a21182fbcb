# The rounding of eq. 18 in single precision for N = 3 (requirement VOT-016).
#
# Each weighted sample carries the errors of its product and of at most two additions (the first
# addition, to 0, is exact), the sum of the weights those of two additions, and the quotient its
# own: relative errors e of at most 2^-24 each, unless a product is subnormal (excluded in the requirement).
# The exact mean of the magnitudes is at most X, so the mean differs by at most X times the factor's
# distance from 1. A unit in the last place of X is more than 2^-24 X, so that is below seven of them.
f = (1 + p) * (1 + s1) * (1 + s2) * (1 + q) / ((1 + w1) * (1 + w2)) - 1;
{ |p| <= 0x1p-24 /\ |s1| <= 0x1p-24 /\ |s2| <= 0x1p-24 /\ |q| <= 0x1p-24 /\
  |w1| <= 0x1p-24 /\ |w2| <= 0x1p-24 -> |f| <= 0x6.0001p-24 }
