/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/ms5611.h"

#include <stdbool.h>

/* The check's polynomial, x^4 + x + 1, without its highest power. */
#define POLYNOMIAL 3u
#define TOP        8u
#define NIBBLE     15u
#define VALUES     16u /* Of four bits. */
#define BITS       4u

/* Four bits each: all of the PROM but its last byte, whose half is the check. */
#define NIBBLES          30u
#define NIBBLES_PER_WORD 4u
#define FIRST_SHIFT      12u

#define CHECK_WORD 7u

/* Hundredths of a degree: the temperature of the reference, and where the second and the third part
 * of the correction begin. */
#define REFERENCE_CDEG 2000
#define COLD_CDEG      2000
#define FROST_CDEG     (-1500)

/* The units of the data sheet's formulas. */
#define TWO_7  128
#define TWO_8  256
#define TWO_15 32768
#define TWO_16 65536
#define TWO_21 2097152
#define TWO_23 8388608
#define TWO_31 2147483648LL

/* The values that give the pressure. */
typedef struct line {
    int64_t offset;
    int64_t sensitivity;
} line_t;

/*@ lemma MSC_grows: \forall integer a, b, c; 0 <= c ==> a <= b ==> c * a <= c * b;
  @
  @ lemma MSC_square: \forall integer x, m; -m <= x <= m ==> 0 <= x * x <= m * m;
  @*/

/* Divides by the polynomial what comes in four bits. */
/*@ requires dividend <= NIBBLE;
  @ assigns \nothing;
  @ ensures \result == ms5611_up(dividend, BITS) && \result <= NIBBLE;
  @*/
static uint32_t nibble_rest(uint32_t dividend)
{
    uint32_t rest = dividend;

    /*@ loop invariant 0 <= i <= BITS && rest <= NIBBLE;
      @ loop invariant rest == ms5611_up(dividend, i);
      @ loop assigns i, rest;
      @ loop variant BITS - i;
      @*/
    for (uint32_t i = 0u; i < BITS; i++) {
        rest = (rest >= TOP) ? (((2u * rest) ^ POLYNOMIAL) % VALUES) : (2u * rest);
    }
    return rest;
}

/*@ requires \valid_read(word + (0 .. KEEL_MS5611_WORDS - 1)) && index < NIBBLES;
  @ assigns \nothing;
  @ ensures \result == ms5611_nibble(word, index) && \result <= NIBBLE;
  @*/
static uint32_t nibble_of(const uint16_t *word, uint32_t index)
{
    const uint32_t bits = word[index / NIBBLES_PER_WORD];

    return (bits >> (FIRST_SHIFT - (BITS * (index % NIBBLES_PER_WORD)))) & NIBBLE;
}

/*@ requires \valid_read(word + (0 .. KEEL_MS5611_WORDS - 1));
  @ assigns \nothing;
  @ ensures \result <==> ms5611_blank(word);
  @*/
static bool is_blank(const uint16_t *word)
{
    bool blank = true;

    /*@ loop invariant 0 <= i <= KEEL_MS5611_WORDS;
      @ loop invariant blank <==> \forall integer j; 0 <= j < i ==> word[j] == 0;
      @ loop assigns i, blank;
      @ loop variant KEEL_MS5611_WORDS - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MS5611_WORDS; i++) {
        blank = blank && (word[i] == 0u);
    }
    return blank;
}

uint8_t keel_ms5611_crc(const uint16_t *word)
{
    uint32_t rest = 0u;

    /*@ loop invariant 0 <= i <= NIBBLES && rest <= NIBBLE;
      @ loop invariant rest == ms5611_rest(word, i);
      @ loop assigns i, rest;
      @ loop variant NIBBLES - i;
      @*/
    for (uint32_t i = 0u; i < NIBBLES; i++) {
        rest = nibble_rest((rest ^ nibble_of(word, i)) % VALUES);
    }
    return (uint8_t)rest;
}

keel_status_t keel_ms5611_init(keel_ms5611_t *ms5611, const uint16_t *word)
{
    if (is_blank(word)) {
        return KEEL_ERR_VALUE;
    }
    if ((word[CHECK_WORD] & NIBBLE) != keel_ms5611_crc(word)) {
        return KEEL_ERR_INPUT;
    }
    ms5611->sensitivity = word[1];
    ms5611->offset = word[2];
    ms5611->sensitivity_slope = word[3];
    ms5611->offset_slope = word[4];
    ms5611->reference = word[5];
    ms5611->temperature_slope = word[6];
    return KEEL_OK;
}

/* How much a coefficient makes of a difference in temperature. */
/*@ requires -16777216 <= difference <= 16777216;
  @ assigns \nothing;
  @ ensures \result == coefficient * difference;
  @ ensures -1099511627776 <= \result <= 1099511627776;
  @*/
