// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * Thresholds that grow with the output stay bounded (requirement VOT-023), over the reals.
 *
 * Before a vote a is at most g + s o: o is the magnitude of the last output, g and s are agree and
 * slope of the configuration (VOT-019). While two of three samples lie within a of each other, and
 * within H of 0, the vote's output leaves their hull by at most c a (VOT-015) and by what rounding
 * adds, at most r (VOT-017). So its magnitude p is at most H + c a + r, and
 *
 *     p - B <= c s (o - B)     with  B (1 - c s) = H + c g + r.
 *
 * Where c s is below 1, an output within B is followed by one within B; one beyond comes nearer to
 * B by the factor c s at least. By induction over the votes, a third sensor opens the thresholds to
 * g + s B at most, however long it tries.
 */

/*@ // What the others use of products.
  @ lemma VOT_023_product: \forall real x, y; 0 <= x && 0 <= y ==> 0 <= x * y;
  @
  @ // m is what a falls short of its most, times c.
  @ lemma VOT_023_step: \forall real c, s, g, r, H, B, a, o, p, m;
  @     m == c * (g + s * o - a) && 0 <= m && p <= H + c * a + r &&
  @     B * (1 - c * s) == H + c * g + r ==> p - B <= c * s * (o - B);
  @
  @ // k is c s. An output within B stays there.
  @ lemma VOT_023_kept: \forall real k, B, o, p, m;
  @     p - B <= k * (o - B) && m == k * (B - o) && 0 <= m ==> p <= B;
  @
  @ // One beyond comes nearer.
  @ lemma VOT_023_nearer: \forall real k, B, o, p, m;
  @     p - B <= k * (o - B) && m == (1 - k) * (o - B) && 0 < m ==> p < o;
  @
  @ // Then so is a.
  @ lemma VOT_023_threshold: \forall real s, g, B, a, o, m;
  @     a <= g + s * o && m == s * (B - o) && 0 <= m ==> a <= g + s * B;
  @*/
