/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file main.c
 * @brief The paper's 21 tasks on a real board, until it is switched off.
 *
 * The first image to flash on a board: it shows whether clock, console, sensor, outputs, watchdog
 * and the handling of faults work there, and what each task takes.
 *
 * The background task of the inertial unit reads the sensor, if there is one, and the ADC task the
 * chip's temperature and supply and the board's analogue pins; every other body, and the rest of
 * these two's time, keeps the CPU busy for the task's worst-case time of table 2.
 * Before that, the memory that parameters are kept in is tried: it counts the starts.
 * Periods, budgets, phases and the guard are those that `make analyze` analyses. A line on the
 * console tells every second how it goes. The watchdog is fed only while every real-time task meets
 * its releases. A refusal of the kernel ends as a fault does.
 *
 * Keys: p lets pulses of 1000 us out, o switches the outputs off, t prints a table of the tasks (a
 * line at a time, so that no release is late for it), r records each run of them until a ring is
 * full and then sends it, for `make generate NAME=schedule`; and, to see what follows: u an
 * undefined instruction, n a null pointer, s a stack that overflows, h a task that hangs.
 */
#include "board.h"
#include "common/task_table.h"
#include "common/trace.h"
#include "common/trace_log.h"
#include "console.h"
#include "cortex_m7/fault.h"
#include "cortex_m7/startup.h"
#include "keel/rtos/load.h"
#include "keel/rtos/scheduler.h"
#include "memory.h"
#include "stm32f767/target/chip.h"
#include "urpilot_tasks.h"

#define REPORT_EVERY_US 1000000u
#define OFFER_US        2000000u
#define PULSE_US        1000u /* No throttle. */
#define BLINK_RUNS      25u   /* 25 runs of 20 ms. */

/* What keel_fault_stop records. */
#define FAULT_SETUP 0xDE300001u
#define FAULT_STEP  0xDE300002u

/* The findings of the background task of the inertial unit. */
typedef struct imu {
    bool there;
    uint32_t samples;
    uint32_t failures;
    keel_inertial_sample_t last;
} imu_t;

/* The channels of the ADC task, in this order; from the third on, the board's analogue pins. */
#define MEASURE_SUPPLY      0u
#define MEASURE_TEMPERATURE 1u
#define MEASURE_PINS        2u
#define MEASURES            (MEASURE_PINS + KEEL_ANALOGUES)

/* Its measurements. One that fails keeps its last value. */
typedef struct analogue {
    keel_bsp_status_t start;
    keel_bsp_status_t status[MEASURES];
    uint32_t next; /* Which is measured in the next run. */
    uint32_t supply_mv;
    int32_t temperature_cdeg;
    uint32_t pin_mv[KEEL_ANALOGUES];
} analogue_t;

static keel_scheduler_t scheduler KEEL_REALTIME_ZERO;

/* The tasks: the scheduler knows each by the address of its declaration, and reads it when it runs
 * the task. */
static keel_task_config_t declaration[URPILOT_TASK_COUNT] KEEL_REALTIME_ZERO;

/* The work of a task, and how long it takes: the context of its body. */
typedef struct work {
    void (*body)(uint32_t length_us);
    uint32_t wcet_us;
} work_t;

static work_t work[URPILOT_TASK_COUNT] KEEL_REALTIME_ZERO;

/* The runs that are recorded on request, and the log that is sent of them, a line at a time. */
#define TRACE_ROOM                                                                                 \
    256u /* So much is left in the ring when recording ends: more than a pass stores. */
#define CHARACTER_US   90u /* On the line, rounded up. */
#define HEX_DIGIT_BITS 4u

typedef struct tracing {
    bool records;
    bool sends;
    uint64_t next_us; /* When the next line may be sent. */
} tracing_t;

/* The table that is printed on request, and its next line. */
typedef struct printing {
    bool prints;
    uint32_t line;
    uint64_t next_us; /* When it may be printed. */
} printing_t;

static keel_task_table_t table KEEL_REALTIME_ZERO;
static printing_t printing;

static keel_trace_t trace KEEL_REALTIME_ZERO;
static tracing_t tracing;
static keel_log_ring_t trace_ring;
static keel_trace_log_t trace_log;

static imu_t imu KEEL_REALTIME_ZERO;
static bool hang;
static analogue_t analogue;

KEEL_REALTIME_CODE static void work_until(uint32_t start_us, uint32_t length_us)
{
    while ((keel_board_clock_us(NULL) - start_us) < length_us) {
    }
}

