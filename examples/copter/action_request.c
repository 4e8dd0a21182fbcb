/* SPDX-License-Identifier: Apache-2.0 */
/* Requests of a ground station to the state machine. */
#include "action_request.h"

static const copter_moved_t asked_now = {.answer = COPTER_ANSWER_WAITS, .is_moved = true};

void copter_action_request_arm(copter_action_request_t *request, bool arms)
{
    request->arm = asked_now;
    request->arms = arms;
}

void copter_action_request_mode(copter_action_request_t *request, uint8_t mode, uint8_t pilot_mode)
{
    request->mode = asked_now;
    request->asked = mode;
    request->pilot_mode = pilot_mode;
}

/* Whether the pilot's frames have said so for long enough. */
static bool take_over(copter_moved_t *moved, bool says)
{
    moved->frames = says ? (moved->frames + 1u) : 0u;
    return moved->frames >= COPTER_ACTION_REQUEST_FRAMES;
}

static void apply_arm(copter_action_request_t *request, keel_mode_input_t *input)
{
    const uint32_t both = KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_ARM_SWITCH_OFF;
    const uint32_t to = request->arms ? KEEL_MODE_ARM_SWITCH_ON : KEEL_MODE_ARM_SWITCH_OFF;

    if (take_over(&request->arm, (input->facts & to) != 0u)) {
        request->arm.is_moved = false;
    }
    input->facts = (input->facts & ~both) | to;
}

static void apply_mode(copter_action_request_t *request, keel_mode_input_t *input)
{
    if (take_over(&request->mode, input->asked != request->pilot_mode)) {
        request->mode.is_moved = false;
    } else {
        input->asked = request->asked;
    }
}

void copter_action_request_apply(copter_action_request_t *request, bool frame,
                                 keel_mode_input_t *input)
{
    if (frame && request->arm.is_moved) {
        apply_arm(request, input);
    }
    if (frame && request->mode.is_moved) {
        apply_mode(request, input);
    }
}

/* A waiting request gets its answer; one that is refused or late is asked no more. */
static void answer_move(copter_moved_t *moved, bool done, bool refused, uint32_t elapsed_us)
{
    if (moved->answer != COPTER_ANSWER_WAITS) {
        return;
    }
    moved->age_us += elapsed_us;
    if (done) {
        moved->answer = COPTER_ANSWER_DONE;
    } else if (refused || !moved->is_moved || (moved->age_us >= COPTER_ACTION_REQUEST_TIME_US)) {
        moved->answer = COPTER_ANSWER_REFUSED;
        moved->is_moved = false;
    } else {
        /* It waits on. */
    }
}

void copter_action_request_follow(copter_action_request_t *request, const keel_mode_t *machine,
                                  uint32_t elapsed_us)
{
    const bool linked = (machine->settled & KEEL_MODE_RC_LINKED) != 0u;
    const bool rests = (machine->settled & KEEL_MODE_SWITCH_UNMOVED) != 0u;
    const bool is_asked = rests && (machine->asked == request->asked);
    const bool has_mode = !machine->motors || (machine->mode == request->asked);

    answer_move(&request->arm, machine->motors == request->arms,
                !linked || (request->arms && !machine->ready), elapsed_us);
    answer_move(&request->mode, is_asked && has_mode, !linked, elapsed_us);
    if (request->arm.answer != COPTER_ANSWER_WAITS) {
        /* No motor starts by a request that is over. */
        request->arm.is_moved = request->arm.is_moved && linked &&
                                (machine->motors || !request->arms);
    }
    request->mode.is_moved = request->mode.is_moved && linked && (machine->motors || !request->ran);
    request->ran = machine->motors;
}
