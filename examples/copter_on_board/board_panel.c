/* SPDX-License-Identifier: Apache-2.0 */
#include "board_panel.h"

#include "board.h"
#include "stm32f767/target/chip.h"

#include <stddef.h>

/* Upwards; low and downwards; two high ones with a long pause; one high one with a short pause. A
 * pause at the end is the time to the next round. */
static const keel_tone_t start_tones[] = {{880u, 120u}, {1109u, 120u}, {1319u, 240u}};
static const keel_tone_t refused_tones[] = {{440u, 200u}, {0u, 50u}, {330u, 400u}};
static const keel_tone_t lost_tones[] = {{1760u, 100u}, {0u, 100u}, {1760u, 100u}, {0u, 1700u}};
static const keel_tone_t battery_tones[] = {{2637u, 400u}, {0u, 400u}};

#define COUNT(tones) ((uint32_t)(sizeof(tones) / sizeof((tones)[0])))

static void play(board_panel_t *panel, board_tune_t tune)
{
    panel->tune = tune;
    switch (tune) {
    case BOARD_TUNE_START:
        keel_chip_buzzer_play(start_tones, COUNT(start_tones));
        break;
    case BOARD_TUNE_REFUSED:
        keel_chip_buzzer_play(refused_tones, COUNT(refused_tones));
        break;
    case BOARD_TUNE_LOST:
        keel_chip_buzzer_play(lost_tones, COUNT(lost_tones));
        break;
    case BOARD_TUNE_BATTERY:
        keel_chip_buzzer_play(battery_tones, COUNT(battery_tones));
        break;
    default:
        keel_chip_buzzer_play(NULL, 0u);
        break;
    }
}

void board_panel_start(board_panel_t *panel)
{
    *panel = (board_panel_t){.has_safety = keel_chip_safety_start(),
                             .has_buzzer = keel_chip_buzzer_start(),
                             .stepped_us = keel_board_clock_us(NULL)};
    keel_safety_switch_init(&panel->safety);
}

/* A button that is touched in flight changes nothing, on the ground behind it either. */
static void turn_safety(board_panel_t *panel, const board_shown_t *shown, uint32_t elapsed_us)
{
    if (!shown->uses_safety) {
        keel_safety_switch_init(&panel->safety);
    } else {
        (void)keel_safety_switch_step(&panel->safety,
                                      !shown->motors && keel_chip_safety_is_pressed(), elapsed_us);
    }
    keel_chip_safety_light(shown->uses_safety && keel_safety_switch_is_lit(&panel->safety));
}

/* An attempt that is over, with the radio heard and the motors still, was refused. */
static board_tune_t tune_of(const board_panel_t *panel, const board_shown_t *shown)
{
    board_tune_t tune = BOARD_TUNE_NONE;

    if (shown->is_low) {
        tune = BOARD_TUNE_BATTERY;
    } else if (panel->was_linked && !shown->is_linked) {
        tune = BOARD_TUNE_LOST;
    } else if (panel->could_try && !shown->can_try && !shown->motors) {
        tune = BOARD_TUNE_REFUSED;
    } else if (!panel->is_greeted) {
        tune = BOARD_TUNE_START;
    } else {
        /* All is well, and nothing is new. */
    }
    return tune;
}

static void turn_buzzer(board_panel_t *panel, const board_shown_t *shown, uint32_t elapsed_us)
{
    const board_tune_t tune = tune_of(panel, shown);
    const bool plays = keel_chip_buzzer_plays();

    panel->is_greeted = true;
    panel->was_linked = panel->was_linked || shown->is_linked;
    panel->could_try = shown->can_try;
    if (!shown->sounds) {
        if (plays) {
            play(panel, BOARD_TUNE_NONE);
        }
    } else if ((tune != BOARD_TUNE_NONE) && (!plays || (tune > panel->tune))) {
        play(panel, tune);
    } else {
        keel_chip_buzzer_turn(elapsed_us);
    }
}

void board_panel_turn(board_panel_t *panel, const board_shown_t *shown, uint32_t now_us)
{
    const uint32_t elapsed_us = now_us - panel->stepped_us;

    panel->stepped_us = now_us;
    if (panel->has_safety) {
        turn_safety(panel, shown, elapsed_us);
    }
    if (panel->has_buzzer) {
        turn_buzzer(panel, shown, elapsed_us);
    }
}

bool board_panel_is_ready(const board_panel_t *panel)
{
    return panel->has_safety && !panel->safety.is_safe;
}
