// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 29 --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_write_port model_ubx_write_port write_cfg write_header write_sums write_number
#include "ubx_proof.h"

void keel_ubx_write_port_harness(void)
{
    const uint32_t at = any_below(KEEL_UBX_MESSAGE_BYTES);
    keel_ubx_message_t message = nondet_ubx_message();
    keel_ubx_message_t model = message;
    const uint32_t baud = nondet_u32();

    model_ubx_write_port(&model, baud);

    keel_ubx_write_port(&message, baud);

    __CPROVER_assert(ubx_message_same(&message, &model, at),
                     "UBX_015_model: every byte is what the model says");
}
