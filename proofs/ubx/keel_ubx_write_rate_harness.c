// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 29 --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_write_rate model_ubx_write_rate write_cfg write_header write_sums write_number
#include "ubx_proof.h"

void keel_ubx_write_rate_harness(void)
{
    const uint32_t at = any_below(KEEL_UBX_MESSAGE_BYTES);
    keel_ubx_message_t message = nondet_ubx_message();
    keel_ubx_message_t model = message;
    const uint16_t period_ms = nondet_u16();

    model_ubx_write_rate(&model, period_ms);

    keel_ubx_write_rate(&message, period_ms);

    __CPROVER_assert(ubx_message_same(&message, &model, at),
                     "UBX_015_model: every byte is what the model says");
}
