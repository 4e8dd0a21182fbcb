/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file chip.h
 * @brief The STM32F767 on a board: what a board says about itself, and what an application may use
 *        beyond board.h.
 */
#ifndef KEEL_BSP_STM32F767_TARGET_CHIP_H
#define KEEL_BSP_STM32F767_TARGET_CHIP_H

#include "common/bus.h"
#include "common/disk.h"
#include "common/slots.h"
#include "devices/inertial.h"
#include "keel/rtos/scheduler.h"
#include "stm32f767/adc.h"
#include "stm32f767/buzzer.h"
#include "stm32f767/capture.h"
#include "stm32f767/clock_tree.h"
#include "stm32f767/pin.h"
#include "stm32f767/power.h"
#include "stm32f767/pwm.h"
#include "stm32f767/receiver.h"
#include "stm32f767/registers/uart.h"

#include <stdbool.h>
#include <stdint.h>

#define KEEL_LEDS       3u
#define KEEL_CARD_LINES 4u

/* What keel_fault_stop records. */
#define KEEL_FAULT_CLOCK    0xB0A20100u /**< Plus a keel_clock_fault_t. */
#define KEEL_FAULT_WATCHDOG 0xB0A20200u /**< The watchdog was not fed in time. */
#define KEEL_FAULT_START    0xB0A20300u /**< A driver refused what the board says. */

/** A port by its letter. */
#define KEEL_PORT(letter) ((keel_gpio_t *)GPIO##letter##_BASE)

/** A pin. */
#define KEEL_PIN(letter, number) {KEEL_PORT(letter), (number)}

/**
 * A pin with its alternate function. Peripheral and signal are for the reader, and for
 * tools/keel registers, which holds them against a database.
 */
#define KEEL_ALTERNATE(letter, number, function, peripheral, signal)                               \
    {KEEL_PIN(letter, number), (function)}

/** A pin that is given to a peripheral. */
typedef struct keel_alternate {
    keel_pin_t pin;
    uint32_t function; /**< Number of the alternate function. */
} keel_alternate_t;

/** The timers that make pulses on some board. */
typedef enum keel_chip_timer {
    KEEL_TIMER_TIM1 = 0,
    KEEL_TIMER_TIM4 = 1,
    KEEL_TIMER_TIM12 = 2
} keel_chip_timer_t;

#define KEEL_CHIP_TIMERS 3u

/** By keel_chip_timer_t. */
extern const keel_pwm_timer_t keel_chip_timers[KEEL_CHIP_TIMERS];

#define KEEL_CHANNEL_CH1 1u
#define KEEL_CHANNEL_CH2 2u
#define KEEL_CHANNEL_CH3 3u
#define KEEL_CHANNEL_CH4 4u

/**
 * An output for pulses: its pin, with its alternate function, timer and channel.
 * tools/keel registers holds each against a database, and their order against specs/outputs.toml.
 */
