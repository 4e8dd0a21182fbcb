// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_step differentiate_error winds_up put_out limit_reached direct_terms is_input
//
// Eq. 4 and the limits, on small whole numbers, whose sums and products are exact: a rate of 2 Hz,
// a low-pass that follows at once (a = 1, the rest 0), ki T instead of ki.
#include "pid_proof.h"

static int any_small(void)
{
    return ((int)(nondet_u8() & 1u) * 3) - 1;
}

static int any_gain(void)
{
    return ((int)(nondet_u8() & 1u) * 2) + 1;
}

static int limited(int value, int least, int greatest)
{
    return (value < least) ? least : ((value > greatest) ? greatest : value);
}

void keel_pid_step__exact_harness(void)
{
    const int kp = any_gain();
    const int ki = any_gain();
    const int kd = any_gain();
    const int kff = any_gain();
    const int r = any_small();
    const int y = any_small();
    const int last = any_small();
    const int old = any_small();
    keel_pid_t pid = {.config = {.gains = {(float)kp, 0.0f, (float)kd, (float)kff},
                                 .rate_hz = 2.0f,
                                 .output_min = -16.0f,
                                 .output_max = 12.0f,
                                 .integral_min = -6.0f,
                                 .integral_max = 5.0f},
                      .filter = {.a = 1.0f, .energy_limit = KEEL_FILTER_LOW_ENERGY_LIMIT},
                      .integral_gain = (float)ki,
                      .integral = (float)old,
                      .started = nondet_bool()};
    const int slope = pid.started ? (2 * ((r - y) - last)) : 0;
    const int direct = (kp * (r - y)) + (kd * slope) + (kff * r);
    const int moved = limited(old + (ki * (r - y)), -6, 5);
    const bool stays = (((direct + moved) > 12) && (moved > old)) ||
                       (((direct + moved) < -16) && (moved < old));
    const int integral = stays ? old : moved;
    const int sum = direct + integral;
    const bool far = nondet_bool();
    const bool full = pid.started && nondet_bool(); /* the low-pass refuses, for its energy */
    keel_status_t status;

    pid.filter.c = full ? 1.0f : 0.0f;
    pid.filter.s1 = full ? KEEL_FILTER_LOW_STATE_LIMIT : 0.0f;
    pid.filter.s2 = full ? -KEEL_FILTER_LOW_STATE_LIMIT : (float)last;
    pid.filter.output = (float)last;

    status = keel_pid_step(&pid, far ? 1.0e6f : (float)r, (float)y);

    __CPROVER_assert((status == KEEL_OK) == (!far && !full),
                     "PID_008_taken: what is in range is taken");
    if (status != KEEL_OK) {
        return;
    }
    __CPROVER_assert(pid.derivative == (float)slope, "PID_008_derivative: of the filtered error");
    __CPROVER_assert(pid.integral == (float)integral, "PID_010_integral: moves unless it winds up");
    __CPROVER_assert(pid.output == (float)limited(sum, -16, 12), "PID_008_output: eq. 4, limited");
    __CPROVER_assert(pid.saturation == ((sum > 12)    ? KEEL_PID_AT_MAX
                                        : (sum < -16) ? KEEL_PID_AT_MIN
                                                      : KEEL_PID_FREE),
                     "PID_010_saturation: exactly beyond a limit");
    __CPROVER_assert((pid.setpoint == (float)r) && (pid.error == (float)(r - y)),
                     "PID_008_remembers: for a change of gains");
}
