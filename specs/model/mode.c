/* SPDX-License-Identifier: Apache-2.0 */
#include "mode.h"

/* The bits of the pilot's facts are 0 to 5, those of the aircraft's 6 to 13. */
#define PILOT_FACTS 6u
#define PILOT       0x003Fu
#define AIRCRAFT    0x3FC0u

#define ALARMS (KEEL_MODE_FENCE_BREACHED | KEEL_MODE_BATTERY_CRITICAL | KEEL_MODE_BATTERY_EMPTY)

/* --- MOD-001, MOD-002 ------------------------------------------------------------------------- */

static bool holds_long_enough(const keel_mode_config_t *config, uint32_t time_us)
{
    return (time_us >= config->loss_us) && (time_us <= KEEL_MODE_TIME_MOST_US);
}

static void settles(uint32_t settle_us[KEEL_MODE_FACTS], uint32_t facts, uint32_t time_us)
{
    for (uint32_t i = 0u; i < KEEL_MODE_FACTS; i++) {
        if (((facts >> i) & 1u) == 1u) {
            settle_us[i] = time_us;
        }
    }
}

keel_status_t model_mode_init(keel_mode_t *mode, const keel_mode_config_t *config)
{
    /* MOD-001 */
    if ((config->loss_us < KEEL_MODE_LOSS_LEAST_US) || (config->loss_us > KEEL_MODE_LOSS_MOST_US) ||
        !holds_long_enough(config, config->regain_us) ||
        !holds_long_enough(config, config->request_us) ||
        !holds_long_enough(config, config->kill_us) ||
        !holds_long_enough(config, config->landed_us) ||
        !holds_long_enough(config, config->estimate_us) ||
        !holds_long_enough(config, config->alarm_us) ||
        !holds_long_enough(config, config->idle_us) || (config->hold_us > KEEL_MODE_TIME_MOST_US) ||
        (config->return_us > KEEL_MODE_TIME_MOST_US)) {
        return KEEL_ERR_LIMITS;
    }
    if (config->required == 0u) {
        return KEEL_ERR_INPUT;
    }
    /* MOD-002 */
    mode->config = *config;
    settles(mode->settle_us, KEEL_MODE_RC_LINKED, config->regain_us);
    settles(mode->settle_us,
            KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_ARM_SWITCH_OFF | KEEL_MODE_THROTTLE_LOW |
                KEEL_MODE_SWITCH_UNMOVED,
            config->request_us);
    settles(mode->settle_us, KEEL_MODE_KILL_SWITCH_ON, config->kill_us);
    settles(mode->settle_us, KEEL_MODE_LANDED, config->landed_us);
    settles(mode->settle_us,
            KEEL_MODE_ATTITUDE_VALID | KEEL_MODE_ALTITUDE_VALID | KEEL_MODE_POSITION_VALID,
            config->estimate_us);
    settles(mode->settle_us, KEEL_MODE_AT_HOME | ALARMS, config->alarm_us);
    for (uint32_t i = 0u; i < KEEL_MODE_FACTS; i++) {
        mode->held_us[i] = 0u;
    }
    mode->silence_us = UINT32_MAX;
    mode->state_us = 0u;
    mode->seen = 0u;
    mode->settled = 0u;
    mode->overridden = 0u;
    mode->cause = 0u;
    mode->missing = 0u;
    mode->blocking.checks = 0u;
    mode->blocking.facts = 0u;
    mode->refused.checks = 0u;
    mode->refused.facts = 0u;
    mode->state = KEEL_MODE_DISARMED;
    mode->mode = KEEL_MODE_NONE;
    mode->asked = KEEL_MODE_NONE;
    mode->rests_at = KEEL_MODE_NONE;
    mode->ready = false;
    mode->motors = false;
    return KEEL_OK;
}

/* --- MOD-003: facts --------------------------------------------------------------------------- */

/* At most UINT32_MAX. */
static uint32_t sum_us(uint32_t a_us, uint32_t b_us)
{
    const uint64_t sum = (uint64_t)a_us + b_us;

    return (sum < UINT32_MAX) ? (uint32_t)sum : UINT32_MAX;
}

