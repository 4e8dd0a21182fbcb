// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * The influence of one faulty sensor (requirement VOT-015), over the reals.
 *
 * Lengths are in units of a. The healthy two are at 0 and at e, 0 <= e <= 1: they agree fully. The
 * third lies at e + u, u > 0, beyond both (the other side is its mirror image, between them it
 * leaves no hull). Its agreements are p with the nearer and q with the farther, q <= p <= 1, and
 * p = 1 for u <= 1, p (n - 1) = n - u for 1 < u < n, 0 from n on. By eq. 17 and 18 the weights are
 * (1 + q)/2, (1 + p)/2 and (p + q)/2, so the mean is
 *
 *     (e (1 + p) + (e + u)(p + q)) / (2 (1 + p + q)),
 *
 * and it exceeds e by (u (p + q) - e (1 + q)) / (2 (1 + p + q)). For c of at least 1/3 that
 * satisfies (n + 2 c)^2 <= 4 c (3 n - 1) this is at most c. For n = 3 that is c = 1/2.
 */

/*@ // What the others use of products.
  @ lemma VOT_015_square: \forall real x; 0 <= x * x;
  @ lemma VOT_015_product: \forall real x, y; 0 <= x && 0 <= y ==> 0 <= x * y;
  @
  @ // The nearer one alone, between 1 and n: u p / (1 + 2 p) <= c, both sides times n - 1. It is
  @ // the discriminant that must not be positive: s is the square that is left.
  @ lemma VOT_015_near: \forall real n, c, u, s;
  @     s == (u - (n + 2 * c) / 2) * (u - (n + 2 * c) / 2) && 0 <= s &&
  @     (n + 2 * c) * (n + 2 * c) <= 4 * c * (3 * n - 1) ==>
  @     u * (n - u) <= c * ((n - 1) + 2 * (n - u));
  @
  @ // Within a the third is believed in full, p = 1: u / 3 <= c.
  @ lemma VOT_015_within: \forall real c, u; 1.0 / 3.0 <= c && 0 <= u <= 1 ==> u <= c * (1 + 2);
  @
  @ // From one agreement to both, q = t p with 0 <= t <= 1, and from e = 0 to any e: r, v and w are
  @ // products of what is not negative.
  @ lemma VOT_015_both: \forall real c, u, p, t, e, r, v, w;
  @     r == (1 + t) * (c * (1 + 2 * p) - u * p) && 0 <= r &&
  @     v == c * (1 - t) && 0 <= v && w == e * (1 + t * p) && 0 <= w ==>
  @     u * (p + t * p) - e * (1 + t * p) <= 2 * c * (1 + p + t * p);
  @
  @ // The same as rounded (VOT-017): agreements ph and qh that are off by at most d. r and s are
  @ // what VOT_017_bound leaves of the products.
  @ lemma VOT_017_bound: \forall real a, b, x, d, v, w;
  @     v == (b - a) * (d + x) && 0 <= v && w == (b + a) * (d - x) && 0 <= w ==> a * x <= b * d;
  @
  @ lemma VOT_017_perturbed: \forall real c, u, e, p, q, ph, qh, d, r, s;
  @     u * (p + q) - e * (1 + q) <= 2 * c * (1 + p + q) &&
  @     r == (u + 2 * c) * d - (u - 2 * c) * (ph - p) && 0 <= r &&
  @     s == (u + 2 * c + e) * d - (u - 2 * c - e) * (qh - q) && 0 <= s ==>
  @     u * (ph + qh) - e * (1 + qh) <= 2 * c * (1 + ph + qh) + (2 * u + 4 * c + e) * d;
  @
  @ // A c for n = 3.
  @ lemma VOT_015_three: (3 + 2 * 0.5) * (3 + 2 * 0.5) <= 4 * 0.5 * (3 * 3 - 1);
  @*/
