/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/mode.h"

#define PILOT                                                                                      \
    (KEEL_MODE_RC_LINKED | KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_ARM_SWITCH_OFF |                    \
     KEEL_MODE_THROTTLE_LOW | KEEL_MODE_KILL_SWITCH_ON | KEEL_MODE_SWITCH_UNMOVED)
#define ESTIMATES (KEEL_MODE_ATTITUDE_VALID | KEEL_MODE_ALTITUDE_VALID | KEEL_MODE_POSITION_VALID)
#define ALARMS    (KEEL_MODE_FENCE_BREACHED | KEEL_MODE_BATTERY_CRITICAL | KEEL_MODE_BATTERY_EMPTY)
#define AIRCRAFT  (KEEL_MODE_LANDED | KEEL_MODE_AT_HOME | ESTIMATES | ALARMS)
#define SWITCH    (KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_ARM_SWITCH_OFF)
#define ON_GROUND (KEEL_MODE_LANDED | KEEL_MODE_THROTTLE_LOW)

/* The facts that must have settled before arming, ARM_SWITCH_OFF and SWITCH_UNMOVED in a special
 * sense (arming_refusal), and those that must not hold. */
#define NEEDED                                                                                     \
    (KEEL_MODE_RC_LINKED | KEEL_MODE_ARM_SWITCH_OFF | KEEL_MODE_SWITCH_UNMOVED | ON_GROUND)
#define FORBIDDEN (KEEL_MODE_KILL_SWITCH_ON | ALARMS)

/* --- The tables ------------------------------------------------------------------------------- */

/* An exit of a state: taken when any of these events has come, and also all of those. */
typedef struct mode_exit {
    uint32_t any;
    uint32_t also;
    uint8_t to;
} mode_exit_t;

#define EXITS 7u

/* Of each state the exits; the first that applies is taken. Those that a state does not need are
 * zeros, which never apply. TERMINATED has none. */
static const mode_exit_t exits[KEEL_MODE_STATES][EXITS] = {
    [KEEL_MODE_DISARMED] = {{KEEL_MODE_PILOT_ARMS, 0u, KEEL_MODE_ARMED}},
    [KEEL_MODE_ARMED] = {{KEEL_MODE_KILL_SWITCH_ON, 0u, KEEL_MODE_TERMINATED},
                         {KEEL_MODE_RC_LOST, 0u, KEEL_MODE_LANDING},
                         {KEEL_MODE_LEAVES_GROUND, 0u, KEEL_MODE_FLYING},
                         {KEEL_MODE_ARM_SWITCH_OFF | KEEL_MODE_STATE_TIMES_OUT, 0u,
                          KEEL_MODE_DISARMED}},
    [KEEL_MODE_FLYING] = {{KEEL_MODE_KILL_SWITCH_ON, 0u, KEEL_MODE_TERMINATED},
                          {KEEL_MODE_RC_LOST, 0u, KEEL_MODE_HOLDING},
                          {KEEL_MODE_BATTERY_EMPTY | KEEL_MODE_PILOT_ASKS_LAND, 0u,
                           KEEL_MODE_LANDING},
                          {KEEL_MODE_PILOT_ASKS_RETURN, 0u, KEEL_MODE_RETURNING},
                          {KEEL_MODE_FENCE_BREACHED | KEEL_MODE_BATTERY_CRITICAL,
                           KEEL_MODE_CAN_RETURN, KEEL_MODE_RETURNING},
                          {KEEL_MODE_FENCE_BREACHED | KEEL_MODE_BATTERY_CRITICAL, 0u,
                           KEEL_MODE_LANDING},
                          {KEEL_MODE_TOUCHES_DOWN, 0u, KEEL_MODE_ARMED}},
    [KEEL_MODE_HOLDING] = {{KEEL_MODE_KILL_SWITCH_ON, 0u, KEEL_MODE_TERMINATED},
                           {KEEL_MODE_PILOT_TAKES_OVER, 0u, KEEL_MODE_FLYING},
                           {KEEL_MODE_BATTERY_EMPTY | KEEL_MODE_LANDED | KEEL_MODE_PILOT_ASKS_LAND,
                            0u, KEEL_MODE_LANDING},
                           {KEEL_MODE_PILOT_ASKS_RETURN, 0u, KEEL_MODE_RETURNING},
                           {KEEL_MODE_FENCE_BREACHED | KEEL_MODE_BATTERY_CRITICAL |
                                KEEL_MODE_STATE_TIMES_OUT,
                            KEEL_MODE_CAN_RETURN, KEEL_MODE_RETURNING},
                           {KEEL_MODE_FENCE_BREACHED | KEEL_MODE_BATTERY_CRITICAL |
                                KEEL_MODE_STATE_TIMES_OUT,
                            0u, KEEL_MODE_LANDING}},
    [KEEL_MODE_RETURNING] = {{KEEL_MODE_KILL_SWITCH_ON, 0u, KEEL_MODE_TERMINATED},
                             {KEEL_MODE_PILOT_TAKES_OVER, 0u, KEEL_MODE_FLYING},
                             {KEEL_MODE_BATTERY_EMPTY | KEEL_MODE_LANDED | KEEL_MODE_AT_HOME |
                                  KEEL_MODE_PILOT_ASKS_LAND | KEEL_MODE_STATE_TIMES_OUT,
                              0u, KEEL_MODE_LANDING}},
    [KEEL_MODE_LANDING] = {{KEEL_MODE_KILL_SWITCH_ON, 0u, KEEL_MODE_TERMINATED},
                           {KEEL_MODE_PILOT_TAKES_OVER, 0u, KEEL_MODE_FLYING},
                           {KEEL_MODE_PILOT_ASKS_RETURN, 0u, KEEL_MODE_RETURNING},
                           {KEEL_MODE_STAYS_LANDED, 0u, KEEL_MODE_DISARMED}},
    [KEEL_MODE_TERMINATED] = {{0u, 0u, KEEL_MODE_TERMINATED}}};

