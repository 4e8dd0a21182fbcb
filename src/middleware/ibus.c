/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/ibus.h"

/* Where what is in a frame, and what its sum and those bytes add up to. */
#define COMMAND_AT 1u
#define WORDS_AT   2u
#define SUM_WORD   14u
#define SUM_AT     30u
#define SUM_TOTAL  0xFFFFu

/* A channel of 12 bits, below those of another. */
#define WORD_SPAN 4096u

/*@ requires \valid_read(ibus) && index <= 14;
  @ assigns \nothing;
  @ ensures \result == ibus_word(ibus, index);
  @ ensures 0 <= \result <= 65535;
  @*/
static uint32_t word_of(const keel_ibus_t *ibus, uint32_t index)
{
    const uint32_t low = WORDS_AT + (2u * index);

    return ibus->framing.byte[low] + (256u * ibus->framing.byte[low + 1u]);
}

/*@ requires \valid_read(ibus) && index < KEEL_IBUS_EXTRAS;
  @ assigns \nothing;
  @ ensures \result == ibus_extra(ibus, index);
  @ ensures 0 <= \result <= KEEL_IBUS_CHANNEL_MAX;
  @*/
static uint32_t extra_of(const keel_ibus_t *ibus, uint32_t index)
{
    const uint32_t first = 3u * index;

    return (word_of(ibus, first) / WORD_SPAN) + (16u * (word_of(ibus, first + 1u) / WORD_SPAN)) +
           (256u * (word_of(ibus, first + 2u) / WORD_SPAN));
}

/*@ requires \valid_read(ibus) && index < KEEL_IBUS_CHANNELS;
  @ assigns \nothing;
  @ ensures \result == ibus_field(ibus, index);
  @ ensures 0 <= \result <= 65535;
  @*/
static uint32_t channel_us(const keel_ibus_t *ibus, uint32_t index)
{
    uint32_t value = 0u;

    if (index < (uint32_t)KEEL_IBUS_WORDS) {
        value = word_of(ibus, index);
        value = ibus->config.extended ? (value % WORD_SPAN) : value;
    } else if (ibus->config.extended) {
        value = extra_of(ibus, index - (uint32_t)KEEL_IBUS_WORDS);
    } else {
        /* There is no such channel. */
    }
    return value;
}

/*@ requires \valid_read(ibus);
  @ assigns \nothing;
  @ ensures \result <==>
  @     ibus_sum(&ibus->framing.byte[0], 30) + ibus_word(ibus, 14) == 65535;
  @*/
static bool adds_up(const keel_ibus_t *ibus)
{
    uint32_t sum = 0u;

    /*@ loop invariant 0 <= i <= SUM_AT && 0 <= sum <= 255 * i;
      @ loop invariant sum == ibus_sum(&ibus->framing.byte[0], i);
      @ loop assigns i, sum;
      @ loop variant SUM_AT - i;
      @*/
    for (uint32_t i = 0u; i < SUM_AT; i++) {
        sum += ibus->framing.byte[i];
    }
    return (sum + word_of(ibus, SUM_WORD)) == SUM_TOTAL;
}

/*@ requires \valid_read(ibus) && index < KEEL_IBUS_CHANNELS;
  @ assigns \nothing;
  @ ensures \result <==> ((ibus->config.judged >> index) & 1) != 0;
  @*/
static bool judges(const keel_ibus_t *ibus, uint32_t index)
{
    return ((ibus->config.judged >> index) & 1u) != 0u;
}

/*@ requires \valid_read(ibus);
  @ assigns \nothing;
  @ ensures \result <==> \forall integer i; ibus_judged(ibus, i) ==>
  @     ibus_in_range(ibus, ibus_field(ibus, i));
  @*/
static bool all_in_range(const keel_ibus_t *ibus)
{
    const uint32_t channels = ibus->config.extended ? (uint32_t)KEEL_IBUS_CHANNELS
                                                    : (uint32_t)KEEL_IBUS_WORDS;
    bool right = true;

    /*@ loop invariant 0 <= i <= channels;
      @ loop invariant right <==> \forall integer j; 0 <= j < i && ibus_judged(ibus, j) ==>
      @     ibus_in_range(ibus, ibus_field(ibus, j));
      @ loop assigns i, right;
      @ loop variant channels - i;
      @*/
    for (uint32_t i = 0u; i < channels; i++) {
        const uint32_t value = channel_us(ibus, i);

        right = right && (!judges(ibus, i) ||
                          ((ibus->config.lowest <= value) && (value <= ibus->config.highest)));
    }
    return right;
}

/* With a frame's bytes: takes them, or counts why not. */
/*@ requires \valid(ibus);
  @ assigns ibus->count.frames, ibus->count.sums, ibus->count.ranges, ibus->age_us,
  @     ibus->channel[0 .. KEEL_IBUS_CHANNELS - 1];
  @ ensures \result ==> ibus_right{Pre}(ibus) && ibus_says{Pre, Post}(ibus);
  @ ensures !\result ==> ibus_kept{Pre, Post}(ibus);
  @ ensures ibus->count.frames == framing_sum(\old(ibus->count.frames), \result ? 1 : 0);
  @ ensures ibus->age_us == (\result ? 0 : \old(ibus->age_us));
  @*/
