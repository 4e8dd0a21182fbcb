// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_init are_gains are_limits is_limit is_gain
//
// Any configuration, any bit pattern in it. Gains and limits are free; the rate and the cut-off are
// one good pair or a bad one, since keel_filter_init_harness has all of them.
#include "../common/keel_pid_proof.h"
#include "../common/unchanged.h"

void keel_pid_init_harness(void)
{
    keel_pid_config_t config = nondet_pid_config();
    const bool good_rate = nondet_bool();
    const bool good_cutoff = nondet_bool();
    keel_pid_t pid = any_pid_at_all();
    const keel_pid_t before = pid;
    keel_status_t status;

    config.rate_hz = good_rate ? 500.0f : -1.0f;
    config.cutoff_hz = good_cutoff ? 40.0f : 250.0f;

    status = keel_pid_init(&pid, &config);

    if (!gains_here(&config.gains)) {
        __CPROVER_assert(status == KEEL_ERR_GAIN, "PID_001_gains: a bad gain is refused");
    } else if (!limits_here(&config)) {
        __CPROVER_assert(status == KEEL_ERR_LIMITS, "PID_001_limits: so are bad limits");
    } else if (!good_rate) {
        __CPROVER_assert(status == KEEL_ERR_RATE, "PID_001_rate: and what the filter refuses");
    } else if (!good_cutoff) {
        __CPROVER_assert(status == KEEL_ERR_CUTOFF, "PID_001_cutoff: and what the filter refuses");
    } else {
        __CPROVER_assert(status == KEEL_OK, "PID_002_ok: all others are taken");
        __CPROVER_assert(pid_valid_here(&pid) && !pid.started, "PID_002_valid: valid and fresh");
        __CPROVER_assert(config_same(&pid.config, &config), "PID_002_config: as configured");
    }
    __CPROVER_assert((status == KEEL_OK) || pid_same(&pid, &before),
                     "PID_001_unchanged: a refusal changes nothing");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&pid, &before, sizeof(pid)),
                     "STA_001_kept: a refusal changes nothing");
}
