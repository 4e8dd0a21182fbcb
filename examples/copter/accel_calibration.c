/* SPDX-License-Identifier: Apache-2.0 */
/* A part of calibration IMU: accelerometers on six sides, and how sensors are mounted. Both are for
 * the ground, and begin when a ground station asks. */
#include "copter.h"

#include <math.h>

#define GRAVITY     9.80665f
#define SIDE_LEAST  (0.75f * GRAVITY)
#define SIDE_MOST   (0.125f * GRAVITY) /* It may lean by 7 degrees. */
#define ALL_SIDES   ((1u << KEEL_CALIBRATION_SIDES) - 1u)
#define FEEL_COUNT  10u   /* Samples, of half a second, until a side is told. */
#define PATIENCE    2400u /* Runs, of 2 minutes, for a side. */
#define TRIM_MOST   0.2f  /* TRIM_ROLL and TRIM_PITCH take as much. */
#define OFFSET_MOST 2.0f  /* ACC1_OFF_X and so on take as much. */

static void begin_rests(copter_accel_calibration_t *self)
{
    for (uint32_t unit = 0u; unit < self->units; unit++) {
        keel_calibration_rest_begin(&self->rest[unit]);
    }
    self->side = (uint8_t)KEEL_CALIBRATION_SIDES;
}

keel_status_t copter_accel_calibration_init(copter_accel_calibration_t *self, uint32_t units)
{
    keel_status_t status = KEEL_OK;

    self->units = units;
    for (uint32_t unit = 0u; (unit < units) && (status == KEEL_OK); unit++) {
        status = keel_calibration_rest_init(&self->rest[unit], &copter_settings.side);
        self->sides[unit] = (keel_calibration_sides_t){.gravity = GRAVITY, .limit = OFFSET_MOST};
    }
    self->levelling = (uint8_t)COPTER_LEVELLING_NONE;
    self->end = (uint8_t)COPTER_LEVELLED_NOT;
    return status;
}

/* Turned to the right by yaw, then nose up by pitch, then rolled to the right. */
static keel_calibration_rotation_t mounted(float roll, float pitch, float yaw)
{
    const float cr = cosf(roll);
    const float sr = sinf(roll);
    const float cp = cosf(pitch);
    const float sp = sinf(pitch);
    const float cy = cosf(yaw);
    const float sy = sinf(yaw);

    return (keel_calibration_rotation_t){
        .x = {cp * cy, (sr * sp * cy) - (cr * sy), (cr * sp * cy) + (sr * sy)},
        .y = {cp * sy, (sr * sp * sy) + (cr * cy), (cr * sp * sy) - (sr * cy)},
        .z = {-sp, sr * cp, cr * cp}};
}

/* First by one, then by the other. */
static keel_calibration_rotation_t then(const keel_calibration_rotation_t *first,
                                        const keel_calibration_rotation_t *other)
{
    keel_calibration_rotation_t both;

    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        const float column[KEEL_CALIBRATION_AXES] = {first->x[k], first->y[k], first->z[k]};
        keel_calibration_vector_t turned;

        keel_calibration_turn(other, column, &turned);
        both.x[k] = turned.axis[0];
        both.y[k] = turned.axis[1];
        both.z[k] = turned.axis[2];
    }
    return both;
}

static bool is_none(float angle)
{
    return (angle >= 0.0f) && (angle <= 0.0f);
}

void copter_accel_calibration_set(copter_accel_calibration_t *self)
{
    const float *const board = copter_settings.board;
    const float *const trim = copter_settings.trim;
    const keel_calibration_rotation_t trimmed = mounted(trim[0], trim[1], 0.0f);

    self->board = mounted(board[0], board[1], board[2]);
    self->turn = then(&self->board, &trimmed);
    self->is_turned = !(is_none(board[0]) && is_none(board[1]) && is_none(board[2]) &&
                        is_none(trim[0]) && is_none(trim[1]));
    for (uint32_t unit = 0u; unit < self->units; unit++) {
        self->correction[unit] = copter_settings.correction[unit];
    }
}

static void finish_levelling(copter_accel_calibration_t *self, copter_levelled_t end)
{
    self->levelling = (uint8_t)COPTER_LEVELLING_NONE;
    self->end = (uint8_t)end;
}

void copter_accel_calibration_ask(copter_accel_calibration_t *self, uint8_t levelling)
{
    if (levelling == (uint8_t)COPTER_LEVELLING_NONE) {
        finish_levelling(self, COPTER_LEVELLED_CANCELLED);
    } else {
        self->levelling = levelling;
        self->end = (uint8_t)COPTER_LEVELLED_NOT;
        self->seen = 0u;
        self->waited = 0u;
        begin_rests(self);
    }
}

static void step_rests(copter_accel_calibration_t *self, const copter_t *copter)
{
    for (uint32_t unit = 0u; unit < self->units; unit++) {
        const keel_virtual_imu_sample_t *const sample = &copter->imu.unit[unit];

        if (sample->present) {
            keel_calibration_rest_step(&self->rest[unit], sample->value);
        }
    }
}

