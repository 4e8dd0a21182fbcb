/* SPDX-License-Identifier: Apache-2.0 */
/* Position control, angle control and angle rate control: the cascade of fig. 8 and the motors. */
#include "copter.h"

#include "keel/middleware/range.h"

#include <math.h>

/* A landing without a height: thrust, in parts of what hovers, for a speed that is off by 1 m/s;
 * what is added to it in a run of 10 ms; and the most of that. */
#define SINK_GAIN     0.1f
#define SINK_INTEGRAL 0.001f
#define SINK_MOST     0.5f

/* With a smaller cosine of the tilt, thrust does not grow any more: it would not carry. */
#define TILT_LEAST 0.5f

#define SETTLES 0.14f /* The sine of the tilt that it keeps on the ground: 8 degrees. */
#define BRAKES  2.0f  /* What it comes to a stop with, in wind, too; in m/s^2. */
#define YIELDS  10.0f /* How fast it turns to give way to the ground, per torque; in rad/s. */

keel_status_t copter_control_init(copter_control_t *control)
{
    keel_mixer_config_t mixer = copter_settings.mixer;
    const keel_status_t status = keel_cascade_init(&control->cascade, &copter_settings.cascade);

    mixer.geometry = keel_mixer_quad_x;
    control->mode = KEEL_MODE_NONE;
    return (status == KEEL_OK) ? keel_mixer_init(&control->mixer, &mixer) : status;
}

static bool is_flown(const copter_t *copter)
{
    return copter->state.mode.state == KEEL_MODE_FLYING;
}

/* Whether the sticks ask for angles. */
static bool sticks_tilt(const copter_t *copter)
{
    const uint8_t mode = copter->state.mode.mode;

    return is_flown(copter) && ((mode == KEEL_MODE_ANGLE) || (mode == KEEL_MODE_ALTITUDE));
}

/* Whether the throttle is the thrust. */
static bool sticks_thrust(const copter_t *copter)
{
    const uint8_t mode = copter->state.mode.mode;

    return is_flown(copter) && ((mode == KEEL_MODE_ACRO) || (mode == KEEL_MODE_ANGLE));
}

/* The mode whose axes are flown. On the ground none leans against the wind, and before it is left
 * or where it carries the aircraft none runs; a landing holds its place where it is known. */
static uint8_t mode_of_axes(const copter_t *copter)
{
    const keel_mode_t *const machine = &copter->state.mode;
    uint8_t mode = machine->mode;

    if ((machine->state == KEEL_MODE_ARMED) || copter->estimate.rests) {
        return KEEL_MODE_NONE;
    }
    if ((mode == KEEL_MODE_LAND) && ((machine->settled & KEEL_MODE_POSITION_VALID) != 0u)) {
        mode = KEEL_MODE_POSITION;
    }
    if (((mode == KEEL_MODE_POSITION) || (mode == KEEL_MODE_RETURN)) &&
        (copter->estimate.is_landed || copter->estimate.touches)) {
        mode = KEEL_MODE_LAND;
    }
    return mode;
}

/* Where it comes to a stop from here. A place that is nearer than it can brake would be flown back
 * to, and a landing would come down on the way. */
static keel_cascade_vector_t stop_of(const keel_cascade_estimate_t *here)
{
    const float speed = sqrtf((here->velocity.north * here->velocity.north) +
                              (here->velocity.east * here->velocity.east));
    const float brakes_s = speed / (2.0f * BRAKES);
    const float stop_s = (brakes_s > copter_settings.stop_s) ? brakes_s : copter_settings.stop_s;

    return (keel_cascade_vector_t){.north = here->position.north + (here->velocity.north * stop_s),
                                   .east = here->position.east + (here->velocity.east * stop_s),
                                   .up = here->position.up +
                                         (here->velocity.up * copter_settings.stop_s)};
}

/* When a state begins, the place to be held is where it comes to a stop; on the way home, home. A
 * landing that ends a return is at home; one that breaks it off is not, or it would come down on
 * the way. */
static void begin_state(copter_control_t *self, const copter_t *copter)
{
    const uint8_t state = copter->state.mode.state;
    const bool is_at_home = (copter->state.mode.settled & KEEL_MODE_AT_HOME) != 0u;
    const bool ends_return = (self->state == KEEL_MODE_RETURNING) && (state == KEEL_MODE_LANDING) &&
                             is_at_home;

    if ((state == self->state) && (copter->state.mode.mode == self->mode)) {
        return;
    }
    if (!ends_return) {
        self->place = stop_of(&copter->estimate.here);
    }
    if (state == KEEL_MODE_RETURNING) {
        self->place.north = 0.0f;
        self->place.east = 0.0f;
        self->place.up = (self->place.up > copter_settings.return_height)
                             ? self->place.up
                             : copter_settings.return_height;
    }
    self->state = state;
    self->mode = copter->state.mode.mode;
}