/* The mode that each state wants where the pilot does not fly. */
static const uint8_t state_wants[KEEL_MODE_STATES] = {
    [KEEL_MODE_DISARMED] = KEEL_MODE_NONE,    [KEEL_MODE_ARMED] = KEEL_MODE_NONE,
    [KEEL_MODE_FLYING] = KEEL_MODE_NONE,      [KEEL_MODE_HOLDING] = KEEL_MODE_POSITION,
    [KEEL_MODE_RETURNING] = KEEL_MODE_RETURN, [KEEL_MODE_LANDING] = KEEL_MODE_LAND,
    [KEEL_MODE_TERMINATED] = KEEL_MODE_NONE};

/* The facts that a mode needs, and the mode that replaces it without them: when the pilot flies,
 * and when nobody does. The latter never leads to a mode that waits for a pilot's throttle. */
typedef struct mode_row {
    uint32_t needs;
    uint8_t piloted;
    uint8_t alone;
} mode_row_t;

static const mode_row_t modes[KEEL_MODE_NONE + 1u] = {
    [KEEL_MODE_ACRO] = {0u, KEEL_MODE_ACRO, KEEL_MODE_ACRO},
    [KEEL_MODE_LAND] = {0u, KEEL_MODE_LAND, KEEL_MODE_LAND},
    [KEEL_MODE_ANGLE] = {KEEL_MODE_ATTITUDE_VALID, KEEL_MODE_ACRO, KEEL_MODE_LAND},
    [KEEL_MODE_ALTITUDE] = {KEEL_MODE_ATTITUDE_VALID | KEEL_MODE_ALTITUDE_VALID, KEEL_MODE_ANGLE,
                            KEEL_MODE_LAND},
    [KEEL_MODE_POSITION] = {ESTIMATES, KEEL_MODE_ALTITUDE, KEEL_MODE_ALTITUDE},
    [KEEL_MODE_RETURN] = {ESTIMATES, KEEL_MODE_ALTITUDE, KEEL_MODE_LAND},
    [KEEL_MODE_NONE] = {0u, KEEL_MODE_NONE, KEEL_MODE_NONE}};

