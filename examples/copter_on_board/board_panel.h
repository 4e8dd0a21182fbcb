/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file board_panel.h
 * @brief What a person beside the aircraft presses, sees and hears: the board's safety switch, and
 *        its buzzer.
 *
 * The switch counts while the parameter SAFETY_SWITCH says that it is used. Then the copter begins
 * at safe and does not arm; the button, held for a second, makes it ready or safe again. The light
 * blinks at safe, shines when it is ready, and is dark when the switch is not used. While motors
 * turn the button does nothing.
 *
 * The buzzer plays a tune at the start, when an attempt to arm is refused, while a radio that was
 * heard is lost, and while the battery is low. A tune waits for no other one of less weight: that
 * of the battery has the most, then that of the radio. The parameter BUZZER silences all.
 */
#ifndef COPTER_BOARD_PANEL_H
#define COPTER_BOARD_PANEL_H

#include "devices/safety_switch.h"

#include <stdbool.h>
#include <stdint.h>

/** The tunes, in the order of their weights. */
typedef enum board_tune {
    BOARD_TUNE_NONE = 0,
    BOARD_TUNE_START,   /**< Once. */
    BOARD_TUNE_REFUSED, /**< Once for each attempt to arm. */
    BOARD_TUNE_LOST,    /**< Again and again, while the radio is lost. */
    BOARD_TUNE_BATTERY  /**< Again and again, while the battery is low. */
} board_tune_t;

/** The panel. The caller owns it; all of it may be read. */
typedef struct board_panel {
    bool has_safety; /**< The board has a safety switch. */
    bool has_buzzer; /**< It has a buzzer. */
    keel_safety_switch_t safety;
    board_tune_t tune;   /**< That plays, or played last. */
    bool is_greeted;     /**< The tune of the start was due. */
    bool was_linked;     /**< The radio was heard. */
    bool could_try;      /**< At the last turn, the arm switch was ready for an attempt. */
    uint32_t stepped_us; /**< When the panel had its last turn. */
} board_panel_t;

/** What the panel is told. */
typedef struct board_shown {
    bool uses_safety; /**< The parameter SAFETY_SWITCH. */
    bool sounds;      /**< The parameter BUZZER. */
    bool motors;      /**< They may turn. */
    bool can_try;     /**< The arm switch was seen off: to switch it on is an attempt to arm. */
    bool is_linked;   /**< The radio is heard. */
    bool is_low;      /**< The battery is low. */
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