static bool is_frame(const keel_mode_input_t *input)
{
    return ((input->facts & KEEL_MODE_RC_LINKED) != 0u) && (input->asked <= KEEL_MODE_RETURN);
}

/* Whether the input says so, in a step with a frame if the fact is the pilot's. */
static bool says(const keel_mode_t *mode, const keel_mode_input_t *input, uint32_t fact)
{
    bool told = (input->facts & fact) != 0u;

    if (fact == KEEL_MODE_ARM_SWITCH_ON) {
        told = told && ((input->facts & KEEL_MODE_ARM_SWITCH_OFF) == 0u);
    }
    if (fact == KEEL_MODE_ARM_SWITCH_OFF) {
        told = told && ((input->facts & KEEL_MODE_ARM_SWITCH_ON) == 0u);
    }
    if (fact == KEEL_MODE_SWITCH_UNMOVED) {
        told = input->asked == mode->rests_at;
    }
    return told;
}

/* One fact at this step. The link is broken after too long a silence, and so is everything that is
 * settling after too long without a look. */
static void look_at(keel_mode_t *after, const keel_mode_t *mode, const keel_mode_input_t *input,
                    uint32_t i)
{
    const uint32_t fact = (uint32_t)1u << i;
    const bool pilots = i < PILOT_FACTS;
    const bool frame = is_frame(input);
    const bool broken = sum_us(mode->silence_us, input->elapsed_us) >= mode->config.loss_us;
    const bool unseen = (input->elapsed_us >= mode->config.loss_us) || (pilots && broken);
    const bool was = ((mode->seen & fact) != 0u) && !unseen;
    const bool is = (pilots && !frame) ? was : says(mode, input, fact);
    const bool counted = ((mode->settled & fact) != 0u) && !(pilots && broken);
    bool counts = is && counted;

    if (is && !counted) {
        after->held_us[i] = was ? sum_us(mode->held_us[i], input->elapsed_us) : 0u;
        counts = (!pilots || frame) && (after->held_us[i] >= mode->settle_us[i]);
    }
    after->seen = is ? (after->seen | fact) : (after->seen & ~fact);
    after->settled = counts ? (after->settled | fact) : (after->settled & ~fact);
}

static bool counts(const keel_mode_t *mode, uint32_t fact)
{
    return (mode->settled & fact) != 0u;
}

static bool seen(const keel_mode_t *mode, uint32_t fact)
{
    return (mode->seen & fact) != 0u;
}

/* --- MOD-009: modes --------------------------------------------------------------------------- */

static bool flown_by_pilot(uint8_t mode)
{
    return (mode == KEEL_MODE_ACRO) || (mode == KEEL_MODE_ANGLE) || (mode == KEEL_MODE_ALTITUDE) ||
           (mode == KEEL_MODE_POSITION);
}

/* The estimates that a mode rests on. */
static uint32_t needs_of(uint8_t mode)
{
    uint32_t needs = 0u;

    if ((mode >= KEEL_MODE_ANGLE) && (mode <= KEEL_MODE_RETURN)) {
        needs |= KEEL_MODE_ATTITUDE_VALID;
    }
    if ((mode >= KEEL_MODE_ALTITUDE) && (mode <= KEEL_MODE_RETURN)) {
        needs |= KEEL_MODE_ALTITUDE_VALID;
    }
    if ((mode >= KEEL_MODE_POSITION) && (mode <= KEEL_MODE_RETURN)) {
        needs |= KEEL_MODE_POSITION_VALID;
    }
    return needs;
}

static uint32_t missing_of(const keel_mode_t *mode, uint8_t wanted)
{
    return needs_of(wanted) & ~mode->settled;
}

/* The best mode that a pilot can fly instead. */
static uint8_t instead_with_pilot(const keel_mode_t *mode, uint8_t wanted)
{
    uint8_t best = KEEL_MODE_ACRO;

    if (missing_of(mode, KEEL_MODE_ANGLE) == 0u) {
        best = KEEL_MODE_ANGLE;
    }
    if ((wanted > KEEL_MODE_ALTITUDE) && (missing_of(mode, KEEL_MODE_ALTITUDE) == 0u)) {
        best = KEEL_MODE_ALTITUDE;
    }
    return best;
}

