/* SPDX-License-Identifier: Apache-2.0 */
/* Common to flight controllers after the Pixhawk standard FMUv5; variant.c has the rest. */
#include "board.h"
#include "stm32f767/target/chip.h"

/* FMU_CH1 to FMU_CH8; with an IO processor on the board these are its auxiliary outputs. */
static const keel_pwm_output_t outputs[] = {
    KEEL_OUTPUT(E, 14u, 1u, TIM1, CH4), KEEL_OUTPUT(A, 10u, 1u, TIM1, CH3),
    KEEL_OUTPUT(E, 11u, 1u, TIM1, CH2), KEEL_OUTPUT(E, 9u, 1u, TIM1, CH1),
    KEEL_OUTPUT(D, 13u, 2u, TIM4, CH2), KEEL_OUTPUT(D, 14u, 2u, TIM4, CH3),
    KEEL_OUTPUT(H, 6u, 9u, TIM12, CH1), KEEL_OUTPUT(H, 9u, 9u, TIM12, CH2),
};

static const keel_level_t levels[] = {
    KEEL_LEVEL(E, 3u, true),   /* 3.3 V of the sensors. */
    KEEL_LEVEL(G, 4u, false),  /* 5 V of the sockets, active low. */
    KEEL_LEVEL(F, 12u, false), /* 5 V of the sockets with more power, active low. */
    KEEL_LEVEL(G, 5u, true),   /* 5 V of the receiver. */
    KEEL_LEVEL(G, 7u, true),   /* 3.3 V of the card. */
    KEEL_LEVEL(H, 2u, false),  /* The silence pins of the CAN transceivers, low as with PX4. */
    KEEL_LEVEL(H, 3u, false),  /* CAN has no driver, so nothing is sent there. */
    KEEL_LEVEL(H, 4u, false),
};

static const keel_pin_t armed = KEEL_ARMED(I, 0u);

/* Of the button in a satellite receiver's case. An IO processor reads it, and drives its light. */
static const keel_board_safety_t safety = KEEL_SAFETY(E, 10u, E, 12u);

/* The power modules' connectors, whose modules divide the battery's voltage by 18.1 and give a volt
 * for 36.4 A (PX4's board configuration of px4/fmu-v5); and the board's own supplies. */
static const keel_analogue_t analogue[KEEL_ANALOGUES] = {
    [KEEL_ANALOGUE_VOLTAGE_1] = KEEL_ANALOGUE(A, 0u, 0u),
    [KEEL_ANALOGUE_CURRENT_1] = KEEL_ANALOGUE(A, 1u, 1u),
    [KEEL_ANALOGUE_VOLTAGE_2] = KEEL_ANALOGUE(A, 2u, 2u),
    [KEEL_ANALOGUE_CURRENT_2] = KEEL_ANALOGUE(A, 3u, 3u),
    [KEEL_ANALOGUE_5V] = KEEL_ANALOGUE(C, 0u, 10u),
    [KEEL_ANALOGUE_SENSORS] = KEEL_ANALOGUE(C, 1u, 11u),
};

static const keel_board_card_t slot = {
    .clock = KEEL_ALTERNATE(C, 12u, 12u, SDMMC1, CK),
    .command = KEEL_ALTERNATE(D, 2u, 12u, SDMMC1, CMD),
    .data = {KEEL_ALTERNATE(C, 8u, 12u, SDMMC1, D0), KEEL_ALTERNATE(C, 9u, 12u, SDMMC1, D1),
             KEEL_ALTERNATE(C, 10u, 12u, SDMMC1, D2), KEEL_ALTERNATE(C, 11u, 12u, SDMMC1, D3)},
};

static const keel_board_device_t fram = {
    .sck = KEEL_ALTERNATE(I, 1u, 5u, SPI2, SCK),
    .miso = KEEL_ALTERNATE(I, 2u, 5u, SPI2, MISO),
    .mosi = KEEL_ALTERNATE(I, 3u, 5u, SPI2, MOSI),
    .select = KEEL_PIN(F, 5u),
};

static const keel_board_device_t barometer = {
    .sck = KEEL_ALTERNATE(E, 2u, 5u, SPI4, SCK),
    .miso = KEEL_ALTERNATE(E, 13u, 5u, SPI4, MISO),
    .mosi = KEEL_ALTERNATE(E, 6u, 5u, SPI4, MOSI),
    .select = KEEL_PIN(F, 10u),
};

/* Inside; the one of a satellite receiver's case is at another bus. */
static const keel_board_magnetometer_t magnetometer = {
    .scl = KEEL_ALTERNATE(H, 7u, 4u, I2C3, SCL),
    .sda = KEEL_ALTERNATE(H, 8u, 4u, I2C3, SDA),
    .mounting = KEEL_MAGNETOMETER(2, 1, -3),
};

/* Beside the socket of the pilot's receiver, where the board has one of its own. */
static const keel_alternate_t ppm = KEEL_PPM(I, 5u, 3u, TIM8, CH1);

static const keel_alternate_t buzzer = KEEL_BUZZER(E, 5u, 3u, TIM9, CH1);

const keel_board_pins_t keel_board_pins = {
    .oscillator = {16000000u, false},
    .console = (keel_uart_t *)UART7_BASE,
    .console_clock = RCC_APB1ENR_UART7EN,
    .console_tx = KEEL_ALTERNATE(E, 8u, 8u, UART7, TX), /* The debug connector. */
    .console_rx = KEEL_ALTERNATE(F, 6u, 8u, UART7, RX),
    .led = {[KEEL_LED_RED] = {KEEL_PIN(B, 1u), true},
            [KEEL_LED_GREEN] = {KEEL_PIN(C, 6u), true},
            [KEEL_LED_BLUE] = {KEEL_PIN(C, 7u), true}},
    .outputs = outputs,
    .output_count = 8u,
    .levels = levels,
    .level_count = 8u,
    .armed = &armed,
    .sck = KEEL_ALTERNATE(G, 11u, 5u, SPI1, SCK),
    .miso = KEEL_ALTERNATE(A, 6u, 5u, SPI1, MISO),
    .mosi = KEEL_ALTERNATE(D, 7u, 5u, SPI1, MOSI),
    .analogue = analogue,
    .analogue_count = KEEL_ANALOGUES,
    .card = &slot,
    .memory = &fram,
    .barometer = &barometer,
    .magnetometer = &magnetometer,
    .safety = &safety,
    .ppm = &ppm,
    .buzzer = &buzzer,
    .lines = {[KEEL_LINE_PILOT] = {KEEL_UART(USART6, APB2, DMA2, 1u, 5u),
                                   .rx = KEEL_ALTERNATE(G, 9u, 8u, USART6, RX)},
              [KEEL_LINE_SPARE] = {KEEL_UART(USART3, APB1, DMA1, 1u, 4u),
                                   .rx = KEEL_ALTERNATE(D, 9u, 7u, USART3, RX)},
              [KEEL_LINE_SATELLITES] = {KEEL_UART(USART1, APB2, DMA2, 5u, 4u),
                                        .rx = KEEL_ALTERNATE(B, 7u, 7u, USART1, RX),
                                        .tx = KEEL_ALTERNATE(B, 6u, 7u, USART1, TX), .sends = true},
              [KEEL_LINE_TELEMETRY] = {KEEL_UART(USART2, APB1, DMA1, 5u, 4u),
                                       .rx = KEEL_ALTERNATE(D, 6u, 7u, USART2, RX),
                                       .tx = KEEL_ALTERNATE(D, 5u, 7u, USART2, TX), .sends = true}},
    .kept_sector = 0u,
};
