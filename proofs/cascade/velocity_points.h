/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file velocity_points.h
 * @brief A chosen cascade at chosen places, one after another, for harnesses of the velocity stage.
 */
#ifndef VELOCITY_POINTS_H
#define VELOCITY_POINTS_H

#include "cascade_points.h"
#include "keel/flight/mode.h"

typedef struct point {
    keel_cascade_vector_t asked;
    keel_cascade_estimate_t estimate;
    keel_cascade_limit_t roll;
    keel_cascade_limit_t pitch;
    uint32_t gave_way;
    uint8_t mode;
} point_t;

#define NONE  {false, false}
#define LEAST {true, false}
#define MOST  {false, true}
#define BOTH  {true, true}

static keel_cascade_t cascade;
static keel_cascade_t model;

/* What the angle stage has done, and another thrust than the cascade hovers with. */
static void tilt_to(keel_cascade_t *c, const point_t *point)
{
    c->axis[KEEL_CASCADE_ROLL].limit = point->roll;
    c->axis[KEEL_CASCADE_PITCH].limit = point->pitch;
    c->axis[KEEL_CASCADE_ROLL].running = true;
    c->axis[KEEL_CASCADE_PITCH].running = true;
    c->axis[KEEL_CASCADE_ROLL].pid.setpoint = 0.11f;
    c->axis[KEEL_CASCADE_PITCH].pid.setpoint = -0.07f;
    c->command.thrust = 0.43f;
    c->thrust = 0.29f;
    c->gave_way = point->gave_way;
}

static void good_cascade(void)
{
    static keel_cascade_config_t config;

    good_config(&config);
    __CPROVER_assert(keel_cascade_init(&cascade, &config) == KEEL_OK, "CAS_010_made: it is made");
    model = cascade;
}

/* Both as they are before a step. */
static void lead_to(const point_t *point)
{
    keel_cascade_enter(&cascade, point->mode);
    model_cascade_enter(&model, point->mode);
    tilt_to(&cascade, point);
    tilt_to(&model, point);
}

#endif
