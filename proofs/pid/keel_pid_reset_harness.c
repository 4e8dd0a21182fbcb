// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_reset
#include "../common/keel_pid_proof.h"

void keel_pid_reset_harness(void)
{
    keel_pid_t pid = any_pid();
    const keel_pid_t before = pid;

    keel_pid_reset(&pid);

    __CPROVER_assert((pid.integral == 0.0f) && (pid.setpoint == 0.0f) && (pid.error == 0.0f) &&
                         (pid.derivative == 0.0f) && (pid.saturation == KEEL_PID_FREE) &&
                         !pid.started,
                     "PID_003_fresh: nothing is remembered");
    __CPROVER_assert((pid.output == 0.0f) ||
                         ((pid.output == pid.config.output_min) && (pid.output > 0.0f)) ||
                         ((pid.output == pid.config.output_max) && (pid.output < 0.0f)),
                     "PID_003_output: 0, or the limit next to it");
    __CPROVER_assert(pid_valid_here(&pid), "PID_003_valid: the controller stays valid");
    __CPROVER_assert(config_same(&pid.config, &before.config) &&
                         filter_same(&pid.filter, &before.filter) &&
                         same(pid.integral_gain, before.integral_gain),
                     "PID_003_frame: the rest stays");
}
