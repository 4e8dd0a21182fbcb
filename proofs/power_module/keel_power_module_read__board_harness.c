// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/power_module.c specs/model/power_module.c
// covers: keel_power_module_read scaled_count model_power_module_read whole_of_counts
//
// A board's modules, a few counts: what is worked out by hand. 3300 mV times 18.1 is 59730 mV for
// 4096 counts, and times 36.367515 A/V 120012.7995 mA.
#include "power_module_proof.h"

void keel_power_module_read__board_harness(void)
{
    static const uint16_t counts[7] = {0u, 1u, 384u, 385u, 1024u, 4095u, 65535u};
    static const uint32_t millivolts[7] = {0u, 15u, 5600u, 5614u, 14933u, 59715u, 59715u};
    static const uint32_t milliamperes[7] = {0u, 29u, 11251u, 11280u, 30003u, 119983u, 119983u};
    static const uint32_t of_voltage[7] = {1u, 1u, 1u, 0u, 0u, 2u, 2u};
    static const uint32_t of_current[7] = {0u, 0u, 0u, 0u, 0u, 4u, 4u};
    const keel_power_module_config_t config = {
        .reference_mv = 3300u, .divider = 18100000u, .ua_per_v = 36367515u, .open_mv = 5600u};
    keel_power_module_t module = nondet_power_module();
    keel_power_module_t model = nondet_power_module();
    keel_power_module_reading_t reading;
    keel_power_module_reading_t said;
    const uint16_t v = nondet_u16();
    const uint16_t c = nondet_u16();

    __CPROVER_assume((v < 7u) && (c < 7u));
    __CPROVER_assert((keel_power_module_init(&module, &config) == KEEL_OK) &&
                         (model_power_module_init(&model, &config) == KEEL_OK),
                     "PMD_001_board: it is taken");

    keel_power_module_read(&module, counts[v], counts[c], &reading);
    model_power_module_read(&model, counts[v], counts[c], &said);

    __CPROVER_assert((reading.voltage_mv == millivolts[v]) &&
                         (reading.current_ma == milliamperes[c]) &&
                         (reading.told == (of_voltage[v] + of_current[c])),
                     "PMD_003_board: what is worked out by hand");
    __CPROVER_assert(power_module_reading_same(&reading, &said), "PMD_003_said: so does the model");
}
