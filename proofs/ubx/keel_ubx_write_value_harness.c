// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 29 --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_write_value model_ubx_write_value write_cfg write_header write_sums write_number
#include "ubx_proof.h"

void keel_ubx_write_value_harness(void)
{
    const uint32_t at = any_below(KEEL_UBX_MESSAGE_BYTES);
    keel_ubx_message_t message = nondet_ubx_message();
    keel_ubx_message_t model = message;
    const uint32_t key = nondet_u32();
    const uint32_t value = nondet_u32();
    const keel_status_t expected = model_ubx_write_value(&model, key, value);
    const keel_status_t status = keel_ubx_write_value(&message, key, value);

    __CPROVER_assert(status == expected, "UBX_014_taken: written or refused as the model says");
    __CPROVER_assert(ubx_message_same(&message, &model, at),
                     "UBX_014_model: every byte is what the model says, and none after a refusal");
}
