/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/sbus.h"

/* Where the flags and the footer are in a frame. */
#define FLAGS_AT  (KEEL_SBUS_BYTES - 2)
#define FOOTER_AT (KEEL_SBUS_BYTES - 1)

#define FLAG_17       0x01u
#define FLAG_18       0x02u
#define FLAG_LOST     0x04u
#define FLAG_FAILSAFE 0x08u
#define FLAGS_LIMIT   0x10u

/* SBUS's, and SBUS2's: one for each quarter of its telemetry. */
#define FOOTER     0x00u
#define FOOTER_2_A 0x04u
#define FOOTER_2_B 0x14u
#define FOOTER_2_C 0x24u
#define FOOTER_2_D 0x34u

#define CHANNEL_BITS 11u
#define CHANNEL_MASK 2047u

/* Eighths of a microsecond: 5 in a step, 4 to round. */
#define EIGHTHS_PER_STEP 5u
#define EIGHTHS_TO_ROUND 4u
#define EIGHTHS          8u

/*@ assigns \nothing;
  @ ensures \result == sbus_sum(a, b);
  @*/
static uint32_t add_up_to_end(uint32_t a, uint32_t b)
{
    return (a <= (UINT32_MAX - b)) ? (a + b) : UINT32_MAX;
}

/*@ requires \valid(count);
  @ assigns *count;
  @ ensures *count == sbus_sum(\old(*count), 1);
  @*/
static void count_to_end(uint32_t *count)
{
    *count = add_up_to_end(*count, 1u);
}

/* Each channel has its 11 bits in three bytes; behind the last one's are the flags. */
/*@ requires \valid_read(sbus) && index < KEEL_SBUS_CHANNELS;
  @ assigns \nothing;
  @ ensures \result == sbus_field(sbus, index);
  @*/
static uint16_t field_of(const keel_sbus_t *sbus, uint32_t index)
{
    const uint32_t bit = CHANNEL_BITS * index;
    const uint32_t first = 1u + (bit / 8u);
    const uint32_t window = sbus->buffer[first] + (256u * sbus->buffer[first + 1u]) +
                            (65536u * sbus->buffer[first + 2u]);

    return (uint16_t)((window >> (bit % 8u)) & CHANNEL_MASK);
}

/*@ assigns \nothing;
  @ ensures \result <==> sbus_footer(byte);
  @*/
static bool is_footer(uint8_t byte)
{
    return (byte == FOOTER) || (byte == FOOTER_2_A) || (byte == FOOTER_2_B) ||
           (byte == FOOTER_2_C) || (byte == FOOTER_2_D);
}

/*@ requires \valid_read(sbus) && index < KEEL_SBUS_CHANNELS;
  @ assigns \nothing;
  @ ensures \result <==> sbus_judged(sbus, index);
  @*/
static bool is_judged(const keel_sbus_t *sbus, uint32_t index)
{
    return (((uint32_t)sbus->config.judged >> index) & 1u) != 0u;
}

/*@ requires \valid_read(sbus);
  @ assigns \nothing;
  @ ensures \result <==> sbus_ranges(sbus);
  @*/
