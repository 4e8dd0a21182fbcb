/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file main.c
 * @brief Records the inertial sensor on the board's SD card, a thousand samples a second.
 *
 * The image that shows whether a card works: pull the supply at any moment, put the card into a PC,
 * and LOG00001.ULG has all but the last second. Two tasks do it. The one reads the sensor and puts
 * a record into a ring; the other moves the ring's bytes into the black box, and lets that do its
 * next step, which writes one sector at most. A line on the console tells every second how it goes.
 *
 * recorder.toml has the tasks as `make analyze` analyses them.
 *
 * Keys: q ends the recording and the file, as an aircraft does on the ground.
 */
#include "board.h"
#include "console.h"
#include "cortex_m7/fault.h"
#include "cortex_m7/startup.h"
#include "fatfs/black_box.h"
#include "keel/middleware/log_ring.h"
#include "keel/middleware/ulog.h"
#include "keel/rtos/scheduler.h"
#include "stm32f767/target/chip.h"

#define REPORT_EVERY_US 1000000u
#define GUARD_US        20u
#define LIMIT_PPM       700000u
#define MIB             0x100000u
#define ALLOCATION      (64u * MIB) /* Some 40 minutes. */
#define CHUNK_BYTES     512u
#define CHUNKS          2u      /* In a run of the recorder: 200 kB/s, of which 27 are needed. */
#define DRAIN_RUNS      100000u /* A look at a busy card takes 6 us: half a second. */
#define SAMPLE_SHORTS   7u
#define TIME_BYTES      8u
#define NUMBER          0u /* The topic's. */

/* What keel_fault_stop records. */
#define FAULT_SETUP 0xDE400001u
#define FAULT_STEP  0xDE400002u

/* The sensor, and what was met. */
typedef struct sensor_state {
    keel_bsp_status_t status;
    uint32_t samples;
    uint32_t failures;
} sensor_state_t;

static keel_scheduler_t scheduler KEEL_REALTIME_ZERO;
static keel_log_ring_t ring KEEL_REALTIME_ZERO;
static keel_ulog_message_t message KEEL_REALTIME_ZERO;
static sensor_state_t imu KEEL_REALTIME_ZERO;
static keel_disk_t disk;
static keel_black_box_t box;
static uint32_t lost; /* Records that found no room, as far as the log tells. */

static const keel_ulog_format_t format = {
    .name = {"sensor_imu"},
    .fields = 4u,
    .field = {{.name = {"timestamp"}, .type = KEEL_ULOG_UINT64, .count = 1u},
              {.name = {"acceleration"}, .type = KEEL_ULOG_INT16, .count = 3u},
              {.name = {"temperature_cdeg"}, .type = KEEL_ULOG_INT16, .count = 1u},
              {.name = {"rate"}, .type = KEEL_ULOG_INT16, .count = 3u}},
};

static void require(keel_status_t status, uint32_t code)
{
    if (status != KEEL_OK) {
        keel_fault_stop(code);
    }
}

/* --- The record. --- */

/* The message goes into the ring; when there is room again, behind what tells how long there was
 * none. */
static void store(uint64_t now_us)
{
    static keel_ulog_message_t dropout KEEL_REALTIME_ZERO;
    keel_log_ring_loss_t loss;

    if (keel_log_ring_take_loss(&ring, KEEL_ULOG_DROPOUT_BYTES + message.size, &loss)) {
        keel_ulog_dropout(&dropout, now_us - loss.since_us);
        (void)keel_log_ring_write(&ring, dropout.bytes, dropout.size, now_us);
        lost += loss.records;
    }
    (void)keel_log_ring_write(&ring, message.bytes, message.size, now_us);
}

static void store_head(void)
{
    keel_ulog_begin(&message, 0u);
    store(0u);
    keel_ulog_flags(&message);
    store(0u);
    (void)keel_ulog_format(&message, &format);
    store(0u);
    keel_ulog_subscription(&message, 0u, (uint16_t)NUMBER, &format.name);
    store(0u);
}

/* Little-endian, as ULog and this processor have it. */
static void store_sample(const keel_inertial_sample_t *sample, uint64_t now_us)
{
    const int16_t values[SAMPLE_SHORTS] = {
        sample->acceleration[0],  sample->acceleration[1], sample->acceleration[2],
        sample->temperature_cdeg, sample->rate[0],         sample->rate[1],
        sample->rate[2],
    };

    keel_ulog_data(&message, (uint16_t)NUMBER);
    (void)keel_ulog_add(&message, (const uint8_t *)&now_us, (uint16_t)TIME_BYTES);
    (void)keel_ulog_add(&message, (const uint8_t *)values, (uint16_t)sizeof values);
    store(now_us);
}

