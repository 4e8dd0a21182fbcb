/* SPDX-License-Identifier: Apache-2.0 */
/* Navigation: where the aircraft is and how it moves, from home. */
#include "copter.h"

#include "keel/middleware/range.h"

/* The rows of the attitude's matrix: see attitude.h. */
typedef struct frame {
    keel_attitude_vector_t north;
    keel_attitude_vector_t east;
    keel_attitude_vector_t down;
} frame_t;

keel_status_t copter_estimate_init(copter_estimate_t *estimate)
{
    keel_status_t status = keel_altitude_init(&estimate->altitude, &copter_settings.altitude);

    if (status == KEEL_OK) {
        status = copter_vertical_init(&estimate->vertical);
    }
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

/* Whether a fix is farther from the origin than the aircraft may fly from home. */
static bool is_elsewhere(const keel_position_t *position, const copter_fix_t *fix)
{
    const float most = 2.0f * copter_settings.cascade.reach[KEEL_CASCADE_NORTH];
    const float north = position->north_scale * ((float)fix->latitude - (float)position->latitude);
    const float east = position->east_scale * ((float)fix->longitude - (float)position->longitude);

    return !keel_range_contains(north, -most, most) || !keel_range_contains(east, -most, most);
}

/* The first good fix is where positions are measured from. On the ground a later one replaces it
 * that is far from there: receivers are wrong in their first seconds, and aircraft are carried. */
static void find_origin(copter_estimate_t *self, const copter_t *copter)
{
    const copter_fix_t *const fix = &copter->gps.fix;

    if (fix->is_valid && (fix->accuracy <= copter_settings.position.accuracy) &&
        (!self->position.has_origin ||
         (!copter->state.mode.motors && is_elsewhere(&self->position, fix))) &&
        (keel_position_set_origin(&self->position, fix->latitude, fix->longitude) == KEEL_OK)) {
        self->field = copter_wmm_field(fix->latitude, fix->longitude);
        self->fields++;
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
static void step_estimators(copter_estimate_t *self, const copter_t *copter, const frame_t *frame,
                            const copter_force_t *force, bool last)
{
    const bool has_force = force->is_known && (copter->imu.attitude.phase == KEEL_ATTITUDE_RUNNING);
    const copter_vertical_force_t lift = {.acceleration = -dot(force->mean, frame->down) -
                                                          KEEL_CASCADE_GRAVITY,
                                          .is_known = has_force};
    const keel_altitude_sample_t vertical = {
        .pressure = copter->barometer.pressure_pa,
        .acceleration = lift.acceleration,
        .has_pressure = last && (copter->barometer.samples != self->pressures),
        .has_acceleration = has_force};
    const keel_position_sample_t horizontal = {
        .fix = fix_of(&copter->gps.fix),
        .north = dot(force->mean, frame->north),
        .east = dot(force->mean, frame->east),
        .has_fix = last && (copter->gps.fixes != self->fixes),
        .has_acceleration = has_force && copter->imu.attitude.heading_valid};

    if (last) {
        self->pressures = copter->barometer.samples;
        self->fixes = copter->gps.fixes;
    }
    if (horizontal.has_fix) {
        find_origin(self, copter);
    }
    keel_altitude_step(&self->altitude, &vertical);
    copter_vertical_step(self, copter, &lift, horizontal.has_fix);
    keel_position_step(&self->position, &horizontal);
}

/* As many steps as blocks have passed: a run that comes late makes up for those before it. */
static void catch_up(copter_estimate_t *self, const copter_t *copter, const frame_t *frame)
{
    const copter_imu_t *const imu = &copter->imu;
    const keel_cascade_vector_t before = {
        self->position.north.position, self->position.east.position, self->altitude.axis.position};

    if ((imu->blocks - self->blocks) > COPTER_BLOCKS) {
        self->blocks = imu->blocks - COPTER_BLOCKS;
    }
    while (self->blocks != imu->blocks) {
        const copter_force_t *const force = &imu->force[self->blocks % COPTER_BLOCKS];

        self->blocks++;
        step_estimators(self, copter, frame, force, self->blocks == imu->blocks);
    }
    tell_reset(self, &before);
}

/* Home is where the aircraft last took off. */
static void find_home(copter_estimate_t *self, const copter_state_t *state)
{
    if (state->homes != self->homes) {
        self->homes = state->homes;
        self->home_north = self->position.north.position;
        self->home_east = self->position.east.position;
        keel_altitude_zero(&self->altitude);
    }
}

void copter_navigation(copter_estimate_t *self, const copter_t *copter)
{
    const frame_t frame = frame_of(&copter->imu.attitude);

    catch_up(self, copter, &frame);
    find_home(self, &copter->state);
    self->here = (keel_cascade_estimate_t){
        .position = {self->position.north.position - self->home_north,
                     self->position.east.position - self->home_east, self->here.position.up},
        .velocity = {self->position.north.velocity, self->position.east.velocity, 0.0f},
        .forward_north = frame.north.x,
        .forward_east = frame.east.x,
        .has_place = self->position.quality != KEEL_AXIS_NONE};
    copter_vertical_tell(self);
    copter_vertical_conclude(self, copter);
}
