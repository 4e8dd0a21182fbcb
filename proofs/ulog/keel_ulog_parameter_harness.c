// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 46 --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_parameter refuse_message put_name put_bytes set_key_length
// covers: model_ulog_parameter
//
// Any value of any type.
#include "ulog_proof.h"

void keel_ulog_parameter_harness(void)
{
    const uint32_t at = any_below(KEEL_ULOG_MESSAGE_BYTES);
    keel_ulog_message_t message = any_message();
    keel_ulog_message_t model = message;
    const keel_ulog_name_t name = nondet_name();
    const uint8_t type = nondet_u8();
    uint8_t value[TEXT_MOST];
    bool expected;
    bool made;

    any_bytes(value);
    expected = model_ulog_parameter(&model, &name, type, value);

    made = keel_ulog_parameter(&message, &name, type, value);

    __CPROVER_assert(message_same(&message, &model, at),
                     "ULG_006_model: every byte as in the model");
    __CPROVER_assert(made == expected, "ULG_006_made: it is said whether there is one");
}
