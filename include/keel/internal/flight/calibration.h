/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/calibration.h
 * @brief The contracts of calibration.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_FLIGHT_CALIBRATION_H
#define KEEL_INTERNAL_FLIGHT_CALIBRATION_H

#include "keel/c_declarations.h"
#include "keel/flight/calibration.h"

KEEL_C_BEGIN

/*@ predicate calibration_number(float value, real least, real most) =
  @     \is_finite(value) && least <= value <= most;
  @
  @ predicate calibration_three(float *v, real least, real most) =
  @     calibration_number(v[0], least, most) && calibration_number(v[1], least, most) &&
  @     calibration_number(v[2], least, most);
  @
  @ predicate calibration_expected(keel_calibration_rest_config_t c) =
  @     calibration_number(c.expected[0], -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) &&
  @     calibration_number(c.expected[1], -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) &&
  @     calibration_number(c.expected[2], -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT);
  @
  @ predicate calibration_rest_limits(keel_calibration_rest_config_t c) =
  @     calibration_number(c.spread, 0, KEEL_CALIBRATION_LIMIT) &&
  @     calibration_number(c.limit, 0, KEEL_CALIBRATION_LIMIT) &&
  @     1 <= c.samples <= KEEL_CALIBRATION_SAMPLES_MAX;
  @
  @ predicate calibration_field_range(keel_calibration_field_config_t c) =
  @     calibration_number(c.highest, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) &&
  @     calibration_number(c.lowest, -KEEL_CALIBRATION_LIMIT, c.highest);
  @
  @ predicate calibration_field_limits(keel_calibration_field_config_t c) =
  @     calibration_number(c.span_max, 0, 2 * KEEL_CALIBRATION_LIMIT) &&
  @     calibration_number(c.span_min, 0, c.span_max) && 0 < c.span_min &&
  @     calibration_number(c.limit, 0, KEEL_CALIBRATION_LIMIT);
  @
  @ // A step asks for this; init establishes it and every step keeps it.
  @ predicate calibration_rest_counts(keel_calibration_rest_t *r) =
  @     \is_finite(r->config.spread) && \is_finite(r->config.limit) &&
  @     r->count <= KEEL_CALIBRATION_SAMPLES_MAX;
  @
  @ predicate calibration_field_finite(keel_calibration_field_config_t c) =
  @     \is_finite(c.lowest) && \is_finite(c.highest) && \is_finite(c.span_min) &&
  @     \is_finite(c.span_max) && \is_finite(c.limit);
  @
  @ // Init establishes this and every function keeps it. A sum is at most as many times the limit.
  @ predicate calibration_sum(keel_calibration_rest_t *r, integer k) = calibration_number(r->sum[k],
  @     -r->count * KEEL_CALIBRATION_LIMIT, r->count * KEEL_CALIBRATION_LIMIT);
  @
  @ predicate calibration_rest_valid(keel_calibration_rest_t *r) =
  @     calibration_expected(r->config) && calibration_rest_limits(r->config) &&
  @     calibration_number(r->per_sample, 1.0 / KEEL_CALIBRATION_SAMPLES_MAX, 1) &&
  @     calibration_three(&r->offset[0], -r->config.limit, r->config.limit) &&
  @     calibration_three(&r->first[0], -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) &&
  @     calibration_three(&r->sum[0], -KEEL_CALIBRATION_SAMPLES_MAX * KEEL_CALIBRATION_LIMIT,
  @         KEEL_CALIBRATION_SAMPLES_MAX * KEEL_CALIBRATION_LIMIT) &&
  @     (r->count != 0 ==> calibration_sum(r, 0) && calibration_sum(r, 1) &&
  @         calibration_sum(r, 2)) && r->count <= r->config.samples && r->beyond <= 7 &&
  @     (r->state == KEEL_CALIBRATION_COLLECTING ==> r->count < r->config.samples) &&
  @     (r->state == KEEL_CALIBRATION_REFUSED <==> r->beyond != 0) &&
  @     r->state <= KEEL_CALIBRATION_REFUSED;
  @
  @ predicate calibration_field_valid(keel_calibration_field_t *f) =
  @     calibration_field_range(f->config) && calibration_field_limits(f->config) &&
  @     calibration_three(&f->offset[0], -f->config.limit, f->config.limit) &&
  @     calibration_three(&f->lowest[0], f->config.lowest, f->config.highest) &&
  @     calibration_three(&f->highest[0], f->config.lowest, f->config.highest) &&
  @     f->state <= KEEL_CALIBRATION_DONE;
  @
  @ // A value that is near the first of its run; rounded, as the difference is.
  @ predicate calibration_near(float value, float first, float spread) =
  @     -spread <= (float)(value - first) <= spread;
  @
  @ predicate calibration_all_near(keel_calibration_rest_t *r, float *s) =
  @     calibration_near(s[0], r->first[0], r->config.spread) &&
  @     calibration_near(s[1], r->first[1], r->config.spread) &&
  @     calibration_near(s[2], r->first[2], r->config.spread);
  @
  @ // A sample that counts.
  @ predicate calibration_heeds(keel_calibration_field_t *f, float *s) =
  @     f->state == KEEL_CALIBRATION_COLLECTING &&
  @     calibration_three(s, f->config.lowest, f->config.highest);
  @
  @ predicate calibration_correction(keel_calibration_correction_t *c) =
  @     calibration_three(&c->offset[0], -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) &&
  @     calibration_three(&c->scale[0], KEEL_CALIBRATION_SCALE_MIN, KEEL_CALIBRATION_SCALE_MAX);
  @
  @ predicate calibration_turn(keel_calibration_rotation_t *t) =
  @     calibration_three(&t->x[0], -1, 1) && calibration_three(&t->y[0], -1, 1) &&
  @     calibration_three(&t->z[0], -1, 1);
  @
  @ // Gravity and limit of a calibration on six sides.
  @ predicate calibration_sides(keel_calibration_sides_t s) =
  @     calibration_number(s.gravity, 0, KEEL_CALIBRATION_LIMIT) && s.gravity > 0 &&
  @     calibration_number(s.limit, 0, KEEL_CALIBRATION_LIMIT);
  @
  @ logic integer calibration_up(integer count) = count < 65535 ? count + 1 : 65535;
  @*/