static int64_t product_of(uint16_t coefficient, int64_t difference)
{
    /*@ assert coefficient * -16777216 <= coefficient * difference <= coefficient * 16777216; */
    return (int64_t)coefficient * difference;
}

/* TEMP, of the first order. */
/*@ requires \valid_read(ms5611) && -16777216 <= difference <= 16777216;
  @ assigns \nothing;
  @ ensures \result == ms5611_first(ms5611, difference);
  @ ensures -131072 <= \result <= 135072;
  @*/
static int64_t first_of(const keel_ms5611_t *ms5611, int64_t difference)
{
    return REFERENCE_CDEG + (product_of(ms5611->temperature_slope, difference) / TWO_23);
}

/* And of the second. */
/*@ requires -16777216 <= difference <= 16777216 && -131072 <= first <= 135072;
  @ assigns \nothing;
  @ ensures \result == ms5611_temperature(difference, first);
  @*/
static int64_t second_of(int64_t difference, int64_t first)
{
    return first - ((first < COLD_CDEG) ? ((difference * difference) / TWO_31) : 0);
}

/* The square of how much a temperature is below another. */
/*@ requires -131072 <= temperature <= 135072 && -2000 <= limit <= 2000;
  @ assigns \nothing;
  @ ensures \result == ms5611_below(temperature, limit);
  @ ensures 0 <= \result <= 133072 * 133072;
  @*/
static int64_t square_below(int64_t temperature, int64_t limit)
{
    const int64_t below = (temperature < limit) ? (limit - temperature) : 0;

    return below * below;
}

/* OFF and SENS. */
/*@ requires \valid_read(ms5611);
  @ requires -16777216 <= difference <= 16777216;
  @ requires -131072 <= first <= 135072;
  @ assigns \nothing;
  @ ensures \result.offset == ms5611_offset(ms5611, difference, first);
  @ ensures \result.sensitivity == ms5611_sensitivity(ms5611, difference, first);
  @ ensures -274877906944 <= \result.offset <= 274877906944;
  @ ensures -274877906944 <= \result.sensitivity <= 274877906944;
  @*/
static line_t line_of(const keel_ms5611_t *ms5611, int64_t difference, int64_t first)
{
    const int64_t cold = square_below(first, COLD_CDEG);
    const int64_t frost = square_below(first, FROST_CDEG);
    const line_t line = {
        .offset = (((int64_t)ms5611->offset * TWO_16) +
                   (product_of(ms5611->offset_slope, difference) / TWO_7)) -
                  (((5 * cold) / 2) + (7 * frost)),
        .sensitivity = (((int64_t)ms5611->sensitivity * TWO_15) +
                        (product_of(ms5611->sensitivity_slope, difference) / TWO_8)) -
                       (((5 * cold) / 4) + ((11 * frost) / 2)),
    };

    return line;
}

/*@ requires d1 <= KEEL_MS5611_READING_MAX && \valid_read(line);
  @ requires -274877906944 <= line->offset <= 274877906944;
  @ requires -274877906944 <= line->sensitivity <= 274877906944;
  @ assigns \nothing;
  @ ensures \result == ms5611_pressure(d1, line->offset, line->sensitivity);
  @*/
static int64_t pressure_of(uint32_t d1, const line_t *line)
{
    /*@ assert d1 * -274877906944 <= d1 * line->sensitivity <= d1 * 274877906944; */
    return ((((int64_t)d1 * line->sensitivity) / TWO_21) - line->offset) / TWO_15;
}

keel_status_t keel_ms5611_compensate(const keel_ms5611_t *ms5611, uint32_t d1, uint32_t d2,
                                     keel_ms5611_sample_t *sample)
{
    int64_t difference;
    int64_t first;
    int64_t temperature;
    int64_t pressure;
    line_t line;

    if ((d1 > (uint32_t)KEEL_MS5611_READING_MAX) || (d2 > (uint32_t)KEEL_MS5611_READING_MAX)) {
        return KEEL_ERR_INPUT;
    }
    if ((d1 == 0u) || (d2 == 0u)) {
        return KEEL_ERR_STATE;
    }
    difference = (int64_t)d2 - ((int64_t)ms5611->reference * TWO_8);
    first = first_of(ms5611, difference);
    temperature = second_of(difference, first);
    if ((temperature < KEEL_MS5611_TEMPERATURE_MIN) ||
        (temperature > KEEL_MS5611_TEMPERATURE_MAX)) {
        return KEEL_ERR_VALUE;
    }
    line = line_of(ms5611, difference, first);
    pressure = pressure_of(d1, &line);
    if ((pressure < KEEL_MS5611_PRESSURE_MIN) || (pressure > KEEL_MS5611_PRESSURE_MAX)) {
        return KEEL_ERR_LIMITS;
    }
    sample->pressure_pa = (int32_t)pressure;
    sample->temperature_cdeg = (int32_t)temperature;
    return KEEL_OK;
}
