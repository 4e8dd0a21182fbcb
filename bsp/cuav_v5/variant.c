/* SPDX-License-Identifier: Apache-2.0 */
/* CUAV V5: after FMUv5, with a third inertial unit. */
#include "board.h"
#include "stm32f767/target/chip.h"

const char keel_board_name[] = "cuav_v5";

static const keel_board_inertial_t inertial[] = {
    KEEL_INERTIAL(ICM20689, F, 2u, 2, 1, -3),
    KEEL_INERTIAL_PAIR(BMI055, F, 4u, G, 10u, 2, 1, -3),
    KEEL_INERTIAL(ICM20602, F, 3u, 2, 1, -3),
};

/* What else may be at their bus: the connector for a memory. */
static const keel_pin_t others[] = {KEEL_PIN(H, 5u)};

const keel_board_units_t keel_board_units = {
    .unit = inertial, .count = 3u, .deselect = others, .deselect_count = 1u};
