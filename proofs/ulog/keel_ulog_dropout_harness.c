// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_dropout model_ulog_dropout
//
// Any time.
#include "ulog_proof.h"

void keel_ulog_dropout_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const uint64_t lost_us = nondet_u64();

    model_ulog_dropout(&model, lost_us);

    keel_ulog_dropout(&message, lost_us);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_011_model: every byte as in the model");
}