/* The tables are read only through these, so the facts known of them stand here. */
/*@ requires state < KEEL_MODE_STATES && i < EXITS;
  @ assigns \nothing;
  @ ensures \result.to < KEEL_MODE_STATES;
  @*/
static mode_exit_t exit_of(uint8_t state, uint32_t i)
{
    return exits[state][i];
}

/*@ requires state < KEEL_MODE_STATES;
  @ assigns \nothing;
  @ ensures \result <= KEEL_MODE_NONE;
  @*/
static uint8_t wanted_by(uint8_t state)
{
    return state_wants[state];
}

/*@ requires mode <= KEEL_MODE_NONE;
  @ assigns \nothing;
  @ ensures mode <= KEEL_MODE_LAND || mode == KEEL_MODE_NONE ==> \result == 0;
  @*/
static uint32_t needs_of(uint8_t mode)
{
    return modes[mode].needs;
}

/*@ requires mode <= KEEL_MODE_NONE;
  @ assigns \nothing;
  @ ensures \result <= KEEL_MODE_NONE;
  @ ensures KEEL_MODE_LAND < mode < KEEL_MODE_NONE ==> \result < mode;
  @*/
static uint8_t instead_of(uint8_t mode, bool piloted)
{
    return piloted ? modes[mode].piloted : modes[mode].alone;
}

/* --- Facts ------------------------------------------------------------------------------------ */

/* The bit of a fact: that of the last one, moved down, as nothing overflows that way. */
/*@ requires i < KEEL_MODE_FACTS;
  @ assigns \nothing;
  @*/
static uint32_t bit_of(uint32_t i)
{
    return KEEL_MODE_BATTERY_EMPTY >> ((KEEL_MODE_FACTS - 1u) - i);
}

/*@ assigns \nothing;
  @ ensures \result == \min(UINT32_MAX, time_us + more_us);
  @*/
static uint32_t add_us(uint32_t time_us, uint32_t more_us)
{
    return (time_us <= (UINT32_MAX - more_us)) ? (time_us + more_us) : UINT32_MAX;
}

/*@ requires \valid_read(input);
  @ assigns \nothing;
  @ ensures \result ==> input->asked < KEEL_MODE_NONE;
  @*/
static bool has_frame(const keel_mode_input_t *input)
{
    return ((input->facts & KEEL_MODE_RC_LINKED) != 0u) && (input->asked < KEEL_MODE_NONE);
}

/* Reads a good frame. A switch that is both on and off is neither. */
/*@ requires \valid(mode) && \valid_read(input) && \separated(mode, input);
  @ assigns mode->rests_at;
  @ ensures mode->rests_at == input->asked;
  @*/
static uint32_t read_frame(keel_mode_t *mode, const keel_mode_input_t *input)
{
    uint32_t facts = input->facts & (PILOT & ~KEEL_MODE_SWITCH_UNMOVED);

    if ((facts & SWITCH) == SWITCH) {
        facts &= ~SWITCH;
    }
    if (input->asked == mode->rests_at) {
        facts |= KEEL_MODE_SWITCH_UNMOVED;
    }
    mode->rests_at = input->asked;
    return facts;
}

/* After too long a silence what the pilot said is forgotten; after too long without a look all
 * facts begin to settle again. */
/*@ requires \valid(mode);
  @ assigns mode->silence_us, mode->seen, mode->settled;
  @*/
static void forget_stale_facts(keel_mode_t *mode, uint32_t elapsed_us)
{
    mode->silence_us = add_us(mode->silence_us, elapsed_us);
    if (mode->silence_us >= mode->config.loss_us) {
        mode->seen &= ~PILOT;
        mode->settled &= ~PILOT;
    }
    if (elapsed_us >= mode->config.loss_us) {
        mode->seen = 0u;
    }
}

/* Counts for how long the facts that are seen have been so; those of `may` can settle. */
/*@ requires \valid(mode);
  @ assigns mode->settled, mode->seen, mode->held_us[0 .. KEEL_MODE_FACTS - 1];
  @*/
