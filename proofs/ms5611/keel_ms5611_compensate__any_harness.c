// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/ms5611.c
// covers: keel_ms5611_compensate line_of product_of first_of second_of square_below pressure_of
//
// Any coefficients, any readings: nothing overflows, what is told lies within its limits, and a
// refusal changes nothing.
#include "../common/unchanged.h"
#include "ms5611_proof.h"

void keel_ms5611_compensate__any_harness(void)
{
    const keel_ms5611_t ms5611 = any_ms5611();
    keel_ms5611_sample_t sample = any_ms5611_sample();
    const keel_ms5611_sample_t before = sample;
    const uint32_t d1 = nondet_u32();
    const uint32_t d2 = nondet_u32();
    const keel_status_t status = keel_ms5611_compensate(&ms5611, d1, d2, &sample);

    if (status == KEEL_OK) {
        __CPROVER_assert((sample.pressure_pa >= 1000) && (sample.pressure_pa <= 120000),
                         "MSC_006_dense: a pressure that the sensor is made for");
        __CPROVER_assert((sample.temperature_cdeg >= -4000) && (sample.temperature_cdeg <= 8500),
                         "MSC_006_warm: a temperature that it is made for");
        __CPROVER_assert((d1 > 0u) && (d2 > 0u), "MSC_005_read: both were read");
    } else {
        __CPROVER_assert(unchanged(&sample, &before, sizeof(sample)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