static bool are_plausible(const keel_sbus_t *sbus)
{
    bool plausible = true;

    /*@ loop invariant 0 <= i <= KEEL_SBUS_CHANNELS;
      @ loop invariant plausible <==> \forall integer j; 0 <= j < i && sbus_judged(sbus, j) ==>
      @     sbus->config.lowest <= sbus_field(sbus, j) <= sbus->config.highest;
      @ loop assigns i, plausible;
      @ loop variant KEEL_SBUS_CHANNELS - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_SBUS_CHANNELS; i++) {
        const uint16_t value = field_of(sbus, i);

        plausible = plausible && (!is_judged(sbus, i) || ((sbus->config.lowest <= value) &&
                                                          (value <= sbus->config.highest)));
    }
    return plausible;
}

/*@ requires \valid(sbus);
  @ assigns sbus->frame.channel[0 .. KEEL_SBUS_CHANNELS - 1], sbus->frame.digital_17,
  @     sbus->frame.digital_18, sbus->frame.lost, sbus->frame.failsafe;
  @ ensures \forall integer i; 0 <= i < KEEL_SBUS_CHANNELS ==>
  @     sbus->frame.channel[i] == sbus_field(sbus, i);
  @*/
static void publish(keel_sbus_t *sbus)
{
    const uint8_t flags = sbus->buffer[FLAGS_AT];

    /*@ loop invariant 0 <= i <= KEEL_SBUS_CHANNELS;
      @ loop invariant \forall integer j; 0 <= j < i ==>
      @     sbus->frame.channel[j] == sbus_field(sbus, j);
      @ loop assigns i, sbus->frame.channel[0 .. KEEL_SBUS_CHANNELS - 1];
      @ loop variant KEEL_SBUS_CHANNELS - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_SBUS_CHANNELS; i++) {
        sbus->frame.channel[i] = field_of(sbus, i);
    }
    sbus->frame.digital_17 = (flags & FLAG_17) != 0u;
    sbus->frame.digital_18 = (flags & FLAG_18) != 0u;
    sbus->frame.lost = (flags & FLAG_LOST) != 0u;
    sbus->frame.failsafe = (flags & FLAG_FAILSAFE) != 0u;
}

/* These 25 bytes are no frame: one may begin at any header among them but the first. */
/*@ requires \valid(sbus);
  @ assigns sbus->buffer[0 .. KEEL_SBUS_BYTES - 1], sbus->held;
  @ ensures sbus_valid(sbus);
  @ ensures \let n = KEEL_SBUS_BYTES - sbus->held; 1 <= n &&
  @     \forall integer j; 1 <= j < n ==> \at(sbus->buffer[j], Pre) != KEEL_SBUS_HEADER;
  @ ensures \let n = KEEL_SBUS_BYTES - sbus->held;
  @     \forall integer j; 0 <= j < sbus->held ==>
  @         sbus->buffer[j] == \at(sbus->buffer[n + j], Pre);
  @*/
static void search_header(keel_sbus_t *sbus)
{
    uint32_t from = 1u;

    /*@ loop invariant 1 <= from <= KEEL_SBUS_BYTES;
      @ loop invariant \forall integer j; 1 <= j < from ==>
      @     sbus->buffer[j] != KEEL_SBUS_HEADER;
      @ loop assigns from;
      @ loop variant KEEL_SBUS_BYTES - from;
      @*/
    while ((from < (uint32_t)KEEL_SBUS_BYTES) &&
           (sbus->buffer[from] != (uint8_t)KEEL_SBUS_HEADER)) {
        from++;
    }
    /*@ loop invariant from <= i <= KEEL_SBUS_BYTES;
      @ loop invariant from < i ==> sbus->buffer[0] == KEEL_SBUS_HEADER;
      @ loop invariant \forall integer j; from <= j < i ==>
      @     sbus->buffer[j - from] == \at(sbus->buffer[j], Pre);
      @ loop invariant \forall integer j; i <= j < KEEL_SBUS_BYTES ==>
      @     sbus->buffer[j] == \at(sbus->buffer[j], Pre);
      @ loop assigns i, sbus->buffer[0 .. KEEL_SBUS_BYTES - 1];
      @ loop variant KEEL_SBUS_BYTES - i;
      @*/
    for (uint32_t i = from; i < (uint32_t)KEEL_SBUS_BYTES; i++) {
        sbus->buffer[i - from] = sbus->buffer[i];
    }
    sbus->held = (uint8_t)((uint32_t)KEEL_SBUS_BYTES - from);
}

/* With 25 bytes: takes them as a frame, or counts why not. */
/*@ requires \valid(sbus);
  @ assigns sbus->frame.channel[0 .. KEEL_SBUS_CHANNELS - 1], sbus->frame.digital_17,
  @     sbus->frame.digital_18, sbus->frame.lost, sbus->frame.failsafe, sbus->count.frames,
  @     sbus->count.footers, sbus->count.flags, sbus->count.ranges;
  @ ensures \result ==> sbus_footer(sbus->buffer[KEEL_SBUS_BYTES - 1]) &&
  @     sbus->buffer[KEEL_SBUS_BYTES - 2] < 16;
  @ ensures \result ==> sbus_ranges(sbus);
  @ ensures \result ==> \forall integer i; 0 <= i < KEEL_SBUS_CHANNELS ==>
  @     sbus->frame.channel[i] == sbus_field(sbus, i);
  @ ensures !\result ==> sbus_kept{Pre, Post}(sbus);
  @ ensures sbus->count.frames ==
  @     (\result ? sbus_sum(\old(sbus->count.frames), 1) : \old(sbus->count.frames));
  @*/
static bool take_frame(keel_sbus_t *sbus)
{
    bool right = false;

    if (!is_footer(sbus->buffer[FOOTER_AT])) {
        count_to_end(&sbus->count.footers);
    } else if (sbus->buffer[FLAGS_AT] >= FLAGS_LIMIT) {
        count_to_end(&sbus->count.flags);
    } else if (!are_plausible(sbus)) {
        count_to_end(&sbus->count.ranges);
    } else {
        publish(sbus);
        count_to_end(&sbus->count.frames);
        right = true;
    }
    return right;
}

keel_status_t keel_sbus_init(keel_sbus_t *sbus, const keel_sbus_config_t *config)
{
    static const keel_sbus_frame_t no_frame = {.failsafe = true};
    static const keel_sbus_count_t no_count = {0};

    if ((config->lowest > config->highest) || (config->highest > (uint16_t)KEEL_SBUS_CHANNEL_MAX)) {
        return KEEL_ERR_LIMITS;
    }
    if (config->gap_us == 0u) {
        return KEEL_ERR_AGE;
    }
    sbus->config = *config;
    sbus->frame = no_frame;
    sbus->count = no_count;
    sbus->age_us = UINT32_MAX;
    sbus->quiet_us = UINT32_MAX;
    /*@ loop invariant 0 <= i <= KEEL_SBUS_BYTES;
      @ loop assigns i, sbus->buffer[0 .. KEEL_SBUS_BYTES - 1];
      @ loop variant KEEL_SBUS_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_SBUS_BYTES; i++) {
        sbus->buffer[i] = 0u;
    }
    sbus->held = 0u;
    return KEEL_OK;
}

void keel_sbus_pass_time(keel_sbus_t *sbus, uint32_t elapsed_us)
{
    sbus->age_us = add_up_to_end(sbus->age_us, elapsed_us);
    sbus->quiet_us = add_up_to_end(sbus->quiet_us, elapsed_us);
}

bool keel_sbus_take(keel_sbus_t *sbus, uint8_t byte, uint32_t elapsed_us)
{
    bool right = false;

    keel_sbus_pass_time(sbus, elapsed_us);
    if ((sbus->held > 0u) && (sbus->quiet_us > sbus->config.gap_us)) {
        count_to_end(&sbus->count.gaps);
        sbus->held = 0u;
    }
    sbus->quiet_us = 0u;
    if ((sbus->held == 0u) && (byte != (uint8_t)KEEL_SBUS_HEADER)) {
        count_to_end(&sbus->count.headers);
    } else {
        sbus->buffer[sbus->held] = byte;
        sbus->held++;
    }
    if (sbus->held == (uint8_t)KEEL_SBUS_BYTES) {
        sbus->held = 0u;
        right = take_frame(sbus);
        if (right) {
            sbus->age_us = 0u;
        } else {
            search_header(sbus);
        }
    }
    return right;
}

uint16_t keel_sbus_us(uint16_t raw)
{
    const uint32_t step = (raw < (uint16_t)KEEL_SBUS_CHANNEL_MAX) ? raw
                                                                  : (uint32_t)KEEL_SBUS_CHANNEL_MAX;

    return (uint16_t)((uint32_t)KEEL_SBUS_US_MIN +
                      (((EIGHTHS_PER_STEP * step) + EIGHTHS_TO_ROUND) / EIGHTHS));
}