KEEL_REALTIME_CODE static void plain_body(uint32_t length_us)
{
    work_until(keel_board_clock_us(NULL), length_us);
}

KEEL_REALTIME_CODE static void imu_body(uint32_t length_us)
{
    const uint32_t start_us = keel_board_clock_us(NULL);

    while (hang) {
    }
    if (imu.there) {
        if (keel_chip_inertial_read(0u, &imu.last) == KEEL_BSP_OK) {
            imu.samples++;
        } else {
            imu.failures++;
        }
    }
    work_until(start_us, length_us);
}

static void state_body(uint32_t length_us)
{
    static uint32_t runs;
    const uint32_t start_us = keel_board_clock_us(NULL);

    keel_chip_led(KEEL_LED_GREEN, (runs % (2u * BLINK_RUNS)) < BLINK_RUNS);
    runs++;
    work_until(start_us, length_us);
}

static keel_bsp_status_t measure_pin(uint32_t pin)
{
    uint16_t count;
    const keel_bsp_status_t status = keel_chip_analogue(pin, &count);

    return (status == KEEL_BSP_OK) ? keel_adc_pin(count, analogue.supply_mv, &analogue.pin_mv[pin])
                                   : status;
}

static void measure(uint32_t which)
{
    keel_bsp_status_t *const status = &analogue.status[which];

    if (which == MEASURE_SUPPLY) {
        *status = keel_chip_supply(&analogue.supply_mv);
    } else if (which == MEASURE_TEMPERATURE) {
        *status = keel_chip_temperature(analogue.supply_mv, &analogue.temperature_cdeg);
    } else {
        *status = measure_pin(which - MEASURE_PINS);
    }
}

static uint32_t measures(void)
{
    return MEASURE_PINS + keel_chip_analogue_count();
}

/* Everything once, before there are budgets, so that the first line has it all. */
static void start_analogue(void)
{
    analogue.start = keel_chip_adc_start();
    if (analogue.start == KEEL_BSP_OK) {
        for (uint32_t i = 0u; i < measures(); i++) {
            measure(i);
        }
    }
}

/* A conversion takes 12 us of the 18 that this body works in table 2, so there is one in a run, and
 * a line has no value that is older than eight runs. One that fails takes up to 30 us, which is the
 * task's budget. */
static void adc_body(uint32_t length_us)
{
    const uint32_t start_us = keel_board_clock_us(NULL);

    if (analogue.start == KEEL_BSP_OK) {
        measure(analogue.next);
        analogue.next = (analogue.next + 1u) % measures();
    }
    work_until(start_us, length_us);
}

static void require(keel_status_t status, uint32_t code)
{
    if (status != KEEL_OK) {
        keel_fault_stop(code);
    }
}

/* The body of every task, so that each run can be recorded, and its lateness is counted. */
KEEL_REALTIME_CODE static void body(void *context)
{
    const work_t *const own = context;

    keel_trace_begin(&trace, &scheduler);
    own->body(own->wcet_us);
    if (tracing.records) {
        keel_trace_end(&trace, &scheduler);
        keel_trace_store(&trace, &trace_ring);
    }
    keel_task_table_add(&table, &trace.run);
}

static void (*body_of(uint32_t i))(uint32_t length_us)
{
    if (i == (uint32_t)URPILOT_BACKGROUND_IMU) {
        return imu_body;
    }
    if (i == (uint32_t)URPILOT_ADC) {
        return adc_body;
    }
    return (i == (uint32_t)URPILOT_STATE_MACHINE) ? state_body : plain_body;
}

static void start(void)
{
    const keel_scheduler_config_t config = urpilot_scheduler_config(keel_board_clock_us, NULL);

    require(keel_scheduler_init(&scheduler, &config), FAULT_SETUP);
    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        work[i] = (work_t){.body = body_of(i), .wcet_us = urpilot_task[i].wcet_us};
        declaration[i] = urpilot_task_config(i, body, &work[i]);
        require(keel_scheduler_add(&scheduler, &declaration[i]), FAULT_SETUP);
    }
    require(keel_scheduler_start(&scheduler), FAULT_SETUP);
}

static void print_number(const char *label, uint64_t value)
{
    keel_console_text(label);
    keel_console_number(value);
}

static void print_signed(const char *label, int32_t value)
{
    keel_console_text(label);
    keel_console_text((value < 0) ? "-" : "");
    keel_console_number((uint64_t)((value < 0) ? -(int64_t)value : (int64_t)value));
}

