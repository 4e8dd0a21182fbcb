/* SPDX-License-Identifier: Apache-2.0 */
/* Says how the board has turned a sample of each unit, and turns motors by the copter's port. */
#include "../../../examples/copter_on_board/board_port.h"
#include "board.h"
#include "console.h"

static board_port_t board;
static uint32_t turns KEEL_REALTIME_ZERO;

static void wait(uint32_t us)
{
    const uint32_t start_us = keel_board_clock_us(NULL);

    while ((keel_board_clock_us(NULL) - start_us) < us) {
        turns++;
    }
}

static void print_signed(float value)
{
    keel_console_text((value < 0.0f) ? " -" : " ");
    keel_console_number((uint64_t)((((value < 0.0f) ? -value : value) * 1000.0f) + 0.5f));
}

int main(void)
{
    static const float output[4][COPTER_MOTORS] = {
        {0.0f, 0.0f, 0.0f, 0.0f},
        {0.05f, 0.25f, 0.5f, 1.0f},
        {0.05f, 0.05f, 0.05f, 0.05f},
        {0.0f, 0.0f, 0.0f, 0.0f},
    };
    const copter_port_t port = board_port_start(&board);
    copter_imu_sample_t sample;

    for (uint32_t unit = 0u; port.read_imu(&board, unit, &sample); unit++) {
        keel_console_text("body");
        for (uint32_t i = 0u; i < 3u; i++) {
            print_signed(sample.accelerometer[i]);
        }
        for (uint32_t i = 0u; i < 3u; i++) {
            print_signed(sample.gyroscope[i]);
        }
        keel_console_text("\n");
    }
    for (uint32_t i = 0u; i < 4u; i++) {
        port.write_motors(&board, output[i]);
        wait(6000u);
    }
    keel_board_halt(0);
}
