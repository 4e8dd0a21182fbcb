// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/flight/mode.c
// checks: assertions
// covers: keel_mode_step look_at_facts settle_facts exit_of wanted_by needs_of instead_of
// covers: heed_mode_switch heed_arm_switch try_to_arm events_of change_state choose_mode
//
// What is safe, of one step from any valid machine, for every input of any bit pattern; that init
// makes a valid machine and a step keeps it so are MOD_002_valid and MOD_003_valid, so this holds
// of every step for ever. All other checks: keel_mode_step_harness.c.
#include "mode_proof.h"

static keel_mode_input_t input;
static keel_mode_t old;
static keel_mode_t mode;
static bool frame;
static bool broken; /* The link was silent for too long before this step. */

static bool was(uint8_t state)
{
    return old.state == state;
}

static bool is(uint8_t state)
{
    return mode.state == state;
}

static bool counts(uint32_t facts)
{
    return (mode.settled & facts) == facts;
}

static bool alone(const keel_mode_t *of)
{
    return (of->state == KEEL_MODE_HOLDING) || (of->state == KEEL_MODE_RETURNING) ||
           (of->state == KEEL_MODE_LANDING);
}

static uint32_t needs(uint8_t of)
{
    return (of == KEEL_MODE_ANGLE)      ? KEEL_MODE_ATTITUDE_VALID
           : (of == KEEL_MODE_ALTITUDE) ? (KEEL_MODE_ATTITUDE_VALID | KEEL_MODE_ALTITUDE_VALID)
           : ((of == KEEL_MODE_POSITION) || (of == KEEL_MODE_RETURN))
               ? (KEEL_MODE_ATTITUDE_VALID | KEEL_MODE_ALTITUDE_VALID | KEEL_MODE_POSITION_VALID)
               : 0u;
}

static void check_arming(void)
{
    const bool starts = !old.motors && mode.motors;
    const bool attempt = was(KEEL_MODE_DISARMED) && old.ready &&
                         counts(KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_RC_LINKED);

    __CPROVER_assert(!starts || (attempt && frame && is(KEEL_MODE_ARMED)),
                     "MOD_004_attempt: motors start only as the switch goes on, in a frame");
    __CPROVER_assert(!starts || ((mode.config.required & ~input.checks) == 0u),
                     "MOD_004_checks: all required checks hold in that step");
    __CPROVER_assert(!starts || (counts(KEEL_MODE_THROTTLE_LOW | KEEL_MODE_LANDED) &&
                                 !is_set(mode.seen, KEEL_MODE_KILL_SWITCH_ON | ALARMS)),
                     "MOD_004_facts: throttle low, landed, no kill, no alarm");
    __CPROVER_assert(!starts || ((mode.asked < KEEL_MODE_RETURN) &&
                                 (mode.asked != KEEL_MODE_LAND) && (mode.mode == mode.asked)),
                     "MOD_004_mode: the mode that is asked for is in force");
    __CPROVER_assert(!mode.ready || old.ready ||
                         counts(KEEL_MODE_ARM_SWITCH_OFF | KEEL_MODE_RC_LINKED),
                     "MOD_004_off: ready only after off was seen with a link");
    __CPROVER_assert(!mode.ready ||
                         (counts(KEEL_MODE_RC_LINKED) && !counts(KEEL_MODE_ARM_SWITCH_ON)),
                     "MOD_004_once: not ready without a link, nor after an attempt");
    __CPROVER_assert(!attempt || is(KEEL_MODE_ARMED) ||
                         (((mode.refused.checks | mode.refused.facts) != 0u) &&
                          mode_refusal_same(&mode.refused, &mode.blocking)),
                     "MOD_005_named: an attempt that fails tells what was in the way");
    __CPROVER_assert(!is(KEEL_MODE_DISARMED) || !was(KEEL_MODE_DISARMED) ||
                         (mode.blocking.checks == (mode.config.required & ~input.checks)),
                     "MOD_005_checks: the checks that fail, each by its bit");
}

