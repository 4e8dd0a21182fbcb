/* SPDX-License-Identifier: Apache-2.0 */
/* Height by the barometer or, when that falls silent, by the satellites; the thrust that hovers;
 * and whether the aircraft stands on the ground. */
#include "copter.h"

#include "keel/middleware/range.h"

#define PERIOD_S      0.02f  /* Of navigation: table 2. */
#define OFFSET_PART   0.02f  /* Of a difference between both heights, made up for in a step. */
#define SPEED_S       2.0f   /* In this time the speed by acceleration alone is forgotten. */
#define HOVER_PART    0.02f  /* Of a difference in the thrust that hovers, in a step. */
#define HOVER_LEAST   0.4f   /* Of what is configured. */
#define HOVER_MOST    2.0f   /* Of what is configured. */
#define LIFT_LEAST    3.0f   /* With less lift, thrust over lift says little; in m/s^2. */
#define UPRIGHT       0.8f   /* The least cosine of the tilt with which it learns. */
#define LEAVES_SPEED  0.5f   /* Faster than this, up or down, it is in the air; in m/s. */
#define LANDED_SHARE  0.75f  /* On the ground the motors push less than this part of hovering. */
#define SINKS         -0.25f /* Who asks for this climb rate or less asks for the ground; in m/s. */
#define ON_ITS_SIDE   0.5f   /* The cosine of 60 degrees. */
#define SUPPORT_LEAST 8.0f /* What carries an aircraft that lies still, in m/s^2: g, within 18 %. */
#define SUPPORT_MOST  11.6f
#define CRASH_STEPS   100u /* Of navigation: 2 s. */
#define TOUCH_STEPS   25u  /* Of navigation: 0.5 s. */
#define REST_STEPS    15u  /* Of navigation: 0.3 s. */

keel_status_t copter_vertical_init(copter_vertical_t *vertical)
{
    vertical->hover = copter_settings.cascade.hover;
    return keel_axis_init(&vertical->gps, &copter_settings.position.axis);
}

/* Where the receiver's height counts from: where it was when it first could be used. */
static void find_zero(copter_vertical_t *self, const copter_fix_t *fix, bool usable)
{
    if (usable && !self->has_zero) {
        self->zero = fix->height;
        self->has_zero = true;
    }
}

static void step_gps(copter_vertical_t *self, const copter_fix_t *fix, bool has_fix,
                     const copter_vertical_force_t *force)
{
    const bool usable = has_fix && fix->is_valid &&
                        (fix->height_accuracy <= copter_settings.height_accuracy);

    find_zero(self, fix, usable);
    {
        const keel_axis_sample_t sample = {.acceleration = force->acceleration,
                                           .position = fix->height - self->zero,
                                           .velocity = fix->climb,
                                           .has_acceleration = force->is_known,
                                           .has_fix = has_fix,
                                           .has_velocity = fix->speed_accuracy <=
                                                           copter_settings.position.speed_accuracy,
                                           .is_usable = usable};

        keel_axis_step(&self->gps, &sample);
    }
}

/* Both heights count from the same place while both are known. */
static void compare_heights(copter_vertical_t *self, const keel_altitude_t *altitude)
{
    const float apart = self->gps.position - altitude->height;

    if ((altitude->axis.quality == KEEL_AXIS_NONE) || (self->gps.quality == KEEL_AXIS_NONE)) {
        return;
    }
    self->offset = self->has_offset ? (self->offset + (OFFSET_PART * (apart - self->offset)))
                                    : apart;
    self->has_offset = true;
}

static uint8_t source_of(const copter_vertical_t *self, const keel_altitude_t *altitude)
{
    if (altitude->axis.quality != KEEL_AXIS_NONE) {
        return COPTER_HEIGHT_BAROMETER;
    }
    return ((self->gps.quality != KEEL_AXIS_NONE) && self->has_offset) ? COPTER_HEIGHT_GPS
                                                                       : COPTER_HEIGHT_NONE;
}

