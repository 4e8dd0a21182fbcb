// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 3 --external-sat-solver cadical
// sources: src/flight/battery.c
// covers: keel_battery_restart begin_battery clear_sum clear_alarm whole_of
//
// Any monitor with a valid configuration: a restart leaves all of it valid, as every step keeps it
// (keel_battery_step__valid_harness); a refusal changes nothing.
#include "../common/unchanged.h"
#include "battery_proof.h"

void keel_battery_restart__valid_harness(void)
{
    const float part = nondet_float();
    const bool is_part = within(part, 0.0f, 1.0f);
    keel_battery_t battery = any_battery_at_all();
    keel_battery_t before;
    keel_status_t status;

    __CPROVER_assume(battery_config_valid(&battery.config) && battery_scale_valid(&battery.scale));
    before = battery;

    status = keel_battery_restart(&battery, part);

    __CPROVER_assert(is_part || ((status == KEEL_ERR_INITIAL) && battery_same(&battery, &before)),
                     "BAT_003_refused: what is no part is refused");
    __CPROVER_assert(!is_part || ((status == KEEL_OK) && (battery.charge.whole == 0u) &&
                                  (battery.charge.part == 0u) && (battery.energy.whole == 0u) &&
                                  (battery.energy.part == 0u)),
                     "BAT_003_unused: nothing is used");
    __CPROVER_assert(!is_part || ((battery.level == KEEL_BATTERY_UNKNOWN) &&
                                  (battery.count == KEEL_BATTERY_WAITING) && !battery.low.raised &&
                                  !battery.critical.raised),
                     "BAT_003_unknown: nothing is known");
    if (status == KEEL_OK) {
        __CPROVER_assert(battery_valid(&battery) && battery_products_valid(&battery),
                         "BAT_015_begins: all of it is valid");
    } else {
        __CPROVER_assert(unchanged(&battery, &before, sizeof(battery)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