#define KEEL_OUTPUT(letter, number, function, timer, channel)                                      \
    {KEEL_PIN(letter, number), (function), &keel_chip_timers[KEEL_TIMER_##timer],                  \
     KEEL_CHANNEL_##channel}

/** The pin of a receiver of PPM, of timer 8; held against a database and specs/outputs.toml. */
#define KEEL_PPM(letter, number, function, timer, channel)                                         \
    KEEL_ALTERNATE(letter, number, function, timer, channel)

/** The pin of the buzzer, of timer 9; held against a database and specs/outputs.toml. */
#define KEEL_BUZZER(letter, number, function, timer, channel)                                      \
    KEEL_ALTERNATE(letter, number, function, timer, channel)

/** A pin that has one level for good; `make check NAME=registers` holds it against
 * specs/outputs.toml. */
#define KEEL_LEVEL(letter, number, high) {KEEL_PIN(letter, number), (high)}

/** A pin that tells others on the board that motors may turn; held against specs/outputs.toml. */
#define KEEL_ARMED(letter, number) KEEL_PIN(letter, number)

/** A pin that switches a supply, say, and its level while the board runs. */
typedef struct keel_level {
    keel_pin_t pin;
    bool high;
} keel_level_t;

/** A light. */
typedef struct keel_led {
    keel_pin_t pin;
    bool active_low; /**< It shines when the pin is low; the pin is then an open drain. */
} keel_led_t;

/**
 * The pins of a safety switch: its button, and its light. `make check NAME=registers` holds them
 * against specs/outputs.toml.
 */
#define KEEL_SAFETY(letter, number, other, another)                                                \
    {                                                                                              \
        KEEL_PIN(letter, number),                                                                  \
        {                                                                                          \
            KEEL_PIN(other, another), true                                                         \
        }                                                                                          \
    }

/** A safety switch: a button that joins its pin to the supply, and a light. */
typedef struct keel_board_safety {
    keel_pin_t button;
    keel_led_t light;
} keel_board_safety_t;

/** The lights of both boards. */
typedef enum keel_led_name {
    KEEL_LED_RED = 0,
    KEEL_LED_GREEN = 1,
    KEEL_LED_BLUE = 2
} keel_led_name_t;

/** A pin of ADC1, with its channel's number; tools/keel registers holds both against a database. */
#define KEEL_ANALOGUE(letter, number, channel) {KEEL_PIN(letter, number), (channel)}

/** A pin that the analogue-to-digital converter reads. */
typedef struct keel_analogue {
    keel_pin_t pin;
    uint32_t channel; /**< Of ADC1, 0 to 15. */
} keel_analogue_t;

/** The analogue pins of a board that has them; keel/middleware/power_module.h takes the first
 * four. */
typedef enum keel_analogue_name {
    KEEL_ANALOGUE_VOLTAGE_1 = 0, /**< Power module 1. */
    KEEL_ANALOGUE_CURRENT_1 = 1,
    KEEL_ANALOGUE_VOLTAGE_2 = 2, /**< Power module 2. */
    KEEL_ANALOGUE_CURRENT_2 = 3,
    KEEL_ANALOGUE_5V = 4,     /**< The board's 5 V, divided. */
    KEEL_ANALOGUE_SENSORS = 5 /**< The sensors' 3.3 V, divided. */
} keel_analogue_name_t;

#define KEEL_ANALOGUES 6u

/** A card's slot, at SDMMC1. */
typedef struct keel_board_card {
    keel_alternate_t clock;
    keel_alternate_t command;
    keel_alternate_t data[KEEL_CARD_LINES];
} keel_board_card_t;

/** A device that has an SPI for itself. */
typedef struct keel_board_device {
    keel_alternate_t sck;
    keel_alternate_t miso;
    keel_alternate_t mosi;
    keel_pin_t select;
} keel_board_device_t;

/** Which way a sensor lies on its board: for each axis of the body (forward, right, down) the axis
 * of the sensor that is along it, from 1 on, negative where it points the other way. */
typedef struct keel_mounting {
    int8_t axis[3];
} keel_mounting_t;

/* 12 for a rotation and for nothing else: three axes in the order of a right hand. The differences
 * of a permutation of 1, 2 and 3 multiply to 2 or, when it is odd, to -2. */
#define KEEL_SIZE(axis) (((axis) < 0) ? -(axis) : (axis))
#define KEEL_HANDED(x, y, z)                                                                       \
    ((x) * (y) * (z) * (KEEL_SIZE(x) - KEEL_SIZE(y)) * (KEEL_SIZE(y) - KEEL_SIZE(z)) *             \
     (KEEL_SIZE(z) - KEEL_SIZE(x)))

/**
 * A mounting. One that is no rotation does not compile: the array would have a negative size.
 * tools/keel registers holds it against specs/outputs.toml.
 */
#define KEEL_MOUNTING(x, y, z)                                                                     \
    {                                                                                              \
        {                                                                                          \
            (int8_t)((x) + (0 * (int)sizeof(char[(KEEL_HANDED(x, y, z) == 12) ? 1 : -1]))), (y),   \
                (z)                                                                                \
        }                                                                                          \
    }

/** The kinds of inertial units that have a driver. */
typedef enum keel_inertial_kind {
    KEEL_INERTIAL_ICM20689 = 0,
    KEEL_INERTIAL_ICM20602 = 1,
    KEEL_INERTIAL_BMI055 = 2,
    KEEL_INERTIAL_ICM42688 = 3
} keel_inertial_kind_t;

/** Inertial units of a board, at most. */
#define KEEL_CHIP_INERTIAL_UNITS 3u

/** An inertial unit at SPI 1. */
typedef struct keel_board_inertial {
    keel_inertial_kind_t kind;
    keel_pin_t select;               /**< Of the BMI055, its gyroscope's. */
    keel_pin_t accelerometer_select; /**< Of the BMI055; of the others, select again. */
    keel_mounting_t mounting;
} keel_board_inertial_t;

/**
 * An inertial unit: its kind, the port and pin of its chip select, and its mounting.
 * `make check NAME=registers` holds it against specs/outputs.toml.
 */
#define KEEL_INERTIAL(kind, letter, number, x, y, z)                                               \
    {KEEL_INERTIAL_##kind, KEEL_PIN(letter, number), KEEL_PIN(letter, number),                     \
     KEEL_MOUNTING(x, y, z)}

/** The same of a BMI055, with two selects: the gyroscope's, and the accelerometer's. */
#define KEEL_INERTIAL_PAIR(kind, letter, number, other, another, x, y, z)                          \
    {KEEL_INERTIAL_##kind, KEEL_PIN(letter, number), KEEL_PIN(other, another),                     \
     KEEL_MOUNTING(x, y, z)}

/** A magnetometer IST8310 at I2C 3. */
typedef struct keel_board_magnetometer {
    keel_alternate_t scl;
    keel_alternate_t sda;
    keel_mounting_t mounting; /**< Of forward, right and down as its driver tells them. */
} keel_board_magnetometer_t;

/** A magnetometer's mounting; `make check NAME=registers` holds it against specs/outputs.toml. */
#define KEEL_MAGNETOMETER(x, y, z) KEEL_MOUNTING(x, y, z)

/** The lines of a board, by what is meant to be at their sockets. */
typedef enum keel_chip_line {
    KEEL_LINE_PILOT = 0,      /**< The socket of the pilot's receiver. */
    KEEL_LINE_SPARE = 1,      /**< A socket for the same, where an IO processor has the first. */
    KEEL_LINE_SATELLITES = 2, /**< The satellite receiver. */
    KEEL_LINE_TELEMETRY = 3   /**< A radio to a ground station. */
} keel_chip_line_t;

#define KEEL_CHIP_LINES 4u

/** A UART with the stream of DMA that takes its bytes. */
typedef struct keel_board_line {
    keel_uart_t *uart; /**< Null: the board has no such line. */
    uint32_t enable;   /**< Its bit in APB1ENR or … */
    bool on_apb2;      /**< … in APB2ENR. */
    bool sends;        /**< It has tx; else it only receives. */
    keel_dma_t *dma;
    uint32_t stream;
    uint32_t channel;
    keel_alternate_t rx;
    keel_alternate_t tx; /**< Where it sends. */
} keel_board_line_t;

/**
 * The UART and the stream of a line. `make check NAME=registers` holds which line it is against
 * specs/outputs.toml; the chip's model refuses a stream that does not hear the UART.
 */
#define KEEL_UART(uart_name, bus, dma_name, stream_number, channel_number)                         \
    .uart = (keel_uart_t *)uart_name##_BASE, .enable = RCC_##bus##ENR_##uart_name##EN,             \
    .on_apb2 = (KEEL_IS_##bus != 0), .dma = (keel_dma_t *)dma_name##_BASE,                         \
    .stream = (stream_number), .channel = (channel_number)
#define KEEL_IS_APB1 0
#define KEEL_IS_APB2 1

/** The inertial units of a board. */
typedef struct keel_board_units {
    const keel_board_inertial_t *unit; /**< In the order of the vote. */
    uint32_t count;                    /**< 1 to KEEL_CHIP_INERTIAL_UNITS. */
    const keel_pin_t *deselect;        /**< Other devices on the bus, which must stay silent. */
    uint32_t deselect_count;
} keel_board_units_t;

/** Board: its inertial units, in which boards after one standard differ. */
extern const keel_board_units_t keel_board_units;

/** What a board says about itself. */
typedef struct keel_board_pins {
    keel_oscillator_t oscillator;
    keel_uart_t *console;
    uint32_t console_clock; /**< The console's bit in APB1ENR. */
    keel_alternate_t console_tx;
    keel_alternate_t console_rx;
    keel_led_t led[KEEL_LEDS];        /**< By keel_led_name_t. */
    const keel_pwm_output_t *outputs; /**< In the order of their sockets. */
    uint32_t output_count;            /**< 1 to KEEL_PWM_OUTPUTS_MAX. */
    const keel_level_t *levels;       /**< Supplies and what else has one level; null: none. */
    uint32_t level_count;
    const keel_pin_t *armed; /**< Low while outputs are armed, else held high; null: none. */
    keel_alternate_t sck;    /**< SPI 1, with the inertial units. */
    keel_alternate_t miso;
    keel_alternate_t mosi;
    const keel_analogue_t *analogue;               /**< By keel_analogue_name_t; null: none. */
    uint32_t analogue_count;                       /**< KEEL_ANALOGUES, or 0. */
    const keel_board_card_t *card;                 /**< Null: no slot. */
    const keel_board_device_t *memory;             /**< FM25V02 at SPI 2; null: none. */
    const keel_board_device_t *barometer;          /**< MS5611 at SPI 4; null: none. */
    const keel_board_magnetometer_t *magnetometer; /**< Null: none. */
    const keel_board_safety_t *safety;             /**< Null: none. */
    const keel_alternate_t *ppm;                   /**< At timer 8, channel 1; null: none. */
    const keel_alternate_t *buzzer;                /**< At timer 9, channel 1; null: none. */
    keel_board_line_t lines[KEEL_CHIP_LINES];      /**< By keel_chip_line_t. */
    uint32_t kept_sector; /**< The first of two flash sectors that images leave free, where there is
                               no memory; 0: none. */
} keel_board_pins_t;

/** Board: its description. */
extern const keel_board_pins_t keel_board_pins;

/**
 * Sets a light.
 *
 * @param name which
 * @param on   whether it shines
 */
void keel_chip_led(keel_led_name_t name, bool on);

/**
 * Starts the board's safety switch: its button's pin is held low, so that an open socket reads as
 * a button that nobody presses, and its light is dark.
 *
 * @return whether the board has one
 */
bool keel_chip_safety_start(void);

/** Whether the button of the safety switch is pressed now; false where there is none. */
bool keel_chip_safety_is_pressed(void);

/**
 * Sets the light of the safety switch, if there is one.
 *
 * @param on whether it shines
 */
void keel_chip_safety_light(bool on);

/**
 * Starts the board's buzzer, silent. To be called once, before those below.
 *
 * @return whether the board has one
 */
bool keel_chip_buzzer_start(void);

/** Plays a tune, as keel_buzzer_play, if there is a buzzer. */
void keel_chip_buzzer_play(const keel_tone_t *tones, uint32_t count);

/** Lets time pass for the tune, as keel_buzzer_turn, if there is a buzzer. */
void keel_chip_buzzer_turn(uint32_t elapsed_us);

/** Whether a tune plays; false without a buzzer, too. */
bool keel_chip_buzzer_plays(void);

/** How many inertial units the board says that it has, 1 to KEEL_CHIP_INERTIAL_UNITS. */
uint32_t keel_chip_inertial_count(void);

/** Starts the bus of the inertial units; takes 20 ms. To be called once, before all of them. */
void keel_chip_inertial_begin(void);

/**
 * Starts an inertial unit; takes some 110 ms.
 *
 * @param number 0 to keel_chip_inertial_count() - 1
 * @return as its driver's start: keel_invensense_start, keel_bmi055_start or keel_icm42688_start;
 *         KEEL_BSP_ARGUMENT when the board has no such unit
 */
keel_bsp_status_t keel_chip_inertial_start(uint32_t number);

/**
 * Reads a sample of an inertial unit, in the unit's own axes.
 *
 * @param number 0 to keel_chip_inertial_count() - 1, of one that was started
 * @param sample the sample; as it was unless KEEL_BSP_OK
 * @return as its driver's read; KEEL_BSP_ARGUMENT when the board has no such unit
 */
keel_bsp_status_t keel_chip_inertial_read(uint32_t number, keel_inertial_sample_t *sample);

/** A sample of an inertial unit in body axes (forward, right, down). */
typedef struct keel_chip_motion {
    float force[3];           /**< Specific force, in m/s^2. */
    float rate[3];            /**< In rad/s. */
    int16_t temperature_cdeg; /**< Of the unit, in hundredths of a degree Celsius. */
} keel_chip_motion_t;

/**
 * Reads an inertial unit and turns the sample as the board has mounted it.
 *
 * @param number as keel_chip_inertial_read
 * @param motion the sample; as it was unless KEEL_BSP_OK
 * @return as keel_chip_inertial_read
 */
keel_bsp_status_t keel_chip_motion(uint32_t number, keel_chip_motion_t *motion);

/**
 * Turns three values of a sensor as it is mounted.
 *
 * @param mounting the sensor's
 * @param sensor   counts along the sensor's axes
 * @param unit     what a count is
 * @param body     the values along forward, right and down
 */
void keel_mounting_turn(const keel_mounting_t *mounting, const int16_t sensor[3], float unit,
                        float body[3]);

/**
 * Starts the bus of the board's barometer, an MS5611. To be called once, 20 ms after the start.
 *
 * @param bus the bus; as it was when there is no barometer
 * @return whether the board has one
 */
bool keel_chip_barometer(keel_bus_t *bus);

/**
 * Starts the bus of the board's magnetometer, an IST8310. To be called once.
 *
 * @param bus      the bus; as it was when there is no magnetometer
 * @param mounting how the magnetometer lies; as it was when there is none
 * @return whether the board has one
 */
bool keel_chip_magnetometer(keel_bus_t *bus, keel_mounting_t *mounting);

/** Whether the board has a line. */
bool keel_chip_has_line(keel_chip_line_t name);

/**
 * Starts a line, or starts it anew with other bits: what was unread is forgotten.
 *
 * @param name which
 * @param line its bits
 * @return as keel_receiver_start; KEEL_BSP_ARGUMENT when the board has no such line
 */
keel_bsp_status_t keel_chip_line_start(keel_chip_line_t name, const keel_line_t *line);

/**
 * The next byte of a line, as keel_receiver_read.
 *
 * @param name which
 * @param byte the byte; as it was when there is none
 * @return whether there is one; false before the line's start, too
 */
bool keel_chip_line_read(keel_chip_line_t name, keel_receiver_byte_t *byte);

/**
 * Sends a byte, as keel_receiver_send.
 *
 * @param name  which
 * @param value the byte
 * @return whether it is on its way; false before the line's start, too
 */
bool keel_chip_line_send(keel_chip_line_t name, uint8_t value);

/** Whether the board has a pin for a receiver of PPM. */
bool keel_chip_has_ppm(void);

/**
 * Starts to take the edges of a receiver of PPM, or starts anew: what was unread is forgotten.
 *
 * @return as keel_capture_start; KEEL_BSP_ARGUMENT when the board has no such pin
 */
keel_bsp_status_t keel_chip_ppm_start(void);

/**
 * The next edge of PPM, as keel_capture_read.
 *
 * @param elapsed_us the time since the edge before, in us; as it was when there is none
 * @return whether there is one; false before the start, too
 */
bool keel_chip_ppm_read(uint32_t *elapsed_us);

/** What came by a line, and what did not; all 0 before its start. */
const keel_receiver_count_t *keel_chip_line_count(keel_chip_line_t name);

/**
 * The slot for an SD card, supplied and ready for the disk's start, which is the card's, by
 * sd_card.h. Takes 20 ms; may be called once. When the card breaks down in flight, a write takes
 * 2 ms at most.
 *
 * @param disk the card as a disk; as it was when there is no slot
 * @return whether the board has a slot; a card need not be in it
 */
bool keel_chip_card(keel_disk_t *disk);

/**
 * What the board keeps sets of parameters in (common/slots.h): its ferroelectric memory, or, on a
 * board without one, two sectors of the chip's own flash. Slot i begins at i times slot_bytes. To
 * be called once.
 *
 * The ferroelectric memory can be written in flight, and does not wear out. A save into the flash
 * erases a sector first, which stops the processor for seconds, so it is for the ground and for
 * the time before the watchdog runs; each byte that is written switches the memory's protection off
 * for a moment; and a sector bears 10 000 erasures.
 *
 * @param medium     the memory; it has erase if it is the flash
 * @param slot_bytes bytes of each of the two slots
 * @return KEEL_BSP_OK; KEEL_BSP_ARGUMENT when the board has neither; as keel_fm25v02_start for the
 *         ferroelectric memory; KEEL_BSP_ID when the chip's option bytes make two banks of its
 *         flash. Unless KEEL_BSP_OK, medium and slot_bytes are as they were
 */
keel_bsp_status_t keel_chip_memory(keel_medium_t *medium, uint32_t *slot_bytes);

/** Bytes of the chip's own number. */
#define KEEL_CHIP_UID_BYTES 12u

/**
 * Reads the chip's own number, which no other STM32 has: for the port of a copter, say. Memory is
 * not protected meanwhile, so this is for the time before tasks run.
 *
 * @param uid the number, its lowest byte first
 */
void keel_chip_uid(uint8_t uid[KEEL_CHIP_UID_BYTES]);

/** Why the chip started. After a fault for which the application was allowed another start
 * (keel_fault_allow_restart) it is what the record tells. */
keel_restart_t keel_chip_restart(void);

/** Starts all anew, as a reset does, with the outputs off. */
void keel_chip_reset(void) __attribute__((noreturn));

/** Whether the brown-out level is 2.7 V, below which the flash is too slow for the core's clock. */
bool keel_chip_brownout_is_set(void);

/**
 * Sets the brown-out level to 2.7 V for good, in the option bytes. Takes up to 2 s, so the watchdog
 * must not run yet.
 *
 * @return as keel_brownout_set
 */
keel_bsp_status_t keel_chip_brownout_set(void);

/**
 * Starts the watchdog; from then on keel_chip_turn must be called every 50 ms at least.
 *
 * @param scheduler the scheduler whose real-time tasks are to meet their releases; started
 */
void keel_chip_watchdog_start(const keel_scheduler_t *scheduler);

/**
 * To be called in every turn of the main loop: moves the console on, looks at the lines, and feeds
 * the watchdog if all real-time tasks met their releases.
 */
void keel_chip_turn(void);

/**
 * A character from the console.
 *
 * @param character the character
 * @return whether one came
 */
bool keel_chip_get(char *character);

/** How many outputs for pulses the board has, 1 to KEEL_PWM_OUTPUTS_MAX. */
uint32_t keel_chip_output_count(void);

/**
 * Sets the pulse of an output; it comes out once the outputs are armed.
 *
 * @param output   0 to keel_chip_output_count() - 1, in the order of the board's sockets
 * @param pulse_us 0, or 900 to 2100 us
 * @return KEEL_BSP_OK, or KEEL_BSP_ARGUMENT
 */
keel_bsp_status_t keel_chip_pulse(uint32_t output, uint32_t pulse_us);

/** Lets the pulses out that were set since the outputs were off; keel_board_outputs_off ends and
 *  forgets them. */
void keel_chip_arm(void);

/**
 * Starts the analogue-to-digital converter with the board's analogue pins, and reads the chip's
 * calibration. Takes some 15 us. Memory is not protected while the calibration is read, so this is
 * for the time before tasks run.
 *
 * @return as keel_adc_start
 */
keel_bsp_status_t keel_chip_adc_start(void);

/** How many analogue pins the board has, 0 to KEEL_ANALOGUES. */
uint32_t keel_chip_analogue_count(void);

/**
 * Measures the chip's supply, after keel_chip_adc_start; takes some 12 us, 30 when it fails.
 *
 * @param supply_mv in mV; as it was when that failed
 * @return as keel_adc_read and keel_adc_supply
 */
keel_bsp_status_t keel_chip_supply(uint32_t *supply_mv);

/**
 * Measures the chip's temperature, as keel_chip_supply.
 *
 * @param supply_mv        the supply, in mV
 * @param temperature_cdeg in hundredths of a degree Celsius; as it was when that failed
 * @return as keel_adc_read and keel_adc_temperature
 */
keel_bsp_status_t keel_chip_temperature(uint32_t supply_mv, int32_t *temperature_cdeg);

/**
 * Reads an analogue pin, as keel_chip_supply.
 *
 * @param name  which, below keel_chip_analogue_count
 * @param count what it counts, 0 to KEEL_ADC_COUNT_MAX; as it was when that failed
 * @return as keel_adc_read; KEEL_BSP_ARGUMENT when the board has no such pin
 */
keel_bsp_status_t keel_chip_analogue(uint32_t name, uint16_t *count);

#endif