/* A place that is held moves with the estimate; home does not. */
static void follow_reset(copter_control_t *self, const copter_estimate_t *estimate)
{
    if ((self->resets != estimate->resets) && (self->state != KEEL_MODE_RETURNING)) {
        self->place.north += estimate->reset_by.north;
        self->place.east += estimate->reset_by.east;
        self->place.up += estimate->reset_by.up;
    }
    self->resets = estimate->resets;
}

/* Slow near the ground; fast again where it touches, so that the motors let go of it at once. */
static float descent_of(const copter_estimate_t *estimate)
{
    const bool is_slow = (estimate->here.position.up <= copter_settings.land_near) &&
                         !estimate->touches;

    return is_slow ? -copter_settings.land_slow : -copter_settings.land_fast;
}

/* Towards the fence the pilot comes to a stop by himself: slower the nearer it is. Without that the
 * cascade's fence would do it, which brakes as hard as it has to. */
static float slow_down(float asked, float place, float reach)
{
    const float rate = copter_settings.fence_rate;
    const float ahead = rate * (reach - copter_settings.fence_margin - place);
    const float behind = rate * (reach - copter_settings.fence_margin + place);
    const float most = (ahead > 0.0f) ? ahead : 0.0f;
    const float least = (behind > 0.0f) ? -behind : 0.0f;

    if (asked > most) {
        return most;
    }
    return (asked < least) ? least : asked;
}

/* The pilot's sticks take over from position hold; the place to be held follows. */
static void follow_sticks(copter_control_t *self, const copter_t *copter)
{
    const keel_reference_setpoints_t *const pilot = &copter->pilot.reference.setpoints;
    const keel_cascade_estimate_t *const here = &copter->estimate.here;
    const keel_cascade_vector_t stop = stop_of(here);
    const float *const reach = copter_settings.cascade.reach;
    const bool goes = (pilot->forward != 0.0f) || (pilot->right != 0.0f);
    const bool climbs = pilot->climb_rate != 0.0f;

    if (goes || copter->estimate.is_landed) {
        const float north = (pilot->forward * here->forward_north) -
                            (pilot->right * here->forward_east);
        const float east = (pilot->forward * here->forward_east) +
                           (pilot->right * here->forward_north);

        self->asked.north = slow_down(north, here->position.north, reach[KEEL_CASCADE_NORTH]);
        self->asked.east = slow_down(east, here->position.east, reach[KEEL_CASCADE_EAST]);
        self->place.north = stop.north;
        self->place.east = stop.east;
    }
    if (climbs) {
        self->asked.up = slow_down(pilot->climb_rate, here->position.up,
                                   reach[KEEL_CASCADE_HEIGHT]);
        self->place.up = stop.up;
    }
}

/* Whether it has to come down without knowing its height. */
static bool sinks_blindly(const copter_t *copter)
{
    return (copter->state.mode.mode == KEEL_MODE_LAND) && !copter->estimate.here.has_height;
}

/* What is known then is how the speed changed in the last seconds. The integral takes the thrust
 * from an aircraft that does not sink: because it hovers, or because it stands. */
static void sink(copter_control_t *self, const copter_estimate_t *estimate)
{
    const float hover = estimate->vertical.hover;
    const float error = -copter_settings.land_slow - estimate->here.velocity.up;

    self->sink_integral = keel_range_clamp(self->sink_integral + (SINK_INTEGRAL * error),
                                           -SINK_MOST, SINK_MOST);
    self->sink = keel_range_clamp(hover * (1.0f + (SINK_GAIN * error) + self->sink_integral), 0.0f,
                                  1.0f);
}

void copter_position_control(copter_control_t *self, const copter_t *copter)
{
    const keel_cascade_estimate_t *const here = &copter->estimate.here;

    follow_reset(self, &copter->estimate);
    begin_state(self, copter);
    keel_cascade_enter(&self->cascade, mode_of_axes(copter));
    keel_cascade_position_step(&self->cascade, self->place, here);
    self->asked = self->cascade.velocity;
    if (is_flown(copter)) {
        follow_sticks(self, copter);
    } else if (self->mode == KEEL_MODE_LAND) {
        self->asked.up = descent_of(&copter->estimate);
    } else {
        /* It goes where the position stage says. */
    }
    keel_cascade_velocity_step(&self->cascade, self->asked, here);
    if (sinks_blindly(copter)) {
        sink(self, &copter->estimate);
    } else {
        self->sink_integral = 0.0f;
    }
}

