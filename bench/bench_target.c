/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file bench_target.c
 * @brief Counts the instructions of passes and steps on the emulated Cortex-M7. Started by
 *        tools/keel/bench/emulated.py, which has the emulator take 1024 ns for each instruction.
 *
 * The board's counter then moves by 25.6 ticks of 25 MHz for each, so a difference of two readings,
 * rounded, is exactly the number of instructions between them. What the reading and the call take
 * is measured with a function of one instruction, and taken off.
 *
 * The passes are those of bench_scheduler.c: the tasks of table 2 on a virtual clock, 100 ms of
 * polling, one pass every 5 us. The clock and the tasks' bodies are assembly of known length, which
 * is taken off: what is printed is the kernel's own, with the compiler's library that it calls.
 */
#include "board.h"
#include "common/task_table.h"
#include "common/trace.h"
#include "console.h"
#include "copter.h"
#include "desk.h"
#include "keel/internal/rtos/queue.h"
#include "keel/internal/rtos/stats.h"
#include "keel/rtos/scheduler.h"
#include "keel/rtos/spread.h"
#include "urpilot_tasks.h"
#include "workload.h"

#include <string.h>

#define SIMULATED_US       100000u
#define POLL_US            5u
#define CLOCK_INSTRUCTIONS 5u  /* Of bench_clock. */
#define BODY_INSTRUCTIONS  10u /* Of bench_body. */
#define TICK_NS            40u
#define INSTRUCTION_NS     1024u
#define PRESCALE           (*(volatile uint32_t *)0x4002801Cu)

typedef void (*function_t)(void);

/* What the assembly below reads and writes, by the offsets of its members. */
typedef struct virtual_clock {
    uint32_t now_us;
    uint32_t reads;
} virtual_clock_t;

typedef struct virtual_body {
    virtual_clock_t *clock;
    uint32_t wcet_us;
    uint32_t *runs;
} virtual_body_t;

typedef struct kind {
    const char *name;
    uint32_t passes;
    uint32_t instructions;
    uint32_t longest;
} kind_t;

enum {
    WAITED,
    IDLE,
    REALTIME,
    OTHER,
    SEVERAL, /* Two or three tasks. */
    FOUR,    /* All real-time tasks and another: no pass of this set runs more. */
    KINDS
};

static kind_t kind[KINDS] = {{"waited", 0u, 0u, 0u},   {"idle", 0u, 0u, 0u},
                             {"realtime", 0u, 0u, 0u}, {"other", 0u, 0u, 0u},
                             {"several", 0u, 0u, 0u},  {"four", 0u, 0u, 0u}};

static virtual_clock_t virtual_clock KEEL_REALTIME_ZERO;
static keel_scheduler_t scheduler KEEL_REALTIME_ZERO;
static keel_task_config_t config[URPILOT_TASK_COUNT];
static virtual_body_t body[URPILOT_TASK_COUNT];
static uint32_t ran_realtime;
static uint32_t ran_other;
static uint32_t overhead; /* Instructions of a measurement of nothing. */
static bool bad;

uint32_t bench_clock(void *context);
void bench_body(void *context);
void bench_nothing(void);
uint64_t bench_call(function_t function, const void *first, uint32_t second, uint32_t third);

__attribute__((naked, noinline)) uint32_t bench_clock(void *context)
{
    (void)context;
    __asm volatile("ldr r1, [r0, #4]\n\t"
                   "adds r1, #1\n\t"
                   "str r1, [r0, #4]\n\t"
                   "ldr r0, [r0]\n\t"
                   "bx lr");
}

__attribute__((naked, noinline)) void bench_body(void *context)
{
    (void)context;
    __asm volatile("ldr r1, [r0]\n\t"
                   "ldr r2, [r1]\n\t"
                   "ldr r3, [r0, #4]\n\t"
                   "adds r2, r2, r3\n\t"
                   "str r2, [r1]\n\t"
                   "ldr r1, [r0, #8]\n\t"
                   "ldr r2, [r1]\n\t"
                   "adds r2, #1\n\t"
                   "str r2, [r1]\n\t"
                   "bx lr");
}

