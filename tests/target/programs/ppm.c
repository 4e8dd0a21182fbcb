/* SPDX-License-Identifier: Apache-2.0 */
/* Says the channels of each frame of PPM. */
#include "keel/middleware/ppm.h"
#include "board.h"
#include "console.h"
#include "stm32f767/target/chip.h"

static keel_ppm_t ppm KEEL_REALTIME_ZERO;

static void say_channels(void)
{
    keel_console_text("channels");
    for (uint32_t i = 0u; i < ppm.channels; i++) {
        keel_console_text(" ");
        keel_console_number(ppm.channel[i]);
    }
    keel_console_text("\n");
}

int main(void)
{
    static const keel_ppm_config_t config = {100000u, 800u, 2200u, 2300u, 0x000Fu, 4u, 2u};

    (void)keel_ppm_init(&ppm, &config);
    keel_console_text("ppm status ");
    keel_console_number((uint64_t)keel_chip_ppm_start());
    keel_console_text("\n");
    for (;;) {
        uint32_t elapsed_us;

        keel_chip_turn();
        while (keel_chip_ppm_read(&elapsed_us)) {
            if (keel_ppm_take(&ppm, elapsed_us)) {
                say_channels();
            }
        }
    }
}
