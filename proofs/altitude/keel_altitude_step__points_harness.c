// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 13 --external-sat-solver cadical
// sources: src/flight/altitude.c src/flight/axis.c specs/model/altitude.c specs/model/axis.c
// covers: keel_altitude_step height_between
// covers: model_altitude_step pressure_counts height_above
//
// Chosen estimators and samples, each in a case of its own: the same as the model's. All of them
// are dealt with in keel_altitude_step_harness; wrong bodies are refuted here, for where floats
// differ z3 finds no example.
#include "../../specs/model/altitude.h"
#include "../axis/axis_points.h"
#include "altitude_proof.h"

#define ALTITUDES 12u

static keel_altitude_t known_altitude(void)
{
    const keel_altitude_t altitude = {.axis = known_axis(),
                                      .reference = 100000.0f,
                                      .zero = 3.0f,
                                      .height = 7.0f,
                                      .has_reference = true};

    return altitude;
}

static void make_altitude(unsigned point, keel_altitude_t *altitude, keel_altitude_sample_t *sample)
{
    static const float pressures[ALTITUDES] = {99850.0f,  99850.0f,  99850.0f, 99000.0f,
                                               30000.0f,  120000.0f, 29999.0f, 120001.0f,
                                               101325.0f, 99860.0f,  99870.0f, 99840.0f};
    const keel_altitude_sample_t measured = {.pressure = pressures[point],
                                             .acceleration = 3.0f,
                                             .has_pressure = point != 9u,
                                             .has_acceleration = point != 10u};

    *altitude = known_altitude();
    *sample = measured;
    altitude->has_reference = (point != 1u) && (point != 7u);
    altitude->axis.age = (point == 4u) || (point == 5u) ? 200u : 10u;
    altitude->reference = (point == 11u) ? 101325.0f : 100000.0f;
}

void keel_altitude_step__points_harness(void)
{
    for (unsigned point = 0u; point < ALTITUDES; point++) {
        keel_altitude_t altitude;
        keel_altitude_t model;
        keel_altitude_sample_t sample;

        make_altitude(point, &altitude, &sample);
        model = altitude;

        keel_altitude_step(&altitude, &sample);
        model_altitude_step(&model, &sample);

        __CPROVER_assert(altitude_same(&altitude, &model),
                         "ALT_007_points: every field is what the model says");
    }
}
