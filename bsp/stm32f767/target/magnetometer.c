/* SPDX-License-Identifier: Apache-2.0 */
/* The magnetometer of a board: an IST8310 on I2C 3. */
#include "board.h"
#include "devices/ist8310.h"
#include "stm32f767/clock_tree.h"
#include "stm32f767/i2c_bus.h"
#include "stm32f767/registers/rcc.h"
#include "stm32f767/target/chip.h"
#include "stm32f767/target/chip_parts.h"

#include <stddef.h>

#define RCC  ((keel_rcc_t *)RCC_BASE)
#define I2C3 ((keel_i2c_t *)I2C3_BASE)
#define PINS (&keel_board_pins)

#define PAUSE_US 2u /* Half a clock of a bus that is freed: 22 of them are 44 us. */

/* All looks of an exchange: 340 us at some 50 ns each, just beyond the longest that goes well. */
static const keel_wait_t exchange_patience = {6800u, NULL, NULL};

static void pause_bus(void *context)
{
    (void)keel_chip_delay(context, PAUSE_US);
}

bool keel_chip_magnetometer(keel_bus_t *bus, keel_mounting_t *mounting)
{
    static keel_i2c_device_t device;
    const keel_board_magnetometer_t *const place = PINS->magnetometer;

    if (place == NULL) {
        return false;
    }
    device = (keel_i2c_device_t){.i2c = I2C3,
                                 .address = KEEL_IST8310_ADDRESS,
                                 .scl = place->scl.pin,
                                 .sda = place->sda.pin,
                                 .function = place->scl.function,
                                 .wait = &exchange_patience,
                                 .pause = pause_bus,
                                 .pause_context = NULL};
    keel_pin_alternate_open_drain(place->scl.pin, place->scl.function, KEEL_PULL_NONE);
    keel_pin_alternate_open_drain(place->sda.pin, place->sda.function, KEEL_PULL_NONE);
    keel_bits_enable(&RCC->APB1ENR, RCC_APB1ENR_I2C3EN);
    keel_chip_require(keel_i2c_start(I2C3, KEEL_APB1_LIMIT_HZ));
    *bus = (keel_bus_t){keel_i2c_bus_exchange, &device};
    *mounting = place->mounting;
    return true;
}
