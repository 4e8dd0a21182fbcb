/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file model.h
 * @brief An FMUv5 for a plant: the parts of the model, and what they share.
 *
 * Time is counted in ticks, of which a core at 216 MHz has two a cycle. It passes by the
 * instructions of basic blocks, one a cycle, by accesses to peripherals, and by what buses take. It
 * never passes a limit, at which the plant moves: whoever waits for longer looks again behind it.
 *
 * There is one board in a process.
 */
#ifndef MODEL_H
#define MODEL_H

#include "board_in_plant.h"
#include "sim.h"

#include <stdbool.h>
#include <stdint.h>

#define MODEL_TICKS_PER_US 432u
#define MODEL_TEXT         65536u /* What is kept of the console. */
#define MODEL_PROBLEM      256u

#define MODEL_CHIP      0x40000000u /* Registers of the chip's peripherals, … */
#define MODEL_CHIP_SIZE 0x80000u
#define MODEL_CORE      0xE0000000u /* … and of the core's. */
#define MODEL_CORE_SIZE 0x100000u
#define MODEL_DTCM      0x20000000u
#define MODEL_DTCM_SIZE 0x20000u

/** @name Time. It is looked at with each block of instructions. */
/** @{ */

/** The time, and what ends a flight. */
typedef struct model_clock {
    uint64_t now;   /**< Ticks since power-up. */
    uint64_t limit; /**< Up to where time may pass. */
    bool failed;    /**< There is a problem: model_problem() has it. */
} model_clock_t;

extern model_clock_t model_clock;

/** Ticks since power-up. */
static inline uint64_t model_now(void)
{
    return model_clock.now;
}

/** Microseconds since power-up. */
static inline uint64_t model_now_us(void)
{
    return model_clock.now / MODEL_TICKS_PER_US;
}

/** Whether the limit is reached. */
static inline bool model_time_is_up(void)
{
    return model_clock.now >= model_clock.limit;
}

/** Lets time pass. */
static inline void model_pass(uint64_t ticks)
{
    model_clock.now += ticks;
}

/** Waits for a time, but no longer than to the limit.
 * @return whether that time has come */
static inline bool model_wait(uint64_t ticks)
{
    const uint64_t reached = (ticks < model_clock.limit) ? ticks : model_clock.limit;

    model_clock.now = (model_clock.now < reached) ? reached : model_clock.now;
    return model_clock.now >= ticks;
}

/** Begins a flight: it is time 0, and nothing is wrong. */
void model_clock_start(void);

/** Up to where time may pass, in ticks. */
void model_clock_limit(uint64_t ticks);

/** Notes what the image did that must not be, or what broke; the first one counts. */
void model_fail(const char *format, ...) __attribute__((format(printf, 1, 2)));

/** Why the board cannot go on; empty: it can. */
const char *model_problem(void);
/** @} */

/** @name The processor, with its memories. */
/** @{ */

/** Loads an image and powers up.
 * @return whether that went well */
bool model_processor_start(const char *path, uint32_t address);

/** Runs it until the limit of time, or until something is wrong. */
void model_processor_run(void);

/** A place in its memories, or null when there are not so many bytes there. */
uint8_t *model_memory(uint32_t address, uint32_t size);

/** The protection of memory is switched: guards hold while it is on. */
void model_guard(bool on);

/** Why the chip is reset. */
typedef enum model_cause {
    MODEL_BY_POWER,
    MODEL_BY_SOFTWARE,
    MODEL_BY_WATCHDOG
} model_cause_t;

/** A reset is asked for: it comes before the next block of instructions. */
void model_reset(model_cause_t cause);

/** From now on faults are the board's, as on hardware: exceptions go to the image's handlers, and
 * the watchdog resets. Else both end the flight. */
void model_expect_faults(void);

/** An exception is pending, with what CFSR says: it comes before the next block. */
void model_except(uint32_t number, uint32_t status);

/** The number of the exception that is active; 0: none. */
uint32_t model_exception(void);

/** From now on no instruction is executed, until a reset. */
void model_hang(void);

/** The same from the end of a task's next run on. */
void model_hang_task(uint32_t task);

/** A function of the image at whose entry time passes: the end of a task's run, with the task as
 * its second argument. */
void model_watch(uint32_t address);

/** Makes the next runs of a task longer. */
void model_delay(uint32_t task, uint32_t runs, uint32_t extra_us);
/** @} */

/** @name Registers. */
/** @{ */

/** Power up: nothing is said yet, and all clocks can run. */
void model_registers_start(void);

