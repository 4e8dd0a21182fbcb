// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --max-field-sensitivity-array-size 400 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_format is_format_known refuse put_field
//
// One topic and its first field, any second one, and any number of fields.
#include "ulog_proof.h"

void keel_ulog_format__two_harness(void)
{
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const keel_ulog_format_t format = {.name = {"on"},
                                       .fields = nondet_u8(),
                                       .field = {{{"a"}, KEEL_ULOG_FLOAT, 3u}, nondet_field()}};
    bool expected;
    bool made;

    expected = model_ulog_format(&model, &format);

    made = keel_ulog_format(&message, &format);

    __CPROVER_assert(message_same(&message, &model), "ULG_004_model: every byte as in the model");
    __CPROVER_assert(made == expected, "ULG_004_made: it is said whether there is one");
}
