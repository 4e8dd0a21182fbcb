// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c specs/model/cascade.c
// replaces: keel_cascade_check keel_pid_init
// covers: keel_cascade_init model_cascade_init
// reach: --z3 --fpa
//
// Any bit pattern for all of a configuration. What a check and the making of a controller come to
// is unknown: anything to the model, within the contract; the code asks it of the same axes and
// configurations, and is told the same.
#include "cascade_proof.h"

static keel_cascade_config_t config;
static keel_cascade_t cascade;
static keel_cascade_t model;
static keel_status_t checked[AXES];
static keel_pid_t made[AXES];

static uint32_t making;
static uint32_t told;

keel_status_t model_cascade_check(const keel_cascade_config_t *whole, uint32_t axis)
{
    __CPROVER_assert((whole == &config) && (axis < AXES), "CAS_002_checked: an axis of this");
    checked[axis] = nondet_bool() ? KEEL_OK : (nondet_bool() ? KEEL_ERR_LIMITS : KEEL_ERR_GAIN);
    __CPROVER_assume(keel_cascade_check_does(checked[axis], whole, axis));
    return checked[axis];
}

keel_status_t keel_cascade_check_stand_in(const keel_cascade_config_t *whole, uint32_t axis)
{
    __CPROVER_assert(keel_cascade_check_may(), "precondition: keel_cascade_check");
    __CPROVER_assert((whole == &config) && (axis < AXES), "CAS_002_checked: an axis of this");
    __CPROVER_assume(keel_cascade_check_does(checked[axis], whole, axis));
    return checked[axis];
}

keel_status_t model_pid_init(keel_pid_t *pid, const keel_pid_config_t *of)
{
    __CPROVER_assume(making < AXES);
    __CPROVER_assert(of == &config.pid[making], "CAS_002_modelled: one axis after another");
    made[making] = any_pid_at_all();
    *pid = made[making];
    making++;
    return KEEL_OK;
}

keel_status_t keel_pid_init_stand_in(keel_pid_t *pid, const keel_pid_config_t *of)
{
    const keel_status_t status = nondet_bool() ? KEEL_OK : KEEL_ERR_GAIN;

    __CPROVER_assert(told < AXES, "CAS_002_made: no more than there are");
    __CPROVER_assert(of == &config.pid[told], "CAS_002_made: one axis after another");
    __CPROVER_assert(keel_pid_init_may(), "precondition: keel_pid_init");
    *pid = made[told];
    __CPROVER_assume(keel_pid_init_does(status, pid, of));
    told++;
    return status;
}

void keel_cascade_init_harness(void)
{
    keel_status_t status;
    keel_status_t expected;

    config = nondet_cascade_config();
    any_cascade(&cascade);
    model = cascade;
    expected = model_cascade_init(&model, &config);

    status = keel_cascade_init(&cascade, &config);

    __CPROVER_assert(told == making, "CAS_002_made: as many as the model makes");
    __CPROVER_assert(status == expected, "CAS_002_taken: taken or refused as the model says");
    __CPROVER_assert(cascade_same(&cascade, &model),
                     "CAS_002_model: every field is what the model says");
}
