/* SPDX-License-Identifier: Apache-2.0 */
/* The state machine: it is told plain facts, and says which mode flies and whether motors turn. */
#include "copter.h"

#include "keel/middleware/range.h"

#include <stddef.h>

#define UNCONFIRMED_RUNS 25u /* Half a second. */

keel_status_t copter_state_machine_init(copter_state_t *state)
{
    return keel_mode_init(&state->mode, &copter_settings.mode);
}

static uint32_t bit_when(bool condition, uint32_t bit)
{
    return condition ? bit : 0u;
}

/* A good estimate stays one while it is known at all: single fixes may fail. */
static bool is_good(keel_axis_quality_t quality, uint32_t before, uint32_t fact)
{
    return (quality == KEEL_AXIS_GOOD) || ((quality == KEEL_AXIS_POOR) && ((before & fact) != 0u));
}

static bool is_beyond(float distance, float limit)
{
    return (distance > limit) || (distance < -limit);
}

/* The side of the fence that the aircraft is beyond. */
static copter_side_t side_of(const copter_t *copter)
{
    const keel_cascade_vector_t place = copter->estimate.here.position;
    const float *const reach = copter_settings.cascade.reach;
    copter_side_t side = COPTER_SIDE_NONE;

    if (is_beyond(place.north, reach[KEEL_CASCADE_NORTH]) ||
        is_beyond(place.east, reach[KEEL_CASCADE_EAST])) {
        side = COPTER_SIDE_AROUND;
    } else if (is_beyond(place.up, reach[KEEL_CASCADE_HEIGHT])) {
        side = (place.up > 0.0f) ? COPTER_SIDE_HIGH : COPTER_SIDE_LOW;
    } else {
        /* It is inside. */
    }
    return side;
}

static bool is_home(const copter_t *copter)
{
    const keel_cascade_vector_t place = copter->estimate.here.position;

    return !is_beyond(place.north, copter_settings.home_radius) &&
           !is_beyond(place.east, copter_settings.home_radius);
}

/* Home is where it takes off: before, there is none to be away from. */
static bool has_home(const copter_t *copter)
{
    return copter->state.mode.motors && (copter->estimate.homes == copter->state.homes);
}

static uint32_t facts_of(const copter_t *copter)
{
    const copter_estimate_t *const estimate = &copter->estimate;
    const keel_battery_level_t level = copter->power.battery.level;
    const uint32_t before = copter->state.mode.seen;
    const bool has_place = is_good(estimate->position.quality, before, KEEL_MODE_POSITION_VALID) &&
                           copter->imu.attitude.heading_valid;

    return bit_when(estimate->is_landed, KEEL_MODE_LANDED) |
           bit_when(has_place && is_home(copter), KEEL_MODE_AT_HOME) |
           bit_when(copter->imu.attitude.phase == KEEL_ATTITUDE_RUNNING, KEEL_MODE_ATTITUDE_VALID) |
           bit_when(is_good(estimate->vertical.quality, before, KEEL_MODE_ALTITUDE_VALID),
                    KEEL_MODE_ALTITUDE_VALID) |
           bit_when(has_place, KEEL_MODE_POSITION_VALID) |
           bit_when(has_place && has_home(copter) && (side_of(copter) != COPTER_SIDE_NONE),
                    KEEL_MODE_FENCE_BREACHED) |
           bit_when(level >= KEEL_BATTERY_LOW, KEEL_MODE_BATTERY_CRITICAL) |
           bit_when(level >= KEEL_BATTERY_CRITICAL, KEEL_MODE_BATTERY_EMPTY);
}

/* Whether the votes of some channels are each confirmed by a second unit. */
static bool are_confirmed(const keel_virtual_imu_t *imu, uint32_t from, uint32_t to)
{
    bool confirmed = true;

    for (uint32_t k = from; k < to; k++) {
        confirmed = confirmed && (imu->channel[k].vote.state == KEEL_VOTER_MEAN);
    }
    return confirmed;
}

/* For the accelerometers or the gyroscopes one unit is left, none, or two that disagree. */
static bool is_unconfirmed(const keel_virtual_imu_t *imu)
{
    bool unconfirmed = false;

    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        const uint8_t state = imu->channel[k].vote.state;

        unconfirmed = unconfirmed || (state == KEEL_VOTER_SINGLE) || (state >= KEEL_VOTER_DISAGREE);
    }
    return unconfirmed;
}

/* Whether it would fly on, and the pilot's radio is linked: a request counts with his frames. */
static bool can_be_landed(const keel_mode_t *machine)
{
    const uint8_t state = machine->state;

    return ((machine->settled & KEEL_MODE_RC_LINKED) != 0u) &&
           ((state == KEEL_MODE_FLYING) || (state == KEEL_MODE_HOLDING) ||
            (state == KEEL_MODE_RETURNING));
}

