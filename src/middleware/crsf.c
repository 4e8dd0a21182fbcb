/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/crsf.h"

/* Where what is in a frame; a payload begins at PAYLOAD_AT. */
#define LENGTH_AT  1u
#define TYPE_AT    2u
#define PAYLOAD_AT 3u

/* Bytes of a frame besides those that its length counts. */
#define BESIDE_LENGTH 2u

/* Where what is in a frame with statistics. */
#define RSSI_AT    3u
#define QUALITY_AT 5u
#define SNR_AT     6u
#define ANTENNA_AT 7u
#define MODE_AT    8u

#define FIELD_BITS 11u
#define FIELD_MASK 2047u

#define SIGNED_FROM 128
#define SIGNED_SPAN 256

/* Each channel has its 11 bits in three bytes; behind the last one's is the CRC. */
/*@ requires \valid_read(crsf) && index < KEEL_CRSF_CHANNELS &&
  @     KEEL_CRSF_LENGTH_CHANNELS + 2 <= crsf->framing.held <= KEEL_FRAMING_BYTES;
  @ assigns \nothing;
  @ ensures \result == crsf_field(crsf, 0, index);
  @*/
static uint16_t channel_of(const keel_crsf_t *crsf, uint32_t index)
{
    const uint32_t bit = FIELD_BITS * index;
    const uint32_t first = PAYLOAD_AT + (bit / 8u);
    const uint32_t window = crsf->framing.byte[first] + (256u * crsf->framing.byte[first + 1u]) +
                            (65536u * crsf->framing.byte[first + 2u]);

    return (uint16_t)((window >> (bit % 8u)) & FIELD_MASK);
}

/*@ requires \valid(crsf) &&
  @     KEEL_CRSF_LENGTH_CHANNELS + 2 <= crsf->framing.held <= KEEL_FRAMING_BYTES;
  @ assigns crsf->channel[0 .. KEEL_CRSF_CHANNELS - 1], crsf->count.channels,
  @     crsf->channels_age_us;
  @ ensures crsf_channels_say{Pre, Post}(crsf, 0);
  @ ensures crsf->count.channels == framing_sum(\old(crsf->count.channels), 1);
  @ ensures crsf->channels_age_us == 0;
  @*/