/* --- The tasks. --- */

KEEL_REALTIME_CODE static void imu_body(void *context)
{
    keel_inertial_sample_t sample;

    (void)context;
    if (keel_chip_inertial_read(0u, &sample) == KEEL_BSP_OK) {
        imu.samples++;
        store_sample(&sample, scheduler.clock.now_us);
    } else {
        imu.failures++;
    }
}

static void recorder_body(void *context)
{
    uint8_t chunk[CHUNK_BYTES];

    (void)context;
    for (uint32_t i = 0u; i < CHUNKS; i++) {
        const uint32_t room = keel_black_box_room(&box);
        const uint32_t most = (room < CHUNK_BYTES) ? room : CHUNK_BYTES;

        (void)keel_black_box_write(&box, chunk, keel_log_ring_read(&ring, chunk, most));
    }
    (void)keel_black_box_step(&box, keel_board_clock_us(NULL));
}

static const keel_task_config_t task[] = {
    {.name = "IMU",
     .run = imu_body,
     .period_us = 1000u,
     .budget_us = 82u,
     .phase_us = 0u,
     .priority = KEEL_PRIORITY_REALTIME},
    {.name = "Recorder",
     .run = recorder_body,
     .period_us = 5000u,
     .budget_us = 212u,
     .phase_us = 200u,
     .priority = KEEL_PRIORITY_LOW},
};

static void start(void)
{
    const keel_scheduler_config_t config = {.read_clock = keel_board_clock_us,
                                            .guard_us = GUARD_US,
                                            .utilisation_limit_ppm = LIMIT_PPM};

    require(keel_scheduler_init(&scheduler, &config), FAULT_SETUP);
    for (uint32_t i = 0u; i < (sizeof task / sizeof task[0]); i++) {
        require(keel_scheduler_add(&scheduler, &task[i]), FAULT_SETUP);
    }
    require(keel_scheduler_start(&scheduler), FAULT_SETUP);
}

/* --- The console. --- */

static void print_number(const char *label, uint64_t value)
{
    keel_console_text(label);
    keel_console_number(value);
}

static void print_report(void)
{
    print_number("t ", scheduler.clock.now_us / REPORT_EVERY_US);
    print_number(" s samples ", imu.samples);
    print_number(" failed ", imu.failures);
    print_number(" lost ", lost);
    print_number(" box ", (uint64_t)box.state);
    print_number(" kept ", box.kept);
    print_number(" of ", box.taken);
    print_number(" busy ", box.count.busy);
    print_number(" errors ", box.count.errors);
    keel_console_text("\n");
}

static void open_box(void)
{
    const keel_black_box_config_t config = {&disk, ALLOCATION, 1u};
    keel_card_result_t result;

    if (!keel_chip_card(&disk)) {
        keel_console_text("this board has no slot for a card\n");
        keel_board_halt(1);
    }
    require(keel_black_box_init(&box, &config), FAULT_SETUP);
    result = keel_black_box_open(&box, keel_board_clock_us(NULL));
    print_number("card status ", (uint64_t)result);
    print_number(" file ", (result == KEEL_CARD_OK) ? box.file.number : 0u);
    keel_console_text("\n");
}

/* The bytes in the ring go into the file as well. Closing waits for the card, for longer than a
 * watchdog would: this image starts none. */
static void end(void)
{
    for (uint32_t i = 0u; (i < DRAIN_RUNS) && (keel_log_ring_held(&ring) != 0u); i++) {
        recorder_body(NULL);
    }
    print_number("closed, status ", (uint64_t)keel_black_box_close(&box));
    print_number(", bytes ", box.taken);
    keel_console_text("\n");
    keel_board_halt(0);
}

int main(void)
{
    uint64_t reported_us = 0u;
    char key;

    keel_console_text("Keel on ");
    keel_console_text(keel_board_name);
    keel_console_text(": recorder\n");
    keel_chip_inertial_begin();
    imu.status = keel_chip_inertial_start(0u);
    print_number("sensor status ", (uint64_t)imu.status);
    keel_console_text("\n");
    keel_log_ring_init(&ring);
    open_box();
    store_head();
    start();
    for (;;) {
        require(keel_scheduler_step(&scheduler), FAULT_STEP);
        keel_chip_turn();
        if ((scheduler.clock.now_us - reported_us) >= REPORT_EVERY_US) {
            reported_us = scheduler.clock.now_us;
            print_report();
        }
        if (keel_chip_get(&key) && (key == 'q')) {
            end();
        }
        keel_board_sleep_us(keel_scheduler_idle_us(&scheduler, KEEL_BOARD_WAKE_US,
                                                   KEEL_BOARD_SLEEP_US));
    }
}
