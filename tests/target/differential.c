/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file differential.c
 * @brief Random vectors through the kernel's units, printed as digests, on the target; and on the
 *        host, through their executable specification. tools/keel test-target compares the two.
 *
 * Every vector's results, floats by their bits, go into its unit's digest; each block of vectors
 * prints the digest so far. With DETAIL_UNIT and DETAIL_BLOCK defined, each vector of that block
 * prints it, so that the first vector that differs can be named.
 *
 * Only what is the same under both data models is digested: no pointer, no size.
 */
#include "console.h"
#include "keel/flight/filter.h"
#include "keel/flight/pid.h"
#include "keel/flight/reference.h"
#include "keel/internal/rtos/queue.h"
#include "keel/middleware/voter.h"
#include "keel/rtos/priority.h"

#include <string.h>

#define BLOCKS        50u
#define VECTORS       2000u /* Of a block: 100 000 of each unit. */
#define QUEUE_TASKS   (KEEL_QUEUE_CAPACITY + 4u)
#define FILL_EVERY    256u
#define SETUP_EVERY   64u                 /* A new configuration of those that have one. */
#define DIGEST_SEED   0xCBF29CE484222325u /* FNV-1a. */
#define DIGEST_PRIME  0x00000100000001B3u
#define RANDOM_FACTOR 0x2545F4914F6CDD1Du /* xorshift64*. */
#define TIME_BITS     62u
#define MANTISSA      16777216u /* 2^24. */

#ifndef DETAIL_UNIT
#define DETAIL_UNIT  UINT32_MAX
#define DETAIL_BLOCK UINT32_MAX
#endif

typedef struct stream {
    uint64_t random;
    uint64_t digest;
    uint32_t vector; /* Within its unit. */
} stream_t;

static keel_queue_t queue;
static keel_task_config_t task[QUEUE_TASKS];
static keel_voter_t voter;
static keel_filter_t filter;
static keel_pid_t pid;
static keel_reference_t reference;
static uint32_t frozen; /* The sensor whose sample never changes, if there is such. */
static bool voter_made;
static bool filter_made;
static bool pid_made;
static bool reference_made;

/* --- Randomness ------------------------------------------------------------------------------- */

static uint64_t any64(stream_t *s)
{
    s->random ^= s->random >> 12;
    s->random ^= s->random << 25;
    s->random ^= s->random >> 27;
    return s->random * RANDOM_FACTOR;
}

static uint32_t any32(stream_t *s)
{
    return (uint32_t)(any64(s) >> 32);
}

static uint32_t below(stream_t *s, uint32_t limit)
{
    return (uint32_t)(((uint64_t)any32(s) * limit) >> 32);
}

/* A number of a random length, so that small ones are as frequent as large ones. */
static uint64_t any_bits(stream_t *s, uint32_t most)
{
    const uint32_t bits = 1u + below(s, most);

    return any64(s) >> (64u - bits);
}

static float any_float(stream_t *s)
{
    const uint32_t bits = any32(s);
    float value;

    memcpy(&value, &bits, sizeof value);
    return value;
}

/* From low up to high; both are exact here, so that each build sees the same. */
static float between(stream_t *s, float low, float high)
{
    const float part = (float)(any32(s) >> 8) / (float)MANTISSA;

    return low + ((high - low) * part);
}

/* Now and then anything at all, NaN and infinities included. */
static float mostly_between(stream_t *s, float low, float high)
{
    return (below(s, 16u) == 0u) ? any_float(s) : between(s, low, high);
}

/* From 1 up to limit, now and then 0. */
static uint32_t rarely_zero(stream_t *s, uint32_t limit)
{
    return (below(s, 16u) == 0u) ? 0u : (1u + below(s, limit));
}

/* --- Digest ----------------------------------------------------------------------------------- */

static void digest(stream_t *s, uint64_t word)
{
    for (uint32_t i = 0u; i < 64u; i += 8u) {
        s->digest = (s->digest ^ ((word >> i) & 0xFFu)) * DIGEST_PRIME;
    }
}

static void digest_float(stream_t *s, float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    digest(s, bits);
}

/* --- Units ------------------------------------------------------------------------------------ */

static void body(void *context)
{
    (void)context;
}