static uint8_t wanted_in(const keel_mode_t *mode)
{
    switch (mode->state) {
    case KEEL_MODE_ARMED:
    case KEEL_MODE_FLYING:
        return mode->asked;
    case KEEL_MODE_HOLDING:
        return KEEL_MODE_POSITION;
    case KEEL_MODE_RETURNING:
        return KEEL_MODE_RETURN;
    case KEEL_MODE_LANDING:
        return KEEL_MODE_LAND;
    default:
        return KEEL_MODE_NONE;
    }
}

static void put_in_force(keel_mode_t *mode)
{
    const uint8_t wanted = wanted_in(mode);

    mode->missing = missing_of(mode, wanted);
    if (mode->missing == 0u) {
        mode->mode = wanted;
    } else if ((mode->state == KEEL_MODE_ARMED) || (mode->state == KEEL_MODE_FLYING)) {
        mode->mode = instead_with_pilot(mode, wanted);
    } else if ((mode->state == KEEL_MODE_HOLDING) && (missing_of(mode, KEEL_MODE_ALTITUDE) == 0u)) {
        mode->mode = KEEL_MODE_ALTITUDE;
    } else {
        mode->mode = KEEL_MODE_LAND;
    }
    mode->motors = (mode->state != KEEL_MODE_DISARMED) && (mode->state != KEEL_MODE_TERMINATED);
}

/* --- MOD-004, MOD-005: arming ----------------------------------------------------------------- */

static keel_mode_refusal_t in_the_way(const keel_mode_t *mode, uint32_t checks, bool attempt)
{
    keel_mode_refusal_t way;

    way.checks = mode->config.required & ~checks;
    way.facts = mode->seen & (KEEL_MODE_KILL_SWITCH_ON | ALARMS);
    way.facts |= counts(mode, KEEL_MODE_RC_LINKED) ? 0u : KEEL_MODE_RC_LINKED;
    way.facts |= counts(mode, KEEL_MODE_THROTTLE_LOW) ? 0u : KEEL_MODE_THROTTLE_LOW;
    way.facts |= counts(mode, KEEL_MODE_LANDED) ? 0u : KEEL_MODE_LANDED;
    way.facts |= (attempt || mode->ready) ? 0u : KEEL_MODE_ARM_SWITCH_OFF;
    way.facts |= (counts(mode, KEEL_MODE_SWITCH_UNMOVED) && flown_by_pilot(mode->asked) &&
                  (missing_of(mode, mode->asked) == 0u))
                     ? 0u
                     : KEEL_MODE_SWITCH_UNMOVED;
    return way;
}

/* --- MOD-006 to MOD-011: states --------------------------------------------------------------- */

/* What moves the machine in a step. */
typedef struct happens {
    bool frame;
    bool arms;
    bool moved; /* The mode switch. */
} happens_t;

/* An alarm, unless the pilot took over from it. */
static uint32_t alarms(const keel_mode_t *mode, uint32_t which)
{
    return mode->settled & ~mode->overridden & which;
}

static uint32_t if_so(bool so, uint32_t cause)
{
    return so ? cause : 0u;
}

static bool lasts(const keel_mode_t *mode, uint32_t time_us)
{
    return mode->state_us >= time_us;
}

static void go_to(keel_mode_t *mode, uint8_t state, uint32_t cause)
{
    const bool was = (mode->state >= KEEL_MODE_HOLDING) && (mode->state <= KEEL_MODE_LANDING);
    const bool will = (state >= KEEL_MODE_HOLDING) && (state <= KEEL_MODE_LANDING);

    mode->cause = (was && will) ? (mode->cause | cause) : cause;
    mode->state = state;
    mode->state_us = 0u;
}

static bool asks(const keel_mode_t *mode, const happens_t *happens, uint8_t asked)
{
    return (happens->moved || (mode->state == KEEL_MODE_FLYING)) && (mode->asked == asked);
}

static bool asks_return(const keel_mode_t *mode, const happens_t *happens)
{
    return asks(mode, happens, KEEL_MODE_RETURN) && counts(mode, KEEL_MODE_POSITION_VALID);
}

static uint32_t asks_land(const keel_mode_t *mode, const happens_t *happens)
{
    return if_so(asks(mode, happens, KEEL_MODE_LAND), KEEL_MODE_PILOT_ASKS_LAND);
}

