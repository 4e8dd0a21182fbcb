/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/ms5611.h
 * @brief The contracts of ms5611.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_MS5611_H
#define KEEL_INTERNAL_MIDDLEWARE_MS5611_H

#include "keel/c_declarations.h"
#include "keel/middleware/ms5611.h"

KEEL_C_BEGIN

/*@ // Four bits, the highest first, that are in the rest already, divided by x^4 + x + 1.
  @ logic integer ms5611_up(integer rest, integer bits) =
  @     bits <= 0 ? rest :
  @     \let before = ms5611_up(rest, bits - 1);
  @         before >= 8 ? ((2 * before) ^ 3) % 16 : 2 * before;
  @
  @ // Four bits of the PROM, the first word's highest first.
  @ logic integer ms5611_nibble(uint16_t *word, integer index) =
  @     (word[index / 4] >> (12 - 4 * (index % 4))) & 15;
  @
  @ // The rest of so many of them.
  @ logic integer ms5611_rest(uint16_t *word, integer count) =
  @     count <= 0 ? 0 :
  @     ms5611_up((ms5611_rest(word, count - 1) ^ ms5611_nibble(word, count - 1)) % 16, 4);
  @
  @ predicate ms5611_blank(uint16_t *word) =
  @     \forall integer i; 0 <= i < KEEL_MS5611_WORDS ==> word[i] == 0;
  @
  @ predicate ms5611_is(keel_ms5611_t *m, uint16_t *word) =
  @     m->sensitivity == word[1] && m->offset == word[2] && m->sensitivity_slope == word[3] &&
  @     m->offset_slope == word[4] && m->reference == word[5] &&
  @     m->temperature_slope == word[6];
  @
  @ // dT: how far D2 is from what it is at 20 degrees.
  @ logic integer ms5611_difference(keel_ms5611_t *m, integer d2) = d2 - 256 * m->reference;
  @
  @ // TEMP, first order.
  @ logic integer ms5611_first(keel_ms5611_t *m, integer difference) =
  @     2000 + (m->temperature_slope * difference) / 8388608;
  @
  @ // How much it is below a temperature, squared.
  @ logic integer ms5611_below(integer temperature, integer limit) =
  @     temperature < limit ? (limit - temperature) * (limit - temperature) : 0;
  @
  @ // OFF, with its second order.
  @ logic integer ms5611_offset(keel_ms5611_t *m, integer difference, integer first) =
  @     65536 * m->offset + (m->offset_slope * difference) / 128 -
  @     (5 * ms5611_below(first, 2000)) / 2 - 7 * ms5611_below(first, -1500);
  @
  @ // SENS, with its second order.
  @ logic integer ms5611_sensitivity(keel_ms5611_t *m, integer difference, integer first) =
  @     32768 * m->sensitivity + (m->sensitivity_slope * difference) / 256 -
  @     (5 * ms5611_below(first, 2000)) / 4 - (11 * ms5611_below(first, -1500)) / 2;
  @
  @ // TEMP, with its second order.
  @ logic integer ms5611_temperature(integer difference, integer first) =
  @     first - (first < 2000 ? (difference * difference) / 2147483648 : 0);
  @
  @ logic integer ms5611_pressure(integer d1, integer offset, integer sensitivity) =
  @     ((d1 * sensitivity) / 2097152 - offset) / 32768;
  @
  @ // The readings amount to this.
  @ logic integer ms5611_pressure_of(keel_ms5611_t *m, integer d1, integer d2) =
  @     \let difference = ms5611_difference(m, d2);
  @     \let first = ms5611_first(m, difference);
  @     ms5611_pressure(d1, ms5611_offset(m, difference, first),
  @                     ms5611_sensitivity(m, difference, first));
  @
  @ logic integer ms5611_temperature_of(keel_ms5611_t *m, integer d2) =
  @     \let difference = ms5611_difference(m, d2);
  @     ms5611_temperature(difference, ms5611_first(m, difference));
  @
  @ predicate ms5611_warm(integer temperature) =
  @     KEEL_MS5611_TEMPERATURE_MIN <= temperature <= KEEL_MS5611_TEMPERATURE_MAX;
  @
  @ predicate ms5611_dense(integer pressure) =
  @     KEEL_MS5611_PRESSURE_MIN <= pressure <= KEEL_MS5611_PRESSURE_MAX;
  @*/

