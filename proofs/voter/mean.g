# goals: 6
# rounds: proofs/voter/voter_mean.h mean_of_three
#
# The rounding of eq. 18 in single precision for three sensors (requirement VOT-016).
#
# Each operation of mean_of_three is exact but for a factor 1 + e, |e| <= 2^-24 (specs/soundness.md).
# A weighted sample gathers the factors of its product, of the additions that follow and of the
# quotient; a weight those of its additions, by which the quotient is divided. There is a goal for
# each way that a sample and a weight can go.
VOT_016_p0_v1 = (1 + p0) * (1 + s1) * (1 + s2) * (1 + q) / ((1 + v1) * (1 + v2)) - 1;
VOT_016_p0_v2 = (1 + p0) * (1 + s1) * (1 + s2) * (1 + q) / (1 + v2) - 1;
VOT_016_p1_v1 = (1 + p1) * (1 + s1) * (1 + s2) * (1 + q) / ((1 + v1) * (1 + v2)) - 1;
VOT_016_p1_v2 = (1 + p1) * (1 + s1) * (1 + s2) * (1 + q) / (1 + v2) - 1;
VOT_016_p2_v1 = (1 + p2) * (1 + s2) * (1 + q) / ((1 + v1) * (1 + v2)) - 1;
VOT_016_p2_v2 = (1 + p2) * (1 + s2) * (1 + q) / (1 + v2) - 1;
{ |p0| <= 0x1p-24 /\ |p1| <= 0x1p-24 /\ |p2| <= 0x1p-24 /\ |s1| <= 0x1p-24 /\ |s2| <= 0x1p-24 /\
  |v1| <= 0x1p-24 /\ |v2| <= 0x1p-24 /\ |q| <= 0x1p-24
  -> |VOT_016_p0_v1| <= 0x6.0001p-24 /\ |VOT_016_p0_v2| <= 0x6.0001p-24 /\
     |VOT_016_p1_v1| <= 0x6.0001p-24 /\ |VOT_016_p1_v2| <= 0x6.0001p-24 /\
     |VOT_016_p2_v1| <= 0x6.0001p-24 /\ |VOT_016_p2_v2| <= 0x6.0001p-24 }