__attribute__((naked, noinline)) void bench_nothing(void)
{
    __asm volatile("bx lr");
}

/* Calls a function with up to three arguments (the later two also as floats); gives the ticks that
   passed, and above them what the function returned. */
__attribute__((naked, noinline)) uint64_t bench_call(function_t function, const void *first,
                                                     uint32_t second, uint32_t third)
{
    (void)function;
    (void)first;
    (void)second;
    (void)third;
    __asm volatile("push {r3-r7, lr}\n\t"
                   "mov r4, r0\n\t"
                   "mov r0, r1\n\t"
                   "mov r1, r2\n\t"
                   "mov r2, r3\n\t"
                   "vmov s0, r1\n\t"
                   "vmov s1, r2\n\t"
                   "ldr r6, =0x40028018\n\t"
                   "ldr r5, [r6]\n\t"
                   "blx r4\n\t"
                   "ldr r2, [r6]\n\t"
                   "mov r1, r0\n\t"
                   "subs r0, r2, r5\n\t"
                   "pop {r3-r7, pc}\n\t"
                   ".ltorg");
}

static void require(bool condition)
{
    bad = bad || !condition;
}

/* Ticks as instructions, rounded. */
static uint32_t instructions_of(uint32_t ticks)
{
    return (uint32_t)((((uint64_t)ticks * TICK_NS) + (INSTRUCTION_NS / 2u)) / INSTRUCTION_NS);
}

static uint32_t bits_of(float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* The instructions of one call; its status must be KEEL_OK if there is one. */
static uint32_t measure(function_t function, const void *first, uint32_t second, uint32_t third,
                        bool has_status)
{
    const uint64_t both = bench_call(function, first, second, third);

    require(!has_status || ((both >> 32) == (uint64_t)KEEL_OK));
    return instructions_of((uint32_t)both) - overhead;
}

static void add(kind_t *to, uint32_t instructions)
{
    to->passes++;
    to->instructions += instructions;
    to->longest = (instructions > to->longest) ? instructions : to->longest;
}

static void print(const kind_t *of)
{
    keel_console_text("bench ");
    keel_console_text(of->name);
    keel_console_text(" passes ");
    keel_console_number(of->passes);
    keel_console_text(" instructions ");
    keel_console_number(of->instructions);
    keel_console_text(" longest ");
    keel_console_number(of->longest);
    keel_console_text("\n");
}

/* --- Passes ----------------------------------------------------------------------------------- */

static void setup_scheduler(void)
{
    const keel_scheduler_config_t settings = urpilot_scheduler_config(bench_clock, &virtual_clock);

    require(keel_scheduler_init(&scheduler, &settings) == KEEL_OK);
    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        const urpilot_task_t *const row = &urpilot_task[i];
        const bool realtime = row->priority == KEEL_PRIORITY_REALTIME;

        body[i] = (virtual_body_t){&virtual_clock, row->wcet_us,
                                   realtime ? &ran_realtime : &ran_other};
        config[i] = urpilot_task_config(i, bench_body, &body[i]);
        config[i].phase_us = 0u; /* All released together: the longest passes. */
        require(keel_scheduler_add(&scheduler, &config[i]) == KEEL_OK);
    }
    require(keel_scheduler_start(&scheduler) == KEEL_OK);
}

static kind_t *kind_of(bool waits)
{
    const uint32_t ran = ran_realtime + ran_other;

    if (ran == 0u) {
        return waits ? &kind[WAITED] : &kind[IDLE];
    }
    require(ran <= 4u);
    if (ran > 1u) {
        return (ran == 4u) ? &kind[FOUR] : &kind[SEVERAL];
    }
    return (ran_realtime == 1u) ? &kind[REALTIME] : &kind[OTHER];
}

