// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --unwindset put_text.0:37,append_text.0:37 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_logging put_number put_text model_ulog_logging
//
// Any text of up to 36 characters: some fit, some do not.
#include "ulog_proof.h"

void keel_ulog_logging_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const uint8_t level = nondet_u8();
    const uint64_t time_us = nondet_u64();
    const uint8_t length = any_length();
    char text[TEXT_MOST];
    bool expected;
    bool made;

    any_text(text);
    expected = model_ulog_logging(&model, level, time_us, text, length);

    made = keel_ulog_logging(&message, level, time_us, text, length);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_010_model: every byte as in the model");
    __CPROVER_assert(made == expected, "ULG_010_made: it is said whether there is one");
}