static void print_imu(void)
{
    if (!imu.there) {
        keel_console_text(" imu none");
        return;
    }
    print_number(" imu ", imu.samples);
    print_number(" failed ", imu.failures);
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        print_signed((axis == 0u) ? " a " : " ", imu.last.acceleration[axis]);
    }
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        print_signed((axis == 0u) ? " g " : " ", imu.last.rate[axis]);
    }
}

/* The first that is wrong with what is measured. */
static keel_bsp_status_t analogue_status(void)
{
    keel_bsp_status_t status = analogue.start;

    for (uint32_t i = 0u; (i < measures()) && (status == KEEL_BSP_OK); i++) {
        status = analogue.status[i];
    }
    return status;
}

static void print_analogue(void)
{
    static const char *const label[KEEL_ANALOGUES] = {
        [KEEL_ANALOGUE_VOLTAGE_1] = " v1 ", [KEEL_ANALOGUE_CURRENT_1] = " i1 ",
        [KEEL_ANALOGUE_VOLTAGE_2] = " v2 ", [KEEL_ANALOGUE_CURRENT_2] = " i2 ",
        [KEEL_ANALOGUE_5V] = " 5v ",        [KEEL_ANALOGUE_SENSORS] = " sensors ",
    };
    const keel_bsp_status_t status = analogue_status();

    if (status != KEEL_BSP_OK) {
        print_number(" adc status ", (uint64_t)status);
        return;
    }
    print_signed(" chip ", analogue.temperature_cdeg);
    print_number(" supply ", analogue.supply_mv);
    for (uint32_t i = 0u; i < keel_chip_analogue_count(); i++) {
        print_number(label[i], analogue.pin_mv[i]);
    }
}

/* The scheduler's report of a task. */
static keel_task_report_t report_of(uint32_t i)
{
    keel_task_report_t report = {0};

    (void)keel_scheduler_report(&scheduler, &declaration[i], &report);
    return report;
}

/* One line: time, load, and what went wrong since the start. */
static void print_report(keel_load_t *window)
{
    uint64_t skipped = 0u;
    uint64_t overruns = 0u;
    uint64_t promotions = 0u;

    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        const keel_task_report_t report = report_of(i);

        skipped += report.skipped;
        overruns += report.stats.overruns;
        promotions += report.stats.promotions;
    }
    print_number("t ", scheduler.clock.now_us / REPORT_EVERY_US);
    print_number(" s load ", keel_load_ppm(window, scheduler.clock.now_us, scheduler.busy_us));
    print_number(" ppm skipped ", skipped);
    print_number(" overruns ", overruns);
    print_number(" promotions ", promotions);
    print_imu();
    print_analogue();
    keel_console_text("\n");
    keel_load_begin(window, scheduler.clock.now_us, scheduler.busy_us);
}

/* Between two steps: a line of the table, when those before it are out. */
static void turn_table(void)
{
    const uint64_t now_us = scheduler.clock.now_us;
    char line[KEEL_TASK_TABLE_LINE];
    uint32_t length;

    if (!printing.prints || (now_us < printing.next_us)) {
        return;
    }
    length = keel_task_table_line(&table, &scheduler, printing.line, line);
    if (length > 0u) {
        keel_console_text(line);
        printing.line++;
        printing.next_us = now_us + ((uint64_t)length * CHARACTER_US);
    } else {
        print_number("stack used ", keel_stack_used_b());
        keel_console_text(" bytes\n");
        printing.prints = false;
    }
}

static void start_trace(void)
{
    if (!tracing.records && !tracing.sends) {
        keel_log_ring_init(&trace_ring);
        keel_trace_log_start(&trace_log, &scheduler, &trace_ring);
        tracing.records = true;
    }
}

/* A message of the log as a line of hexadecimal digits, which any terminal can save. */
static void send_message(const keel_ulog_message_t *message)
{
    static const char digit[] = "0123456789abcdef";

    keel_console_text("log ");
    for (uint32_t i = 0u; i < message->size; i++) {
        keel_board_put(digit[message->bytes[i] >> HEX_DIGIT_BITS]);
        keel_board_put(digit[message->bytes[i] & 0xFu]);
    }
    keel_console_text("\n");
}