static void settle_facts(keel_mode_t *mode, uint32_t now, uint32_t may, uint32_t elapsed_us)
{
    const uint32_t before = mode->seen;
    const uint32_t waiting = now & ~mode->settled;
    uint32_t settled = mode->settled & now;

    /*@ loop invariant 0 <= i <= KEEL_MODE_FACTS;
      @ loop assigns i, settled, mode->held_us[0 .. KEEL_MODE_FACTS - 1];
      @ loop variant KEEL_MODE_FACTS - i;
      @*/
    for (uint32_t i = 0u; (i < KEEL_MODE_FACTS) && ((waiting >> i) != 0u); i++) {
        const uint32_t bit = bit_of(i);

        if ((waiting & bit) != 0u) {
            const uint32_t held_us = ((before & bit) != 0u) ? add_us(mode->held_us[i], elapsed_us)
                                                            : 0u;

            mode->held_us[i] = held_us;
            if (held_us >= mode->settle_us[i]) {
                settled |= bit & may;
            }
        }
    }
    mode->settled = settled;
    mode->seen = now;
}

/*@ requires \valid(mode) && \valid_read(input) && \separated(mode, input);
  @ requires frame: frame ==> input->asked < KEEL_MODE_NONE;
  @ requires rests: mode->rests_at <= KEEL_MODE_NONE;
  @ assigns mode->settled, mode->seen, mode->held_us[0 .. KEEL_MODE_FACTS - 1], mode->silence_us,
  @     mode->rests_at;
  @ ensures mode->rests_at <= KEEL_MODE_NONE;
  @*/
static void look_at_facts(keel_mode_t *mode, const keel_mode_input_t *input, bool frame)
{
    uint32_t now = input->facts & AIRCRAFT;

    forget_stale_facts(mode, input->elapsed_us);
    if (frame) {
        now |= read_frame(mode, input);
        mode->silence_us = 0u;
    } else {
        now |= mode->seen & PILOT;
    }
    settle_facts(mode, now, frame ? (PILOT | AIRCRAFT) : AIRCRAFT, input->elapsed_us);
}

/*@ requires \valid_read(mode);
  @ assigns \nothing;
  @*/
static bool has_settled(const keel_mode_t *mode, uint32_t facts)
{
    return (mode->settled & facts) == facts;
}

/* --- The pilot's wishes ----------------------------------------------------------------------- */

/* Whether the mode switch was moved. Where it is when the link comes up is no move. */
/*@ requires \valid(mode);
  @ requires rests: mode->rests_at <= KEEL_MODE_NONE && mode->asked <= KEEL_MODE_NONE;
  @ assigns mode->asked;
  @ ensures mode->asked <= KEEL_MODE_NONE;
  @*/
static bool heed_mode_switch(keel_mode_t *mode, bool frame)
{
    bool moved = false;

    if (!has_settled(mode, KEEL_MODE_RC_LINKED)) {
        mode->asked = KEEL_MODE_NONE;
    } else if (frame && has_settled(mode, KEEL_MODE_SWITCH_UNMOVED)) {
        moved = (mode->asked != KEEL_MODE_NONE) && (mode->asked != mode->rests_at);
        mode->asked = mode->rests_at;
    } else {
        /* It stays at what it was. */
    }
    return moved;
}

/* Whether the arm switch was switched on after it was seen off, both with a link. */
/*@ requires \valid(mode);
  @ assigns mode->ready;
  @*/
static bool heed_arm_switch(keel_mode_t *mode)
{
    const bool up = has_settled(mode, KEEL_MODE_RC_LINKED);
    const bool on = has_settled(mode, KEEL_MODE_ARM_SWITCH_ON);
    const bool attempt = mode->ready && up && on;

    mode->ready = up && !on && (mode->ready || has_settled(mode, KEEL_MODE_ARM_SWITCH_OFF));
    return attempt;
}

/*@ assigns \nothing;
  @ ensures \result <==> asked != KEEL_MODE_LAND && asked < KEEL_MODE_RETURN;
  @*/
static bool is_piloted(uint8_t asked)
{
    return (asked != KEEL_MODE_LAND) && (asked < KEEL_MODE_RETURN);
}

/* The obstacles to arming. */
/*@ requires \valid_read(mode) && asked: mode->asked <= KEEL_MODE_NONE;
  @ assigns \nothing;
  @*/