static void bench_pass(void)
{
    const bool waits = virtual_clock.now_us < scheduler.wake_us;
    uint32_t instructions;

    ran_realtime = 0u;
    ran_other = 0u;
    virtual_clock.reads = 0u;
    instructions = measure((function_t)keel_scheduler_step, &scheduler, 0u, 0u, true);
    instructions -= CLOCK_INSTRUCTIONS * virtual_clock.reads;
    instructions -= BODY_INSTRUCTIONS * (ran_realtime + ran_other);
    add(kind_of(waits), instructions);
}

static void bench_passes(void)
{
    setup_scheduler();
    while (virtual_clock.now_us < SIMULATED_US) {
        bench_pass();
        virtual_clock.now_us += POLL_US;
    }
    for (uint32_t i = 0u; i < KINDS; i++) {
        print(&kind[i]);
    }
}

/* --- Steps ------------------------------------------------------------------------------------ */

static void bench_filter(void)
{
    static keel_filter_t filter KEEL_REALTIME_ZERO;
    kind_t steps = {"filter", 0u, 0u, 0u};

    require(keel_filter_init(&filter, 1000.0f, 80.0f) == KEEL_OK);
    for (uint32_t n = 0u; n < STEPS; n++) {
        add(&steps,
            measure((function_t)keel_filter_step, &filter, bits_of(signal_at(n)), 0u, true));
    }
    print(&steps);
}

static void bench_pid(void)
{
    static keel_pid_t pid KEEL_REALTIME_ZERO;
    kind_t steps = {"pid", 0u, 0u, 0u};

    require(keel_pid_init(&pid, &pid_workload) == KEEL_OK);
    require(keel_pid_step(&pid, 0.5f, 0.5f) == KEEL_OK);
    for (uint32_t n = 0u; n < STEPS; n++) {
        add(&steps,
            measure((function_t)keel_pid_step, &pid, bits_of(0.5f), bits_of(signal_at(n)), true));
    }
    print(&steps);
}

static void bench_reference(void)
{
    static keel_reference_t reference KEEL_REALTIME_ZERO;
    kind_t steps = {"reference", 0u, 0u, 0u};

    require(keel_reference_init(&reference, &reference_workload) == KEEL_OK);
    for (uint32_t n = 0u; n < STEPS; n++) {
        keel_reference_sticks_t sticks = sticks_at(n);

        add(&steps,
            measure((function_t)keel_reference_step, &reference, (uint32_t)&sticks, 0u, true));
    }
    print(&steps);
}

static void bench_mixer(const char *name, float torque, uint8_t limited)
{
    static keel_mixer_t mixer KEEL_REALTIME_ZERO;
    const keel_mixer_config_t settings = {keel_mixer_quad_x, 0.05f, 1.0f, 0.1f};
    kind_t steps = {name, 0u, 0u, 0u};

    require(keel_mixer_init(&mixer, &settings) == KEEL_OK);
    for (uint32_t n = 0u; n < STEPS; n++) {
        const keel_mixer_command_t command = command_at(n, torque);

        add(&steps, measure((function_t)keel_mixer_step, &mixer, (uint32_t)&command, 1u, false));
        require((mixer.limited & (KEEL_MIXER_YAW | KEEL_MIXER_TILT)) == limited);
    }
    print(&steps);
}

static void bench_attitude(void)
{
    static keel_attitude_t attitude KEEL_REALTIME_ZERO;
    kind_t steps = {"attitude", 0u, 0u, 0u};

    require(keel_attitude_init(&attitude, &attitude_workload) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        keel_attitude_sample_t sample = attitude_sample_at(n);

        if (n < STEPS) {
            keel_attitude_step(&attitude, &sample);
        } else {
            require(attitude.heading_valid);
            add(&steps,
                measure((function_t)keel_attitude_step, &attitude, (uint32_t)&sample, 0u, false));
        }
    }
    print(&steps);
}

