// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_enter direct_terms is_input is_limit
//
// As keel_pid_enter__any_harness: any valid controller, any bit pattern for all arguments, and the
// contract, clause by clause.
#include "../common/pid_contracts.h"

void keel_pid_enter__clauses_harness(void)
{
    const float setpoint = nondet_float();
    const float measurement = nondet_float();
    const float output = nondet_float();
    keel_pid_t pid = any_pid();
    const keel_pid_t before = pid;
    keel_status_t status;

    __CPROVER_assume(keel_pid_enter_may(&pid));

    status = keel_pid_enter(&pid, setpoint, measurement, output);

    __CPROVER_assert(pid_valid_here(&pid), "PID_011_bounded: the controller stays valid");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_INPUT),
                     "PID_011_status: taken or refused");
    __CPROVER_assert((status == KEEL_OK) ==
                         (pid_input_here(setpoint) && pid_input_here(measurement) &&
                          magnitude(output, KEEL_PID_OUTPUT_LIMIT)),
                     "PID_011_ok: taken exactly when all are in range");
    __CPROVER_assert((status != KEEL_ERR_INPUT) || pid_same(&pid, &before),
                     "PID_011_held: what is refused changes nothing");
    __CPROVER_assert((status != KEEL_OK) ||
                         !within(output, pid.config.output_min, pid.config.output_max) ||
                         (pid.output == output),
                     "PID_011_output: it begins there");
    __CPROVER_assert((status != KEEL_OK) || (!pid.started && (pid.saturation == KEEL_PID_FREE)),
                     "PID_011_fresh: the next step is the first");
}