static keel_mode_refusal_t arming_refusal(const keel_mode_t *mode, uint32_t checks, bool attempt)
{
    uint32_t good = mode->settled &
                    (NEEDED & ~(KEEL_MODE_ARM_SWITCH_OFF | KEEL_MODE_SWITCH_UNMOVED));
    keel_mode_refusal_t refusal;

    if (attempt || mode->ready) {
        good |= KEEL_MODE_ARM_SWITCH_OFF;
    }
    if (has_settled(mode, KEEL_MODE_SWITCH_UNMOVED | needs_of(mode->asked)) &&
        is_piloted(mode->asked)) {
        good |= KEEL_MODE_SWITCH_UNMOVED;
    }
    refusal.checks = mode->config.required & ~checks;
    refusal.facts = (NEEDED & ~good) | (mode->seen & FORBIDDEN);
    return refusal;
}

/* Whether an attempt to arm succeeds. In all states but DISARMED nothing is refused. */
/*@ requires \valid(mode) && asked: mode->asked <= KEEL_MODE_NONE;
  @ assigns mode->blocking, mode->refused;
  @*/
static bool try_to_arm(keel_mode_t *mode, uint32_t checks, bool attempt)
{
    const keel_mode_refusal_t none = {0u, 0u};

    if (mode->state != KEEL_MODE_DISARMED) {
        mode->blocking = none;
        return false;
    }
    mode->blocking = arming_refusal(mode, checks, attempt);
    if (attempt) {
        mode->refused = mode->blocking;
    }
    return attempt && ((mode->blocking.checks | mode->blocking.facts) == 0u);
}

/* --- Facts that have come --------------------------------------------------------------------- */

/*@ assigns \nothing;
  @ ensures \result == (condition ? event : 0);
  @*/
static uint32_t event_when(bool condition, uint32_t event)
{
    return condition ? event : 0u;
}

/*@ requires \valid_read(mode);
  @ assigns \nothing;
  @*/
static bool is_time_up(const keel_mode_t *mode)
{
    uint32_t limit_us = mode->config.idle_us;

    if (mode->state == KEEL_MODE_HOLDING) {
        limit_us = mode->config.hold_us;
    } else if (mode->state == KEEL_MODE_RETURNING) {
        limit_us = mode->config.return_us;
    } else {
        /* No other state but ARMED asks. */
    }
    return mode->state_us >= limit_us;
}

/* A pilot who flies asks for what his switch says; else he must move it. */
/*@ requires \valid_read(mode);
  @ assigns \nothing;
  @*/
static uint32_t pilot_requests(const keel_mode_t *mode, bool moved)
{
    const bool asks = moved || (mode->state == KEEL_MODE_FLYING);

    return event_when(moved && is_piloted(mode->asked), KEEL_MODE_PILOT_TAKES_OVER) |
           event_when(asks && (mode->asked == KEEL_MODE_LAND), KEEL_MODE_PILOT_ASKS_LAND) |
           event_when(asks && (mode->asked == KEEL_MODE_RETURN) &&
                          has_settled(mode, KEEL_MODE_POSITION_VALID),
                      KEEL_MODE_PILOT_ASKS_RETURN);
}

/* The facts that have come. The pilot's count only in a step with a frame. */
/*@ requires \valid_read(mode);
  @ assigns \nothing;
  @*/
static uint32_t events_of(const keel_mode_t *mode, bool frame)
{
    const bool landed = has_settled(mode, KEEL_MODE_LANDED);

    return (mode->settled & ~mode->overridden & (frame ? (PILOT | AIRCRAFT) : AIRCRAFT)) |
           event_when(!has_settled(mode, KEEL_MODE_RC_LINKED), KEEL_MODE_RC_LOST) |
           event_when((mode->seen & ON_GROUND) != ON_GROUND, KEEL_MODE_LEAVES_GROUND) |
           event_when(has_settled(mode, ON_GROUND), KEEL_MODE_TOUCHES_DOWN) |
           event_when(landed && (mode->state_us >= mode->config.landed_us),
                      KEEL_MODE_STAYS_LANDED) |
           event_when(is_time_up(mode), KEEL_MODE_STATE_TIMES_OUT) |
           event_when(mode->config.returns && has_settled(mode, KEEL_MODE_POSITION_VALID),
                      KEEL_MODE_CAN_RETURN);
}

