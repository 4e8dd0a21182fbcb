/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mode_proof.h
 * @brief What the CBMC harnesses of the modes share: arbitrary machines and inputs.
 */
#ifndef MODE_PROOF_H
#define MODE_PROOF_H

#include "../../specs/model/mode.h"

#include <stdbool.h>

#define FACTS KEEL_MODE_FACTS
#define PILOT                                                                                      \
    (KEEL_MODE_RC_LINKED | KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_ARM_SWITCH_OFF |                    \
     KEEL_MODE_THROTTLE_LOW | KEEL_MODE_KILL_SWITCH_ON | KEEL_MODE_SWITCH_UNMOVED)
#define ALARMS (KEEL_MODE_FENCE_BREACHED | KEEL_MODE_BATTERY_CRITICAL | KEEL_MODE_BATTERY_EMPTY)

bool nondet_bool(void);
uint8_t nondet_u8(void);
uint32_t nondet_u32(void);
keel_mode_t nondet_mode(void);
keel_mode_config_t nondet_mode_config(void);
keel_mode_input_t nondet_mode_input(void);

static keel_mode_config_t any_config(void)
{
    keel_mode_config_t config = nondet_mode_config();

    config.returns = nondet_bool();
    return config;
}

/* Any machine: every bit pattern, but that a truth value is one. */
static keel_mode_t any_mode(void)
{
    keel_mode_t mode = nondet_mode();

    mode.config.returns = nondet_bool();
    mode.ready = nondet_bool();
    mode.motors = nondet_bool();
    return mode;
}

static bool is_set(uint32_t word, uint32_t bit)
{
    return (word & bit) != 0u;
}

/* mode_runs */
static bool runs(const keel_mode_t *mode)
{
    return (mode->state != KEEL_MODE_DISARMED) && (mode->state < KEEL_MODE_TERMINATED);
}

/* mode_piloted */
static bool piloted(const keel_mode_t *mode)
{
    return (mode->state == KEEL_MODE_ARMED) || (mode->state == KEEL_MODE_FLYING);
}

/* mode_times_valid */
static bool times_valid_here(const keel_mode_config_t *c)
{
    const uint32_t time_us[] = {c->regain_us,   c->request_us, c->kill_us, c->landed_us,
                                c->estimate_us, c->alarm_us,   c->idle_us};
    bool valid = (KEEL_MODE_LOSS_LEAST_US <= c->loss_us) && (c->loss_us <= KEEL_MODE_LOSS_MOST_US);

    for (uint32_t i = 0u; i < (sizeof time_us / sizeof time_us[0]); i++) {
        valid = valid && (c->loss_us <= time_us[i]) && (time_us[i] <= KEEL_MODE_TIME_MOST_US);
    }
    return valid && (c->hold_us <= KEEL_MODE_TIME_MOST_US) &&
           (c->return_us <= KEEL_MODE_TIME_MOST_US);
}

/* mode_config_valid */
static bool config_valid_here(const keel_mode_config_t *c)
{
    return times_valid_here(c) && (c->required != 0u);
}

/* mode_valid */
static bool valid_here(const keel_mode_t *mode)
{
    const keel_mode_config_t *const c = &mode->config;
    const uint32_t settle_us[FACTS] = {
        c->regain_us,   c->request_us, c->request_us, c->request_us,  c->kill_us,
        c->request_us,  c->landed_us,  c->alarm_us,   c->estimate_us, c->estimate_us,
        c->estimate_us, c->alarm_us,   c->alarm_us,   c->alarm_us};
    const bool up = is_set(mode->settled, KEEL_MODE_RC_LINKED);
    bool valid = config_valid_here(c) && (mode->state < KEEL_MODE_STATES) &&
                 (mode->mode <= KEEL_MODE_NONE) && (mode->asked <= KEEL_MODE_NONE) &&
                 (mode->rests_at <= KEEL_MODE_NONE);

    for (uint32_t i = 0u; i < FACTS; i++) {
        valid = valid && (mode->settle_us[i] == settle_us[i]);
    }
    return valid && (mode->motors == runs(mode)) && ((mode->settled & ~mode->seen & PILOT) == 0u) &&
           ((mode->overridden & ~ALARMS) == 0u) && (!up || (mode->silence_us < c->loss_us)) &&
           (!mode->ready || (up && !is_set(mode->settled, KEEL_MODE_ARM_SWITCH_ON))) &&
           (!piloted(mode) || (up && (mode->asked != KEEL_MODE_NONE))) &&
           ((mode->mode == KEEL_MODE_NONE) == !runs(mode)) &&
           ((mode->state == KEEL_MODE_DISARMED) || (mode->cause != 0u));
}

static uint32_t sum_here(uint32_t a_us, uint32_t b_us)
{
    const uint64_t sum = (uint64_t)a_us + b_us;

    return (sum < UINT32_MAX) ? (uint32_t)sum : UINT32_MAX;
}

static bool frame_here(const keel_mode_input_t *input)
{
    return is_set(input->facts, KEEL_MODE_RC_LINKED) && (input->asked < KEEL_MODE_NONE);
}

static bool mode_config_same(const keel_mode_config_t *a, const keel_mode_config_t *b)
{
    return (a->loss_us == b->loss_us) && (a->regain_us == b->regain_us) &&
           (a->request_us == b->request_us) && (a->kill_us == b->kill_us) &&
           (a->landed_us == b->landed_us) && (a->estimate_us == b->estimate_us) &&
           (a->alarm_us == b->alarm_us) && (a->idle_us == b->idle_us) &&
           (a->hold_us == b->hold_us) && (a->return_us == b->return_us) &&
           (a->required == b->required) && (a->returns == b->returns);
}

static bool mode_refusal_same(const keel_mode_refusal_t *a, const keel_mode_refusal_t *b)
{
    return (a->checks == b->checks) && (a->facts == b->facts);
}

static bool mode_same(const keel_mode_t *a, const keel_mode_t *b, uint32_t i)
{
    return mode_config_same(&a->config, &b->config) && (a->silence_us == b->silence_us) &&
           (a->state_us == b->state_us) && (a->seen == b->seen) && (a->settled == b->settled) &&
           (a->overridden == b->overridden) && (a->cause == b->cause) &&
           (a->missing == b->missing) && mode_refusal_same(&a->blocking, &b->blocking) &&
           mode_refusal_same(&a->refused, &b->refused) && (a->state == b->state) &&
           (a->mode == b->mode) && (a->asked == b->asked) && (a->rests_at == b->rests_at) &&
           (a->ready == b->ready) && (a->motors == b->motors) &&
           (a->settle_us[i] == b->settle_us[i]) && (a->held_us[i] == b->held_us[i]);
}

#endif