/** As a reset leaves them. */
void model_registers_reset(model_cause_t cause);

/** The oscillator stands still, for good. */
void model_lose_oscillator(void);

/** A register of a peripheral, or of the core, is read: bytes of it. */
uint32_t model_read(uint32_t address, uint32_t size);

/** The same for writing. */
void model_write(uint32_t address, uint32_t size, uint32_t value);

/** The registers of the chip, and of its core, as they were written last. */
extern uint32_t model_chip[MODEL_CHIP_SIZE / sizeof(uint32_t)];
extern uint32_t model_core[MODEL_CORE_SIZE / sizeof(uint32_t)];

/** A register's word, as it was written last. */
static inline uint32_t *model_word(uint32_t address)
{
    return (address >= MODEL_CORE) ? &model_core[(address - MODEL_CORE) / sizeof(uint32_t)]
                                   : &model_chip[(address - MODEL_CHIP) / sizeof(uint32_t)];
}

/** Whether a pin is an output that is low. */
bool model_pin_is_low(uint32_t port, uint32_t pin);

/** Whether it is one that is high. */
bool model_pin_is_high(uint32_t port, uint32_t pin);

/** Whether a pin has an alternate function, and which. */
bool model_pin_has(uint32_t port, uint32_t pin, uint32_t function);

/** The ticks of an instruction at the core's clock now. */
extern uint32_t model_instruction_ticks;

/** Whether the watchdog was fed in time until now; it is when it does not run. */
bool model_is_fed(void);

/** When it resets, unless it is fed; UINT64_MAX: never. */
uint64_t model_bites_at(void);

/** Whether the watchdog runs: behind its start the main loop begins. */
bool model_is_up(void);

/** What the board said on its console. */
const char *model_text(void);
/** @} */

/** @name Outputs: FMU_CH1 to FMU_CH8, from 0 on, with TIM 1, 4 and 12. */
/** @{ */
#define MODEL_OUTPUTS 8u
#define MODEL_ARMED   8u /* The line behind the outputs: nARMED, low while they are armed. */
#define MODEL_EVENT   9u /* And what is no line: model_event_t. */

/** What a line does. */
typedef enum model_level {
    MODEL_FLOATS,
    MODEL_LOW,
    MODEL_HIGH,
    MODEL_UNKNOWN
} model_level_t;

/** What happens to the chip: the exception that it enters, or a reset, by its cause. */
#define MODEL_RESET_EVENT 256u

/** A change, in ticks. */
typedef board_edge_t model_edge_t;

/** Power up: nothing is noted yet. */
void model_pins_start(void);

/** As a reset leaves them: they float. */
void model_pins_reset(void);

/** Notes a change of a line. */
void model_note(uint64_t at, uint32_t line, uint32_t level);

/** All changes since power-up, in the order of their times. */
const model_edge_t *model_edges(uint32_t *count);

/** Notes what timers did up to now; before anything changes that they depend on. */
void model_pins_pass(void);

/** Notes what has changed now. */
void model_pins_look(void);

/** A register of a timer is written. */
void model_timer_write(uint32_t base, uint32_t offset, uint32_t value);

/** The ticks of the timers' clock from now on. */
void model_timers_clock(uint32_t ticks);

/** The pulse that leaves an output now, in us; 0: none. */
uint32_t model_pulse_us(uint32_t output);
/** @} */

/** @name Buses: SPI 1, 2 and 4, and I2C 3. */
/** @{ */
void model_buses_reset(void);
uint32_t model_spi_read(uint32_t base, uint32_t offset);
void model_spi_write(uint32_t base, uint32_t offset, uint32_t value);
uint32_t model_i2c_read(uint32_t offset);
void model_i2c_write(uint32_t offset, uint32_t value);

/** Pins have changed: what is selected by them, is. */
void model_select(void);

/** Power up: nothing holds a bus. */
void model_buses_start(void);

/** What is read by an SPI is low, whoever is selected. */
void model_spi_hold(uint32_t spi, bool holds);

/** A device holds SDA low, until so many clocks have come, or, with 0, for good. */
void model_i2c_hold(bool holds, uint32_t clocks);

/** Whether SDA is held low. */
bool model_i2c_is_held(void);

/** Pins have changed: clocks may come by them. */
void model_i2c_look(void);
/** @} */

/** @name Devices at the buses. Each holds what the plant said last. */
/** @{ */

