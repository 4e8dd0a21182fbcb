// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --unwindset put_text.0:9,append_text.0:9 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_information put_name put_text set_key_length
// covers: model_ulog_information append_text
//
// Any name, any text of up to 8 characters.
#include "ulog_proof.h"

void keel_ulog_information_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const keel_ulog_name_t name = nondet_name();
    const uint8_t length = any_count();
    char text[TEXT_MOST];
    bool expected;
    bool made;

    any_text(text);
    expected = model_ulog_information(&model, &name, text, length);

    made = keel_ulog_information(&message, &name, text, length);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_005_model: every byte as in the model");
    __CPROVER_assert(made == expected, "ULG_005_made: it is said whether there is one");
}
