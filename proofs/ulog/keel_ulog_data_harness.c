// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_data model_ulog_data
//
// Messages of up to 43 bytes and names of up to 4 characters, as in all harnesses of this unit:
// larger ones take the solver hours. WP shows the clauses for the shipped sizes.
#include "ulog_proof.h"

void keel_ulog_data_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const uint16_t number = nondet_u16();

    model_ulog_data(&model, number);

    keel_ulog_data(&message, number);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_008_model: every byte as in the model");
}