/** The devices at the SPIs. */
typedef enum model_device {
    MODEL_ICM20689,
    MODEL_GYROSCOPE,     /**< Of the BMI055. */
    MODEL_ACCELEROMETER, /**< Of the BMI055. */
    MODEL_FRAM,
    MODEL_MS5611,
    MODEL_DEVICES,
    MODEL_IST8310 = MODEL_DEVICES /**< At the I2C, behind all of these. */
} model_device_t;

/** Power up: all are silent, and there. */
void model_devices_start(void);

/** The same, as the supply went: what the memory and the plant hold stays. */
void model_devices_power(void);

/** An inertial unit, from 0 on, is taken off its bus, or put there again. */
void model_unit_unplug(uint32_t unit, bool is_off);

/** Devices that the board has not, a bit of model_device_t each: from now on, whatever starts. */
void model_devices_leave_out(uint32_t devices);

/** Whether a device of an SPI is there. */
bool model_device_is_there(model_device_t device);

/** Whether the magnetometer is. */
bool model_field_is_there(void);

/** The supply goes when so many bytes more were written to the memory of parameters. */
void model_fram_cut(uint32_t bytes);

/** What the plant says now. */
sim_sensors_t *model_sensors(void);

/** The devices see how far the plant's counts have moved: one whose count stands is silent. */
void model_devices_turn(void);

/** A device is selected, or no longer. */
void model_device_select(model_device_t device, bool selected);

/** A byte each way. */
uint8_t model_device_exchange(model_device_t device, uint8_t byte);

/** The magnetometer is addressed. */
void model_field_begin(bool reads);

/** A byte to it. */
void model_field_take(uint8_t byte);

/** A byte from it. */
uint8_t model_field_give(void);

/** What ADC1 counts on a channel. */
uint32_t model_count(uint32_t channel);

/** The memory of parameters: its bytes. */
uint8_t *model_fram(void);
#define MODEL_FRAM_BYTES 32768u

/** Whether something was written to it since this was asked last. */
bool model_fram_has_changed(void);
/** @} */

/** @name SDMMC 1, and the card in its slot. */
/** @{ */

/** Puts a card of high capacity into the slot, whose sectors are these bytes: a multiple of 1024
 * sectors. Null takes it out. */
void model_card_insert(uint8_t *bytes, uint32_t sectors);

/** Power up: a card that was inserted is there, and works. */
void model_card_start(void);

/** As a reset of the chip leaves both: the card loses its supply. */
void model_card_reset(void);

/** The card is pulled out, or put there again.
 * @return whether there is one */
bool model_card_pull(bool is_out);

/** From now on what the card programs does not come to its end, or does again.
 * @return whether there is one */
bool model_card_stick(bool is_stuck);

uint32_t model_slot_read(uint32_t offset);
void model_slot_write(uint32_t offset, uint32_t value);
/** @} */

/** @name UARTs, each with the stream of DMA that takes its bytes, and who sends. */
/** @{ */

/** The lines. */
typedef enum model_line {
    MODEL_PILOT,      /**< USART 6. */
    MODEL_SPARE,      /**< USART 3. */
    MODEL_SATELLITES, /**< USART 1. */
    MODEL_TELEMETRY,  /**< USART 2. */
    MODEL_LINES
} model_line_t;

/** How somebody sends bytes of 8 bits. */
typedef struct model_bits {
    uint32_t baud;
    bool even_parity;
    bool two_stops;
    bool inverted;
} model_bits_t;

/** Power up: nothing is on its way. */
void model_lines_start(void);

/** As a reset of the chip leaves them. */
void model_lines_reset(void);

/** How the pilot's receiver sends. */
void model_pilot_sends(const model_bits_t *bits);

/** What is wrong with a line. */
typedef struct model_disturbance {
    bool silent;    /**< Nothing comes. */
    bool unplugged; /**< The same, and nobody drives the line. */
    uint32_t noise; /**< Of so many bytes of 1000 something goes wrong. */
} model_disturbance_t;

/** From now on. */
void model_line_disturb(model_line_t line, const model_disturbance_t *disturbance);

/** Whether an address is a register of a UART of a line, and of which. */
bool model_is_uart(uint32_t address, model_line_t *line);

uint32_t model_uart_read(model_line_t line, uint32_t offset);
void model_uart_write(model_line_t line, uint32_t offset, uint32_t value);
uint32_t model_dma_read(uint32_t dma, uint32_t offset);
void model_dma_write(uint32_t dma, uint32_t offset, uint32_t value);

/** Bytes for the telemetry's line, and from it. */
uint32_t model_telemetry_send(const uint8_t *bytes, uint32_t size);
uint32_t model_telemetry_receive(uint8_t *bytes, uint32_t size);
/** @} */

#endif
