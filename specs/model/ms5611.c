/* SPDX-License-Identifier: Apache-2.0 */
/* In the letters of the data sheet, formula by formula. */
#include "ms5611.h"

#include <stdbool.h>

/* MSC-001: bit by bit, the highest of the first word first; the last byte is not in. */
uint8_t model_ms5611_crc(const uint16_t *word)
{
    uint32_t rest = 0u;

    for (uint32_t bit = 0u; bit < 120u; bit++) {
        const uint32_t comes = ((uint32_t)word[bit / 16u] >> (15u - (bit % 16u))) & 1u;
        const uint32_t leaves = rest / 8u;

        rest = (2u * rest) % 16u;
        if (comes != leaves) {
            rest = rest ^ 3u; /* x + 1, what x^4 leaves. */
        }
    }
    return (uint8_t)rest;
}

/* MSC-002, MSC-003 */
keel_status_t model_ms5611_init(keel_ms5611_t *ms5611, const uint16_t *word)
{
    uint32_t sum = 0u;

    for (uint32_t i = 0u; i < 8u; i++) {
        sum += word[i];
    }
    if (sum == 0u) {
        return KEEL_ERR_VALUE;
    }
    if (model_ms5611_crc(word) != (word[7] % 16u)) {
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

/* MSC-004 to MSC-008 */
keel_status_t model_ms5611_compensate(const keel_ms5611_t *ms5611, uint32_t d1, uint32_t d2,
                                      keel_ms5611_sample_t *sample)
{
    const int64_t C1 = ms5611->sensitivity;
    const int64_t C2 = ms5611->offset;
    const int64_t C3 = ms5611->sensitivity_slope;
    const int64_t C4 = ms5611->offset_slope;
    const int64_t C5 = ms5611->reference;
    const int64_t C6 = ms5611->temperature_slope;
    const int64_t dT = (int64_t)d2 - (C5 * 256);
    int64_t TEMP;
    int64_t OFF;
    int64_t SENS;
    int64_t T2;
    int64_t OFF2;
    int64_t SENS2;
    int64_t P;
    int64_t cold;
    int64_t frost;

    if ((d1 >= 16777216u) || (d2 >= 16777216u)) { /* MSC-004 */
        return KEEL_ERR_INPUT;
    }
    if ((d1 == 0u) || (d2 == 0u)) { /* MSC-005 */
        return KEEL_ERR_STATE;
    }
    TEMP = 2000 + ((C6 * dT) / 8388608);
    OFF = (C2 * 65536) + ((C4 * dT) / 128);
    SENS = (C1 * 32768) + ((C3 * dT) / 256);
    cold = (TEMP < 2000) ? (2000 - TEMP) : 0;
    frost = (TEMP < -1500) ? (-1500 - TEMP) : 0;
    T2 = (TEMP < 2000) ? ((dT * dT) / 2147483648LL) : 0;
    OFF2 = ((5 * (cold * cold)) / 2) + (7 * (frost * frost));
    SENS2 = ((5 * (cold * cold)) / 4) + ((11 * (frost * frost)) / 2);
    TEMP = TEMP - T2;
    OFF = OFF - OFF2;
    SENS = SENS - SENS2;
    P = ((((int64_t)d1 * SENS) / 2097152) - OFF) / 32768;
    if ((TEMP < -4000) || (TEMP > 8500)) { /* MSC-006 */
        return KEEL_ERR_VALUE;
    }
    if ((P < 1000) || (P > 120000)) { /* MSC-006 */
        return KEEL_ERR_LIMITS;
    }
    sample->pressure_pa = (int32_t)P;         /* MSC-007 */
    sample->temperature_cdeg = (int32_t)TEMP; /* MSC-008 */
    return KEEL_OK;
}
