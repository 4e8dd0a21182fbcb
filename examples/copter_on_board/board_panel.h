/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file board_panel.h
 * @brief What a person beside the aircraft presses and sees: the board's safety switch.
 *
 * The switch counts while the parameter SAFETY_SWITCH says that it is used. Then the copter begins
 * at safe and does not arm; the button, held for a second, makes it ready or safe again. The light
 * blinks at safe, shines when it is ready, and is dark when the switch is not used. While motors
 * turn the button does nothing.
 */
#ifndef COPTER_BOARD_PANEL_H
#define COPTER_BOARD_PANEL_H

#include "devices/safety_switch.h"

#include <stdbool.h>
#include <stdint.h>

/** The panel. The caller owns it; all of it may be read. */
typedef struct board_panel {
    bool has_safety; /**< The board has a safety switch. */
    keel_safety_switch_t safety;
    uint32_t stepped_us; /**< When it had its last step. */
} board_panel_t;

/** What the panel is told. */
typedef struct board_shown {
    bool uses_safety; /**< The parameter SAFETY_SWITCH. */
    bool motors;      /**< They may turn. */
} board_shown_t;

/** Starts what the board has. */
void board_panel_start(board_panel_t *panel);

/**
 * Goes on. To be called in every turn of the main loop.
 *
 * @param panel  the panel
 * @param shown  what it is told
 * @param now_us the time, in us, modulo 2^32
 */
void board_panel_turn(board_panel_t *panel, const board_shown_t *shown, uint32_t now_us);

/** Whether motors may start, as copter_port_t's is_ready. */
bool board_panel_is_ready(const board_panel_t *panel);

#endif
