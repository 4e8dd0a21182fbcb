// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_subscription put_number put_name model_ulog_subscription append_u16
//
// Messages of up to 43 bytes and names of up to 4 characters, as in all harnesses of this unit:
// larger ones take the solver hours. WP shows the clauses for the shipped sizes.
#include "ulog_proof.h"

void keel_ulog_subscription_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const keel_ulog_name_t name = nondet_name();
    const uint8_t instance = nondet_u8();
    const uint16_t number = nondet_u16();

    model_ulog_subscription(&model, instance, number, &name);

    keel_ulog_subscription(&message, instance, number, &name);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_007_model: every byte as in the model");
}