static void setup_queue(stream_t *s)
{
    for (uint32_t i = 0u; i < QUEUE_TASKS; i++) {
        task[i].run = body;
        task[i].period_us = 1u + (uint32_t)any_bits(s, 30u);
        task[i].budget_us = 1u + (uint32_t)any_bits(s, 30u);
        task[i].priority = (below(s, 3u) == 0u) ? KEEL_PRIORITY_REALTIME
                                                : (1u + below(s, KEEL_PRIORITY_HIGH));
    }
    keel_queue_init(&queue);
}

/* Adds a task that is not there, or serves one that is. */
static void add_or_serve(stream_t *s, uint32_t which)
{
    const uint32_t position = keel_queue_find(&queue, &task[which]);

    if (position < queue.count) {
        const uint32_t slot = queue.order[position];

        keel_queue_advance(&queue, slot, queue.release_us[slot] + any_bits(s, 40u));
    } else if (queue.count < KEEL_QUEUE_CAPACITY) {
        keel_queue_add(&queue, &task[which], any_bits(s, 40u));
    } else {
        /* It is full. */
    }
}

static void digest_queue(stream_t *s)
{
    digest(s, queue.count);
    digest(s, queue.realtime_count);
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        digest(s, queue.order[i]);
    }
    for (uint32_t i = 0u; i < queue.count; i++) {
        const uint32_t slot = queue.order[i];

        digest(s, (uint64_t)(queue.task[slot] - task));
        digest(s, queue.release_us[slot]);
        digest(s, queue.period_us[slot]);
        digest(s, queue.budget_us[slot]);
        digest(s, queue.priority[slot]);
        digest(s, queue.skipped[slot]);
    }
}

static void vector_queue(stream_t *s)
{
    const uint32_t choice = below(s, 16u);
    /* Fills up and empties in turn, so that it is often full. */
    const uint32_t adds = (((s->vector / FILL_EVERY) % 2u) == 0u) ? 12u : 4u;
    const uint32_t which = below(s, QUEUE_TASKS);
    const uint32_t position = below(s, KEEL_QUEUE_CAPACITY);

    if (s->vector == 0u) {
        setup_queue(s);
    }
    if (choice < adds) {
        add_or_serve(s, which);
    } else if (choice < 14u) {
        if (position < queue.count) {
            keel_queue_remove(&queue, position);
        }
    } else {
        digest(s, keel_queue_find(&queue, &task[which]));
    }
    digest_queue(s);
}

static void vector_priority(stream_t *s)
{
    const uint32_t sp = 1u + below(s, KEEL_PRIORITY_REALTIME);
    const uint32_t period_us = 1u + (uint32_t)any_bits(s, 30u);
    const uint64_t promotion_us = keel_priority_promotion_age_us(sp, period_us);
    const uint64_t near_us = promotion_us + below(s, 5u);
    uint64_t age_us = any_bits(s, TIME_BITS);

    if (below(s, 2u) == 0u) {
        age_us = (near_us > 2u) ? (near_us - 2u) : 0u;
    }
    digest(s, promotion_us);
    digest(s, keel_priority_dynamic(sp, age_us, period_us));
    digest(s, keel_priority_promoted(sp, age_us, period_us) ? 1u : 0u);
}

static void setup_voter(stream_t *s)
{
    const float limit = mostly_between(s, 900.0f, 1000.0f);
    keel_voter_config_t config = {.agree = mostly_between(s, 0.001f, 4.0f),
                                  .cutoff = mostly_between(s, 1.01f, 6.0f),
                                  .slope = mostly_between(s, -0.01f, 0.2f),
                                  .lowest = -limit,
                                  .highest = limit,
                                  .initial = mostly_between(s, -2.0f, 2.0f),
                                  .max_age_us = rarely_zero(s, 5000u),
                                  .latch_count = (uint16_t)rarely_zero(s, 100u),
                                  .stale_count = (uint16_t)below(s, 20u),
                                  .readmit_count = (uint16_t)below(s, 20u),
                                  .density_limit = (uint16_t)below(s, 200u),
                                  .sensors = (uint8_t)rarely_zero(s, KEEL_VOTER_SENSORS)};
    const keel_status_t status = keel_voter_init(&voter, &config);

    frozen = below(s, 2u * KEEL_VOTER_SENSORS); /* Half of the time no sensor. */
    voter_made = voter_made || (status == KEEL_OK);
    digest(s, (uint64_t)status);
}