/*@ requires \valid(rest) && \valid_read(config) && \separated(rest, config);
  @ assigns *rest;
  @ ensures CAL_001_expected: !calibration_expected(*config) ==> \result == KEEL_ERR_VALUE;
  @ ensures CAL_001_limits: calibration_expected(*config) && !calibration_rest_limits(*config) ==>
  @     \result == KEEL_ERR_LIMITS;
  @ ensures CAL_001_kept: \result != KEEL_OK ==> *rest == \old(*rest);
  @ ensures CAL_002_taken: calibration_expected(*config) && calibration_rest_limits(*config) ==>
  @     \result == KEEL_OK && rest->config == *config && calibration_rest_counts(rest);
  @ ensures CAL_003_idle: \result == KEEL_OK ==> rest->state == KEEL_CALIBRATION_IDLE &&
  @     calibration_three(&rest->offset[0], 0, 0);
  @ ensures CAL_013_made: \result == KEEL_OK ==> calibration_rest_valid(rest);
  @*/
keel_status_t keel_calibration_rest_init(keel_calibration_rest_t *rest,
                                         const keel_calibration_rest_config_t *config);

/*@ requires \valid(rest);
  @ assigns rest->first[0 .. 2], rest->sum[0 .. 2], rest->count, rest->state, rest->restarts,
  @     rest->beyond;
  @ ensures CAL_003_begun: rest->state == KEEL_CALIBRATION_COLLECTING && rest->count == 0 &&
  @     rest->restarts == 0 && rest->beyond == 0;
  @ ensures CAL_003_zero: calibration_three(&rest->first[0], 0, 0) &&
  @     calibration_three(&rest->sum[0], 0, 0);
  @ ensures CAL_013_begun: \old(calibration_rest_valid(rest)) ==> calibration_rest_valid(rest);
  @*/
void keel_calibration_rest_begin(keel_calibration_rest_t *rest);