void copter_vertical_step(copter_estimate_t *estimate, const copter_t *copter,
                          const copter_vertical_force_t *force, bool has_fix)
{
    copter_vertical_t *const self = &estimate->vertical;
    const keel_altitude_t *const altitude = &estimate->altitude;
    const float known = force->is_known ? force->acceleration : 0.0f;

    step_gps(self, &copter->gps.fix, has_fix, force);
    compare_heights(self, altitude);
    self->speed += PERIOD_S * ((known - altitude->axis.bias) - (self->speed / SPEED_S));
    self->speed = keel_range_clamp(self->speed, -KEEL_AXIS_VELOCITY_LIMIT,
                                   KEEL_AXIS_VELOCITY_LIMIT);
}

void copter_vertical_tell(copter_estimate_t *estimate)
{
    copter_vertical_t *const self = &estimate->vertical;
    keel_cascade_estimate_t *const here = &estimate->here;
    const uint8_t source = source_of(self, &estimate->altitude);
    const float before = here->position.up;

    if (source == COPTER_HEIGHT_BAROMETER) {
        here->position.up = estimate->altitude.height;
        here->velocity.up = estimate->altitude.axis.velocity;
        self->quality = estimate->altitude.axis.quality;
    } else if (source == COPTER_HEIGHT_GPS) {
        here->position.up = self->gps.position - self->offset;
        here->velocity.up = self->gps.velocity;
        self->quality = self->gps.quality;
    } else {
        here->velocity.up = self->speed;
        self->quality = KEEL_AXIS_NONE;
    }
    here->has_height = source != COPTER_HEIGHT_NONE;
    if (here->has_height && (self->source != source)) {
        estimate->reset_by = (keel_cascade_vector_t){0.0f, 0.0f, here->position.up - before};
        estimate->resets++;
    }
    self->source = source;
}

static bool is_within(float value, float limit)
{
    return keel_range_contains(value, -limit, limit);
}

static bool turns_little(const copter_t *copter)
{
    const keel_attitude_vector_t rate = copter->imu.attitude.rate;

    return is_within(rate.x, copter_settings.landed_rate) &&
           is_within(rate.y, copter_settings.landed_rate) &&
           is_within(rate.z, copter_settings.landed_rate);
}

static keel_attitude_vector_t last_force(const copter_imu_t *imu)
{
    return imu->force[(imu->blocks - 1u) % COPTER_BLOCKS].mean;
}

/* Whether its speed stays as it is. On a slope the ground pushes sideways, too: what is left of the
 * force without gravity counts. */
static bool accelerates_little(const copter_t *copter)
{
    const keel_attitude_vector_t force = last_force(&copter->imu);
    const keel_attitude_vector_t down = copter->imu.down;
    const float most = copter_settings.landed_acceleration;

    return is_within(force.x + (KEEL_CASCADE_GRAVITY * down.x), most) &&
           is_within(force.y + (KEEL_CASCADE_GRAVITY * down.y), most);
}

/* Whether the aircraft neither turns, nor rises or sinks, nor slides to a stop. */
static bool is_calm(const copter_t *copter)
{
    return turns_little(copter) && accelerates_little(copter) &&
           is_within(copter->estimate.here.velocity.up, copter_settings.landed_speed);
}

/* Whether it is let down: a descent is asked for, or nobody has asked for a take-off yet. Where the
 * throttle is the thrust, that is low. */
static bool is_let_down(const copter_t *copter)
{
    const keel_mode_t *const machine = &copter->state.mode;
    const bool thrusts = (machine->mode == KEEL_MODE_ACRO) || (machine->mode == KEEL_MODE_ANGLE);

    return (machine->state == KEEL_MODE_ARMED) || (machine->mode == KEEL_MODE_LAND) || thrusts ||
           (copter->control.asked.up <= SINKS);
}

static bool pushes_little(const copter_t *copter)
{
    const float hover = copter->estimate.vertical.hover;

    return copter->control.cascade.command.thrust < (LANDED_SHARE * hover);
}

/* It has landed when a descent is asked for and does not happen, though the motors push less than
 * its weight. From then on it stands until it moves or the motors push. Idling motors shake it in
 * such a way that no filter takes it for calm; but then they do not carry it. */
