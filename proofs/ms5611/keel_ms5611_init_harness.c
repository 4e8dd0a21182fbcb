// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 121 --external-sat-solver cadical
// sources: src/middleware/ms5611.c specs/model/ms5611.c
// covers: keel_ms5611_init keel_ms5611_crc nibble_of nibble_rest is_blank model_ms5611_init
// covers: model_ms5611_crc
#include "../common/unchanged.h"
#include "ms5611_proof.h"

void keel_ms5611_init_harness(void)
{
    uint16_t word[KEEL_MS5611_WORDS];
    keel_ms5611_t ms5611 = any_ms5611();
    keel_ms5611_t model = ms5611;
    const keel_ms5611_t before = ms5611;
    keel_status_t expected;
    keel_status_t status;

    any_words(word);
    expected = model_ms5611_init(&model, word);

    status = keel_ms5611_init(&ms5611, word);

    __CPROVER_assert(status == expected, "MSC_002_model: taken or refused as the model says");
    __CPROVER_assert(ms5611_same(&ms5611, &model), "MSC_003_model: each coefficient is its word");
    if (status != KEEL_OK) {
        __CPROVER_assert(unchanged(&ms5611, &before, sizeof(ms5611)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
