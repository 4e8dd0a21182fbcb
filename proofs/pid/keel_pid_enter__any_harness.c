// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_enter direct_terms is_input is_limit
//
// Any valid controller, any bit pattern for all arguments: it stays valid, a refusal changes
// nothing, and no operation overflows or gives a NaN. What it is then is in keel_pid_enter_harness.
#include "../common/pid_contracts.h"
#include "../common/unchanged.h"

void keel_pid_enter__any_harness(void)
{
    const float setpoint = nondet_float();
    const float measurement = nondet_float();
    const float output = nondet_float();
    keel_pid_t pid = any_pid();
    const keel_pid_t before = pid;
    keel_status_t status;

    __CPROVER_assume(keel_pid_enter_may(&pid));

    status = keel_pid_enter(&pid, setpoint, measurement, output);

    __CPROVER_assert(keel_pid_enter_does(status, &pid, &before),
                     "PID_011_any: begun anew, or as it was");
    __CPROVER_assert((status == KEEL_OK) ==
                         (pid_input_here(setpoint) && pid_input_here(measurement) &&
                          magnitude(output, KEEL_PID_OUTPUT_LIMIT)),
                     "PID_011_ok: taken when all are in range");
    __CPROVER_assert((status != KEEL_OK) ||
                         !within(output, pid.config.output_min, pid.config.output_max) ||
                         (pid.output == output),
                     "PID_011_output: it begins there");
    if (status != KEEL_OK) {
        __CPROVER_assert(unchanged(&pid, &before, sizeof(pid)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
