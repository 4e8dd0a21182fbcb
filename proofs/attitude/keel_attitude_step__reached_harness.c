// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 47 --external-sat-solver cadical
// sources: src/flight/attitude.c specs/model/attitude.c
// covers: keel_attitude_step take_rate take_field judge_field judge_heading miss_field
// covers: lose_attitude counted_step rate_correction take_force gain_of has_force judge_tilt
// covers: follow_bias turn_along rotate_attitude turned_quaternion to_earth to_body low_passed
// covers: keel_attitude_is_unit await_still conclude_still axes_of is_within dot_product
// covers: cross_product add_scaled scaled_vector vector_difference clamped_vector
// covers: model_attitude_step rate_step field_step heading_validity field_missing align_again
// covers: rate_of_correction down_step force_came tilt_validity bias_step turn_step still_step
// covers: of_earth of_body towards turned_by model_attitude_is_unit mean_of_still north_of east_of
// covers: down_of vector_to from_to product_of sum_of apart nearest nearest_vector next_count
//
// Chosen estimators and samples, each in a case of its own: all that a step does is reached, and no
// operation on them overflows, gives a NaN or leaves an object. Of all others WP proves the latter,
// and keel_attitude_step__valid_harness that nothing but numbers is kept.
#include "../../specs/model/attitude.h"
#include "attitude_points.h"

void keel_attitude_step__reached_harness(void)
{
    for (unsigned point = 0u; point < POINTS; point++) {
        keel_attitude_t attitude;
        keel_attitude_t model;
        keel_attitude_sample_t sample;

        make_point(point, &attitude, &sample);
        model = attitude;

        keel_attitude_step(&attitude, &sample);
        model_attitude_step(&model, &sample);

        __CPROVER_assert(attitude.flags == model.flags, "ATT_009_reached: its flags");
    }
}