/* Between two steps: ends the recording when the ring is full, then sends what it holds. */
static void turn_trace(void)
{
    const uint64_t now_us = scheduler.clock.now_us;

    if (tracing.records &&
        ((keel_log_ring_held(&trace_ring) + TRACE_ROOM) >= KEEL_LOG_RING_BYTES)) {
        tracing = (tracing_t){.sends = true};
    }
    if (!tracing.sends || (now_us < tracing.next_us)) {
        return;
    }
    if (keel_trace_log_next(&trace_log)) {
        send_message(&trace_log.message);
        tracing.next_us = now_us + ((8u + (2u * (uint64_t)trace_log.message.size)) * CHARACTER_US);
    } else {
        keel_console_text("log ends\n");
        tracing.sends = false;
    }
}

static void outputs(bool on)
{
    for (uint32_t channel = 0u; channel < keel_chip_output_count(); channel++) {
        (void)keel_chip_pulse(channel, on ? PULSE_US : 0u);
    }
    if (on) {
        keel_chip_arm();
    } else {
        keel_board_outputs_off();
    }
    keel_console_text(on ? "outputs on\n" : "outputs off\n");
}

/* Goes down the stack into its guard, a frame at a time, without a function that calls itself. */
static void overflow(void)
{
    volatile uint8_t *const here = __builtin_frame_address(0);

    for (uint32_t i = 0u; i < 0x8000u; i++) {
        *(here - i) = 0u;
    }
}

/* The pointer is volatile, so that the compiler cannot know that it is null. */
static void read_nowhere(void)
{
    const volatile uint32_t *volatile nowhere = NULL;

    (void)*nowhere;
}

static void obey(char key)
{
    switch (key) {
    case 'p':
        outputs(true);
        break;
    case 'o':
        outputs(false);
        break;
    case 't':
        printing = (printing_t){.prints = true};
        break;
    case 'r':
        start_trace();
        break;
    case 'u':
        __asm volatile("udf #1");
        break;
    case 'n':
        read_nowhere();
        break;
    case 's':
        overflow();
        break;
    case 'h':
        hang = true;
        break;
    default:
        keel_console_text("keys: p o t r, and u n s h for faults\n");
        break;
    }
}

/* All are started, so that each is named; the tasks read the first. */
static void start_units(void)
{
    keel_chip_inertial_begin();
    for (uint32_t i = 0u; i < keel_chip_inertial_count(); i++) {
        print_number("sensor ", i + 1u);
        print_number(" status ", (uint64_t)keel_chip_inertial_start(i));
        keel_console_text("\n");
    }
}

static void print_start(void)
{
    keel_console_text("Keel on ");
    keel_console_text(keel_board_name);
    keel_console_text(": 21 tasks\n");
    if (keel_fault_last() != NULL) {
        keel_console_text("since power-on: ");
        keel_fault_print();
    }
    start_units();
    print_memory();
}

/* The level lies in the option bytes, so it is set by hand, once for a board, and before the
 * watchdog runs, which would bite meanwhile. */
static void offer_brownout(void)
{
    const uint32_t start_us = keel_board_clock_us(NULL);
    char key = '\0';

    if (keel_chip_brownout_is_set()) {
        return;
    }
    keel_console_text("brown-out reset is below 2.7 V: b within 2 s sets 2.7 V for good\n");
    while ((key != 'b') && ((keel_board_clock_us(NULL) - start_us) < OFFER_US)) {
        keel_chip_turn();
        (void)keel_chip_get(&key);
    }
    if (key == 'b') {
        print_number("brown-out status ", (uint64_t)keel_chip_brownout_set());
        keel_console_text("\n");
    }
}

int main(void)
{
    keel_load_t window;
    char key;

    print_start();
    offer_brownout();
    imu.there = (keel_chip_inertial_read(0u, &imu.last) == KEEL_BSP_OK);
    keel_chip_led(KEEL_LED_BLUE, imu.there);
    start_analogue();
    keel_fault_watch(&scheduler);
    start();
    keel_chip_watchdog_start(&scheduler);
    keel_load_begin(&window, 0u, 0u);
    for (;;) {
        require(keel_scheduler_step(&scheduler), FAULT_STEP);
        keel_chip_turn();
        if ((scheduler.clock.now_us - window.start_us) >= REPORT_EVERY_US) {
            print_report(&window);
        }
        if (keel_chip_get(&key)) {
            obey(key);
        }
        turn_table();
        turn_trace();
        keel_board_sleep_us(keel_scheduler_idle_us(&scheduler, KEEL_BOARD_WAKE_US,
                                                   KEEL_BOARD_SLEEP_US));
    }
}