/*@ requires \valid(rest) && \valid_read(sample + (0 .. 2)) && \separated(rest, sample + (0 .. 2));
  @ requires rest_counts: calibration_rest_counts(rest);
  @ assigns rest->offset[0 .. 2], rest->first[0 .. 2], rest->sum[0 .. 2], rest->count, rest->state,
  @     rest->restarts, rest->beyond;
  @ ensures CAL_004_only: \old(rest->state) != KEEL_CALIBRATION_COLLECTING ==>
  @     rest->state == \old(rest->state) && rest->count == \old(rest->count) &&
  @     rest->restarts == \old(rest->restarts) && rest->beyond == \old(rest->beyond);
  @ ensures CAL_004_counted: \old(rest->state) == KEEL_CALIBRATION_COLLECTING ==>
  @     rest->count == \old(rest->count) + 1 || rest->count == 0;
  @ ensures CAL_004_first: \old(rest->state) == KEEL_CALIBRATION_COLLECTING &&
  @     \old(rest->count) == 0 &&
  @     calibration_three(sample, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) ==>
  @     rest->count == 1 && rest->first[0] == sample[0] && rest->first[1] == sample[1] &&
  @     rest->first[2] == sample[2];
  @ ensures CAL_005_none: \old(rest->state) == KEEL_CALIBRATION_COLLECTING &&
  @     !calibration_three(sample, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) ==>
  @     rest->count == 0;
  @ ensures CAL_005_far: \old(rest->state) == KEEL_CALIBRATION_COLLECTING &&
  @     \old(rest->count) != 0 &&
  @     calibration_three(sample, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT) ==>
  @     (rest->count == 0 <==> !\old(calibration_all_near(rest, sample)));
  @ ensures CAL_005_told: \old(rest->state) == KEEL_CALIBRATION_COLLECTING ==>
  @     rest->restarts == (rest->count == 0 && \old(rest->count) != 0
  @     ? calibration_up(\old(rest->restarts)) : \old(rest->restarts));
  @ ensures CAL_006_ends: \old(rest->state) == KEEL_CALIBRATION_COLLECTING ==>
  @     (rest->state == KEEL_CALIBRATION_COLLECTING <==> rest->count < rest->config.samples) &&
  @     rest->state != KEEL_CALIBRATION_IDLE;
  @ ensures CAL_007_limit: rest->state == KEEL_CALIBRATION_DONE &&
  @     \old(rest->state) == KEEL_CALIBRATION_COLLECTING ==> rest->beyond == 0 &&
  @     calibration_three(&rest->offset[0], -rest->config.limit, rest->config.limit);
  @ ensures CAL_007_refused: rest->state == KEEL_CALIBRATION_REFUSED &&
  @     \old(rest->state) == KEEL_CALIBRATION_COLLECTING ==> 1 <= rest->beyond <= 7;
  @ ensures CAL_007_kept: \old(calibration_three(&rest->offset[0], -KEEL_CALIBRATION_LIMIT,
  @     KEEL_CALIBRATION_LIMIT)) && (rest->state != KEEL_CALIBRATION_DONE ||
  @     \old(rest->state) != KEEL_CALIBRATION_COLLECTING) ==>
  @     rest->offset[0] == \old(rest->offset[0]) && rest->offset[1] == \old(rest->offset[1]) &&
  @     rest->offset[2] == \old(rest->offset[2]);
  @ ensures CAL_013_rest: \old(calibration_rest_valid(rest)) ==> calibration_rest_valid(rest);
  @*/
void keel_calibration_rest_step(keel_calibration_rest_t *rest,
                                const float sample[KEEL_CALIBRATION_AXES]);

/*@ requires \valid(field) && \valid_read(config) && \separated(field, config);
  @ assigns *field;
  @ ensures CAL_008_range: !calibration_field_range(*config) ==> \result == KEEL_ERR_VALUE;
  @ ensures CAL_008_limits: calibration_field_range(*config) &&
  @     !calibration_field_limits(*config) ==> \result == KEEL_ERR_LIMITS;
  @ ensures CAL_008_kept: \result != KEEL_OK ==> *field == \old(*field);
  @ ensures CAL_008_taken: calibration_field_range(*config) && calibration_field_limits(*config) ==>
  @     \result == KEEL_OK && field->config == *config && calibration_field_finite(field->config);
  @ ensures CAL_009_idle: \result == KEEL_OK ==> field->state == KEEL_CALIBRATION_IDLE &&
  @     calibration_three(&field->offset[0], 0, 0);
  @ ensures CAL_013_new: \result == KEEL_OK ==> calibration_field_valid(field);
  @*/
keel_status_t keel_calibration_field_init(keel_calibration_field_t *field,
                                          const keel_calibration_field_config_t *config);

