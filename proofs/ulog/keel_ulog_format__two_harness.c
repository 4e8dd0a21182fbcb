// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_format is_format_known refuse_message put_field log_byte close_message finish
//
// Any first field, a second one with which the message may be too long, and any number of them.
#include "ulog_proof.h"

void keel_ulog_format__two_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const keel_ulog_format_t format = {
        .name = {"on"},
        .fields = nondet_u8(),
        .field = {nondet_field(), {{"abcd"}, KEEL_ULOG_UINT64, 200u}}};
    bool expected;
    bool made;

    expected = model_ulog_format(&model, &format);

    made = keel_ulog_format(&message, &format);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_004_model: every byte as in the model");
    __CPROVER_assert(made == expected, "ULG_004_made: it is said whether there is one");
}