static void digest_vote(stream_t *s)
{
    digest_float(s, voter.vote.output);
    digest(s, voter.vote.state);
    digest(s, voter.vote.held);
    digest(s, voter.vote.held_us);
    for (uint32_t i = 0u; i < voter.config.sensors; i++) {
        digest_float(s, voter.vote.weight[i]);
        digest(s, voter.vote.reason[i]);
        digest(s, voter.sensor[i].condemned_votes);
        digest(s, voter.sensor[i].unchanged_votes);
        digest(s, voter.sensor[i].density);
        digest(s, voter.sensor[i].probation);
        digest(s, voter.sensor[i].latched ? 1u : 0u);
    }
}

static void vector_voter(stream_t *s)
{
    keel_voter_sample_t sample[KEEL_VOTER_SENSORS];
    const float truth = between(s, -10.0f, 10.0f);
    uint32_t oldest_us = 0u;
    bool complete = true;

    if ((s->vector % SETUP_EVERY) == 0u) {
        setup_voter(s);
    }
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        sample[i].value = (i == frozen) ? 1.5f : mostly_between(s, truth - 2.0f, truth + 2.0f);
        sample[i].value = (below(s, 16u) == 0u) ? voter.sensor[i].last : sample[i].value;
        sample[i].age_us = below(s, 1500u);
        sample[i].present = below(s, 32u) != 0u;
        oldest_us = (sample[i].age_us > oldest_us) ? sample[i].age_us : oldest_us;
        complete = complete && sample[i].present;
    }
    if (voter_made) {
        keel_voter_scale(&voter);
        if (!complete || !keel_voter_step_unanimous(&voter, sample, oldest_us)) {
            keel_voter_step(&voter, sample, any32(s));
            keel_voter_reconsider(&voter, sample);
        }
        if (below(s, 32u) == 0u) {
            digest(s, (uint64_t)keel_voter_readmit(&voter, below(s, KEEL_VOTER_SENSORS + 1u)));
        }
        digest_vote(s);
    }
}

static void digest_filter(stream_t *s, const keel_filter_t *of)
{
    digest_float(s, of->a);
    digest_float(s, of->b);
    digest_float(s, of->c);
    digest_float(s, of->s1);
    digest_float(s, of->s2);
    digest_float(s, of->output);
}

static void vector_filter(stream_t *s)
{
    if ((s->vector % SETUP_EVERY) == 0u) {
        const float rate_hz = mostly_between(s, 1.0f, 8000.0f);
        const float cutoff_hz = mostly_between(s, 0.1f, 0.6f * rate_hz);
        const keel_status_t status = keel_filter_init(&filter, rate_hz, cutoff_hz);

        filter_made = filter_made || (status == KEEL_OK);
        digest(s, (uint64_t)status);
    }
    if (filter_made) {
        digest(s, (uint64_t)keel_filter_step(&filter, mostly_between(s, -100.0f, 100.0f)));
        if (below(s, 64u) == 0u) {
            digest(s, (uint64_t)keel_filter_reset(&filter, mostly_between(s, -10.0f, 10.0f)));
        }
        digest_filter(s, &filter);
    }
}

static void setup_pid(stream_t *s)
{
    const float rate_hz = mostly_between(s, 50.0f, 8000.0f);
    const float limit = mostly_between(s, 0.1f, 1000.0f);
    const keel_pid_config_t config = {.gains = {mostly_between(s, 0.0f, 10.0f),
                                                mostly_between(s, 0.0f, 10.0f),
                                                between(s, 0.0f, 1.0f), between(s, 0.0f, 2.0f)},
                                      .rate_hz = rate_hz,
                                      .cutoff_hz = between(s, 0.01f, 0.45f) * rate_hz,
                                      .output_min = -limit,
                                      .output_max = limit,
                                      .integral_min = -0.5f * limit,
                                      .integral_max = 0.25f * limit};
    const keel_status_t status = keel_pid_init(&pid, &config);

    pid_made = pid_made || (status == KEEL_OK);
    digest(s, (uint64_t)status);
}

static void change_pid(stream_t *s)
{
    const keel_pid_gains_t gains = {between(s, 0.0f, 10.0f), between(s, 0.0f, 10.0f),
                                    mostly_between(s, 0.0f, 1.0f), between(s, 0.0f, 2.0f)};

    if (below(s, 4u) == 0u) {
        keel_pid_reset(&pid);
    } else {
        digest(s, (uint64_t)keel_pid_set_gains(&pid, &gains));
    }
}

