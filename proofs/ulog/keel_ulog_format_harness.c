// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=1u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_format is_format_known refuse_message put_field put_type put_name put_decimal
// covers: type_letter open_message
// covers: model_ulog_format append append_field append_type append_name append_array start
// covers: none
//
// Any table of one field, with names of up to four characters.
#include "ulog_proof.h"

void keel_ulog_format_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const keel_ulog_format_t format = nondet_format();
    bool expected;
    bool made;

    expected = model_ulog_format(&model, &format);

    made = keel_ulog_format(&message, &format);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_004_model: every byte as in the model");
    __CPROVER_assert(made == expected, "ULG_004_made: it is said whether there is one");
}
