/* SPDX-License-Identifier: Apache-2.0 */
/* ST Nucleo-F767ZI (user manual UM1974). The sensor, if any, is at the Arduino connector. */
#include "board.h"
#include "stm32f767/target/chip.h"

#include <stddef.h>

const char keel_board_name[] = "nucleo_f767zi";

static const keel_pwm_output_t outputs[] = {
    KEEL_OUTPUT(E, 9u, 1u, TIM1, CH1),  /* D6. */
    KEEL_OUTPUT(E, 11u, 1u, TIM1, CH2), /* D5. */
    KEEL_OUTPUT(E, 13u, 1u, TIM1, CH3), /* D3. */
    KEEL_OUTPUT(E, 14u, 1u, TIM1, CH4), /* D38, CN10. */
};

/* At D10; its x is forward and its z upwards. */
static const keel_board_inertial_t inertial[] = {KEEL_INERTIAL(ICM20689, D, 14u, 1, -2, -3)};

const keel_board_units_t keel_board_units = {
    .unit = inertial, .count = 1u, .deselect = NULL, .deselect_count = 0u};

const keel_board_pins_t keel_board_pins = {
    .oscillator = {8000000u, true}, /* From the ST-LINK. */
    .console = (keel_uart_t *)USART3_BASE,
    .console_clock = RCC_APB1ENR_USART3EN,
    .console_tx = KEEL_ALTERNATE(D, 8u, 7u, USART3, TX), /* The ST-LINK's virtual port. */
    .console_rx = KEEL_ALTERNATE(D, 9u, 7u, USART3, RX),
    .led = {[KEEL_LED_RED] = {KEEL_PIN(B, 14u), false},  /* LD3. */
            [KEEL_LED_GREEN] = {KEEL_PIN(B, 0u), false}, /* LD1. */
            [KEEL_LED_BLUE] = {KEEL_PIN(B, 7u), false}}, /* LD2. */
    .outputs = outputs,
    .output_count = 4u,
    .levels = NULL,
    .level_count = 0u,
    .sck = KEEL_ALTERNATE(A, 5u, 5u, SPI1, SCK),   /* D13. */
    .miso = KEEL_ALTERNATE(A, 6u, 5u, SPI1, MISO), /* D12. */
    .mosi = KEEL_ALTERNATE(A, 7u, 5u, SPI1, MOSI), /* D11; JP6 off, it is Ethernet's too. */
    .analogue = NULL,
    .analogue_count = 0u,
    .card = NULL,
    .barometer = NULL,
    .kept_sector = 10u, /* The last two; board.toml keeps images out of them. */
};
