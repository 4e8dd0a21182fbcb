// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 29 --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_write_output model_ubx_write_output write_cfg write_header write_sums
#include "ubx_proof.h"

void keel_ubx_write_output_harness(void)
{
    const uint32_t at = any_below(KEEL_UBX_MESSAGE_BYTES);
    keel_ubx_message_t message = nondet_ubx_message();
    keel_ubx_message_t model = message;
    const uint8_t group = nondet_u8();
    const uint8_t id = nondet_u8();
    const uint8_t every = nondet_u8();

    model_ubx_write_output(&model, group, id, every);

    keel_ubx_write_output(&message, group, id, every);

    __CPROVER_assert(ubx_message_same(&message, &model, at),
                     "UBX_015_model: every byte is what the model says");
}