static void bench_cascade(void)
{
    static keel_cascade_t cascade KEEL_REALTIME_ZERO;
    const keel_cascade_config_t config = cascade_workload();
    kind_t steps = {"cascade", 0u, 0u, 0u};

    require(keel_cascade_init(&cascade, &config) == KEEL_OK);
    keel_cascade_enter(&cascade, KEEL_MODE_RETURN);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        keel_cascade_estimate_t estimate = place_at(n);

        if (n < STEPS) {
            bench_cascade_steps(&cascade, &estimate);
        } else {
            add(&steps,
                measure((function_t)bench_cascade_steps, &cascade, (uint32_t)&estimate, 0u, false));
            require(cascade.axis[KEEL_CASCADE_NORTH].running);
        }
    }
    print(&steps);
}

static void bench_altitude(void)
{
    static keel_altitude_t altitude KEEL_REALTIME_ZERO;
    kind_t steps = {"altitude", 0u, 0u, 0u};

    require(keel_altitude_init(&altitude, &altitude_workload) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        keel_altitude_sample_t sample = altitude_sample_at(n);

        if (n < STEPS) {
            keel_altitude_step(&altitude, &sample);
        } else {
            require(altitude.axis.quality == KEEL_AXIS_GOOD);
            add(&steps,
                measure((function_t)keel_altitude_step, &altitude, (uint32_t)&sample, 0u, false));
        }
    }
    print(&steps);
}

static void bench_position(void)
{
    static keel_position_t position KEEL_REALTIME_ZERO;
    kind_t steps = {"position", 0u, 0u, 0u};

    require(keel_position_init(&position, &position_workload) == KEEL_OK);
    require(keel_position_set_origin(&position, 481000000, 115000000) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        keel_position_sample_t sample = position_sample_at(n);

        if (n < STEPS) {
            keel_position_step(&position, &sample);
        } else {
            require(position.quality == KEEL_AXIS_GOOD);
            add(&steps,
                measure((function_t)keel_position_step, &position, (uint32_t)&sample, 0u, false));
        }
    }
    print(&steps);
}

static void bench_battery(void)
{
    static keel_battery_t battery KEEL_REALTIME_ZERO;
    kind_t steps = {"battery", 0u, 0u, 0u};

    require(keel_battery_init(&battery, &battery_workload) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        keel_battery_sample_t sample = battery_sample_at(n);

        if (n < STEPS) {
            keel_battery_step(&battery, &sample);
        } else {
            require(battery.level == KEEL_BATTERY_OK);
            add(&steps,
                measure((function_t)keel_battery_step, &battery, (uint32_t)&sample, 0u, false));
        }
    }
    print(&steps);
}

static void bench_calibration(void)
{
    static keel_calibration_rest_t calibration KEEL_REALTIME_ZERO;
    kind_t steps = {"calibration", 0u, 0u, 0u};

    require(keel_calibration_rest_init(&calibration, &calibration_workload) == KEEL_OK);
    keel_calibration_rest_begin(&calibration);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        keel_calibration_vector_t sample = calibration_sample_at(n);

        if (n < STEPS) {
            keel_calibration_rest_step(&calibration, sample.axis);
        } else {
            require(calibration.count == n);
            add(&steps, measure((function_t)keel_calibration_rest_step, &calibration,
                                (uint32_t)sample.axis, 0u, false));
        }
    }
    print(&steps);
}

/* The argument that bench_call has no room for is a constant. */
static void bench_ms5611_sample(keel_ms5611_sample_t *sample, uint32_t d1, uint32_t d2)
{
    (void)keel_ms5611_compensate(&ms5611_workload, d1, d2, sample);
}

static void bench_ms5611(void)
{
    keel_ms5611_sample_t sample = {0};
    kind_t steps = {"ms5611", 0u, 0u, 0u};

    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const uint32_t d1 = ms5611_pressure_at(n);
        const uint32_t d2 = ms5611_temperature_at(n);

        if (n < STEPS) {
            bench_ms5611_sample(&sample, d1, d2);
        } else {
            add(&steps, measure((function_t)bench_ms5611_sample, &sample, d1, d2, false));
        }
    }
    require(sample.temperature_cdeg < -1500);
    print(&steps);
}

