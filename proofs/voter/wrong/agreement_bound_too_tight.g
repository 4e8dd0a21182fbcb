# expect: VOT_017_agreement
# witness: z = -1, d1 = 0, e1 = 0x1p-24, v1 = -0x1p-24, q = 0x1p-24
#
# Two samples of the same value: the difference, the divisor and the quotient round to one side.
r = (1 + z) / 2;
factor = (1 + e1) * (1 + q) / (1 + v1);
VOT_017_agreement = (1 - r * (1 + d1)) * factor - (1 - r);
{ |z| <= 0x1p+0 /\ |d1| <= 0x1p-24 /\ |e1| <= 0x1p-24 /\ |v1| <= 0x1p-24 /\ |q| <= 0x1p-24
  -> |VOT_017_agreement| <= 0x2.ffffp-24 }
# The error of the factor counts for what is left of the range, that of the distance for the rest.
VOT_017_agreement -> (1 - r) * (factor - 1) - r * d1 * factor { 1 + v1 <> 0 };
