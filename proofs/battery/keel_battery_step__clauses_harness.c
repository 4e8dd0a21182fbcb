// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/battery.c
// covers: keel_battery_step
//
// Any monitor that satisfies the precondition, any bit pattern for all that was measured: the
// contract of a step, clause by clause.
#include "battery_proof.h"

static keel_battery_t old;
static keel_battery_t now;
static keel_battery_sample_t sample;

static bool is_told(uint32_t flags)
{
    return (now.flags & flags) != 0u;
}

static uint64_t quanta_of(const keel_battery_sum_t *sum)
{
    return ((uint64_t)sum->whole * KEEL_BATTERY_QUANTA) + sum->part;
}

/* battery_steady */
static bool is_steady(const keel_battery_alarm_t *was, const keel_battery_alarm_t *is)
{
    const uint32_t most = now.config.settle_steps;
    const bool raised = is->raised && !was->raised;
    const bool ended = !is->raised && was->raised;

    return (!raised || ((is->count == most) && (most <= (was->count + 1u)))) &&
           (!ended || ((is->count == 0u) && (was->count <= 1u)));
}

static void check_samples(void)
{
    const uint32_t first = KEEL_BATTERY_NO_CURRENT;

    __CPROVER_assert(is_told(first) || (sample.module[0].has_current &&
                                        within(sample.module[0].current, now.config.current_min,
                                               now.config.current_max)),
                     "BAT_004_told: a current that does not count is told");
    __CPROVER_assert((now.voltage_age != 0u) ||
                         within(now.voltage, now.config.voltage_min, now.config.voltage_max),
                     "BAT_005_fresh: a new voltage is in its range");
    __CPROVER_assert((now.voltage_age == 0u) || float_same(now.voltage, old.voltage),
                     "BAT_005_held: without a new one the last stays");
    __CPROVER_assert(is_told(KEEL_BATTERY_LOST) == (now.module[0].age >= now.config.hold_steps),
                     "BAT_006_lost: a module that is lost is told");
}

static void check_sums(void)
{
    const uint32_t rest = (now.initial > now.charge.whole) ? (now.initial - now.charge.whole) : 0u;

    __CPROVER_assert(quanta_of(&old.charge) <= quanta_of(&now.charge),
                     "BAT_007_forward: the charge used does not get less");
    __CPROVER_assert(now.charge.part < KEEL_BATTERY_QUANTA, "BAT_007_whole: its part is a part");
    __CPROVER_assert(quanta_of(&old.energy) <= quanta_of(&now.energy),
                     "BAT_008_forward: nor does the energy used");
    __CPROVER_assert(now.energy.part < KEEL_BATTERY_QUANTA, "BAT_008_whole: its part is a part");
    __CPROVER_assert(now.left == rest, "BAT_009_left: what is left is what is not used");
    __CPROVER_assert(within(now.remaining, 0.0f, 1.0f), "BAT_009_part: as a part, from 0 to 1");
}

static void check_time(void)
{
    __CPROVER_assert(within(now.remaining_s, 0.0f, KEEL_BATTERY_CAP_MAX_S),
                     "BAT_010_range: the time left is a number, not negative");
    __CPROVER_assert(now.remaining_s <= now.config.cap_s, "BAT_010_cap: at most the cap");
    __CPROVER_assert((now.left > now.scale.critical) || (now.remaining_s == 0.0f),
                     "BAT_010_none: none when the critical part is reached");
    __CPROVER_assert(within(now.current, 0.0f, KEEL_BATTERY_TOTAL_LIMIT) &&
                         within(now.smoothed, 0.0f, KEEL_BATTERY_TOTAL_LIMIT),
                     "BAT_015_bounded: currents are in bounds, whatever they were");
    __CPROVER_assert(sample.running || !within(old.smoothed, 0.0f, KEEL_BATTERY_TOTAL_LIMIT) ||
                         (now.smoothed == old.smoothed),
                     "BAT_016_rests: the smoothed current follows only while motors run");
}

static void check_alarms(void)
{
    const uint32_t lost = KEEL_BATTERY_LOST | (KEEL_BATTERY_LOST << 1u);

    __CPROVER_assert(!is_told(KEEL_BATTERY_SAG) || !is_told(lost),
                     "BAT_011_known: the load is made up for only where it is known");
    __CPROVER_assert(is_steady(&old.low, &now.low),
                     "BAT_012_low: raised at a full count, taken back at an empty one");
    __CPROVER_assert(is_steady(&old.critical, &now.critical), "BAT_012_critical: so is this one");
    __CPROVER_assert(!old.low.raised || now.low.raised ||
                         ((now.voltage_age == 0u) && (now.left > now.scale.low)),
                     "BAT_013_low: taken back with a new voltage, and with enough charge");
    __CPROVER_assert(!old.critical.raised || now.critical.raised ||
                         ((now.voltage_age == 0u) && (now.left > now.scale.critical)),
                     "BAT_013_critical: so is this one");
    __CPROVER_assert((old.low.count >= now.low.count) || (now.voltage_age == 0u) ||
                         (now.left <= now.scale.low),
                     "BAT_012_evidence: a voltage that is held is no evidence");
}

static void check_level(void)
{
    const uint32_t lost = KEEL_BATTERY_LOST | (KEEL_BATTERY_LOST << 1u) | KEEL_BATTERY_VOLTAGE_LOST;

    __CPROVER_assert(((now.level == KEEL_BATTERY_CRITICAL) == now.critical.raised) &&
                         ((now.level == KEEL_BATTERY_LOW) ==
                          (now.low.raised && !now.critical.raised)),
                     "BAT_014_alarm: an alarm is the level, whatever is known");
    __CPROVER_assert((now.level != KEEL_BATTERY_OK) ||
                         ((now.count == KEEL_BATTERY_COUNTED) &&
                          (now.voltage_age < now.config.hold_steps) &&
                          (now.known == now.config.settle_steps) && !is_told(lost)),
                     "BAT_014_ok: all is well only where all is known");
    __CPROVER_assert((now.level <= KEEL_BATTERY_CRITICAL) &&
                         ((old.count > KEEL_BATTERY_UNCOUNTED) ||
                          (now.count <= KEEL_BATTERY_UNCOUNTED)),
                     "BAT_014_one: one of four levels, and one of three counts");
    __CPROVER_assert((old.count != KEEL_BATTERY_UNCOUNTED) || (now.count == KEEL_BATTERY_UNCOUNTED),
                     "BAT_014_latched: what was not counted is not known any more");
}

void keel_battery_step__clauses_harness(void)
{
    sample = any_battery_sample();
    now = any_battery_at_all();
    __CPROVER_assume(battery_ranges_here(&now.config) && battery_counts_here(&now));
    old = now;

    keel_battery_step(&now, &sample);

    check_samples();
    check_sums();
    check_time();
    check_alarms();
    check_level();
}