static bool take_words(keel_ibus_t *ibus)
{
    bool right = false;

    if (!adds_up(ibus)) {
        ibus->count.sums = keel_framing_sum(ibus->count.sums, 1u);
    } else if (!all_in_range(ibus)) {
        ibus->count.ranges = keel_framing_sum(ibus->count.ranges, 1u);
    } else {
        /*@ loop invariant 0 <= i <= KEEL_IBUS_CHANNELS;
          @ loop invariant \forall integer j; 0 <= j < i ==>
          @     ibus->channel[j] == ibus_field(ibus, j);
          @ loop assigns i, ibus->channel[0 .. KEEL_IBUS_CHANNELS - 1];
          @ loop variant KEEL_IBUS_CHANNELS - i;
          @*/
        for (uint32_t i = 0u; i < (uint32_t)KEEL_IBUS_CHANNELS; i++) {
            ibus->channel[i] = (uint16_t)channel_us(ibus, i);
        }
        ibus->count.frames = keel_framing_sum(ibus->count.frames, 1u);
        ibus->age_us = 0u;
        right = true;
    }
    return right;
}

/* The bytes held begin with a header and the byte behind it. Of those that can be no frame the
 * header is dropped, as one may begin behind it. */
/*@ requires \valid(ibus) && framing_begins(&ibus->framing) &&
  @     ibus_headers(ibus) && 2 <= ibus->framing.held <= KEEL_IBUS_BYTES;
  @ assigns ibus->framing.byte[0 .. KEEL_FRAMING_BYTES - 1], ibus->framing.held,
  @     ibus->count.frames, ibus->count.headers, ibus->count.sums, ibus->count.ranges,
  @     ibus->age_us, ibus->channel[0 .. KEEL_IBUS_CHANNELS - 1];
  @ ensures ibus_valid(ibus);
  @ ensures \result ==> \old(ibus->framing.held) == KEEL_IBUS_BYTES && ibus->framing.held == 0 &&
  @     \old(ibus->framing.byte[1]) == KEEL_IBUS_COMMAND && ibus_right{Pre}(ibus) &&
  @     ibus_says{Pre, Post}(ibus);
  @ ensures !\result ==> ibus_kept{Pre, Post}(ibus);
  @ ensures ibus->count.frames == framing_sum(\old(ibus->count.frames), \result ? 1 : 0);
  @ ensures ibus->age_us == (\result ? 0 : \old(ibus->age_us));
  @ ensures !\result ==> \let n = \old(ibus->framing.held) - ibus->framing.held; 0 <= n &&
  @     (\forall integer j; 1 <= j < n ==>
  @         \at(ibus->framing.byte[j], Pre) != KEEL_IBUS_HEADER) &&
  @     (\forall integer j; 0 <= j < ibus->framing.held ==>
  @         ibus->framing.byte[j] == \at(ibus->framing.byte[n + j], Pre));
  @*/
static bool take_held(keel_ibus_t *ibus)
{
    bool right = false;

    if (ibus->framing.byte[COMMAND_AT] != (uint8_t)KEEL_IBUS_COMMAND) {
        ibus->count.headers = keel_framing_sum(ibus->count.headers, 1u);
        keel_framing_drop(&ibus->framing, 1u);
    } else if (ibus->framing.held == (uint8_t)KEEL_IBUS_BYTES) {
        right = take_words(ibus);
        keel_framing_drop(&ibus->framing, right ? (uint32_t)KEEL_IBUS_BYTES : 1u);
    } else {
        /* Its end is still to come. */
    }
    return right;
}

keel_status_t keel_ibus_init(keel_ibus_t *ibus, const keel_ibus_config_t *config)
{
    const uint8_t headers[KEEL_FRAMING_HEADERS] = {KEEL_IBUS_HEADER, KEEL_IBUS_HEADER,
                                                   KEEL_IBUS_HEADER, KEEL_IBUS_HEADER};
    static const keel_ibus_count_t no_count = {0};

    if ((config->lowest > config->highest) || (config->highest > (uint16_t)KEEL_IBUS_CHANNEL_MAX)) {
        return KEEL_ERR_LIMITS;
    }
    if (config->gap_us == 0u) {
        return KEEL_ERR_AGE;
    }
    ibus->config = *config;
    keel_framing_begin(&ibus->framing, config->gap_us, headers);
    ibus->count = no_count;
    ibus->age_us = UINT32_MAX;
    /*@ loop invariant 0 <= i <= KEEL_IBUS_CHANNELS;
      @ loop assigns i, ibus->channel[0 .. KEEL_IBUS_CHANNELS - 1];
      @ loop variant KEEL_IBUS_CHANNELS - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_IBUS_CHANNELS; i++) {
        ibus->channel[i] = 0u;
    }
    return KEEL_OK;
}

void keel_ibus_pass_time(keel_ibus_t *ibus, uint32_t elapsed_us)
{
    ibus->age_us = keel_framing_sum(ibus->age_us, elapsed_us);
    keel_framing_pass_time(&ibus->framing, elapsed_us);
}

bool keel_ibus_take(keel_ibus_t *ibus, uint8_t byte, uint32_t elapsed_us)
{
    bool right = false;

    keel_ibus_pass_time(ibus, elapsed_us);
    keel_framing_take(&ibus->framing, byte, 0u);
    if (ibus->framing.held > COMMAND_AT) {
        right = take_held(ibus);
    }
    return right;
}
