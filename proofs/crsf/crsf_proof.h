/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file crsf_proof.h
 * @brief What the harnesses of the CRSF decoder share: arbitrary decoders, valid ones, and when two
 *        are the same.
 */
#ifndef CRSF_PROOF_H
#define CRSF_PROOF_H

#include "../../specs/model/crsf.h"
#include "../common/framing_drop.h"

keel_crsf_t nondet_crsf(void);
keel_crsf_config_t nondet_crsf_config(void);

/* crsf_valid */
static bool crsf_valid_here(const keel_crsf_t *s)
{
    return framing_valid_here(&s->framing) && (s->framing.header[0] == 0xC8u) &&
           (s->framing.header[1] == 0x00u) && (s->framing.header[2] == 0xECu) &&
           (s->framing.header[3] == 0xEEu);
}

static bool crsf_config_same(const keel_crsf_config_t *a, const keel_crsf_config_t *b)
{
    return (a->gap_us == b->gap_us) && (a->channels_us == b->channels_us) &&
           (a->link_us == b->link_us);
}

static bool crsf_link_same(const keel_crsf_link_t *a, const keel_crsf_link_t *b)
{
    return (a->quality == b->quality) && (a->snr == b->snr) && (a->antenna == b->antenna) &&
           (a->mode == b->mode) && (a->rssi[0u] == b->rssi[0u]) && (a->rssi[1u] == b->rssi[1u]);
}

/* Whether these are the same channels. */
static bool crsf_channels_alike(const uint16_t *a, const uint16_t *b)
{
    bool alike = true;

    for (uint32_t i = 0u; i < KEEL_CRSF_CHANNELS; i++) {
        alike = alike && (a[i] == b[i]);
    }
    return alike;
}

static bool crsf_count_same(const keel_crsf_count_t *a, const keel_crsf_count_t *b)
{
    return (a->channels == b->channels) && (a->links == b->links) && (a->shorts == b->shorts) &&
           (a->others == b->others) && (a->lengths == b->lengths) && (a->crcs == b->crcs);
}

static bool crsf_same(const keel_crsf_t *a, const keel_crsf_t *b, uint32_t i)
{
    return crsf_config_same(&a->config, &b->config) && framing_same(&a->framing, &b->framing, i) &&
           crsf_count_same(&a->count, &b->count) && crsf_link_same(&a->link, &b->link) &&
           (a->channels_age_us == b->channels_age_us) && (a->link_age_us == b->link_age_us) &&
           (a->channel[0u] == b->channel[0u]) && (a->channel[1u] == b->channel[1u]) &&
           (a->channel[2u] == b->channel[2u]) && (a->channel[3u] == b->channel[3u]) &&
           (a->channel[4u] == b->channel[4u]) && (a->channel[5u] == b->channel[5u]) &&
           (a->channel[6u] == b->channel[6u]) && (a->channel[7u] == b->channel[7u]) &&
           (a->channel[8u] == b->channel[8u]) && (a->channel[9u] == b->channel[9u]) &&
           (a->channel[10u] == b->channel[10u]) && (a->channel[11u] == b->channel[11u]) &&
           (a->channel[12u] == b->channel[12u]) && (a->channel[13u] == b->channel[13u]) &&
           (a->channel[14u] == b->channel[14u]) && (a->channel[15u] == b->channel[15u]);
}

/* What keel_crsf_crc asks for and does, as far as the decoder needs to know. */
static bool keel_crsf_crc_may(const uint8_t *bytes, uint32_t count)
{
    return (count <= 62u) && ((count == 0u) || __CPROVER_r_ok(bytes, count));
}

static bool keel_crsf_crc_does(uint8_t crc, uint32_t count)
{
    return (count > 0u) || (crc == 0u);
}

#ifndef CRC_AS_IT_IS
/* What the model asked about: the bytes of a CRC, and what it is said to be. Of other bytes it may
 * be anything. */
static uint8_t told_bytes[KEEL_FRAMING_BYTES];
static uint32_t told_count;
static uint8_t told_crc;

static bool is_told(const uint8_t *bytes, uint32_t count)
{
    bool same = count == told_count;

    for (uint32_t i = 0u; i < 62u; i++) {
        same = same && ((i >= told_count) || (i >= count) || (bytes[i] == told_bytes[i]));
    }
    return same;
}

uint8_t model_crsf_crc(const uint8_t *bytes, uint32_t count)
{
    told_count = count;
    for (uint32_t i = 0u; i < 62u; i++) {
        told_bytes[i] = (i < count) ? bytes[i] : 0u;
    }
    told_crc = nondet_u8();
    __CPROVER_assume(keel_crsf_crc_does(told_crc, count));
    return told_crc;
}

uint8_t keel_crsf_crc_stand_in(const uint8_t *bytes, uint32_t count)
{
    const uint8_t crc = is_told(bytes, count) ? told_crc : nondet_u8();

    __CPROVER_assert(keel_crsf_crc_may(bytes, count), "precondition: keel_crsf_crc");
    __CPROVER_assume(keel_crsf_crc_does(crc, count));
    return crc;
}

/* Any frame that is right as a whole. */
static void any_right_frame(uint8_t *frame)
{
    for (uint32_t i = 0u; i < KEEL_FRAMING_BYTES; i++) {
        frame[i] = nondet_u8();
    }
    __CPROVER_assume(model_crsf_right(frame));
}

/* What a byte ends that ends this frame. */
static keel_crsf_taken_t kind_of(const uint8_t *frame)
{
    keel_crsf_taken_t kind = KEEL_CRSF_TOOK_OTHER;

    if (frame[2] == 0x16u) {
        kind = (frame[1] < 24u) ? KEEL_CRSF_TOOK_SHORT : KEEL_CRSF_TOOK_CHANNELS;
    }
    if (frame[2] == 0x14u) {
        kind = (frame[1] < 12u) ? KEEL_CRSF_TOOK_SHORT : KEEL_CRSF_TOOK_LINK;
    }
    return kind;
}

/* Whether what was published is this frame. */
static bool says(const keel_crsf_t *s, const uint8_t *frame)
{
    bool same = true;

    if (kind_of(frame) == KEEL_CRSF_TOOK_LINK) {
        same = (s->link.rssi[0] == frame[3]) && (s->link.rssi[1] == frame[4]) &&
               (s->link.quality == frame[5]) &&
               (s->link.snr == ((frame[6] < 128u) ? (int)frame[6] : ((int)frame[6] - 256))) &&
               (s->link.antenna == frame[7]) && (s->link.mode == frame[8]);
    } else if (kind_of(frame) == KEEL_CRSF_TOOK_CHANNELS) {
        for (uint32_t i = 0u; i < KEEL_CRSF_CHANNELS; i++) {
            same = same && (s->channel[i] == model_crsf_channel(frame, i));
        }
    } else {
        /* It is skipped. */
    }
    return same;
}
#endif

#endif