/* An urgent cause leads home where that can be, else down. */
static void go_home_or_down(keel_mode_t *mode, uint32_t cause)
{
    const bool home = mode->config.returns && counts(mode, KEEL_MODE_POSITION_VALID);

    go_to(mode, home ? KEEL_MODE_RETURNING : KEEL_MODE_LANDING, cause);
}

static void from_armed(keel_mode_t *mode, const happens_t *happens)
{
    const uint32_t disarms = if_so(happens->frame && counts(mode, KEEL_MODE_ARM_SWITCH_OFF),
                                   KEEL_MODE_ARM_SWITCH_OFF) |
                             if_so(lasts(mode, mode->config.idle_us), KEEL_MODE_STATE_TIMES_OUT);

    if (!counts(mode, KEEL_MODE_RC_LINKED)) {
        go_to(mode, KEEL_MODE_LANDING, KEEL_MODE_RC_LOST);
    } else if (!seen(mode, KEEL_MODE_LANDED) || !seen(mode, KEEL_MODE_THROTTLE_LOW)) {
        go_to(mode, KEEL_MODE_FLYING, KEEL_MODE_LEAVES_GROUND);
    } else if (disarms != 0u) {
        go_to(mode, KEEL_MODE_DISARMED, disarms);
    } else {
        /* Stays. */
    }
}

static void from_flying(keel_mode_t *mode, const happens_t *happens)
{
    const uint32_t down = alarms(mode, KEEL_MODE_BATTERY_EMPTY) | asks_land(mode, happens);
    const uint32_t urgent = alarms(mode, KEEL_MODE_FENCE_BREACHED | KEEL_MODE_BATTERY_CRITICAL);

    if (!counts(mode, KEEL_MODE_RC_LINKED)) {
        go_to(mode, KEEL_MODE_HOLDING, KEEL_MODE_RC_LOST);
    } else if (down != 0u) {
        go_to(mode, KEEL_MODE_LANDING, down);
    } else if (asks_return(mode, happens)) {
        go_to(mode, KEEL_MODE_RETURNING, KEEL_MODE_PILOT_ASKS_RETURN);
    } else if (urgent != 0u) {
        go_home_or_down(mode, urgent);
    } else if (counts(mode, KEEL_MODE_LANDED) && counts(mode, KEEL_MODE_THROTTLE_LOW)) {
        go_to(mode, KEEL_MODE_ARMED, KEEL_MODE_TOUCHES_DOWN);
    } else {
        /* Stays. */
    }
}

static void from_holding(keel_mode_t *mode, const happens_t *happens)
{
    const uint32_t down = alarms(mode, KEEL_MODE_BATTERY_EMPTY) | asks_land(mode, happens) |
                          if_so(counts(mode, KEEL_MODE_LANDED), KEEL_MODE_LANDED);
    const uint32_t urgent = alarms(mode, KEEL_MODE_FENCE_BREACHED | KEEL_MODE_BATTERY_CRITICAL) |
                            if_so(lasts(mode, mode->config.hold_us), KEEL_MODE_STATE_TIMES_OUT);

    if (down != 0u) {
        go_to(mode, KEEL_MODE_LANDING, down);
    } else if (asks_return(mode, happens)) {
        go_to(mode, KEEL_MODE_RETURNING, KEEL_MODE_PILOT_ASKS_RETURN);
    } else if (urgent != 0u) {
        go_home_or_down(mode, urgent);
    } else {
        /* Stays. */
    }
}

static void from_returning(keel_mode_t *mode, const happens_t *happens)
{
    const uint32_t down = alarms(mode, KEEL_MODE_BATTERY_EMPTY) | asks_land(mode, happens) |
                          (mode->settled & (KEEL_MODE_LANDED | KEEL_MODE_AT_HOME)) |
                          if_so(lasts(mode, mode->config.return_us), KEEL_MODE_STATE_TIMES_OUT);

    if (down != 0u) {
        go_to(mode, KEEL_MODE_LANDING, down);
    }
}

