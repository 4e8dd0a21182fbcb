/* SPDX-License-Identifier: Apache-2.0 */
/* Background and foreground radio: frames become sticks, switches and what they ask for. */
#include "copter.h"

/* Channels. */
#define ROLL      0u
#define PITCH     1u
#define THROTTLE  2u
#define YAW       3u
#define ARM       4u
#define MODE      5u
#define KILL      6u
#define CALIBRATE 7u

/* What a channel says: its middle, the way to either end, and what no receiver sends. */
#define MIDDLE   1500
#define WAY      512.0f
#define LEAST    900u
#define GREATEST 2100u

/* Below LOW the throttle is low; switches are off below OFF and on above ON. */
#define LOW 1080u
#define OFF 1300u
#define ON  1700u

/* The mode switch has a position for each mode, in the order of their numbers. */
#define MODE_FIRST 960u
#define MODE_STEP  180u

keel_status_t copter_pilot_init(copter_pilot_t *pilot)
{
    pilot->asked = KEEL_MODE_NONE;
    return keel_reference_init(&pilot->reference, &copter_settings.reference);
}

void copter_background_radio(copter_t *copter)
{
    copter_pilot_t *const self = &copter->pilot;

    if (copter->port->read_radio(copter->port->context, &self->frame)) {
        self->received++;
    }
}

static bool is_whole(const copter_frame_t *frame)
{
    bool whole = !frame->failsafe;

    for (uint32_t i = 0u; i < COPTER_CHANNELS; i++) {
        whole = whole && (frame->channel[i] >= LEAST) && (frame->channel[i] <= GREATEST);
    }
    return whole;
}

/* A stick, from -1 to 1. */
static float stick_of(uint16_t channel)
{
    const float stick = (float)((int32_t)channel - MIDDLE) / WAY;

    if (stick < -1.0f) {
        return -1.0f;
    }
    return (stick > 1.0f) ? 1.0f : stick;
}

static uint8_t mode_of(uint16_t channel)
{
    const uint32_t position = (channel > MODE_FIRST) ? ((channel - MODE_FIRST) / MODE_STEP) : 0u;

    return (position < KEEL_MODE_NONE) ? (uint8_t)position : (uint8_t)KEEL_MODE_NONE;
}

static uint32_t facts_of(const copter_frame_t *frame)
{
    uint32_t facts = KEEL_MODE_IS_LINKED;

    facts |= (frame->channel[ARM] > ON) ? KEEL_MODE_IS_ON : 0u;
    facts |= (frame->channel[ARM] < OFF) ? KEEL_MODE_IS_OFF : 0u;
    facts |= (frame->channel[KILL] > ON) ? KEEL_MODE_IS_KILL : 0u;
    facts |= (frame->channel[THROTTLE] < LOW) ? KEEL_MODE_IS_LOW : 0u;
    return facts;
}

void copter_foreground_radio(copter_t *copter)
{
    copter_pilot_t *const self = &copter->pilot;
    const uint16_t *const channel = self->frame.channel;

    if ((self->received == self->read) || !is_whole(&self->frame)) {
        return;
    }
    self->read = self->received;
    self->sticks = (keel_reference_sticks_t){.roll = stick_of(channel[ROLL]),
                                             .pitch = stick_of(channel[PITCH]),
                                             .yaw = stick_of(channel[YAW]),
                                             .climb = stick_of(channel[THROTTLE])};
    (void)keel_reference_step(&self->reference, &self->sticks);
    self->facts = facts_of(&self->frame);
    self->asked = mode_of(channel[MODE]);
    self->calibrates = channel[CALIBRATE] > ON;
    self->frames++;
}
