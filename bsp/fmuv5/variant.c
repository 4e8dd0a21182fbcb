/* SPDX-License-Identifier: Apache-2.0 */
/* Pixhawk 4 and 4 Mini, and what else after FMUv5 has at least their inertial units. */
#include "board.h"
#include "stm32f767/target/chip.h"

const char keel_board_name[] = "fmuv5";

/* bsp/cuav_v5 has the ICM-20602 of a CUAV V5 besides, which stays silent here. */
static const keel_board_inertial_t inertial[] = {
    KEEL_INERTIAL(ICM20689, F, 2u, 2, 1, -3),
    KEEL_INERTIAL_PAIR(BMI055, F, 4u, G, 10u, 2, 1, -3),
};

/* What else may be at their bus: the ICM-20602, and the connector for a memory. */
static const keel_pin_t others[] = {KEEL_PIN(F, 3u), KEEL_PIN(H, 5u)};

const keel_board_units_t keel_board_units = {
    .unit = inertial, .count = 2u, .deselect = others, .deselect_count = 2u};
