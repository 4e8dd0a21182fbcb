/* SPDX-License-Identifier: Apache-2.0 */
/* Navigation: where the aircraft is and how it moves, from home. */
#include "copter.h"

/* The rows of the attitude's matrix: see attitude.h. */
typedef struct frame {
    keel_attitude_vector_t north;
    keel_attitude_vector_t east;
    keel_attitude_vector_t down;
} frame_t;

keel_status_t copter_estimate_init(copter_estimate_t *estimate)
{
    const keel_status_t status = keel_altitude_init(&estimate->altitude, &copter_settings.altitude);

    return (status == KEEL_OK) ? keel_position_init(&estimate->position, &copter_settings.position)
                               : status;
}

static frame_t frame_of(const keel_attitude_t *attitude)
{
    const keel_attitude_quaternion_t q = attitude->quaternion;
    const frame_t frame = {
        .north = {1.0f - (2.0f * ((q.y * q.y) + (q.z * q.z))), 2.0f * ((q.x * q.y) - (q.w * q.z)),
                  2.0f * ((q.x * q.z) + (q.w * q.y))},
        .east = {2.0f * ((q.x * q.y) + (q.w * q.z)), 1.0f - (2.0f * ((q.x * q.x) + (q.z * q.z))),
                 2.0f * ((q.y * q.z) - (q.w * q.x))},
        .down = keel_attitude_down(attitude)};

    return frame;
}

static float dot(keel_attitude_vector_t a, keel_attitude_vector_t b)
{
    return (a.x * b.x) + (a.y * b.y) + (a.z * b.z);
}

static keel_position_fix_t fix_of(const copter_fix_t *fix)
{
    return (keel_position_fix_t){.latitude = fix->latitude,
                                 .longitude = fix->longitude,
                                 .north = fix->north,
                                 .east = fix->east,
                                 .accuracy = fix->accuracy,
                                 .speed_accuracy = fix->speed_accuracy,
                                 .is_valid = fix->is_valid};
}

/* The first good fix is where positions are measured from. */
static void find_origin(copter_estimate_t *self, const copter_fix_t *fix)
{
    if (!self->position.has_origin && fix->is_valid &&
        (fix->accuracy <= copter_settings.position.accuracy)) {
        (void)keel_position_set_origin(&self->position, fix->latitude, fix->longitude);
    }
}

/* The distance that a contradicting fix moved an estimate by at its restart; 0 without one. */
static float reset_of(const keel_axis_t *axis, float before)
{
    return ((axis->flags & KEEL_AXIS_BEGUN) != 0u) ? (axis->position - before) : 0.0f;
}

/* Whoever holds a place has to follow when the estimate of it jumps. */
static void tell_reset(copter_estimate_t *self, const keel_cascade_vector_t *before)
{
    const keel_cascade_vector_t by = {reset_of(&self->position.north, before->north),
                                      reset_of(&self->position.east, before->east),
                                      reset_of(&self->altitude.axis, before->up)};

    if ((by.north != 0.0f) || (by.east != 0.0f) || (by.up != 0.0f)) {
        self->reset_by = by;
        self->resets++;
    }
}

/* A step of both estimators, a block of the inertial unit's after the other. Other samples
 * are for the last of them. */
static void step_estimators(copter_t *copter, const frame_t *frame, const copter_force_t *force,
                            bool last)
{
    copter_estimate_t *const self = &copter->estimate;
    const bool has_force = force->is_known &&
                           (copter->inertia.attitude.phase == KEEL_ATTITUDE_RUNNING);
    const keel_altitude_sample_t vertical = {
        .pressure = copter->air.pressure_pa,
        .acceleration = -dot(force->mean, frame->down) - KEEL_CASCADE_GRAVITY,
        .has_pressure = last && (copter->air.samples != self->pressures),
        .has_acceleration = has_force};
    const keel_position_sample_t horizontal = {
        .fix = fix_of(&copter->satellites.fix),
        .north = dot(force->mean, frame->north),
        .east = dot(force->mean, frame->east),
        .has_fix = last && (copter->satellites.fixes != self->fixes),
        .has_acceleration = has_force && copter->inertia.attitude.heading_valid};

    if (last) {
        self->pressures = copter->air.samples;
        self->fixes = copter->satellites.fixes;
    }
    if (horizontal.has_fix) {
        find_origin(self, &copter->satellites.fix);
    }
    keel_altitude_step(&self->altitude, &vertical);
    keel_position_step(&self->position, &horizontal);
}

/* As many steps as blocks have passed: a run that comes late makes up for those before it. */
static void catch_up(copter_t *copter, const frame_t *frame)
{
    copter_estimate_t *const self = &copter->estimate;
    const copter_inertia_t *const inertia = &copter->inertia;
    const keel_cascade_vector_t before = {
        self->position.north.position, self->position.east.position, self->altitude.axis.position};

    if ((inertia->blocks - self->blocks) > COPTER_BLOCKS) {
        self->blocks = inertia->blocks - COPTER_BLOCKS;
    }
    while (self->blocks != inertia->blocks) {
        const copter_force_t *const force = &inertia->force[self->blocks % COPTER_BLOCKS];

        self->blocks++;
        step_estimators(copter, frame, force, self->blocks == inertia->blocks);
    }
    tell_reset(self, &before);
}

/* Home is where the aircraft last took off. */
static void find_home(copter_t *copter)
{
    copter_estimate_t *const self = &copter->estimate;

    if (copter->state.homes != self->homes) {
        self->homes = copter->state.homes;
        self->home_north = self->position.north.position;
        self->home_east = self->position.east.position;
        keel_altitude_zero(&self->altitude);
    }
}

static bool is_within(float value, float limit)
{
    return (value <= limit) && (value >= -limit);
}

/* Whether the aircraft neither turns, nor rises or sinks, nor slides to a stop. */
static bool is_calm(const copter_t *copter)
{
    const copter_inertia_t *const inertia = &copter->inertia;
    const keel_attitude_vector_t rate = inertia->attitude.rate;
    const keel_attitude_vector_t force = inertia->force[(inertia->blocks - 1u) % COPTER_BLOCKS]
                                             .mean;

    return is_within(rate.x, copter_settings.landed_rate) &&
           is_within(rate.y, copter_settings.landed_rate) &&
           is_within(rate.z, copter_settings.landed_rate) &&
           is_within(force.x, copter_settings.landed_force) &&
           is_within(force.y, copter_settings.landed_force) &&
           is_within(copter->estimate.altitude.axis.velocity, copter_settings.landed_speed);
}

/* On the ground it is calm though the motors push less than its weight. */
static bool is_landed(const copter_t *copter)
{
    return !copter->state.mode.motors ||
           (is_calm(copter) &&
            (copter->control.cascade.command.thrust < copter_settings.landed_thrust));
}

void copter_navigation(copter_t *copter)
{
    copter_estimate_t *const self = &copter->estimate;
    const frame_t frame = frame_of(&copter->inertia.attitude);

    catch_up(copter, &frame);
    find_home(copter);
    self->here = (keel_cascade_estimate_t){
        .position = {self->position.north.position - self->home_north,
                     self->position.east.position - self->home_east, self->altitude.height},
        .velocity = {self->position.north.velocity, self->position.east.velocity,
                     self->altitude.axis.velocity},
        .forward_north = frame.north.x,
        .forward_east = frame.east.x,
        .has_place = self->position.quality != KEEL_AXIS_NONE,
        .has_height = self->altitude.axis.quality != KEEL_AXIS_NONE};
    self->is_landed = is_landed(copter);
}