/*@ requires \valid(field) && calibration_field_finite(field->config);
  @ assigns field->lowest[0 .. 2], field->highest[0 .. 2], field->state, field->dropped;
  @ ensures CAL_009_begun: field->state == KEEL_CALIBRATION_COLLECTING && field->dropped == 0;
  @ ensures CAL_009_lowest: calibration_three(&field->lowest[0], field->config.highest,
  @     field->config.highest);
  @ ensures CAL_009_highest: calibration_three(&field->highest[0], field->config.lowest,
  @     field->config.lowest);
  @ ensures CAL_013_again: \old(calibration_field_valid(field)) ==>
  @     calibration_field_valid(field);
  @*/
void keel_calibration_field_begin(keel_calibration_field_t *field);

/*@ requires \valid(field) && \valid_read(sample + (0 .. 2)) &&
  @     \separated(field, sample + (0 .. 2));
  @ requires field_finite: calibration_field_finite(field->config);
  @ assigns field->lowest[0 .. 2], field->highest[0 .. 2], field->dropped;
  @ ensures CAL_010_only: field->state != KEEL_CALIBRATION_COLLECTING ==>
  @     field->dropped == \old(field->dropped);
  @ ensures CAL_010_dropped: field->state == KEEL_CALIBRATION_COLLECTING &&
  @     !calibration_three(sample, field->config.lowest, field->config.highest) ==>
  @     field->dropped == calibration_up(\old(field->dropped));
  @ ensures CAL_010_heeded: calibration_heeds(field, sample) ==>
  @     field->dropped == \old(field->dropped);
  @ ensures CAL_010_lowest: \forall integer k; 0 <= k < 3 && \is_finite(\old(field->lowest[k])) ==>
  @     (calibration_heeds(field, sample) && sample[k] < \old(field->lowest[k]) ==>
  @     field->lowest[k] == sample[k]) &&
  @     (!(calibration_heeds(field, sample) && sample[k] < \old(field->lowest[k])) ==>
  @     field->lowest[k] == \old(field->lowest[k]));
  @ ensures CAL_010_highest: \forall integer k; 0 <= k < 3 &&
  @     \is_finite(\old(field->highest[k])) ==>
  @     (calibration_heeds(field, sample) && sample[k] > \old(field->highest[k]) ==>
  @     field->highest[k] == sample[k]) &&
  @     (!(calibration_heeds(field, sample) && sample[k] > \old(field->highest[k])) ==>
  @     field->highest[k] == \old(field->highest[k]));
  @ ensures CAL_013_field: \old(calibration_field_valid(field)) ==> calibration_field_valid(field);
  @*/
void keel_calibration_field_step(keel_calibration_field_t *field,
                                 const float sample[KEEL_CALIBRATION_AXES]);

/*@ requires \valid_read(field) && axis < KEEL_CALIBRATION_AXES;
  @ requires axis_finite: calibration_field_finite(field->config);
  @ assigns \nothing;
  @ ensures CAL_011_narrow: \result == KEEL_CALIBRATION_NARROW <==>
  @     !((float)(field->highest[axis] - field->lowest[axis]) >= field->config.span_min);
  @ ensures CAL_011_wide: \result == KEEL_CALIBRATION_WIDE ==>
  @     (float)(field->highest[axis] - field->lowest[axis]) > field->config.span_max;
  @ ensures CAL_011_fit: \result == KEEL_CALIBRATION_FIT ==>
  @     field->config.span_min <= (float)(field->highest[axis] - field->lowest[axis]) <=
  @     field->config.span_max;
  @*/
keel_calibration_verdict_t keel_calibration_field_axis(const keel_calibration_field_t *field,
                                                       uint32_t axis);

/*@ requires \valid(field);
  @ requires finish_finite: calibration_field_finite(field->config);
  @ assigns field->offset[0 .. 2], field->state;
  @ ensures CAL_012_state: \old(field->state) != KEEL_CALIBRATION_COLLECTING <==>
  @     \result == KEEL_ERR_STATE;
  @ ensures CAL_012_kept: \result != KEEL_OK ==> field->state == \old(field->state) &&
  @     (\old(calibration_three(&field->offset[0], -KEEL_CALIBRATION_LIMIT,
  @         KEEL_CALIBRATION_LIMIT)) ==> field->offset[0] == \old(field->offset[0]) &&
  @     field->offset[1] == \old(field->offset[1]) && field->offset[2] == \old(field->offset[2]));
  @ ensures CAL_012_taken: \result == KEEL_OK ==> field->state == KEEL_CALIBRATION_DONE &&
  @     calibration_three(&field->offset[0], -field->config.limit, field->config.limit);
  @ ensures CAL_013_finish: \old(calibration_field_valid(field)) ==>
  @     calibration_field_valid(field);
  @*/
