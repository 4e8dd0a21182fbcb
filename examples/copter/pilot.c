/* SPDX-License-Identifier: Apache-2.0 */
/* Background and foreground radio: frames become sticks, switches and what they ask for. */
#include "copter.h"

#include "keel/middleware/range.h"

/* Channels, of which these are used. */
#define ROLL      0u
#define PITCH     1u
#define THROTTLE  2u
#define YAW       3u
#define ARM       4u
#define MODE      5u
#define KILL      6u
#define CALIBRATE 7u

/* A channel: its middle, and the way to either end. */
#define MIDDLE 1500
#define WAY    512.0f

/* Below LOW the throttle is low; switches are off below OFF and on above ON. */
#define LOW 1080u
#define OFF 1300u
#define ON  1700u

/* Runs of foreground radio in a second, and frames in it that are no chance. */
#define RUNS_OF_A_SECOND 50u
#define NO_CHANCE        10u

/* The mode switch has a position for each mode, in the order of their numbers. */
#define MODE_FIRST 960u
#define MODE_STEP  180u

keel_status_t copter_pilot_init(copter_pilot_t *pilot)
{
    const keel_status_t status = copter_rc_init(&pilot->rc, &copter_settings.rc);

    pilot->asked = KEEL_MODE_NONE;
    return (status == KEEL_OK) ? copter_pilot_tune(pilot) : status;
}

keel_status_t copter_pilot_tune(copter_pilot_t *pilot)
{
    keel_status_t status = keel_reference_init(&pilot->reference, &copter_settings.reference);

    for (uint32_t i = 0u; (i < COPTER_STICKS) && (status == KEEL_OK); i++) {
        status = keel_filter_init(&pilot->smoother[i], COPTER_CONTROL_HZ, copter_settings.stick_hz);
    }
    return status;
}

/* Whether a run that began then takes another byte. Noise can make one of CRSF cost as much as a
 * frame, so it is time that is counted. The rest waits in the port. */
static bool has_time(const copter_port_t *port, uint32_t began_us)
{
    return (port->read_clock(port->clock) - began_us) < COPTER_RADIO_READS_US;
}

void copter_background_radio(copter_pilot_t *self, const copter_t *copter)
{
    const copter_port_t *const port = copter->port;
    const uint32_t began_us = port->read_clock(port->clock);
    copter_byte_t byte;

    for (uint32_t i = 0u; (i < COPTER_BYTES) && has_time(port, began_us) &&
                          port->read_byte(port->context, COPTER_RC, &byte);
         i++) {
        (void)copter_rc_take(&self->rc, &byte);
    }
}

/* A stick, from -1 to 1. */
static float stick_of(uint16_t channel)
{
    return keel_range_clamp((float)((int32_t)channel - MIDDLE) / WAY, -1.0f, 1.0f);
}

/* A stick behind its low-pass, which goes beyond a stair by 4 % for a moment. */
static float smoothed(keel_filter_t *smoother, float stick)
{
    (void)keel_filter_step(smoother, stick);
    return keel_range_clamp(smoother->output, -1.0f, 1.0f);
}

/* A receiver tells the sticks some 50 times a second. Ten steps of control would ask for the same
 * then, and the eleventh for a jump, whose derivative kicks. */
void copter_pilot_smooth(copter_pilot_t *pilot)
{
    const keel_reference_sticks_t *const said = &pilot->sticks;

    pilot->smooth = (keel_reference_sticks_t){.roll = smoothed(&pilot->smoother[0], said->roll),
                                              .pitch = smoothed(&pilot->smoother[1], said->pitch),
                                              .yaw = smoothed(&pilot->smoother[2], said->yaw),
                                              .climb = smoothed(&pilot->smoother[3], said->climb)};
    (void)keel_reference_step(&pilot->reference, &pilot->smooth);
}

/* A position beyond an end counts as the end. */
static uint8_t mode_of(uint16_t channel)
{
    const uint32_t position = (channel > MODE_FIRST) ? ((channel - MODE_FIRST) / MODE_STEP) : 0u;

    return (position < KEEL_MODE_NONE) ? (uint8_t)position : (uint8_t)(KEEL_MODE_NONE - 1);
}

static uint32_t facts_of(const uint16_t channel[])
{
    uint32_t facts = KEEL_MODE_RC_LINKED;

    facts |= (channel[ARM] > ON) ? KEEL_MODE_ARM_SWITCH_ON : 0u;
    facts |= (channel[ARM] < OFF) ? KEEL_MODE_ARM_SWITCH_OFF : 0u;
    facts |= (channel[KILL] > ON) ? KEEL_MODE_KILL_SWITCH_ON : 0u;
    facts |= (channel[THROTTLE] < LOW) ? KEEL_MODE_THROTTLE_LOW : 0u;
    return facts;
}

/* Without a frame of the pilot in a second: why, by what was refused in it. */
static copter_heard_t silence_of(bool received, const uint32_t refused[COPTER_REFUSALS])
{
    copter_heard_t heard = COPTER_HEARD_NOTHING;

    if (received) {
        heard = COPTER_HEARD_LOST;
    } else if (refused[COPTER_REFUSED_STICK] >= NO_CHANCE) {
        heard = COPTER_HEARD_NO_STICK;
    } else if (refused[COPTER_REFUSED_FLAGS] >= NO_CHANCE) {
        heard = COPTER_HEARD_FLAGS;
    } else if ((refused[COPTER_REFUSED_CHECK] + refused[COPTER_REFUSED_BYTES]) > 0u) {
        heard = COPTER_HEARD_NOISE;
    } else {
        /* Nothing came. */
    }
    return heard;
}

/* At the end of a second: whether the pilot was heard in it, or why not. */
static void conclude_second(copter_pilot_t *self)
{
    copter_pilot_ear_t *const ear = &self->ear;
    uint32_t refused[COPTER_REFUSALS];
    uint32_t all[COPTER_REFUSALS];

    ear->runs++;
    if (ear->runs < RUNS_OF_A_SECOND) {
        return;
    }
    copter_rc_count(&self->rc, all);
    for (uint32_t i = 0u; i < COPTER_REFUSALS; i++) {
        refused[i] = all[i] - ear->refused[i];
        ear->refused[i] = all[i];
    }
    ear->heard = (uint8_t)((self->frames != ear->frames)
                               ? COPTER_HEARD_PILOT
                               : silence_of(self->rc.frames != ear->received, refused));
    ear->runs = 0u;
    ear->received = self->rc.frames;
    ear->frames = self->frames;
}

/* A frame of the pilot. */
static void obey_frame(copter_pilot_t *self)
{
    const uint16_t *const channel = self->rc.channel;

    self->read = self->rc.frames;
    self->sticks = (keel_reference_sticks_t){.roll = stick_of(channel[ROLL]),
                                             .pitch = stick_of(channel[PITCH]),
                                             .yaw = stick_of(channel[YAW]),
                                             .climb = stick_of(channel[THROTTLE])};
    self->facts = facts_of(channel);
    self->asked = mode_of(channel[MODE]);
    self->calibrates = channel[CALIBRATE] > ON;
    self->frames++;
}

void copter_foreground_radio(copter_pilot_t *self)
{
    if ((self->rc.frames != self->read) && !self->rc.is_lost) {
        obey_frame(self);
    }
    conclude_second(self);
}
