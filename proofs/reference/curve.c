// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * The curve of a stick, as rounded: bounded, 0 within the dead band, 1 at the end, and monotone
 * (requirements REF-006 to REF-009); and the disc (REF-010), over the reals.
 *
 * Each operation of the curve is a real one and a rounding. Rounding is monotone and leaves floats
 * as they are (REF_008_rounding to REF_008_minus_one); products of what is not negative are
 * monotone. So each step of the curve is monotone, and with it the whole, for all floats. The
 * formulas are those of `deflection` in src/flight/reference.c, in the same order, which
 * keel_reference_step_harness shows to be the model's, bit for bit.
 */

/*@ lemma REF_010_product: \forall real x, y; 0 <= x && 0 <= y ==> 0 <= x * y;
  @
  @ // Of products, before there is rounding, of which not every prover knows: all that the others
  @ // use of them. With cases, or WP would put the product itself wherever it stands.
  @ logic real times(real a, real b) = a == 0 ? 0 : a * b;
  @
  @ lemma REF_008_swapped: \forall real a, b; times(a, b) == times(b, a);
  @
  @ lemma REF_006_unit: \forall real a; times(1, a) == a && times(a, 1) == a;
  @
  @ lemma REF_007_none: \forall real a; times(0, a) == 0 && times(a, 0) == 0;
  @
  @ lemma REF_008_exact: \forall real a, b, c; 0 <= a <= b && 0 <= c ==>
  @     0 <= times(a, c) <= times(b, c);
  @
  @ lemma REF_008_some: \forall real a, b; 0 <= a && 0 <= b <= 1 ==> 0 <= times(a, b) <= a;
  @
  @ lemma REF_008_scaled: \forall real a, b, scale; -1 <= a <= b <= 1 && 1 <= scale <= 2.5 ==>
  @     -2.5 <= times(a, scale) <= times(b, scale) <= 2.5;
  @
  @ lemma REF_007_scaled: \forall real a, scale; -1 <= a <= 0 && 1 <= scale <= 2.5 ==>
  @     -2.5 <= times(a, scale) <= 0;
  @
  @ logic real rounded(real x) = (real)(float)x;
  @
  @ // What the others use of rounding.
  @ lemma REF_008_rounding: \forall real x, y; -128 <= x <= y <= 128 ==> rounded(x) <= rounded(y);
  @
  @ lemma REF_008_zero: rounded(0.0) == 0;
  @
  @ lemma REF_008_one: rounded(1.0) == 1;
  @
  @ lemma REF_008_minus_one: rounded(-1.0) == -1;
  @
  @ // What they use of products, as rounded. REF_008_left and REF_006_whole are those of a limit
  @ // with the size of a deflection, too, and of that with what the stick across leaves of it.
  @ logic real product(real a, real b) = rounded(times(a, b));
  @
  @ lemma REF_008_commuted: \forall real a, b; product(a, b) == product(b, a);
  @
  @ lemma REF_008_left: \forall real a, b, c; 0 <= a <= b <= 1 && 0 <= c <= 100 ==>
  @     0 <= product(a, c) <= product(b, c);
  @
  @ lemma REF_006_whole: \forall real a, b; 0 <= a <= 100 && 0 <= b <= 1 ==>
  @     product(a, b) <= rounded(a);
  @
  @ lemma REF_008_parts: \forall real a, b, c, d; 0 <= a <= b <= 1 && 0 <= c <= d <= 1 ==>
  @     0 <= product(a, c) <= product(b, c) && product(c, b) <= product(d, b) <= rounded(1.0) &&
  @     product(a, c) <= product(b, d) <= 1;
  @
  @ // The stretch beyond the dead band: monotone, and not above 0 within it.
  @ lemma REF_008_beyond: \forall real x, y, d; 0 <= x <= y <= 1 && 0 < d <= 0.5 ==>
  @     rounded(-1.0) <= rounded(x - d) <= rounded(y - d) <= rounded(1.0);
  @
  @ lemma REF_008_stretched: \forall real a, b, scale; -1 <= a <= b <= 1 && 1 <= scale <= 2.5 ==>
  @     product(a, scale) <= product(b, scale);
  @
  @ lemma REF_007_within: \forall real x, d; 0 <= x <= d <= 0.5 ==>
  @     rounded(-1.0) <= rounded(x - d) <= rounded(0.0);
  @
  @ lemma REF_007_stretched: \forall real a, scale; -1 <= a <= 0 && 1 <= scale <= 2.5 ==>
  @     product(a, scale) <= rounded(0.0);
  @
  @ logic real clamped(real x) = x <= 0 ? 0 : x >= 1 ? 1 : x;
  @
  @ lemma REF_008_clamped: \forall real a, b; a <= b ==> 0 <= clamped(a) <= clamped(b) <= 1;
  @
  @ // x and y are sizes of sticks, a and b what they are beyond the dead band.
  @ lemma REF_008_u: \forall real x, y, d, scale, a, b;
  @     a == rounded(x - d) && b == rounded(y - d) && 0 <= x <= y <= 1 &&
  @     0 < d <= 0.5 && 1 <= scale <= 2.5 ==>
  @     -1 <= a <= b <= 1 && product(a, scale) <= product(b, scale) &&
  @     0 <= clamped(product(a, scale)) <= clamped(product(b, scale)) <= 1;
  @
  @ lemma REF_007_dead: \forall real x, d, scale, a; a == rounded(x - d) &&
  @     0 <= x <= d <= 0.5 && 1 <= scale <= 2.5 ==>
  @     -1 <= a <= 0 && product(a, scale) <= 0 && clamped(product(a, scale)) == 0;
  @
  @ // The cubic of u, l being 1 - e as rounded: the factor of u, and its product with u.
  @ logic real factor(real u, real l, real e) = rounded(l + product(e, product(u, u)));
  @
  @ logic real bent(real u, real l, real e) = product(u, factor(u, l, e));
  @
  @ lemma REF_008_squared: \forall real u, v; 0 <= u <= v <= 1 ==>
  @     0 <= product(u, u) <= product(v, v) <= 1;
  @
  @ lemma REF_008_cubed: \forall real u, v, e; 0 <= u <= v <= 1 && 0 <= e <= 1 ==>
  @     0 <= product(e, product(u, u)) <= product(e, product(v, v)) <= 1;
  @
  @ lemma REF_008_sum: \forall real l, a, b; 0 <= a <= b <= 1 && 0 <= l <= 1 ==>
  @     rounded(0.0) <= rounded(l + a) <= rounded(l + b);
  @
  @ lemma REF_008_factor: \forall real u, v, l, e;
  @     0 <= u <= v <= 1 && 0 <= l <= 1 && 0 <= e <= 1 ==>
  @     0 <= factor(u, l, e) <= factor(v, l, e);
  @
  @ // At the end of the stick the curve is 1: e is a float, and so REF_003_sum has it of the sum.
  @ lemma REF_006_end: \forall real l, e; rounded(e) == e && rounded(l + e) == 1 ==>
  @     factor(1, l, e) == 1 && bent(1, l, e) == 1;
  @
  @ lemma REF_006_one: \forall real u, l, e; 0 <= u <= 1 && 0 <= l <= 1 && 0 <= e <= 1 &&
  @     rounded(e) == e && rounded(l + e) == 1 ==> 0 <= factor(u, l, e) <= factor(1, l, e);
  @
  @ lemma REF_008_bent: \forall real u, v, l, e, f, g; 0 <= u <= v <= 1 && 0 <= l <= 1 &&
  @     0 <= e <= 1 && rounded(e) == e && rounded(l + e) == 1 &&
  @     f == factor(u, l, e) && g == factor(v, l, e) ==>
  @     0 <= f <= g <= 1 && 0 <= product(u, f) <= product(v, g) <= 1;
  @
  @ lemma REF_007_centre: \forall real l, e; bent(0, l, e) == 0;
  @
  @ // The deflection, d, scale, l and e being the curve: that of the size, with the stick's sign.
  @ logic real deflected(real x, real d, real scale, real l, real e) =
  @     bent(clamped(product(rounded(x - d), scale)), l, e);
  @
  @ logic real deflection(real x, real d, real scale, real l, real e) =
  @     x < 0 ? -deflected(-x, d, scale, l, e) : deflected(x, d, scale, l, e);
  @
  @ lemma REF_009_odd: \forall real x, d, scale, l, e; x != 0 ==>
  @     deflection(-x, d, scale, l, e) == -deflection(x, d, scale, l, e);
  @
  @ // The disc: 1 less the sum of both squares, with s^2 = a and t^2 = b.
  @ lemma REF_010_disc: \forall real a, b, k, v, w;
  @     v == (1 - a) * (1 - b) && 0 <= v &&
  @     w == a * b * ((4 * k - 1 - 2 * k * k) + k * k * ((1 - a) + (1 - b))) && 0 <= w ==>
  @     a * (1 - k * b) * (1 - k * b) + b * (1 - k * a) * (1 - k * a) <= 1;
  @
  @ // k is not too small.
  @ lemma REF_010_corner: \forall real k; k == 0.292893230915069580078125 ==>
  @     0 <= 4 * k - 1 - 2 * k * k;
  @*/