/* --- Where it leads --------------------------------------------------------------------------- */

/*@ assigns \nothing;
  @ ensures \result <==> mode_alone(state);
  @*/
static bool is_failsafe(uint8_t state)
{
    return (state >= KEEL_MODE_HOLDING) && (state <= KEEL_MODE_LANDING);
}

/* Takes an exit. The first cause that led away from the pilot is kept until he flies again. */
/*@ requires \valid(mode);
  @ assigns mode->state, mode->state_us, mode->cause, mode->overridden;
  @ ensures mode->state == way.to && mode->state_us == 0;
  @*/
static void take_exit(keel_mode_t *mode, mode_exit_t way, uint32_t events)
{
    const uint32_t cause = way.any & events;

    if (!is_failsafe(mode->state) || !is_failsafe(way.to)) {
        mode->cause = 0u;
    }
    mode->cause |= cause;
    if ((cause & KEEL_MODE_PILOT_TAKES_OVER) != 0u) {
        mode->overridden = mode->settled & ALARMS;
    }
    mode->state = way.to;
    mode->state_us = 0u;
}

/*@ requires \valid(mode) && state: mode->state < KEEL_MODE_STATES;
  @ assigns mode->state, mode->state_us, mode->cause, mode->overridden;
  @ ensures mode->state < KEEL_MODE_STATES;
  @*/
static void change_state(keel_mode_t *mode, uint32_t events)
{
    const uint8_t state = mode->state;

    /*@ loop invariant 0 <= i <= EXITS;
      @ loop assigns i;
      @ loop variant EXITS - i;
      @*/
    for (uint32_t i = 0u; (i < EXITS) && (exit_of(state, i).any != 0u); i++) {
        const mode_exit_t way = exit_of(state, i);

        if (((way.any & events) != 0u) && ((way.also & events) == way.also)) {
            take_exit(mode, way, events);
            return;
        }
    }
}

/* The mode in force: the one that is wanted, or what takes its place. */
/*@ requires \valid(mode) && state: mode->state < KEEL_MODE_STATES;
  @ requires asked: mode->asked <= KEEL_MODE_NONE;
  @ assigns mode->missing, mode->mode, mode->motors;
  @ ensures mode->mode <= KEEL_MODE_NONE;
  @*/
static void choose_mode(keel_mode_t *mode)
{
    const bool piloted = (mode->state == KEEL_MODE_ARMED) || (mode->state == KEEL_MODE_FLYING);
    uint8_t chosen = piloted ? mode->asked : wanted_by(mode->state);

    mode->missing = needs_of(chosen) & ~mode->settled;
    /*@ loop invariant chosen <= KEEL_MODE_NONE;
      @ loop assigns chosen;
      @ loop variant chosen;
      @*/
    while ((needs_of(chosen) & ~mode->settled) != 0u) {
        chosen = instead_of(chosen, piloted);
    }
    mode->mode = chosen;
    mode->motors = piloted || is_failsafe(mode->state);
}

void keel_mode_step(keel_mode_t *mode, const keel_mode_input_t *input)
{
    const bool frame = has_frame(input);
    bool moved;
    bool attempt;
    bool arms;
    uint32_t events;

    look_at_facts(mode, input, frame);
    mode->overridden &= has_settled(mode, KEEL_MODE_RC_LINKED) ? mode->settled : 0u;
    mode->state_us = add_us(mode->state_us, input->elapsed_us);
    moved = heed_mode_switch(mode, frame);
    attempt = heed_arm_switch(mode);
    arms = try_to_arm(mode, input->checks, attempt);
    events = events_of(mode, frame) | pilot_requests(mode, moved) |
             event_when(arms, KEEL_MODE_PILOT_ARMS);
    change_state(mode, events);
    choose_mode(mode);
}

/* --- The beginning ---------------------------------------------------------------------------- */

