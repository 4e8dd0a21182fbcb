// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * The fence's law, over the reals (requirement CAS-012): from inside, with way to brake, the
 * aircraft never leaves it.
 *
 * x is a position, v a speed, both towards a side at L. inside(x, v) says that full braking, by a,
 * stops before the side. `admits` is what the velocity stage asks for where it finds a side not
 * near: the aircraft is inside after the reaction time T even with the worst acceleration, A.
 *
 * While it admits, every motion y, w after a time t up to T that is not beyond the worst one, p, q
 * (y <= p, w <= q), is inside: where p still comes nearer, by CAS_012_sooner and CAS_012_slower it
 * is not beyond that after T, which is inside (CAS_012_admitted), and so is what is less
 * (CAS_012_less); where it does not, it went away only (CAS_012_away, CAS_012_resting). Braked by a
 * at least from inside, it stays so while it comes nearer (CAS_012_kept for the motion braked by a,
 * CAS_012_less for one braked more, CAS_012_before), and where it has stopped (CAS_012_stopped).
 *
 * Variables d and e stand for products, which are not negative by CAS_012_product: provers do not
 * multiply by themselves.
 */

/*@ // Braking by a stops before the side.
  @ predicate inside(real L, real a, real x, real v) =
  @     x <= L && (v > 0 ==> v * v <= 2 * a * (L - x));
  @
  @ // x' of cascade.h.
  @ logic real farthest(real x, real v, real A, real T) = x + v * T + A * T * T / 2;
  @
  @ predicate admits(real L, real a, real x, real v, real A, real T) =
  @     farthest(x, v, A, T) <= L &&
  @     (v + A * T > 0 ==> (v + A * T) * (v + A * T) <= 2 * a * (L - farthest(x, v, A, T)));
  @
  @ // The code's form: the distance to the side in the place of the position.
  @ lemma CAS_012_left: \forall real L, x, v, A, T;
  @     L - farthest(x, v, A, T) == (L - x) - T * (v + A * T / 2);
  @
  @ lemma CAS_012_product: \forall real a, b; 0 <= a && 0 <= b ==> 0 <= a * b;
  @
  @ // A motion that is less than one that is inside.
  @ lemma CAS_012_less: \forall real L, a, p, q, y, w, d, e; 0 < a && inside(L, a, p, q) &&
  @     y <= p && w <= q && d == 2 * a * (p - y) && 0 <= d &&
  @     e == (q - w) * (q + w) && (0 < w ==> 0 <= e) ==> inside(L, a, y, w);
  @
  @ lemma CAS_012_sooner: \forall real x, v, A, t, T, d, e;
  @     d == (T - t) * (v + A * t) && 0 <= d && e == A * ((T - t) * (T - t)) && 0 <= e ==>
  @     farthest(x, v, A, t) + d + e / 2 == farthest(x, v, A, T) &&
  @     farthest(x, v, A, t) <= farthest(x, v, A, T);
  @
  @ lemma CAS_012_slower: \forall real v, A, t, T, d; d == A * (T - t) && 0 <= d ==>
  @     v + A * t <= v + A * T;
  @
  @ lemma CAS_012_away: \forall real x, v, A, t, d, e; d == t * (-v - A * t) && 0 <= d &&
  @     e == A * (t * t) && 0 <= e ==> farthest(x, v, A, t) <= x;
  @
  @ lemma CAS_012_admitted: \forall real L, a, x, v, A, T;
  @     admits(L, a, x, v, A, T) ==> inside(L, a, farthest(x, v, A, T), v + A * T);
  @
  @ lemma CAS_012_resting: \forall real L, a, y, w; y <= L && w <= 0 ==> inside(L, a, y, w);
  @
  @ // It went no farther than to where braking by a stops.
  @ predicate stopped(real a, real x, real v, real y, real w) =
  @     w <= 0 && (v > 0 ==> 2 * a * (y - x) <= v * v) && (v <= 0 ==> y <= x);
  @
  @ // Braked by a for a time t.
  @ lemma CAS_012_kept: \forall real L, a, x, v, t, d; 0 < v && inside(L, a, x, v) &&
  @     d == 2 * a * (v * t - a * t * t / 2) ==>
  @     (v - a * t) * (v - a * t) == v * v - d &&
  @     (v - a * t) * (v - a * t) <= 2 * a * (L - (x + v * t - a * t * t / 2));
  @
  @ lemma CAS_012_before: \forall real L, a, x, s; 0 < a && s * s <= 2 * a * (L - x) &&
  @     0 <= s * s ==> x <= L;
  @
  @ lemma CAS_012_stopped: \forall real L, a, x, v, y, w;
  @     0 < a && inside(L, a, x, v) && stopped(a, x, v, y, w) ==> inside(L, a, y, w);
  @*/