static void bench_sbus(const char *name, bool noise)
{
    static keel_sbus_t sbus KEEL_REALTIME_ZERO;
    kind_t steps = {name, 0u, 0u, 0u};

    require(keel_sbus_init(&sbus, &sbus_workload) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const uint8_t byte = noise ? (uint8_t)KEEL_SBUS_HEADER : sbus_byte_at(n);

        if (n < STEPS) {
            (void)keel_sbus_take(&sbus, byte, 120u);
        } else {
            add(&steps, measure((function_t)keel_sbus_take, &sbus, byte, 120u, false));
        }
    }
    require(noise == (sbus.count.frames == 0u));
    print(&steps);
}

static void bench_ubx(void)
{
    static keel_ubx_t ubx KEEL_REALTIME_ZERO;
    kind_t steps = {"ubx", 0u, 0u, 0u};

    require(keel_ubx_init(&ubx, &ubx_workload) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const uint8_t byte = ubx_byte_at(n);

        if (n < STEPS) {
            (void)keel_ubx_take(&ubx, byte, 87u);
        } else {
            add(&steps, measure((function_t)keel_ubx_take, &ubx, byte, 87u, false));
        }
    }
    require(ubx.count.fixes == ((2u * STEPS) / 100u));
    print(&steps);
}

static void bench_log_ring(void)
{
    static keel_log_ring_t ring KEEL_REALTIME_ZERO;
    uint8_t read[LOG_RECORD];
    kind_t steps = {"log_ring", 0u, 0u, 0u};

    keel_log_ring_init(&ring);
    for (uint32_t n = 0u; n < STEPS; n++) {
        add(&steps, measure((function_t)keel_log_ring_write, &ring, (uint32_t)log_workload,
                            LOG_RECORD, false));
        require(keel_log_ring_read(&ring, read, LOG_RECORD) == LOG_RECORD);
    }
    print(&steps);
}

static void bench_ulog(void)
{
    static keel_ulog_message_t message KEEL_REALTIME_ZERO;
    kind_t steps = {"ulog", 0u, 0u, 0u};

    for (uint32_t n = 0u; n < STEPS; n++) {
        keel_ulog_data(&message, 1u);
        add(&steps, measure((function_t)keel_ulog_add, &message, (uint32_t)log_workload, LOG_RECORD,
                            false));
        require(message.size > LOG_RECORD);
    }
    print(&steps);
}

/* What a run costs that is traced, the clock's reading included. */
static void traced_run(keel_trace_t *trace, const keel_scheduler_t *of, keel_log_ring_t *ring)
{
    keel_trace_begin(trace, of);
    keel_trace_end(trace, of);
    keel_trace_store(trace, ring);
}

static void bench_trace(void)
{
    static keel_scheduler_t traced KEEL_REALTIME_ZERO;
    static keel_trace_t trace KEEL_REALTIME_ZERO;
    static keel_log_ring_t ring KEEL_REALTIME_ZERO;
    const keel_task_config_t task = {.run = bench_body,
                                     .period_us = POLL_US,
                                     .budget_us = 1u,
                                     .priority = KEEL_PRIORITY_REALTIME};
    uint8_t read[KEEL_TRACE_RUN_BYTES];
    kind_t steps = {"trace", 0u, 0u, 0u};

    traced.config.read_clock = bench_clock;
    traced.config.clock_context = &virtual_clock;
    keel_queue_init(&traced.queue);
    keel_queue_add(&traced.queue, &task, 0u);
    keel_trace_start(&trace, &traced);
    keel_log_ring_init(&ring);
    for (uint32_t n = 0u; n < STEPS; n++) {
        keel_queue_advance(&traced.queue, 0u, traced.clock.now_us);
        add(&steps,
            measure((function_t)traced_run, &trace, (uint32_t)&traced, (uint32_t)&ring, false));
        require(keel_log_ring_read(&ring, read, sizeof read) == KEEL_TRACE_RUN_BYTES);
        traced.queue.stats[0].runs++;
        traced.clock.now_us += POLL_US;
    }
    require(trace.run.late_us == 0u);
    print(&steps);
}

