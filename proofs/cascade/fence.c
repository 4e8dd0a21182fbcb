// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * The fence's law, over the reals (requirement CAS-012): from inside, with way to brake, the
 * aircraft never leaves it.
 *
 * x is a position, v a speed, both towards a side at L. inside(x, v) says that full braking, by a,
 * stops before the side. At each step the velocity stage looks whether the side is near; if it is
 * not, the aircraft may do anything with an acceleration up to A for the reaction time T
 * (CAS_012_free); if it is, it is braked from then on, and so it is after T at the latest, from
 * when on each further step of it keeps what is needed (CAS_012_braked), at the steps and in
 * between.
 */

/*@ predicate inside(real L, real a, real x, real v) =
  @     x <= L && (v > 0 ==> v * v <= 2 * a * (L - x));
  @
  @ // What the code asks for, as in cascade.h.
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
  @ // With the worst acceleration for a time t up to T: the worst is at the end.
  @ lemma CAS_012_sooner: \forall real x, v, A, t, T; 0 <= A && 0 <= t <= T && 0 <= v + A * t ==>
  @     farthest(x, v, A, t) <= farthest(x, v, A, T);
  @
  @ lemma CAS_012_slower: \forall real v, A, t, T; 0 <= A && 0 <= t <= T && 0 <= v + A * t ==>
  @     v + A * t <= v + A * T &&
  @     (v + A * t) * (v + A * t) <= (v + A * T) * (v + A * T);
  @
  @ lemma CAS_012_way: \forall real L, a, p, q; 0 < a && p <= q ==>
  @     2 * a * (L - q) <= 2 * a * (L - p);
  @
  @ // Where it still moves away at the end, it has only moved away.
  @ lemma CAS_012_away: \forall real x, v, A, t; 0 <= A && 0 <= t && v + A * t <= 0 ==>
  @     farthest(x, v, A, t) <= x;
  @
  @ // Any motion y, w after t that is not faster than the worst one is inside.
  @ lemma CAS_012_free: \forall real L, a, x, v, A, t, T, y, w;
  @     0 < a && 0 <= A && 0 <= t <= T && x <= L && admits(L, a, x, v, A, T) &&
  @     y <= farthest(x, v, A, t) && w <= v + A * t ==> inside(L, a, y, w);
  @
  @ // Braked for a time t by a at least: slower by a t at least, and where it still moves towards
  @ // the side, no farther than braking by a leads. Where it does not, it went no farther than to
  @ // where that braking stops.
  @ predicate braked(real a, real x, real v, real t, real y, real w) =
  @     w <= v - a * t && y <= x + v * t - a * t * t / 2;
  @
  @ predicate stopped(real a, real x, real v, real y, real w) =
  @     w <= 0 && (v > 0 ==> 2 * a * (y - x) <= v * v) && (v <= 0 ==> y <= x);
  @
  @ lemma CAS_012_square: \forall real a, v, t; 0 < a && 0 <= t && 0 <= v - a * t ==>
  @     (v - a * t) * (v - a * t) == v * v - 2 * a * (v * t - a * t * t / 2);
  @
  @ lemma CAS_012_braked: \forall real L, a, x, v, t, y, w;
  @     0 < a && 0 <= t && inside(L, a, x, v) && 0 < w && braked(a, x, v, t, y, w) ==>
  @     inside(L, a, y, w);
  @
  @ lemma CAS_012_stopped: \forall real L, a, x, v, y, w;
  @     0 < a && inside(L, a, x, v) && stopped(a, x, v, y, w) ==> inside(L, a, y, w);
  @*/