static void vector_pid(stream_t *s)
{
    if ((s->vector % SETUP_EVERY) == 0u) {
        setup_pid(s);
    }
    if (pid_made) {
        const float setpoint = mostly_between(s, -50.0f, 50.0f);

        digest(s, (uint64_t)keel_pid_step(&pid, setpoint, mostly_between(s, -50.0f, 50.0f)));
        digest_float(s, pid.output);
        digest_float(s, pid.integral);
        digest_float(s, pid.derivative);
        digest(s, (uint64_t)pid.saturation);
        digest_filter(s, &pid.filter);
        if (below(s, 64u) == 0u) {
            change_pid(s);
        }
    }
}

static keel_reference_shape_t any_shape(stream_t *s)
{
    return (keel_reference_shape_t){.dead_band = mostly_between(s, 0.001f, 0.5f),
                                    .expo = mostly_between(s, 0.0f, 1.0f)};
}

static void setup_reference(stream_t *s)
{
    const keel_reference_config_t config = {.roll = any_shape(s),
                                            .pitch = any_shape(s),
                                            .yaw = any_shape(s),
                                            .climb = any_shape(s),
                                            .limits = {.roll_rate = between(s, 0.1f, 64.0f),
                                                       .pitch_rate = between(s, 0.1f, 64.0f),
                                                       .yaw_rate = between(s, 0.1f, 64.0f),
                                                       .heading_rate = between(s, 0.1f, 64.0f),
                                                       .tilt = between(s, 0.1f, 1.5f),
                                                       .speed = between(s, 0.1f, 100.0f),
                                                       .climb_rate = between(s, 0.1f, 100.0f),
                                                       .descent_rate = between(s, 0.1f, 100.0f)}};
    const keel_status_t status = keel_reference_init(&reference, &config);

    reference_made = reference_made || (status == KEEL_OK);
    digest(s, (uint64_t)status);
}

static void digest_setpoints(stream_t *s)
{
    digest_float(s, reference.setpoints.roll_rate);
    digest_float(s, reference.setpoints.pitch_rate);
    digest_float(s, reference.setpoints.yaw_rate);
    digest_float(s, reference.setpoints.heading_rate);
    digest_float(s, reference.setpoints.roll);
    digest_float(s, reference.setpoints.pitch);
    digest_float(s, reference.setpoints.forward);
    digest_float(s, reference.setpoints.right);
    digest_float(s, reference.setpoints.climb_rate);
}

static void vector_reference(stream_t *s)
{
    if ((s->vector % SETUP_EVERY) == 0u) {
        setup_reference(s);
    }
    if (reference_made) {
        const keel_reference_sticks_t sticks = {.roll = mostly_between(s, -1.0f, 1.0f),
                                                .pitch = mostly_between(s, -1.0f, 1.0f),
                                                .yaw = mostly_between(s, -1.0f, 1.0f),
                                                .climb = mostly_between(s, -1.0f, 1.0f)};

        digest(s, (uint64_t)keel_reference_step(&reference, &sticks));
        digest_setpoints(s);
    }
}

/* --- All of them ------------------------------------------------------------------------------ */

typedef struct unit {
    const char *name;
    void (*vector)(stream_t *s);
} unit_t;

static const unit_t unit[] = {{"queue", vector_queue}, {"priority", vector_priority},
                              {"voter", vector_voter}, {"filter", vector_filter},
                              {"pid", vector_pid},     {"reference", vector_reference}};

#define UNITS (sizeof unit / sizeof unit[0])

static void print(const char *name, const char *what, uint32_t number, uint64_t value)
{
    keel_console_text(name);
    keel_console_text(what);
    keel_console_number(number);
    keel_console_text(" ");
    keel_console_hex((uint32_t)(value >> 32));
    keel_console_hex((uint32_t)value);
    keel_console_text("\n");
}

static void run_unit(uint32_t index)
{
    stream_t s = {.random = 0x9E3779B97F4A7C15u + index, .digest = DIGEST_SEED, .vector = 0u};

    for (uint32_t block = 0u; block < BLOCKS; block++) {
        for (uint32_t i = 0u; i < VECTORS; i++) {
            unit[index].vector(&s);
            if ((index == DETAIL_UNIT) && (block == DETAIL_BLOCK)) {
                print(unit[index].name, " vector ", s.vector, s.digest);
            }
            s.vector++;
        }
        print(unit[index].name, " block ", block, s.digest);
    }
}

int main(void)
{
    for (uint32_t i = 0u; i < UNITS; i++) {
        run_unit(i);
    }
    print("all", " vectors ", (uint32_t)(UNITS * BLOCKS * VECTORS), 0u);
    return 0;
}
