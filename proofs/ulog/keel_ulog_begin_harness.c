// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_begin put_bytes put_number model_ulog_begin append append_u64
//
// Whatever was in the message, any time.
#include "ulog_proof.h"

void keel_ulog_begin_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const uint64_t start_us = nondet_u64();

    model_ulog_begin(&model, start_us);

    keel_ulog_begin(&message, start_us);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_001_model: every byte as in the model");
}
