// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * The filter's states are bounded for bounded inputs (requirement FLT-008), over the reals.
 *
 * Put G = sqrt(2) g, so that D = 1 + G + G^2/2, and let p be the mean of s1 before and after a
 * step, q its output y. A step is that of the trapezoidal rule, both sides times D > 0
 * (FLT_008_first here; FLT_008_second and FLT_008_third in step.c):
 *
 *     s1' - p = p - s1 = G u,  s2' - q = q - s2 = G v    with u = (x - 2 p - q)/2, v = p
 *
 *
 * Along it the energy V(s1, s2) = 2 s1^2 + s1 s2 + s2^2 changes by 4 G F (FLT_008_change), where
 * F = x (p + q/4) - 3/2 p^2 - 1/2 p q - 1/4 q^2. So it falls when F < 0. When F >= 0, (p, q) is
 * near 0: V(p, q) and V(u, v) are bounded by M^2, |x| <= M, and V(s1', s2') with them, for it is
 * V(p, q) + 2 G F + G^2 V(u, v) (FLT_008_after). With R = 8/5 + 2/5 G + 4/5 G^2 it follows that
 * V <= R M^2 before a step implies the same after it (FLT_008_kept). A filter at rest at a value
 * of at most M has V <= M^2.
 *
 * V bounds the states: s1^2 + s2^2 <= 13/10 V (FLT_008_states).
 */

/*@ logic real filter_energy(real a, real b) = 2 * a * a + a * b + b * b;
  @
  @ logic real filter_gain(real p, real q, real x) =
  @     x * (p + q / 4) - 3 * p * p / 2 - p * q / 2 - q * q / 4;
  @
  @ logic real filter_radius(real G) = 8.0 / 5.0 + 2 * G / 5 + 4 * G * G / 5;
  @
  @ // The step of filter.h is that of the trapezoidal rule; a, b and c are the exact coefficients.
  @ lemma FLT_008_first: \forall real G, D, b, c, s1, d, p;
  @     D == 1 + G + G * G / 2 && D * b == G && D * c == 2 - D &&
  @     2 * p == s1 + (c * s1 + b * d) ==> D * p == s1 + G * d / 2;
  @
  @ lemma FLT_008_change: \forall real G, p, q, x, u, v;
  @     u == (x - 2 * p - q) / 2 && v == p ==>
  @     filter_energy(p + G * u, q + G * v) - filter_energy(p - G * u, q - G * v)
  @         == 4 * G * filter_gain(p, q, x);
  @
  @ lemma FLT_008_after: \forall real G, p, q, x, u, v;
  @     u == (x - 2 * p - q) / 2 && v == p ==>
  @     filter_energy(p + G * u, q + G * v) == filter_energy(p, q) + 2 * G * filter_gain(p, q, x)
  @         + G * G * filter_energy(u, v);
  @
  @ lemma FLT_008_square: \forall real x; 0 <= x * x;
  @
  @ // Quadratic forms as sums of squares j, k and that of x.
  @ lemma FLT_008_middle: \forall real p, q, x, j, k;
  @     j == (p + (q - 3 * x) / 7) * (p + (q - 3 * x) / 7) && 0 <= j &&
  @     k == (q - 9 * x / 10) * (q - 9 * x / 10) && 0 <= k && 0 <= x * x ==>
  @     filter_energy(p, q) + 6 * filter_gain(p, q, x) <= 8 * x * x / 5;
  @
  @ lemma FLT_008_rise: \forall real p, q, x, j, k;
  @     j == (p + (q - 2 * x) / 6) * (p + (q - 2 * x) / 6) && 0 <= j &&
  @     k == (q - x / 5) * (q - x / 5) && 0 <= k && 0 <= x * x ==>
  @     2 * filter_gain(p, q, x) <= 2 * x * x / 5;
  @
  @ lemma FLT_008_slope: \forall real p, q, x, u, j, k;
  @     u == (x - 2 * p - q) / 2 &&
  @     j == (p - 3 * x / 10) * (p - 3 * x / 10) && 0 <= j &&
  @     k == (q + x / 2) * (q + x / 2) && 0 <= k && 0 <= x * x ==>
  @     filter_energy(u, p) + 3 * filter_gain(p, q, x) <= 4 * x * x / 5;
  @
  @ // Before a step e, after it f; g, v and w as the lemmas above have them, k and l two products.
  @ lemma FLT_008_kept: \forall real G, m, e, f, g, v, w, k, l;
  @     0 <= G && f - e == 4 * k && f == v + 2 * k + G * G * w && k == G * g && l == G * G * g &&
  @     v + 6 * g <= 8 * m / 5 && 2 * k <= 2 * G * m / 5 &&
  @     G * G * w + 3 * l <= 4 * G * G * m / 5 &&
  @     (0 <= g ==> 0 <= k && 0 <= l) && (g <= 0 ==> k <= 0) &&
  @     e <= filter_radius(G) * m ==> f <= filter_radius(G) * m;
  @
  @ lemma FLT_008_states: \forall real a, b, k;
  @     k == (a + 13 * b / 32) * (a + 13 * b / 32) && 0 <= k && 0 <= b * b ==>
  @     a * a + b * b <= 13 * filter_energy(a, b) / 10;
  @*/