/* Whether all rest together since so many samples; begins again when one moves. */
static bool have_rested(copter_accel_calibration_t *self, uint32_t count)
{
    bool rest = true;
    bool moves = false;

    for (uint32_t unit = 0u; unit < self->units; unit++) {
        rest = rest && (self->rest[unit].count >= count);
        moves = moves || copter_has_moved(&self->rest[unit]);
    }
    if (moves) {
        begin_rests(self);
    }
    return rest && !moves;
}

/* The side on which all units lie, by their first samples or by their means. */
static uint8_t side_of(const copter_accel_calibration_t *self, bool by_means)
{
    const keel_calibration_rest_t *const rest = self->rest;
    const uint32_t side = keel_calibration_side(by_means ? rest[0].offset : rest[0].first,
                                                SIDE_LEAST, SIDE_MOST);
    bool alike = true;

    for (uint32_t unit = 1u; unit < self->units; unit++) {
        const float *const said = by_means ? rest[unit].offset : rest[unit].first;

        alike = alike && (keel_calibration_side(said, SIDE_LEAST, SIDE_MOST) == side);
    }
    return (uint8_t)(alike ? side : KEEL_CALIBRATION_SIDES);
}

/* The board may be mounted so that the vehicle's side is another. */
static uint8_t shown_side(const copter_accel_calibration_t *self)
{
    keel_calibration_vector_t turned;
    uint32_t side;

    keel_calibration_turn(&self->board, self->rest[0].first, &turned);
    side = keel_calibration_side(turned.axis, SIDE_LEAST, SIDE_MOST);
    return (side < KEEL_CALIBRATION_SIDES) ? (uint8_t)side : self->side;
}

/* Corrections of all units are taken, or none is. Parameters that keep them put them in force. */
static void finish_sides(copter_accel_calibration_t *self)
{
    keel_calibration_correction_t found[COPTER_IMUS];
    keel_status_t status = KEEL_OK;

    for (uint32_t unit = 0u; (unit < self->units) && (status == KEEL_OK); unit++) {
        status = keel_calibration_six(&self->sides[unit], &found[unit]);
    }
    for (uint32_t unit = 0u; (unit < self->units) && (status == KEEL_OK); unit++) {
        self->found[unit] = found[unit];
    }
    finish_levelling(self, (status == KEEL_OK) ? COPTER_LEVELLED_DONE : COPTER_LEVELLED_BEYOND);
}

static void take_side(copter_accel_calibration_t *self, uint8_t side)
{
    const uint32_t axis = side / 2u;
    const bool is_up = (side % 2u) == 0u;

    for (uint32_t unit = 0u; unit < self->units; unit++) {
        float *const to = is_up ? self->sides[unit].up : self->sides[unit].down;

        to[axis] = self->rest[unit].offset[axis];
    }
    self->seen |= 1u << side;
    self->waited = 0u;
}

static void step_sides(copter_accel_calibration_t *self)
{
    if (have_rested(self, FEEL_COUNT)) {
        self->side = side_of(self, false);
        self->shown = shown_side(self);
    }
    if (have_rested(self, copter_settings.side.samples)) {
        const uint8_t side = side_of(self, true);

        if ((side < KEEL_CALIBRATION_SIDES) && (side == self->side) &&
            ((self->seen & (1u << side)) == 0u)) {
            take_side(self, side);
        }
        begin_rests(self);
    }
    if (self->seen == ALL_SIDES) {
        finish_sides(self);
    }
}

/* What the units' mean says of gravity is straight down once it is rolled and pitched back. */
static void step_level(copter_accel_calibration_t *self)
{
    keel_calibration_vector_t mean = {{0.0f, 0.0f, 0.0f}};
    keel_calibration_vector_t down;

    if (!have_rested(self, copter_settings.side.samples)) {
        return;
    }
    for (uint32_t unit = 0u; unit < self->units; unit++) {
        keel_calibration_vector_t force;

        keel_calibration_correct(&self->correction[unit], self->rest[unit].offset, &force);
        for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
            mean.axis[k] += force.axis[k];
        }
    }
    keel_calibration_turn(&self->board, mean.axis, &down);
    self->trim[0] = atan2f(-down.axis[1], -down.axis[2]);
    self->trim[1] = atan2f(down.axis[0],
                           sqrtf((down.axis[1] * down.axis[1]) + (down.axis[2] * down.axis[2])));
    finish_levelling(self,
                     ((fabsf(self->trim[0]) <= TRIM_MOST) && (fabsf(self->trim[1]) <= TRIM_MOST))
                         ? COPTER_LEVELLED_DONE
                         : COPTER_LEVELLED_BEYOND);
}

void copter_accel_calibration_step(copter_accel_calibration_t *self, const copter_t *copter)
{
    if (self->levelling == (uint8_t)COPTER_LEVELLING_NONE) {
        return;
    }
    self->waited++;
    step_rests(self, copter);
    if (copter->state.mode.motors) {
        finish_levelling(self, COPTER_LEVELLED_CANCELLED);
    } else if (self->waited > PATIENCE) {
        finish_levelling(self, COPTER_LEVELLED_LATE);
    } else if (self->levelling == (uint8_t)COPTER_LEVELLING_SIDES) {
        step_sides(self);
    } else {
        step_level(self);
    }
}
