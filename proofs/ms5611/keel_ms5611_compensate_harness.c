// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3
// checks: assertions
// sources: src/middleware/ms5611.c specs/model/ms5611.c
// covers: keel_ms5611_compensate line_of product_of first_of second_of square_below pressure_of
// covers: model_ms5611_compensate
//
// Any coefficients, any readings: the same as the model's. That nothing overflows is shown by
// keel_ms5611_compensate__any_harness.
#include "ms5611_proof.h"

void keel_ms5611_compensate_harness(void)
{
    const keel_ms5611_t ms5611 = any_ms5611();
    keel_ms5611_sample_t sample = any_ms5611_sample();
    keel_ms5611_sample_t model = sample;
    const uint32_t d1 = nondet_u32();
    const uint32_t d2 = nondet_u32();
    const keel_status_t expected = model_ms5611_compensate(&ms5611, d1, d2, &model);
    const keel_status_t status = keel_ms5611_compensate(&ms5611, d1, d2, &sample);

    __CPROVER_assert(status == expected, "MSC_006_model: measured or refused as the model says");
    __CPROVER_assert(ms5611_sample_same(&sample, &model), "MSC_007_model: and what was measured");
    __CPROVER_assert(sample.temperature_cdeg == model.temperature_cdeg,
                     "MSC_008_model: the temperature");
}
