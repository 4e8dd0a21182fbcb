// wp: theorem
/**
 * What lies between two samples is no farther apart than they are, as rounded, too (requirement
 * VOT-018): rounding is monotone. Samples are at most KEEL_VOTER_RANGE, 10^6, in magnitude.
 */

/*@ lemma VOT_018_monotone: \forall real d, e; -4000000 <= d <= e <= 4000000 ==>
  @     (float)d <= (float)e;
  @
  @ lemma VOT_018_between: \forall real least, most, x, y;
  @     -1000000 <= least <= x <= y <= most <= 1000000 ==>
  @     (float)(y - x) <= (float)(most - least);
  @*/