static void take_channels(keel_crsf_t *crsf)
{
    /*@ loop invariant 0 <= i <= KEEL_CRSF_CHANNELS;
      @ loop invariant \forall integer j; 0 <= j < i ==>
      @     crsf->channel[j] == crsf_field(crsf, 0, j);
      @ loop assigns i, crsf->channel[0 .. KEEL_CRSF_CHANNELS - 1];
      @ loop variant KEEL_CRSF_CHANNELS - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_CRSF_CHANNELS; i++) {
        crsf->channel[i] = channel_of(crsf, i);
    }
    crsf->count.channels = keel_framing_sum(crsf->count.channels, 1u);
    crsf->channels_age_us = 0u;
}

/*@ requires \valid(crsf) &&
  @     KEEL_CRSF_LENGTH_LINK + 2 <= crsf->framing.held <= KEEL_FRAMING_BYTES;
  @ assigns crsf->link.rssi[0 .. 1], crsf->link.quality, crsf->link.snr, crsf->link.antenna,
  @     crsf->link.mode, crsf->count.links, crsf->link_age_us;
  @ ensures crsf_link_says{Pre, Post}(crsf, 0);
  @ ensures crsf->count.links == framing_sum(\old(crsf->count.links), 1);
  @ ensures crsf->link_age_us == 0;
  @*/
static void take_link(keel_crsf_t *crsf)
{
    const int32_t snr = (int32_t)crsf->framing.byte[SNR_AT];

    crsf->link.rssi[0] = crsf->framing.byte[RSSI_AT];
    crsf->link.rssi[1] = crsf->framing.byte[RSSI_AT + 1u];
    crsf->link.quality = crsf->framing.byte[QUALITY_AT];
    crsf->link.snr = (int8_t)((snr < SIGNED_FROM) ? snr : (snr - SIGNED_SPAN));
    crsf->link.antenna = crsf->framing.byte[ANTENNA_AT];
    crsf->link.mode = crsf->framing.byte[MODE_AT];
    crsf->count.links = keel_framing_sum(crsf->count.links, 1u);
    crsf->link_age_us = 0u;
}

/* The bytes held begin with a right frame of this length. */
/*@ requires \valid(crsf) && KEEL_CRSF_LENGTH_MIN <= length <= KEEL_CRSF_LENGTH_MAX &&
  @     length + 2 <= crsf->framing.held <= KEEL_FRAMING_BYTES;
  @ assigns crsf->channel[0 .. KEEL_CRSF_CHANNELS - 1], crsf->link.rssi[0 .. 1],
  @     crsf->link.quality, crsf->link.snr, crsf->link.antenna, crsf->link.mode,
  @     crsf->count.channels, crsf->count.links, crsf->count.shorts, crsf->count.others,
  @     crsf->channels_age_us, crsf->link_age_us;
  @ ensures \result == crsf_kind(crsf->framing.byte[2], length);
  @ ensures \result == KEEL_CRSF_TOOK_CHANNELS ==> crsf_channels_say{Pre, Post}(crsf, 0);
  @ ensures \result == KEEL_CRSF_TOOK_LINK ==> crsf_link_says{Pre, Post}(crsf, 0);
  @ ensures \result != KEEL_CRSF_TOOK_CHANNELS ==> crsf_channels_kept{Pre, Post}(crsf);
  @ ensures \result != KEEL_CRSF_TOOK_LINK ==> crsf_link_kept{Pre, Post}(crsf);
  @ ensures crsf->channels_age_us ==
  @     (\result == KEEL_CRSF_TOOK_CHANNELS ? 0 : \old(crsf->channels_age_us));
  @ ensures crsf->link_age_us ==
  @     (\result == KEEL_CRSF_TOOK_LINK ? 0 : \old(crsf->link_age_us));
  @ ensures crsf->count.channels ==
  @     framing_sum(\old(crsf->count.channels), \result == KEEL_CRSF_TOOK_CHANNELS ? 1 : 0);
  @ ensures crsf->count.links ==
  @     framing_sum(\old(crsf->count.links), \result == KEEL_CRSF_TOOK_LINK ? 1 : 0);
  @ ensures crsf->count.shorts ==
  @     framing_sum(\old(crsf->count.shorts), \result == KEEL_CRSF_TOOK_SHORT ? 1 : 0);
  @ ensures crsf->count.others ==
  @     framing_sum(\old(crsf->count.others), \result == KEEL_CRSF_TOOK_OTHER ? 1 : 0);
  @*/
static keel_crsf_taken_t take_whole(keel_crsf_t *crsf, uint32_t length)
{
    const uint8_t type = crsf->framing.byte[TYPE_AT];
    keel_crsf_taken_t taken = KEEL_CRSF_TOOK_OTHER;

    if ((type == (uint8_t)KEEL_CRSF_TYPE_CHANNELS) &&
        (length >= (uint32_t)KEEL_CRSF_LENGTH_CHANNELS)) {
        take_channels(crsf);
        taken = KEEL_CRSF_TOOK_CHANNELS;
    } else if ((type == (uint8_t)KEEL_CRSF_TYPE_LINK) &&
               (length >= (uint32_t)KEEL_CRSF_LENGTH_LINK)) {
        take_link(crsf);
        taken = KEEL_CRSF_TOOK_LINK;
    } else if ((type == (uint8_t)KEEL_CRSF_TYPE_CHANNELS) ||
               (type == (uint8_t)KEEL_CRSF_TYPE_LINK)) {
        crsf->count.shorts = keel_framing_sum(crsf->count.shorts, 1u);
        taken = KEEL_CRSF_TOOK_SHORT;
    } else {
        crsf->count.others = keel_framing_sum(crsf->count.others, 1u);
    }
    return taken;
}

/* The bytes held begin with a frame of this length: takes it, or refuses it for its CRC; then only
 * its header is dropped, as one may begin behind that. */
/*@ requires \valid(crsf) && KEEL_CRSF_LENGTH_MIN <= length <= KEEL_CRSF_LENGTH_MAX &&
  @     length + 2 <= crsf->framing.held <= KEEL_FRAMING_BYTES &&
  @     crsf_headers(crsf);
  @ assigns crsf->framing.byte[0 .. KEEL_FRAMING_BYTES - 1], crsf->framing.held,
  @     crsf->channel[0 .. KEEL_CRSF_CHANNELS - 1], crsf->link.rssi[0 .. 1],
  @     crsf->link.quality, crsf->link.snr, crsf->link.antenna, crsf->link.mode,
  @     crsf->count.channels, crsf->count.links, crsf->count.shorts, crsf->count.others,
  @     crsf->count.crcs, crsf->channels_age_us, crsf->link_age_us;
  @ ensures framing_valid(&crsf->framing);
  @ ensures \result == KEEL_CRSF_NOTHING ==> crsf_dropped{Pre, Post}(crsf);
  @ ensures \result != KEEL_CRSF_NOTHING ==>
  @     \result == crsf_kind(\old(crsf->framing.byte[2]), length);
  @ ensures \result == KEEL_CRSF_TOOK_CHANNELS ==> crsf_channels_say{Pre, Post}(crsf, 0);
  @ ensures \result == KEEL_CRSF_TOOK_LINK ==> crsf_link_says{Pre, Post}(crsf, 0);
  @ ensures \result != KEEL_CRSF_TOOK_CHANNELS ==> crsf_channels_kept{Pre, Post}(crsf);
  @ ensures \result != KEEL_CRSF_TOOK_LINK ==> crsf_link_kept{Pre, Post}(crsf);
  @ ensures crsf->channels_age_us ==
  @     (\result == KEEL_CRSF_TOOK_CHANNELS ? 0 : \old(crsf->channels_age_us));
  @ ensures crsf->link_age_us ==
  @     (\result == KEEL_CRSF_TOOK_LINK ? 0 : \old(crsf->link_age_us));
  @ ensures crsf->count.channels ==
  @     framing_sum(\old(crsf->count.channels), \result == KEEL_CRSF_TOOK_CHANNELS ? 1 : 0);
  @ ensures crsf->count.links ==
  @     framing_sum(\old(crsf->count.links), \result == KEEL_CRSF_TOOK_LINK ? 1 : 0);
  @ ensures crsf->count.shorts ==
  @     framing_sum(\old(crsf->count.shorts), \result == KEEL_CRSF_TOOK_SHORT ? 1 : 0);
  @ ensures crsf->count.others ==
  @     framing_sum(\old(crsf->count.others), \result == KEEL_CRSF_TOOK_OTHER ? 1 : 0);
  @*/
static keel_crsf_taken_t take_or_refuse(keel_crsf_t *crsf, uint32_t length)
{
    const uint8_t crc = crsf->framing.byte[length + 1u];
    keel_crsf_taken_t taken = KEEL_CRSF_NOTHING;

    if (keel_crsf_crc(&crsf->framing.byte[TYPE_AT], length - 1u) == crc) {
        taken = take_whole(crsf, length);
        keel_framing_drop(&crsf->framing, length + BESIDE_LENGTH);
    } else {
        crsf->count.crcs = keel_framing_sum(crsf->count.crcs, 1u);
        keel_framing_drop(&crsf->framing, 1u);
    }
    return taken;
}

/* The bytes held begin with a header and a length. */
/*@ requires \valid(crsf) && crsf_headers(crsf) &&
  @     framing_begins(&crsf->framing) && crsf->framing.held >= 2;
  @ assigns crsf->framing.byte[0 .. KEEL_FRAMING_BYTES - 1], crsf->framing.held,
  @     crsf->channel[0 .. KEEL_CRSF_CHANNELS - 1], crsf->link.rssi[0 .. 1],
  @     crsf->link.quality, crsf->link.snr, crsf->link.antenna, crsf->link.mode,
  @     crsf->count.channels, crsf->count.links, crsf->count.shorts, crsf->count.others,
  @     crsf->count.lengths, crsf->count.crcs, crsf->channels_age_us, crsf->link_age_us;
  @ ensures framing_valid(&crsf->framing);
  @ ensures \result == KEEL_CRSF_NOTHING ==> crsf_dropped{Pre, Post}(crsf);
  @ ensures \result != KEEL_CRSF_NOTHING ==>
  @     KEEL_CRSF_LENGTH_MIN <= \old(crsf->framing.byte[1]) <= KEEL_CRSF_LENGTH_MAX &&
  @     \old(crsf->framing.byte[1]) + 2 <= \old(crsf->framing.held) &&
  @     \result == crsf_kind(\old(crsf->framing.byte[2]), \old(crsf->framing.byte[1]));
  @ ensures \result == KEEL_CRSF_TOOK_CHANNELS ==> crsf_channels_say{Pre, Post}(crsf, 0);
  @ ensures \result == KEEL_CRSF_TOOK_LINK ==> crsf_link_says{Pre, Post}(crsf, 0);
  @ ensures \result != KEEL_CRSF_TOOK_CHANNELS ==> crsf_channels_kept{Pre, Post}(crsf);
  @ ensures \result != KEEL_CRSF_TOOK_LINK ==> crsf_link_kept{Pre, Post}(crsf);
  @ ensures crsf->channels_age_us ==
  @     (\result == KEEL_CRSF_TOOK_CHANNELS ? 0 : \old(crsf->channels_age_us));
  @ ensures crsf->link_age_us ==
  @     (\result == KEEL_CRSF_TOOK_LINK ? 0 : \old(crsf->link_age_us));
  @ ensures crsf->count.channels ==
  @     framing_sum(\old(crsf->count.channels), \result == KEEL_CRSF_TOOK_CHANNELS ? 1 : 0);
  @ ensures crsf->count.links ==
  @     framing_sum(\old(crsf->count.links), \result == KEEL_CRSF_TOOK_LINK ? 1 : 0);
  @ ensures crsf->count.shorts ==
  @     framing_sum(\old(crsf->count.shorts), \result == KEEL_CRSF_TOOK_SHORT ? 1 : 0);
  @ ensures crsf->count.others ==
  @     framing_sum(\old(crsf->count.others), \result == KEEL_CRSF_TOOK_OTHER ? 1 : 0);
  @*/
static keel_crsf_taken_t take_first(keel_crsf_t *crsf)
{
    const uint32_t length = crsf->framing.byte[LENGTH_AT];
    keel_crsf_taken_t taken = KEEL_CRSF_NOTHING;

    if ((length < (uint32_t)KEEL_CRSF_LENGTH_MIN) || (length > (uint32_t)KEEL_CRSF_LENGTH_MAX)) {
        crsf->count.lengths = keel_framing_sum(crsf->count.lengths, 1u);
        keel_framing_drop(&crsf->framing, 1u);
    } else if (crsf->framing.held >= (length + BESIDE_LENGTH)) {
        taken = take_or_refuse(crsf, length);
    } else {
        /* Its end is still to come. */
    }
    return taken;
}

keel_status_t keel_crsf_init(keel_crsf_t *crsf, const keel_crsf_config_t *config)
{
    const uint8_t headers[KEEL_FRAMING_HEADERS] = {
        KEEL_CRSF_HEADER, KEEL_CRSF_HEADER_ALL, KEEL_CRSF_HEADER_RECEIVER, KEEL_CRSF_HEADER_MODULE};
    static const keel_crsf_count_t no_count = {0};
    static const keel_crsf_link_t no_link = {.quality = 0u};

    if ((config->gap_us == 0u) || (config->channels_us == 0u)) {
        return KEEL_ERR_AGE;
    }
    crsf->config = *config;
    keel_framing_begin(&crsf->framing, config->gap_us, headers);
    crsf->count = no_count;
    crsf->channels_age_us = UINT32_MAX;
    crsf->link_age_us = UINT32_MAX;
    /*@ loop invariant 0 <= i <= KEEL_CRSF_CHANNELS;
      @ loop assigns i, crsf->channel[0 .. KEEL_CRSF_CHANNELS - 1];
      @ loop variant KEEL_CRSF_CHANNELS - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_CRSF_CHANNELS; i++) {
        crsf->channel[i] = 0u;
    }
    crsf->link = no_link;
    return KEEL_OK;
}

void keel_crsf_pass_time(keel_crsf_t *crsf, uint32_t elapsed_us)
{
    crsf->channels_age_us = keel_framing_sum(crsf->channels_age_us, elapsed_us);
    crsf->link_age_us = keel_framing_sum(crsf->link_age_us, elapsed_us);
    keel_framing_pass_time(&crsf->framing, elapsed_us);
}

keel_crsf_taken_t keel_crsf_take(keel_crsf_t *crsf, uint8_t byte, uint32_t elapsed_us)
{
    keel_crsf_taken_t taken = KEEL_CRSF_NOTHING;

    keel_crsf_pass_time(crsf, elapsed_us);
    keel_framing_take(&crsf->framing, byte, 0u);
    if (crsf->framing.held > LENGTH_AT) {
        taken = take_first(crsf);
    }
    return taken;
}

bool keel_crsf_is_lost(const keel_crsf_t *crsf)
{
    const keel_crsf_config_t *const config = &crsf->config;

    return (crsf->channels_age_us > config->channels_us) ||
           ((config->link_us > 0u) &&
            ((crsf->link_age_us > config->link_us) || (crsf->link.quality == 0u)));
}

uint8_t keel_crsf_crc(const uint8_t *bytes, uint32_t count)
{
    uint8_t crc = KEEL_CRC8_FIRST;

    /*@ loop invariant 0 <= i <= count;
      @ loop invariant crc == crsf_crc(bytes, i);
      @ loop assigns i, crc;
      @ loop variant count - i;
      @*/
    for (uint32_t i = 0u; i < count; i++) {
        crc = keel_crc8(crc, bytes[i]);
    }
    return crc;
}
