// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_set_gains direct_terms are_gains is_gain
#include "../common/keel_pid_proof.h"
#include "../common/unchanged.h"

void keel_pid_set_gains_harness(void)
{
    const keel_pid_gains_t gains = nondet_gains();
    keel_pid_t pid = any_pid();
    keel_pid_t before = pid;
    keel_status_t status;

    status = keel_pid_set_gains(&pid, &gains);

    __CPROVER_assert(pid_valid_here(&pid), "PID_004_valid: the controller stays valid");
    __CPROVER_assert(status == (gains_here(&gains) ? KEEL_OK : KEEL_ERR_GAIN),
                     "PID_004_status: good gains are taken, others refused");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&pid, &before, sizeof(pid)),
                     "STA_001_kept: a refusal changes nothing");
    if (status == KEEL_OK) {
        __CPROVER_assert(gains_same(&pid.config.gains, &gains), "PID_005_taken: as given");
        __CPROVER_assert((before.started) || (before.error != 0.0f) || (before.setpoint != 0.0f) ||
                             (before.derivative != 0.0f) || (pid.integral == before.integral),
                         "PID_005_fresh: before the first step there is nothing to take over");
        before.config.gains = gains;
        before.integral_gain = pid.integral_gain;
        before.integral = pid.integral;
    }
    __CPROVER_assert(pid_same(&pid, &before), "PID_004_unchanged: nothing else changes");
}