/* Nobody would see the next fault, so it lands. The pilot may know better: he moves his switch. */
static void land_unconfirmed(copter_state_t *self, copter_action_request_t *request,
                             const copter_t *copter)
{
    self->unconfirmed = (is_unconfirmed(&copter->imu.virtual_imu) ||
                         is_unconfirmed(&copter->imu.slow))
                            ? (self->unconfirmed + 1u)
                            : 0u;
    if (self->unconfirmed == 0u) {
        self->lands_unconfirmed = false;
    } else if ((self->unconfirmed >= UNCONFIRMED_RUNS) && !self->lands_unconfirmed &&
               can_be_landed(&self->mode) && (request->mode.answer != COPTER_ANSWER_WAITS)) {
        copter_action_request_mode(request, (uint8_t)KEEL_MODE_LAND, copter->pilot.asked);
        request->mode.answer = COPTER_ANSWER_NONE; /* Nobody waits for it. */
        self->lands_unconfirmed = true;
    } else {
        /* Not for long enough, or it has been asked for. */
    }
}

/* An MS5607 whose readings are taken for an MS5611's shows half of the pressure, and all else of it
 * looks right. Without a pressure there is nothing to say. */
static bool may_be_of_ground(const copter_barometer_t *barometer)
{
    return (barometer->samples == 0u) ||
           keel_range_contains(barometer->pressure_pa, copter_settings.ground_least,
                               copter_settings.ground_most);
}

/* A switch that is to be used and is not there never says that it is ready. */
static bool may_start(const copter_port_t *port)
{
    return !copter_settings.safety_switch ||
           ((port->is_ready != NULL) && port->is_ready(port->context));
}

static uint32_t checks_of(const copter_t *copter)
{
    const keel_virtual_imu_t *const imu = &copter->imu.virtual_imu;
    const copter_estimate_t *const estimate = &copter->estimate;

    return copter->health.checks | copter->calibration.checks |
           bit_when(are_confirmed(imu, 0u, KEEL_VIRTUAL_IMU_ACCELEROMETER),
                    KEEL_MODE_CHECK_ACCELEROMETER) |
           bit_when(are_confirmed(imu, KEEL_VIRTUAL_IMU_ACCELEROMETER, KEEL_VIRTUAL_IMU_CHANNELS),
                    KEEL_MODE_CHECK_GYROSCOPE) |
           bit_when(estimate->altitude.axis.quality == KEEL_AXIS_GOOD, KEEL_MODE_CHECK_BAROMETER) |
           bit_when(estimate->position.quality == KEEL_AXIS_GOOD,
                    KEEL_MODE_CHECK_POSITION_ESTIMATE) |
           bit_when(copter->imu.down.z >= copter_settings.level, KEEL_MODE_CHECK_LEVEL_ATTITUDE) |
           bit_when(copter->power.battery.level == KEEL_BATTERY_OK, KEEL_MODE_CHECK_BATTERY_LEVEL) |
           bit_when(estimate->position.has_origin, KEEL_MODE_CHECK_HOME_POSITION) |
           bit_when(may_be_of_ground(&copter->barometer), COPTER_CHECK_GROUND_PRESSURE) |
           bit_when(may_start(copter->port), COPTER_CHECK_SAFETY_SWITCH);
}

/* Counts when the aircraft goes out of the fence. */
static void watch_fence(copter_state_t *self, const copter_t *copter, uint32_t facts)
{
    if (((facts & KEEL_MODE_FENCE_BREACHED) != 0u) &&
        ((self->mode.seen & KEEL_MODE_FENCE_BREACHED) == 0u)) {
        self->breach.count++;
        self->breach.last_us = copter->scheduler.clock.now_us;
        self->breach.side = (uint8_t)side_of(copter);
    }
}

/* An attempt to arm ends with a switch that is no longer ready, though the link is there. With the
 * motors off before and behind it, it was in vain. */
static void count_refusal(copter_state_t *self, bool could_try)
{
    const keel_mode_t *const mode = &self->mode;

    if (could_try && !mode->ready && !mode->motors &&
        ((mode->settled & KEEL_MODE_RC_LINKED) != 0u)) {
        self->refusals++;
    }
}

void copter_state_machine(copter_state_t *self, copter_action_request_t *request,
                          const copter_t *copter)
{
    const uint64_t now_us = copter->scheduler.clock.now_us;
    const bool frame = copter->pilot.frames != self->frames;
    const bool was_disarmed = self->mode.state == KEEL_MODE_DISARMED;
    const bool could_try = self->mode.ready && !self->mode.motors;
    keel_mode_input_t input = {.elapsed_us = (uint32_t)(now_us - self->stepped_us),
                               .facts = facts_of(copter) | (frame ? copter->pilot.facts : 0u),
                               .checks = checks_of(copter),
                               .asked = copter->pilot.asked};

    self->frames = copter->pilot.frames;
    self->stepped_us = now_us;
    watch_fence(self, copter, input.facts);
    land_unconfirmed(self, request, copter);
    copter_action_request_apply(request, frame, &input);
    keel_mode_step(&self->mode, &input);
    count_refusal(self, could_try);
    copter_action_request_follow(request, &self->mode, input.elapsed_us);
    if (was_disarmed && self->mode.motors) {
        self->homes++;
    }
}
