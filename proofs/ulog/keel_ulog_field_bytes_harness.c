// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// defines: -DKEEL_ULOG_MESSAGE_BYTES=43u -DKEEL_ULOG_NAME_LENGTH=4u -DKEEL_ULOG_FIELDS=2u
// sources: src/middleware/ulog.c specs/model/ulog.c
// covers: keel_ulog_field_bytes value_bytes model_ulog_field_bytes type_size
//
// Messages of up to 43 bytes and names of up to 4 characters, as in all harnesses of this unit:
// larger ones take the solver hours. WP shows the clauses for the shipped sizes.
#include "ulog_proof.h"

void keel_ulog_field_bytes_harness(void)
{
    const keel_ulog_field_t field = nondet_field();
    const uint16_t expected = model_ulog_field_bytes(&field);
    const uint16_t bytes = keel_ulog_field_bytes(&field);

    __CPROVER_assert(bytes == expected, "ULG_012_model: as many as the model counts");
}