/* What a run costs whose lateness is counted. */
static void counted_run(keel_trace_t *trace, const keel_scheduler_t *of, keel_task_table_t *table)
{
    keel_trace_begin(trace, of);
    keel_task_table_add(table, &trace->run);
}

static const keel_task_table_t *table_of; /* The table whose line is made. */

static void table_line(const keel_scheduler_t *of, char *line)
{
    (void)keel_task_table_line(table_of, of, 2u, line);
}

/* A line of the table of tasks, and before it the run that it tells of. */
static void bench_table(void)
{
    static keel_scheduler_t counted KEEL_REALTIME_ZERO;
    static keel_trace_t trace KEEL_REALTIME_ZERO;
    static keel_task_table_t table KEEL_REALTIME_ZERO;
    const keel_task_config_t task = {.name = "Background IMU",
                                     .run = bench_body,
                                     .period_us = POLL_US,
                                     .budget_us = 1u,
                                     .priority = KEEL_PRIORITY_REALTIME};
    char line[KEEL_TASK_TABLE_LINE];
    kind_t runs = {"lateness", 0u, 0u, 0u};
    kind_t lines = {"table_line", 0u, 0u, 0u};

    keel_queue_init(&counted.queue);
    keel_queue_add(&counted.queue, &task, 0u);
    for (uint32_t n = 0u; n < STEPS; n++) {
        keel_queue_advance(&counted.queue, 0u, counted.clock.now_us);
        add(&runs,
            measure((function_t)counted_run, &trace, (uint32_t)&counted, (uint32_t)&table, false));
        keel_stats_record(&counted.queue.stats[0], n, POLL_US);
        counted.clock.now_us += POLL_US;
        table_of = &table;
        add(&lines, measure((function_t)table_line, &counted, (uint32_t)line, 0u, false));
        require(line[0] == 'B');
    }
    require(table.late[0][0] == STEPS);
    print(&runs);
    print(&lines);
}

/* The 21 tasks of table 2, all released together until then. */
static void bench_spread(void)
{
    static keel_scheduler_t spread KEEL_REALTIME_ZERO;
    const keel_scheduler_config_t settings = urpilot_scheduler_config(bench_clock, &virtual_clock);
    uint32_t crowded = UINT32_MAX;
    kind_t once = {"spread", 0u, 0u, 0u};

    require(keel_scheduler_init(&spread, &settings) == KEEL_OK);
    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        require(keel_scheduler_add(&spread, &config[i]) == KEEL_OK);
    }
    add(&once, measure((function_t)keel_scheduler_spread, &spread, (uint32_t)&crowded, 0u, true));
    require(crowded == 0u);
    print(&once);
}

static uint32_t read_mavlink(keel_mavlink_t *mavlink, uint32_t byte)
{
    (void)keel_mavlink_take(mavlink, (uint8_t)byte);
    while (keel_mavlink_look(mavlink) != KEEL_MAVLINK_NOTHING) {
    }
    return byte;
}

static void bench_mavlink(void)
{
    static keel_mavlink_t mavlink KEEL_REALTIME_ZERO;
    kind_t steps = {"mavlink", 0u, 0u, 0u};

    require(keel_mavlink_init(&mavlink, mavlink_workload, 1u) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        const uint8_t byte = mavlink_byte_at(n);

        if (n < STEPS) {
            (void)read_mavlink(&mavlink, byte);
        } else {
            add(&steps, measure((function_t)read_mavlink, &mavlink, byte, 0u, false));
        }
    }
    require(mavlink.count.frames > 0u);
    print(&steps);
}

