// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c
// checks: assertions
// replaces: keel_crsf_crc keel_framing_drop
// covers: keel_crsf_take keel_crsf_pass_time take_first take_or_refuse take_whole take_channels
// covers: take_link channel_of
//
// The clauses about what a frame is and says, what is counted, and ages, without the model, each of
// them for any valid decoder, any byte, any time, and any CRC.
#include "crsf_proof.h"

static keel_crsf_t before;
static uint8_t last;

/* crsf_came */
static uint32_t came_here(uint32_t j)
{
    return (j < before.framing.held) ? before.framing.byte[j] : last;
}

/* crsf_window */
static uint32_t window_here(uint32_t first)
{
    return came_here(first) + (256u * came_here(first + 1u)) + (65536u * came_here(first + 2u));
}

/* crsf_field */
static uint32_t field_here(uint32_t i)
{
    return (window_here(3u + ((11u * i) / 8u)) >> ((11u * i) % 8u)) & 2047u;
}

/* crsf_kind */
static keel_crsf_taken_t kind_here(uint32_t type, uint32_t length)
{
    keel_crsf_taken_t kind = KEEL_CRSF_TOOK_OTHER;

    if (type == 0x16u) {
        kind = (length >= 24u) ? KEEL_CRSF_TOOK_CHANNELS : KEEL_CRSF_TOOK_SHORT;
    } else if (type == 0x14u) {
        kind = (length >= 12u) ? KEEL_CRSF_TOOK_LINK : KEEL_CRSF_TOOK_SHORT;
    } else {
        /* It is of another type. */
    }
    return kind;
}

/* crsf_link_says */
static bool link_says_here(const keel_crsf_link_t *link)
{
    const int32_t snr = (int32_t)came_here(6u);

    return (link->rssi[0] == came_here(3u)) && (link->rssi[1] == came_here(4u)) &&
           (link->quality == came_here(5u)) && (link->snr == ((snr < 128) ? snr : (snr - 256))) &&
           (link->antenna == came_here(7u)) && (link->mode == came_here(8u));
}

/* framing_sum */
static uint32_t sum_here(uint32_t a, uint32_t b)
{
    return ((UINT32_MAX - a) < b) ? UINT32_MAX : (a + b);
}

static void check_frame(const keel_crsf_t *crsf, keel_crsf_taken_t taken)
{
    const uint32_t length = came_here(1u);

    __CPROVER_assert((taken == KEEL_CRSF_NOTHING) ||
                         ((2u <= length) && (length <= 62u) &&
                          ((length + 2u) <= (before.framing.held + 1u))),
                     "CRF_004_whole: a frame that is taken has a possible length, and all came");
    __CPROVER_assert((taken == KEEL_CRSF_NOTHING) || (taken == kind_here(came_here(2u), length)),
                     "CRF_004_kind: it is of the kind that its type and length tell");
    for (uint32_t i = 0u; i < 16u; i++) {
        __CPROVER_assert((taken != KEEL_CRSF_TOOK_CHANNELS) || (crsf->channel[i] == field_here(i)),
                         "CRF_005_fields: each channel is what the bytes say");
    }
    __CPROVER_assert((taken != KEEL_CRSF_TOOK_LINK) || link_says_here(&crsf->link),
                     "CRF_006_link: statistics are what the bytes say");
}

static void check_counts(const keel_crsf_count_t *count, keel_crsf_taken_t taken)
{
    __CPROVER_assert(count->channels == sum_here(before.count.channels,
                                                 (taken == KEEL_CRSF_TOOK_CHANNELS) ? 1u : 0u),
                     "CRF_008_channels: frames with channels are counted");
    __CPROVER_assert(count->links ==
                         sum_here(before.count.links, (taken == KEEL_CRSF_TOOK_LINK) ? 1u : 0u),
                     "CRF_008_links: frames with statistics are counted");
    __CPROVER_assert(count->shorts ==
                         sum_here(before.count.shorts, (taken == KEEL_CRSF_TOOK_SHORT) ? 1u : 0u),
                     "CRF_008_shorts: frames that are too short are counted");
    __CPROVER_assert(count->others ==
                         sum_here(before.count.others, (taken == KEEL_CRSF_TOOK_OTHER) ? 1u : 0u),
                     "CRF_008_others: frames of another type are counted");
}

void keel_crsf_take__clauses_harness(void)
{
    keel_crsf_t crsf = nondet_crsf();
    const uint32_t elapsed_us = nondet_u32();
    keel_crsf_taken_t taken;

    before = crsf;
    last = nondet_u8();
    __CPROVER_assume(crsf_valid_here(&crsf));

    taken = keel_crsf_take(&crsf, last, elapsed_us);

    check_frame(&crsf, taken);
    check_counts(&crsf.count, taken);
    __CPROVER_assert(crsf.channels_age_us == ((taken == KEEL_CRSF_TOOK_CHANNELS)
                                                  ? 0u
                                                  : sum_here(before.channels_age_us, elapsed_us)),
                     "CRF_009_channels: channels are new, or older by the time");
    __CPROVER_assert(crsf.link_age_us == ((taken == KEEL_CRSF_TOOK_LINK)
                                              ? 0u
                                              : sum_here(before.link_age_us, elapsed_us)),
                     "CRF_009_link: statistics are new, or older by the time");
}