static bool is_landed(const copter_t *copter)
{
    const copter_estimate_t *const estimate = &copter->estimate;

    return !copter->state.mode.motors || estimate->vertical.is_crashed ||
           ((is_calm(copter) || estimate->rests) && pushes_little(copter) &&
            (estimate->is_landed || is_let_down(copter)));
}

/* A descent is asked for, and not a quarter of it happens: it may stand on the ground. A place that
 * is held there would only tilt it. */
static void heed_touch(copter_estimate_t *estimate, const copter_t *copter)
{
    copter_vertical_t *const self = &estimate->vertical;
    const float asked = copter->control.asked.up;

    if (copter->state.mode.motors && (asked <= SINKS) &&
        (estimate->here.velocity.up > (0.25f * asked))) {
        self->touching += (self->touching < TOUCH_STEPS) ? 1u : 0u;
    } else {
        self->touching = 0u;
    }
    estimate->touches = self->touching == TOUCH_STEPS;
}

/* It touches, and the motors push less than its weight: the ground carries it. On a slope it would
 * balance on two legs, as controllers that want it level raise the thrust. They let go, and it
 * stands as the ground does. One that falls all the same no longer touches. */
static void heed_rest(copter_estimate_t *estimate, const copter_t *copter)
{
    copter_vertical_t *const self = &estimate->vertical;

    if (estimate->touches && pushes_little(copter)) {
        self->resting += (self->resting < REST_STEPS) ? 1u : 0u;
    } else {
        self->resting = 0u;
    }
    estimate->rests = self->resting == REST_STEPS;
}

/* Something carries it, and that is not the motors: it lies still, and on its side or its back. */
static bool lies(const copter_t *copter)
{
    const keel_attitude_vector_t force = last_force(&copter->imu);
    const keel_attitude_vector_t down = copter->imu.down;
    const float support = -((force.x * down.x) + (force.y * down.y) + (force.z * down.z));

    return (copter->imu.attitude.phase == KEEL_ATTITUDE_RUNNING) && (down.z < ON_ITS_SIDE) &&
           turns_little(copter) && keel_range_contains(support, SUPPORT_LEAST, SUPPORT_MOST);
}

/* Motors stand from then on, until it is disarmed. */
static void heed_crash(copter_vertical_t *self, const copter_t *copter)
{
    if (!copter->state.mode.motors) {
        self->lying = 0u;
        self->is_crashed = false;
    } else if (!self->is_crashed) {
        self->lying = lies(copter) ? (self->lying + 1u) : 0u;
        self->is_crashed = self->lying >= CRASH_STEPS;
    } else {
        /* It stays so. */
    }
}

/* Thrust over lift, both along the body, is what hovers over g, however it moves. */
static void learn_hover(copter_vertical_t *self, const copter_t *copter)
{
    const float lift = -last_force(&copter->imu).z;
    const float thrust = copter->control.cascade.command.thrust;
    const uint32_t gave_way = copter->control.mixer.limited &
                              (KEEL_MIXER_RAISED | KEEL_MIXER_LOWERED);
    const float configured = copter_settings.cascade.hover;

    if (self->is_up && (gave_way == 0u) && (lift > LIFT_LEAST) && (copter->imu.down.z > UPRIGHT)) {
        const float hovers = (thrust * KEEL_CASCADE_GRAVITY) / lift;

        self->hover = keel_range_clamp(self->hover + (HOVER_PART * (hovers - self->hover)),
                                       HOVER_LEAST * configured, HOVER_MOST * configured);
    }
}

void copter_vertical_conclude(copter_estimate_t *estimate, const copter_t *copter)
{
    copter_vertical_t *const self = &estimate->vertical;

    heed_crash(self, copter);
    heed_touch(estimate, copter);
    heed_rest(estimate, copter);
    estimate->is_landed = is_landed(copter);
    if (estimate->is_landed) {
        self->is_up = false;
    } else if (!is_within(estimate->here.velocity.up, LEAVES_SPEED)) {
        self->is_up = true;
    } else {
        /* It stays what it was. */
    }
    learn_hover(self, copter);
}
