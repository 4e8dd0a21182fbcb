// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 19 --external-sat-solver cadical
// sources: src/flight/position.c src/flight/axis.c specs/model/position.c specs/model/axis.c
// covers: keel_position_step longitude_eastwards is_near metres_of
// covers: model_position_step way_east way_fits way_in_metres good_to
//
// Chosen estimators and samples, each in a case of its own: the same as the model's. All of them
// are dealt with in keel_position_step_harness; wrong bodies are refuted here, for where floats
// differ z3 finds no example.
#include "../../specs/model/position.h"
#include "../axis/axis_points.h"
#include "position_proof.h"

#define POSITIONS 18u

static keel_position_t known_position(void)
{
    keel_position_t position = {
        .config = {.axis = known_axis().config, .accuracy = 5.0f, .speed_accuracy = 1.0f},
        .north = known_axis(),
        .east = known_axis(),
        .latitude = 481000000,
        .longitude = 115000000,
        .north_scale = 0.01112f,
        .east_scale = 0.0074f,
        .has_origin = true,
        .quality = KEEL_AXIS_GOOD};

    position.east.position = 5.0f;
    position.east.velocity = -1.0f;
    position.east.bias = -0.25f;
    return position;
}

/* 11.12 m north, 7.4 m east. */
static keel_position_sample_t measured_position(void)
{
    const keel_position_sample_t sample = {.fix = {.latitude = 481001000,
                                                   .longitude = 115001000,
                                                   .north = 2.5f,
                                                   .east = -1.5f,
                                                   .accuracy = 2.0f,
                                                   .speed_accuracy = 0.5f,
                                                   .is_valid = true},
                                           .north = 1.0f,
                                           .east = -2.0f,
                                           .has_fix = true,
                                           .has_acceleration = true};

    return sample;
}

static void change_position(unsigned point, keel_position_t *position)
{
    position->has_origin = point != 1u;
    position->north.age = (point == 2u) ? 200u : 10u;
    position->east.age = (point == 3u) ? 200u : 10u;
    if ((point == 4u) || (point == 5u)) {
        position->longitude = (point == 4u) ? 1799999900 : -1799999900;
    }
}

static void change_fix(unsigned point, keel_position_sample_t *sample)
{
    sample->has_fix = point != 6u;
    sample->has_acceleration = point != 7u;
    sample->fix.is_valid = point != 8u;
    sample->fix.accuracy = (point == 9u) ? 5.5f : 2.0f;
    sample->fix.speed_accuracy = (point == 10u) ? 1.5f : 0.5f;
    switch (point) {
    case 4u:
        sample->fix.longitude = -1799999900;
        break;
    case 5u:
        sample->fix.longitude = 1799999900;
        break;
    case 11u:
        sample->fix.latitude = 481000000 + 16777217;
        break;
    case 12u:
        sample->fix.longitude = 115000000 - 16777217;
        break;
    case 13u:
        sample->fix.latitude = 481000000 - 16777216;
        break;
    case 14u:
        sample->fix.longitude = 115000000 + 16777216;
        break;
    case 15u:
        sample->fix.accuracy = -1.0f;
        break;
    case 16u:
        sample->fix.latitude = 480000000;
        break;
    case 17u:
        sample->fix.longitude = 116000000;
        break;
    default:
        break;
    }
}

void keel_position_step__points_harness(void)
{
    for (unsigned point = 0u; point < POSITIONS; point++) {
        keel_position_t position = known_position();
        keel_position_t model;
        keel_position_sample_t sample = measured_position();

        change_position(point, &position);
        change_fix(point, &sample);
        model = position;

        keel_position_step(&position, &sample);
        model_position_step(&model, &sample);

        __CPROVER_assert(position_same(&position, &model),
                         "POS_007_points: every field is what the model says");
    }
}