static void from_landing(keel_mode_t *mode, const happens_t *happens)
{
    if (asks_return(mode, happens)) {
        go_to(mode, KEEL_MODE_RETURNING, KEEL_MODE_PILOT_ASKS_RETURN);
    } else if (counts(mode, KEEL_MODE_LANDED) && lasts(mode, mode->config.landed_us)) {
        go_to(mode, KEEL_MODE_DISARMED, KEEL_MODE_STAYS_LANDED);
    } else {
        /* Stays. */
    }
}

static void go_on(keel_mode_t *mode, const happens_t *happens)
{
    const bool motors = (mode->state != KEEL_MODE_DISARMED) &&
                        (mode->state != KEEL_MODE_TERMINATED);
    const bool alone = (mode->state == KEEL_MODE_HOLDING) || (mode->state == KEEL_MODE_RETURNING) ||
                       (mode->state == KEEL_MODE_LANDING);

    if (motors && happens->frame && counts(mode, KEEL_MODE_KILL_SWITCH_ON)) {
        go_to(mode, KEEL_MODE_TERMINATED, KEEL_MODE_KILL_SWITCH_ON); /* MOD-010 */
    } else if (alone && happens->moved && flown_by_pilot(mode->asked)) {
        go_to(mode, KEEL_MODE_FLYING, KEEL_MODE_PILOT_TAKES_OVER); /* MOD-008 */
        mode->overridden = mode->settled & ALARMS;
    } else if (happens->arms) {
        go_to(mode, KEEL_MODE_ARMED, KEEL_MODE_PILOT_ARMS);
    } else if (mode->state == KEEL_MODE_ARMED) {
        from_armed(mode, happens);
    } else if (mode->state == KEEL_MODE_FLYING) {
        from_flying(mode, happens);
    } else if (mode->state == KEEL_MODE_HOLDING) {
        from_holding(mode, happens);
    } else if (mode->state == KEEL_MODE_RETURNING) {
        from_returning(mode, happens);
    } else if (mode->state == KEEL_MODE_LANDING) {
        from_landing(mode, happens);
    } else {
        /* DISARMED stays until armed; TERMINATED stays (MOD-010). */
    }
}

void model_mode_step(keel_mode_t *mode, const keel_mode_input_t *input)
{
    const keel_mode_t old = *mode;
    happens_t happens = {is_frame(input), false, false};
    bool up;
    bool on;
    bool attempt;

    /* MOD-003 */
    for (uint32_t i = 0u; i < KEEL_MODE_FACTS; i++) {
        look_at(mode, &old, input, i);
    }
    mode->seen &= PILOT | AIRCRAFT;
    mode->settled &= PILOT | AIRCRAFT;
    mode->silence_us = happens.frame ? 0u : sum_us(old.silence_us, input->elapsed_us);
    mode->rests_at = happens.frame ? input->asked : old.rests_at;
    mode->state_us = sum_us(old.state_us, input->elapsed_us);
    up = counts(mode, KEEL_MODE_RC_LINKED);
    on = counts(mode, KEEL_MODE_ARM_SWITCH_ON);
    /* MOD-011: an alarm that ends, or a link that is lost, ends what was overridden. */
    mode->overridden = up ? (old.overridden & mode->settled) : 0u;
    /* MOD-008: what the mode switch asks for, and whether it was moved. */
    if (!up) {
        mode->asked = KEEL_MODE_NONE;
    } else if (happens.frame && counts(mode, KEEL_MODE_SWITCH_UNMOVED)) {
        mode->asked = input->asked;
        happens.moved = (old.asked != KEEL_MODE_NONE) && (old.asked != input->asked);
    } else {
        /* As before. */
    }
    /* MOD-004: switching on after off, with a link all the time, is an attempt. */
    attempt = old.ready && up && on;
    mode->ready = up && !on && (old.ready || counts(mode, KEEL_MODE_ARM_SWITCH_OFF));
    /* MOD-005 */
    mode->blocking.checks = 0u;
    mode->blocking.facts = 0u;
    if (mode->state == KEEL_MODE_DISARMED) {
        mode->blocking = in_the_way(mode, input->checks, attempt);
        mode->refused = attempt ? mode->blocking : old.refused;
        happens.arms = attempt && (mode->blocking.checks == 0u) && (mode->blocking.facts == 0u);
    }
    go_on(mode, &happens);
    put_in_force(mode);
}
