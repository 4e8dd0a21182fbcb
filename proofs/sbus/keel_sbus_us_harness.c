// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/sbus.c specs/model/sbus.c
// covers: keel_sbus_us model_sbus_us
//
// Any value.
#include "sbus_proof.h"

void keel_sbus_us_harness(void)
{
    const uint16_t raw = nondet_u16();
    const uint16_t us = keel_sbus_us(raw);

    __CPROVER_assert(us == model_sbus_us(raw), "RAD_012_model: as the model says");
    __CPROVER_assert(((raw != 172u) || (us == 988u)) && ((raw != 992u) || (us == 1500u)) &&
                         ((raw != 1811u) || (us == 2012u)),
                     "RAD_012_known: the ends and the middle are as receivers have them");
}
