// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * The second and the third equation of a step of the filter, over the reals (requirement FLT-008);
 * bounded.c has the first, and what follows from all three. They stand alone, for a prover takes
 * each lemma before one for a hypothesis, and comes to no end on these beside others.
 */

/*@ lemma FLT_008_second: \forall real G, D, a, b, s1, d, h;
  @     D * b == G && D * a == G * G / 2 && h == b * s1 + a * d ==>
  @     D * h == G * (s1 + G * d / 2);
  @
  @ // k is D p, as the first says, and e the difference of the two sides, times D.
  @ lemma FLT_008_third: \forall real G, D, s1, s2, x, d, h, p, q, k, e;
  @     D == 1 + G + G * G / 2 && d == x - s2 && q == s2 + h &&
  @     k == s1 + G * d / 2 && D * p == k && D * h == G * k &&
  @     e == k - D * s1 - G * (D * d) / 2 + G * k + G * (G * k) / 2 ==>
  @     e == 0 && D * (p - s1) - D * (G * ((x - 2 * p - q) / 2)) == e;
  @*/