static void bench_signing(void)
{
    static keel_signing_t signing KEEL_REALTIME_ZERO;
    static keel_mavlink_frame_t frame KEEL_REALTIME_ZERO;
    kind_t steps = {"signing", 0u, 0u, 0u};

    frame = signing_workload;
    keel_signing_init(&signing, 1u, bench_hash);
    keel_signing_set_key(&signing, signing_key);
    for (uint32_t n = 0u; n < STEPS; n++) {
        frame.timestamp = (uint64_t)n + 1u;
        add(&steps,
            measure((function_t)keel_signing_accepts, &signing, (uint32_t)&frame, 0u, false));
    }
    require(signing.count.accepted == STEPS);
    print(&steps);
}

static void bench_crsf(void)
{
    static keel_crsf_t crsf KEEL_REALTIME_ZERO;
    kind_t steps = {"crsf", 0u, 0u, 0u};

    require(keel_crsf_init(&crsf, &crsf_workload) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        if (n < STEPS) {
            (void)keel_crsf_take(&crsf, crsf_byte_at(n), 24u);
        } else {
            add(&steps, measure((function_t)keel_crsf_take, &crsf, crsf_byte_at(n), 24u, false));
        }
    }
    require(crsf.count.channels == ((2u * STEPS) / 26u));
    print(&steps);
}

static void bench_ibus(void)
{
    static keel_ibus_t ibus KEEL_REALTIME_ZERO;
    kind_t steps = {"ibus", 0u, 0u, 0u};

    require(keel_ibus_init(&ibus, &ibus_workload) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        if (n < STEPS) {
            (void)keel_ibus_take(&ibus, ibus_byte_at(n), 87u);
        } else {
            add(&steps, measure((function_t)keel_ibus_take, &ibus, ibus_byte_at(n), 87u, false));
        }
    }
    require(ibus.count.frames == ((2u * STEPS) / 32u));
    print(&steps);
}

static void bench_ppm(void)
{
    static keel_ppm_t ppm KEEL_REALTIME_ZERO;
    kind_t steps = {"ppm", 0u, 0u, 0u};

    require(keel_ppm_init(&ppm, &ppm_workload) == KEEL_OK);
    for (uint32_t n = 0u; n < (2u * STEPS); n++) {
        if (n < STEPS) {
            (void)keel_ppm_take(&ppm, ppm_edge_at(n));
        } else {
            add(&steps, measure((function_t)keel_ppm_take, &ppm, ppm_edge_at(n), 0u, false));
        }
    }
    require(ppm.channels == 8u);
    print(&steps);
}

static void bench_mode(const char *name, uint32_t settle_us, uint8_t state)
{
    static keel_mode_t mode KEEL_REALTIME_ZERO;
    keel_mode_input_t input = mode_workload(&mode, settle_us, state == KEEL_MODE_FLYING);
    kind_t steps = {name, 0u, 0u, 0u};

    for (uint32_t n = 0u; n < STEPS; n++) {
        add(&steps, measure((function_t)keel_mode_step, &mode, (uint32_t)&input, 0u, false));
        require(mode.state == state);
    }
    print(&steps);
}

static void bench_imu(const char *name, float offset, uint8_t contributing)
{
    static keel_virtual_imu_t imu KEEL_REALTIME_ZERO;
    static keel_virtual_imu_sample_t sample[UNITS];
    const keel_virtual_imu_config_t settings = {voter_workload, voter_workload};
    kind_t steps = {name, 0u, 0u, 0u};

    require(keel_virtual_imu_init(&imu, &settings) == KEEL_OK);
    for (uint32_t n = 0u; n < STEPS; n++) {
        samples_at(sample, n, offset);
        add(&steps,
            measure((function_t)keel_virtual_imu_step, &imu, (uint32_t)sample, 1000u, false));
        for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
            require(imu.channel[k].vote.contributing == contributing);
        }
    }
    print(&steps);
}

/* --- Tasks ------------------------------------------------------------------------------------ */

/* The copter lies on its desk, armed and flown by position, in the second that is counted. */
#define TASKS_FROM_US 9000000u
#define TASKS_TO_US   10000000u
#define TASKS_STEP_US 1000u

