// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 17 --external-sat-solver cadical
// sources: src/middleware/ms5611.c
// covers: keel_ms5611_compensate line_of product_of first_of second_of square_below pressure_of
//
// Chosen readings of the data sheet's sensor; what they amount to is worked out by hand in
// tests/unit/test_ms5611.c.
#include "../common/unchanged.h"
#include "ms5611_proof.h"

typedef struct point {
    uint32_t d1;
    uint32_t d2;
    keel_status_t status;
    int32_t pressure_pa;
    int32_t temperature_cdeg;
} point_t;

void keel_ms5611_compensate__points_harness(void)
{
    static const point_t point[16] = {
        {9085466u, 8569150u, KEEL_OK, 100009, 2007},  {9085466u, 8566784u, KEEL_OK, 99993, 2000},
        {9085466u, 8273150u, KEEL_OK, 98000, 969},    {9085466u, 7974190u, KEEL_OK, 95791, -163},
        {9085466u, 7233450u, KEEL_OK, 89023, -3327},  {3911817u, 8569150u, KEEL_OK, 1000, 2007},
        {3911816u, 8569150u, KEEL_ERR_LIMITS, 0, 0},  {10130130u, 8569150u, KEEL_OK, 120000, 2007},
        {10130131u, 8569150u, KEEL_ERR_LIMITS, 0, 0}, {9085466u, 10492975u, KEEL_OK, 112496, 8500},
        {9085466u, 10492976u, KEEL_ERR_VALUE, 0, 0},  {9085466u, 7089678u, KEEL_OK, 87062, -4000},
        {9085466u, 7089677u, KEEL_ERR_VALUE, 0, 0},   {0u, 8569150u, KEEL_ERR_STATE, 0, 0},
        {9085466u, 0u, KEEL_ERR_STATE, 0, 0},         {16777216u, 0u, KEEL_ERR_INPUT, 0, 0},
    };
    const keel_ms5611_t ms5611 = {40127u, 36924u, 23317u, 23282u, 33464u, 28312u};

    for (uint32_t i = 0u; i < 16u; i++) {
        keel_ms5611_sample_t sample = any_ms5611_sample();
        const keel_ms5611_sample_t before = sample;
        const keel_status_t status = keel_ms5611_compensate(&ms5611, point[i].d1, point[i].d2,
                                                            &sample);

        __CPROVER_assert(status == point[i].status, "MSC_006_points: measured or refused");
        if (status == KEEL_OK) {
            __CPROVER_assert(sample.pressure_pa == point[i].pressure_pa,
                             "MSC_007_points: the pressure");
            __CPROVER_assert(sample.temperature_cdeg == point[i].temperature_cdeg,
                             "MSC_008_points: the temperature");
        } else {
            __CPROVER_assert(unchanged(&sample, &before, sizeof(sample)),
                             "STA_001_kept: a refusal changes nothing");
        }
    }
}
