// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/ibus.c src/middleware/framing.c
// checks: assertions
// replaces: keel_framing_drop
// covers: keel_ibus_take keel_ibus_pass_time word_of extra_of channel_us adds_up all_in_range judges
// covers: take_words take_held
//
// The clauses about what a frame says, without the model, each of them for any valid decoder, any
// byte and any time.
#include "ibus_proof.h"

/* ibus_sum */
static uint32_t sum_here(const uint8_t *bytes, uint32_t count)
{
    uint32_t sum = 0u;

    for (uint32_t i = 0u; i < count; i++) {
        sum += bytes[i];
    }
    return sum;
}

/* ibus_word */
static uint32_t word_here(const keel_ibus_t *s, uint32_t i)
{
    return s->framing.byte[(2u * i) + 2u] + (256u * s->framing.byte[(2u * i) + 3u]);
}

/* ibus_extra */
static uint32_t extra_here(const keel_ibus_t *s, uint32_t k)
{
    return (word_here(s, 3u * k) / 4096u) + (16u * (word_here(s, (3u * k) + 1u) / 4096u)) +
           (256u * (word_here(s, (3u * k) + 2u) / 4096u));
}

/* ibus_field */
static uint32_t field_here(const keel_ibus_t *s, uint32_t i)
{
    uint32_t field = 0u;

    if (i < 14u) {
        field = s->config.extended ? (word_here(s, i) % 4096u) : word_here(s, i);
    } else if (s->config.extended) {
        field = extra_here(s, i - 14u);
    } else {
        /* There is no such channel. */
    }
    return field;
}

/* ibus_judged, of a bit below 32 */
static bool judged_here(const keel_ibus_t *s, uint32_t i)
{
    return (i < (s->config.extended ? 18u : 14u)) && (((s->config.judged >> i) & 1u) != 0u);
}

/* ibus_in_range */
static bool in_range_here(const keel_ibus_t *s, uint32_t value)
{
    return (s->config.lowest <= value) && (value <= s->config.highest);
}

void keel_ibus_take__clauses_harness(void)
{
    keel_ibus_t ibus = any_ibus();
    const keel_ibus_t before = ibus;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    uint32_t sum;
    bool right;

    __CPROVER_assume(ibus_valid_here(&ibus));
    sum = sum_here(before.framing.byte, 30u) + before.framing.byte[30] + (256u * (uint32_t)byte);

    right = keel_ibus_take(&ibus, byte, elapsed_us);

    __CPROVER_assert(!right || (sum == 65535u),
                     "IBU_004_sum: the bytes of a frame that is taken, with the last, add up");
    for (uint32_t i = 0u; i < 18u; i++) {
        __CPROVER_assert(!right || !judged_here(&ibus, i) || in_range_here(&ibus, ibus.channel[i]),
                         "IBU_004_range: each of its channels that is judged is in its range");
        __CPROVER_assert(!right || (ibus.channel[i] == field_here(&before, i)),
                         "IBU_005_fields: each channel is what the bytes say");
    }
}