/* The sticks' angles, where they say them. An aircraft that touches the ground stays as it stands,
 * so that it comes to lie on a slope while the motors still carry most of it; but it does not go on
 * leaning against the wind, or it would fall over to the other side when they stop. */
static keel_cascade_tilt_t asked_tilt(const copter_control_t *self, const copter_pilot_t *pilot,
                                      const copter_t *copter)
{
    const keel_reference_setpoints_t *const asked = &pilot->reference.setpoints;
    const keel_attitude_vector_t down = copter->imu.down;

    if (sticks_tilt(copter)) {
        return (keel_cascade_tilt_t){.roll = asked->roll, .pitch = asked->pitch};
    }
    if (copter->estimate.touches) {
        return (keel_cascade_tilt_t){.roll = keel_range_clamp(down.y, -SETTLES, SETTLES),
                                     .pitch = -keel_range_clamp(down.x, -SETTLES, SETTLES)};
    }
    return self->cascade.tilt;
}

void copter_angle_control(copter_control_t *self, copter_pilot_t *pilot, const copter_t *copter)
{
    copter_pilot_smooth(pilot);
    keel_cascade_angle_step(&self->cascade, asked_tilt(self, pilot, copter), copter->imu.down,
                            copter->imu.attitude.phase == KEEL_ATTITUDE_RUNNING);
}

/* The throttle's middle hovers. */
static float thrust_of(float stick)
{
    const float hover = copter_settings.cascade.hover;

    return (stick < 0.0f) ? (hover + (hover * stick)) : (hover + ((1.0f - hover) * stick));
}

/* What lifts as much as this does when the aircraft is level; beyond a right angle nothing does.
 * Without an attitude it is taken to be level. */
static float tilted(float thrust, const copter_imu_t *imu)
{
    const float down = imu->down.z;
    float lifts = thrust;

    if (imu->attitude.phase == KEEL_ATTITUDE_RUNNING) {
        if (down <= 0.0f) {
            lifts = 0.0f;
        } else if (down < TILT_LEAST) {
            lifts = thrust * (down / (TILT_LEAST * TILT_LEAST));
        } else {
            lifts = thrust / down;
        }
    }
    return (lifts < 1.0f) ? lifts : 1.0f;
}

/* An aircraft that touches the ground gives way to it: it turns against the torque that keeps it
 * from lying as the ground does, so that on a slope it comes down on all its legs while the motors
 * still carry most of it. Without that it would fall onto them when the motors stop, and over. */
static void give_way(keel_cascade_rates_t *asked, const keel_cascade_t *cascade)
{
    asked->roll -= YIELDS * cascade->axis[KEEL_CASCADE_ROLL_RATE].pid.integral;
    asked->pitch -= YIELDS * cascade->axis[KEEL_CASCADE_PITCH_RATE].pid.integral;
}

static keel_cascade_rates_t rates_of(const copter_t *copter)
{
    const keel_cascade_t *const cascade = &copter->control.cascade;
    const keel_reference_setpoints_t *const pilot = &copter->pilot.reference.setpoints;
    keel_cascade_rates_t asked = {
        .roll = cascade->rates.roll, .pitch = cascade->rates.pitch, .thrust = cascade->thrust};

    if (is_flown(copter)) {
        asked.yaw = pilot->heading_rate;
        if (copter->state.mode.mode == KEEL_MODE_ACRO) {
            asked.roll = pilot->roll_rate;
            asked.pitch = pilot->pitch_rate;
            asked.yaw = pilot->yaw_rate;
        }
    }
    if (sticks_thrust(copter)) {
        asked.thrust = thrust_of(copter->pilot.smooth.climb);
    } else {
        asked.thrust = tilted(sinks_blindly(copter) ? copter->control.sink : cascade->thrust,
                              &copter->imu);
    }
    if (copter->estimate.touches && !sticks_tilt(copter)) {
        give_way(&asked, cascade);
    }
    return asked;
}

void copter_angle_rate_control(copter_control_t *self, const copter_t *copter)
{
    keel_cascade_rate_step(&self->cascade, rates_of(copter), copter->imu.attitude.rate,
                           self->mixer.limited);
    keel_mixer_step(&self->mixer, &self->cascade.command,
                    copter->state.mode.motors && !copter->estimate.vertical.is_crashed);
    copter->port->write_motors(copter->port->context, self->mixer.output);
}