/*@ requires \valid_read(word + (0 .. KEEL_MS5611_WORDS - 1));
  @ assigns \nothing;
  @ ensures MSC_001_rest: \result == ms5611_rest(word, 30);
  @ ensures MSC_001_bits: 0 <= \result <= 15;
  @*/
uint8_t keel_ms5611_crc(const uint16_t *word);

/*@ requires \valid(ms5611) && \valid_read(word + (0 .. KEEL_MS5611_WORDS - 1)) &&
  @     \separated(ms5611, word + (0 .. KEEL_MS5611_WORDS - 1));
  @ assigns *ms5611;
  @ behavior blank:
  @   assumes ms5611_blank(word);
  @   assigns \nothing;
  @   ensures MSC_002_blank: \result == KEEL_ERR_VALUE;
  @ behavior wrong:
  @   assumes !ms5611_blank(word) && (word[7] & 15) != ms5611_rest(word, 30);
  @   assigns \nothing;
  @   ensures MSC_002_wrong: \result == KEEL_ERR_INPUT;
  @ behavior taken:
  @   assumes !ms5611_blank(word) && (word[7] & 15) == ms5611_rest(word, 30);
  @   ensures MSC_003_taken: \result == KEEL_OK && ms5611_is(ms5611, word);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_ms5611_init(keel_ms5611_t *ms5611, const uint16_t *word);

/*@ requires \valid_read(ms5611) && \valid(sample) && \separated(ms5611, sample);
  @ assigns *sample;
  @ behavior wide:
  @   assumes d1 > KEEL_MS5611_READING_MAX || d2 > KEEL_MS5611_READING_MAX;
  @   assigns \nothing;
  @   ensures MSC_004_wide: \result == KEEL_ERR_INPUT;
  @ behavior none:
  @   assumes d1 <= KEEL_MS5611_READING_MAX && d2 <= KEEL_MS5611_READING_MAX;
  @   assumes d1 == 0 || d2 == 0;
  @   assigns \nothing;
  @   ensures MSC_005_none: \result == KEEL_ERR_STATE;
  @ behavior temperature:
  @   assumes 0 < d1 <= KEEL_MS5611_READING_MAX && 0 < d2 <= KEEL_MS5611_READING_MAX;
  @   assumes !ms5611_warm(ms5611_temperature_of(ms5611, d2));
  @   assigns \nothing;
  @   ensures MSC_006_temperature: \result == KEEL_ERR_VALUE;
  @ behavior pressure:
  @   assumes 0 < d1 <= KEEL_MS5611_READING_MAX && 0 < d2 <= KEEL_MS5611_READING_MAX;
  @   assumes ms5611_warm(ms5611_temperature_of(ms5611, d2));
  @   assumes !ms5611_dense(ms5611_pressure_of(ms5611, d1, d2));
  @   assigns \nothing;
  @   ensures MSC_006_pressure: \result == KEEL_ERR_LIMITS;
  @ behavior measured:
  @   assumes 0 < d1 <= KEEL_MS5611_READING_MAX && 0 < d2 <= KEEL_MS5611_READING_MAX;
  @   assumes ms5611_warm(ms5611_temperature_of(ms5611, d2));
  @   assumes ms5611_dense(ms5611_pressure_of(ms5611, d1, d2));
  @   ensures MSC_007_done: \result == KEEL_OK;
  @   ensures MSC_008_temperature: sample->temperature_cdeg ==
  @       ms5611_temperature_of(\old(ms5611), d2);
  @   ensures MSC_007_pressure: sample->pressure_pa ==
  @       ms5611_pressure_of(\old(ms5611), d1, d2);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_ms5611_compensate(const keel_ms5611_t *ms5611, uint32_t d1, uint32_t d2,
                                     keel_ms5611_sample_t *sample);

KEEL_C_END

#endif