static void check_stopping(void)
{
    const bool kill = frame && counts(KEEL_MODE_KILL_SWITCH_ON) && is(KEEL_MODE_TERMINATED);
    const bool sat = was(KEEL_MODE_LANDING) && counts(KEEL_MODE_LANDED) &&
                     (sum_here(old.state_us, input.elapsed_us) >= mode.config.landed_us);
    const bool rests = is_set(mode.seen, KEEL_MODE_LANDED) &&
                       is_set(mode.seen, KEEL_MODE_THROTTLE_LOW);
    const bool idle = sum_here(old.state_us, input.elapsed_us) >= mode.config.idle_us;
    const bool disarms = was(KEEL_MODE_ARMED) && rests && !broken &&
                         ((frame && counts(KEEL_MODE_ARM_SWITCH_OFF)) || idle);

    __CPROVER_assert(!old.motors || mode.motors || kill || sat || disarms,
                     "MOD_006_stops: on the ground, or by the kill switch held, and else never");
    __CPROVER_assert(!was(KEEL_MODE_FLYING) || is(KEEL_MODE_FLYING) || !is(KEEL_MODE_ARMED) ||
                         counts(KEEL_MODE_LANDED | KEEL_MODE_THROTTLE_LOW),
                     "MOD_006_ground: armed on the ground only when it has landed, throttle low");
    __CPROVER_assert(!is(KEEL_MODE_TERMINATED) || was(KEEL_MODE_TERMINATED) || kill,
                     "MOD_010_kill: terminated only by the kill switch held, in a frame");
    __CPROVER_assert(!was(KEEL_MODE_TERMINATED) || (is(KEEL_MODE_TERMINATED) && !mode.motors),
                     "MOD_010_latches: nothing leads out, and motors stand still");
    __CPROVER_assert(!old.motors || !frame || !counts(KEEL_MODE_KILL_SWITCH_ON) ||
                         is(KEEL_MODE_TERMINATED),
                     "MOD_010_obeys: a kill switch held terminates from every state");
}

/* In a state its time begins at 0, goes on by what elapsed, and is not up. */
static bool lasts(uint8_t state, uint32_t limit_us)
{
    const uint32_t now_us = sum_here(old.state_us, input.elapsed_us);

    return was(state) ? ((mode.state_us == now_us) && (now_us < limit_us)) : (mode.state_us == 0u);
}

static void check_link(void)
{
    __CPROVER_assert(!broken || !piloted(&mode), "MOD_007_lost: without a link no pilot flies");
    __CPROVER_assert(!broken || !was(KEEL_MODE_FLYING) || is(KEEL_MODE_HOLDING),
                     "MOD_007_holds: it holds when the link is lost");
    __CPROVER_assert(!broken || !was(KEEL_MODE_ARMED) || is(KEEL_MODE_LANDING),
                     "MOD_007_lands: it lands if it was still on the ground");
    __CPROVER_assert(!is(KEEL_MODE_HOLDING) || lasts(KEEL_MODE_HOLDING, mode.config.hold_us),
                     "MOD_007_hold_ends: holding ends when its time is up");
    __CPROVER_assert(!is(KEEL_MODE_RETURNING) || lasts(KEEL_MODE_RETURNING, mode.config.return_us),
                     "MOD_007_return_ends: returning ends when its time is up");
    __CPROVER_assert(!alone(&old) || !piloted(&mode) ||
                         (frame && counts(KEEL_MODE_RC_LINKED | KEEL_MODE_SWITCH_UNMOVED) &&
                          (old.asked != KEEL_MODE_NONE) && (mode.asked != old.asked)),
                     "MOD_008_moves: the pilot flies again only as he moves the mode switch");
    __CPROVER_assert(!was(KEEL_MODE_FLYING) || !is(KEEL_MODE_FLYING) ||
                         ((mode.settled & ~mode.overridden & ALARMS) == 0u),
                     "MOD_011_alarm: an alarm that counts leads away, unless overridden");
    __CPROVER_assert((mode.overridden & ~old.overridden) == 0u || is(KEEL_MODE_FLYING),
                     "MOD_011_overridden: only by taking over");
}

static void check_mode(void)
{
    const bool held = (mode.mode == KEEL_MODE_POSITION) || (mode.mode == KEEL_MODE_ALTITUDE) ||
                      (mode.mode == KEEL_MODE_RETURN) || (mode.mode == KEEL_MODE_LAND);

    __CPROVER_assert((needs(mode.mode) & ~mode.settled) == 0u,
                     "MOD_009_estimates: a mode is in force only with all that it needs");
    __CPROVER_assert(!piloted(&mode) || (mode.mode == mode.asked) || (mode.missing != 0u),
                     "MOD_009_why: the pilot has what he asks for, or is told what is missing");
    __CPROVER_assert(!alone(&mode) || held, "MOD_009_alone: no mode that waits for a throttle");
    __CPROVER_assert(!alone(&mode) || (mode.cause != 0u), "MOD_009_cause: and is told the cause");
}

void keel_mode_step__safe_harness(void)
{
    input = nondet_mode_input();
    mode = any_mode();
    __CPROVER_assume(valid_here(&mode));
    old = mode;
    frame = frame_here(&input);
    broken = sum_here(old.silence_us, input.elapsed_us) >= old.config.loss_us;

    keel_mode_step(&mode, &input);

    check_arming();
    check_stopping();
    check_link();
    check_mode();
}