static uint32_t bench_desk_clock(void *context)
{
    return *(const uint32_t *)context;
}

/* A task's name as the figures have it: in small letters, joined by underscores. */
static const char *figure_of(const char *task)
{
    static char name[40] = "task_";
    uint32_t i = 5u;

    for (; (*task != '\0') && (i < (sizeof name - 1u)); i++, task++) {
        const char c = *task;

        name[i] = ((c >= 'A') && (c <= 'Z')) ? (char)(c - 'A' + 'a') : ((c == ' ') ? '_' : c);
    }
    name[i] = '\0';
    return name;
}

/* The bodies of the 21 tasks, each at its period, in the order of the queue. The desk's devices are
 * in their figures. */
static void bench_tasks(void)
{
    static copter_t copter KEEL_REALTIME_ZERO;
    static kind_t bodies[URPILOT_TASK_COUNT];
    uint32_t now_us = 0u;
    desk_t desk;
    const copter_port_t port = desk_port(&desk, bench_desk_clock, &now_us);

    require(copter_start(&copter, &port, false) == KEEL_OK);
    for (; now_us < TASKS_TO_US; now_us += TASKS_STEP_US) {
        copter.scheduler.clock.now_us = now_us;
        for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
            const bool due = (now_us % urpilot_task[i].period_us) == 0u;

            if (due && (now_us < TASKS_FROM_US)) {
                copter.task[i].body(&copter);
            } else if (due) {
                add(&bodies[i], measure((function_t)copter.task[i].body, &copter, 0u, 0u, false));
            } else {
                /* It waits. */
            }
        }
    }
    require(copter.state.mode.state == KEEL_MODE_FLYING);
    for (uint32_t i = 0u; i < URPILOT_TASK_COUNT; i++) {
        bodies[i].name = figure_of(urpilot_task[i].name);
        print(&bodies[i]);
    }
}

/* What is known: nothing at all, and the two pieces of assembly. */
static void bench_known(void)
{
    virtual_body_t first = {&virtual_clock, 0u, &ran_other};
    kind_t known = {"known", 0u, 0u, 0u};

    overhead = instructions_of((uint32_t)bench_call(bench_nothing, NULL, 0u, 0u)) - 1u;
    add(&known, measure(bench_nothing, NULL, 0u, 0u, false));
    require(known.instructions == 1u);
    add(&known, measure((function_t)bench_clock, &virtual_clock, 0u, 0u, false));
    require(known.instructions == (1u + CLOCK_INSTRUCTIONS));
    add(&known, measure((function_t)bench_body, &first, 0u, 0u, false));
    require(known.instructions == (1u + CLOCK_INSTRUCTIONS + BODY_INSTRUCTIONS));
    print(&known);
}

int main(void)
{
    PRESCALE = 0u; /* All of the 25 MHz. */
    bench_known();
    bench_passes();
    bench_filter();
    bench_pid();
    bench_reference();
    bench_mixer("mixer", 0.05f, 0u);
    bench_mixer("mixer_worst", 0.4f, KEEL_MIXER_YAW | KEEL_MIXER_TILT);
    bench_mode("mode", 250000u, KEEL_MODE_FLYING);
    bench_mode("mode_worst", KEEL_MODE_TIME_MOST_US, KEEL_MODE_DISARMED);
    bench_attitude();
    bench_cascade();
    bench_altitude();
    bench_position();
    bench_battery();
    bench_calibration();
    bench_ms5611();
    bench_sbus("sbus", false);
    bench_sbus("sbus_worst", true);
    bench_ubx();
    bench_log_ring();
    bench_ulog();
    bench_trace();
    bench_table();
    bench_spread();
    bench_mavlink();
    bench_signing();
    bench_crsf();
    bench_ibus();
    bench_ppm();
    bench_imu("imu", 0.0f, UNITS);
    bench_imu("imu_worst", 10.0f, UNITS - 1u);
    bench_tasks();
    keel_console_text(bad ? "bench failed\n" : "bench ended\n");
    return bad ? 1 : 0;
}