/*@ assigns \nothing;
  @ ensures \result <==> least <= value <= most;
  @*/
static bool is_between(uint32_t least, uint32_t value, uint32_t most)
{
    return (least <= value) && (value <= most);
}

/* Each fact that has to hold for a time holds for at least the longest silence. */
/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> mode_settling(config, time_us);
  @*/
static bool is_settling(const keel_mode_config_t *config, uint32_t time_us)
{
    return is_between(config->loss_us, time_us, KEEL_MODE_TIME_MOST_US);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> mode_settling(config, config->regain_us) &&
  @     mode_settling(config, config->request_us) && mode_settling(config, config->kill_us) &&
  @     mode_settling(config, config->idle_us);
  @*/
static bool are_pilot_times_valid(const keel_mode_config_t *config)
{
    return is_settling(config, config->regain_us) && is_settling(config, config->request_us) &&
           is_settling(config, config->kill_us) && is_settling(config, config->idle_us);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> mode_settling(config, config->landed_us) &&
  @     mode_settling(config, config->estimate_us) && mode_settling(config, config->alarm_us);
  @*/
static bool are_aircraft_times_valid(const keel_mode_config_t *config)
{
    return is_settling(config, config->landed_us) && is_settling(config, config->estimate_us) &&
           is_settling(config, config->alarm_us);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> mode_times_valid(config);
  @*/
static bool are_times_valid(const keel_mode_config_t *config)
{
    return is_between(KEEL_MODE_LOSS_LEAST_US, config->loss_us, KEEL_MODE_LOSS_MOST_US) &&
           are_pilot_times_valid(config) && are_aircraft_times_valid(config) &&
           (config->hold_us <= KEEL_MODE_TIME_MOST_US) &&
           (config->return_us <= KEEL_MODE_TIME_MOST_US);
}

/* How long the fact of a bit takes to settle. */
/*@ requires \valid_read(config);
  @ assigns \nothing;
  @*/
static uint32_t settle_us_of(const keel_mode_config_t *config, uint32_t bit)
{
    uint32_t time_us = config->alarm_us;

    if (bit == KEEL_MODE_RC_LINKED) {
        time_us = config->regain_us;
    } else if (bit == KEEL_MODE_KILL_SWITCH_ON) {
        time_us = config->kill_us;
    } else if ((bit & PILOT) != 0u) {
        time_us = config->request_us;
    } else if (bit == KEEL_MODE_LANDED) {
        time_us = config->landed_us;
    } else if ((bit & ESTIMATES) != 0u) {
        time_us = config->estimate_us;
    } else {
        /* Home and the alarms. */
    }
    return time_us;
}

keel_status_t keel_mode_init(keel_mode_t *mode, const keel_mode_config_t *config)
{
    const keel_mode_refusal_t none = {0u, 0u};

    if (!are_times_valid(config)) {
        return KEEL_ERR_LIMITS;
    }
    if (config->required == 0u) {
        return KEEL_ERR_INPUT;
    }
    mode->config = *config;
    /*@ loop invariant 0 <= i <= KEEL_MODE_FACTS;
      @ loop assigns i, mode->settle_us[0 .. KEEL_MODE_FACTS - 1],
      @     mode->held_us[0 .. KEEL_MODE_FACTS - 1];
      @ loop variant KEEL_MODE_FACTS - i;
      @*/
    for (uint32_t i = 0u; i < KEEL_MODE_FACTS; i++) {
        mode->settle_us[i] = settle_us_of(config, bit_of(i));
        mode->held_us[i] = 0u;
    }
    mode->silence_us = UINT32_MAX;
    mode->state_us = 0u;
    mode->seen = 0u;
    mode->settled = 0u;
    mode->overridden = 0u;
    mode->cause = 0u;
    mode->missing = 0u;
    mode->blocking = none;
    mode->refused = none;
    mode->state = KEEL_MODE_DISARMED;
    mode->mode = KEEL_MODE_NONE;
    mode->asked = KEEL_MODE_NONE;
    mode->rests_at = KEEL_MODE_NONE;
    mode->ready = false;
    mode->motors = false;
    return KEEL_OK;
}