keel_status_t keel_calibration_field_finish(keel_calibration_field_t *field);

/*@ requires \valid_read(offset + (0 .. 2)) && \valid_read(raw + (0 .. 2)) &&
  @     \valid(out) && \separated(offset + (0 .. 2), out) &&
  @     (raw == &out->axis[0] || \separated(raw + (0 .. 2), out));
  @ assigns *out;
  @ ensures CAL_014_finite: calibration_three(offset, -KEEL_CALIBRATION_LIMIT,
  @     KEEL_CALIBRATION_LIMIT) && \old(calibration_three(raw, -KEEL_CALIBRATION_LIMIT,
  @     KEEL_CALIBRATION_LIMIT)) ==> calibration_three(&out->axis[0], -2 * KEEL_CALIBRATION_LIMIT,
  @     2 * KEEL_CALIBRATION_LIMIT);
  @*/
void keel_calibration_apply(const float offset[KEEL_CALIBRATION_AXES],
                            const float raw[KEEL_CALIBRATION_AXES], keel_calibration_vector_t *out);

/*@ requires \valid_read(correction) && \valid_read(raw + (0 .. 2)) && \valid(out) &&
  @     \separated(correction, out) && (raw == &out->axis[0] || \separated(raw + (0 .. 2), out));
  @ assigns *out;
  @ ensures CAL_015_finite: calibration_correction(correction) &&
  @     \old(calibration_three(raw, -KEEL_CALIBRATION_LIMIT, KEEL_CALIBRATION_LIMIT)) ==>
  @     calibration_three(&out->axis[0], -4 * KEEL_CALIBRATION_LIMIT, 4 * KEEL_CALIBRATION_LIMIT);
  @*/
void keel_calibration_correct(const keel_calibration_correction_t *correction,
                              const float raw[KEEL_CALIBRATION_AXES],
                              keel_calibration_vector_t *out);

/*@ requires \valid_read(mean + (0 .. 2));
  @ requires side_limits: calibration_number(least, 0, KEEL_CALIBRATION_LIMIT) &&
  @     calibration_number(most, 0, KEEL_CALIBRATION_LIMIT) && most < least;
  @ assigns \nothing;
  @ ensures CAL_016_side: \result <= KEEL_CALIBRATION_SIDES;
  @ ensures CAL_016_none: !calibration_three(mean, -KEEL_CALIBRATION_LIMIT,
  @     KEEL_CALIBRATION_LIMIT) ==> \result == KEEL_CALIBRATION_SIDES;
  @ ensures CAL_016_up: \forall integer k; 0 <= k < 3 && \result == 2 * k ==> mean[k] >= least;
  @ ensures CAL_016_down: \forall integer k; 0 <= k < 3 && \result == 2 * k + 1 ==>
  @     mean[k] <= -least;
  @*/
uint32_t keel_calibration_side(const float mean[KEEL_CALIBRATION_AXES], float least, float most);

/*@ requires \valid_read(sides) && \valid(correction) && \separated(sides, correction);
  @ assigns *correction;
  @ ensures CAL_017_value: !calibration_sides(*sides) <==> \result == KEEL_ERR_VALUE;
  @ ensures CAL_017_kept: \result != KEEL_OK ==> *correction == \old(*correction);
  @ ensures CAL_017_taken: \result == KEEL_OK ==> calibration_correction(correction) &&
  @     calibration_three(&correction->offset[0], -sides->limit, sides->limit);
  @*/
keel_status_t keel_calibration_six(const keel_calibration_sides_t *sides,
                                   keel_calibration_correction_t *correction);

/*@ requires \valid_read(turn) && \valid_read(raw + (0 .. 2)) && \valid(out) &&
  @     \separated(turn, out) && \separated(raw + (0 .. 2), out);
  @ assigns *out;
  @ ensures CAL_018_finite: calibration_turn(turn) && calibration_three(raw,
  @     -4 * KEEL_CALIBRATION_LIMIT, 4 * KEEL_CALIBRATION_LIMIT) ==>
  @     calibration_three(&out->axis[0], -16 * KEEL_CALIBRATION_LIMIT, 16 * KEEL_CALIBRATION_LIMIT);
  @*/
void keel_calibration_turn(const keel_calibration_rotation_t *turn,
                           const float raw[KEEL_CALIBRATION_AXES], keel_calibration_vector_t *out);

KEEL_C_END

#endif
