// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_add refuse_message put_bytes model_ulog_add
//
// Any message, whole or none, and up to 8 bytes: some fit, some do not. WP has no such bound.
#include "ulog_proof.h"

void keel_ulog_add_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const uint8_t count = any_count();
    uint8_t bytes[TEXT_MOST];
    bool expected;
    bool made;

    __CPROVER_assume(message.size <= KEEL_ULOG_MESSAGE_BYTES);
    any_bytes(bytes);
    expected = model_ulog_add(&model, bytes, count);

    made = keel_ulog_add(&message, bytes, count);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_009_model: every byte as in the model");
    __CPROVER_assert(made == expected, "ULG_009_made: it is said whether there is one");
}
