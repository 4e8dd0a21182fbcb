// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 16 --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c specs/model/pid.c specs/model/filter.c
// covers: keel_pid_step differentiate_error put_out limit_reached direct_terms
// covers: model_pid_step without_integral side_of differentiated
//
// Chosen controllers and inputs, where sums are rounded: the same as the model's. All of them are
// dealt with in keel_pid_step_harness; wrong bodies are refuted here, for where floats differ z3
// finds no example.
#include "../../specs/model/pid.h"
#include "pid_proof.h"

#define POINTS 15u

typedef struct point {
    float setpoint;
    float measurement;
    float integral_gain;
    float integral;
    float s1;
    bool started;
} point_t;

/* The first and later steps, within the limits, the integral beyond those of the output; beyond
 * each limit, with the integral free, at its own limit, held, and held so that the output is free
 * again; refused inputs, one of them by the low-pass, and two that the low-pass does not see. */
static const point_t points[POINTS] = {
    {1.1f, 0.3f, 0.013f, 0.7f, 0.3f, false},   {1.1f, 0.3f, 0.013f, 0.7f, 0.3f, true},
    {9.1f, 0.3f, 0.013f, 0.7f, 0.3f, true},    {-9.1f, 0.3f, 0.013f, 0.7f, 0.3f, true},
    {9.1f, 0.3f, -0.013f, 0.7f, 0.3f, true},   {1.1f, 0.3f, 10.0f, 0.7f, 0.3f, false},
    {-1.1f, -0.3f, 10.0f, -0.7f, 0.3f, false}, {1.0e7f, 0.3f, 0.013f, 0.7f, 0.3f, true},
    {1.1f, -1.0e7f, 0.013f, 0.7f, 0.3f, true}, {1.1f, 0.3f, 0.013f, 0.7f, 2.0e7f, true},
    {1.1f, 9.3f, 0.013f, 7.9f, 0.3f, false},   {0.37f, 1.9f, 0.013f, 0.7f, 0.3f, true},
    {2.3f, -0.45f, 0.013f, 0.7f, 0.3f, true},  {1.1f, 6.0e5f, 0.013f, 0.7f, 0.3f, false},
    {6.0e5f, 0.3f, 0.013f, 0.7f, 0.3f, false},
};

static keel_pid_t controller(const point_t *point)
{
    const keel_pid_t pid = {
        .config = {.gains = {0.7f, 1.3f, 0.0011f, 0.31f},
                   .rate_hz = 1000.0f,
                   .cutoff_hz = 100.0f,
                   .output_min = -4.0f,
                   .output_max = 5.0f,
                   .integral_min = -8.0f,
                   .integral_max = 9.0f},
        .filter = {0.067455274f, 0.293599201f, 0.277891050f, KEEL_FILTER_LOW_ENERGY_LIMIT,
                   point->s1, 0.7f, 0.6f},
        .integral_gain = point->integral_gain,
        .integral = point->integral,
        .setpoint = 0.2f,
        .error = -0.4f,
        .derivative = 0.9f,
        .output = 5.0f,
        .saturation = KEEL_PID_AT_MAX,
        .started = point->started,
    };

    return pid;
}

void keel_pid_step__points_harness(void)
{
    for (unsigned i = 0u; i < POINTS; i++) {
        const point_t *const point = &points[i];
        keel_pid_t pid = controller(point);
        keel_pid_t model = pid;
        const keel_status_t status = keel_pid_step(&pid, point->setpoint, point->measurement);

        __CPROVER_assert(status == model_pid_step(&model, point->setpoint, point->measurement),
                         "PID_007_model: taken or refused as the model says");
        __CPROVER_assert(pid_same(&pid, &model),
                         "PID_008_model: every field is what the model says");
    }
}
