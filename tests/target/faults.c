/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file faults.c
 * @brief Breaks one thing from within a real-time task, FAULT saying which. tools/keel test-target
 *        builds it once for each and reads from the console what was recorded and that the board
 *        came back in its safe state.
 *
 * A program that gets beyond its fault ends with status 1.
 */
#include "board.h"
#include "console.h"
#include "cortex_m7/core.h"
#include "cortex_m7/fault.h"
#include "keel/rtos/scheduler.h"
#include "mps2_an500/watchdog.h"

#define PERIOD_US   1000u
#define BUDGET_US   100u
#define GUARD_US    20u
#define WATCHDOG_US 5000u
#define CODE        0xC0DE0042u

/* Addresses that the board file and the linker script know. */
#define NOWHERE   0x70000000u
#define WILD      0x00100000u
#define WILD_FAR  0x08300000u /* Behind the STM32F767's flash. */
#define NULL_PAGE 0x00000010u
#define FLASH     0x00200000u
#define NVIC_ISPR 0xE000E200u
#define NVIC_ISER 0xE000E100u

#define WORD(address) (*(volatile uint32_t *)(address))

typedef void (*function_t)(void);

/* A scheduler, and behind the last of its slots what a number that is no slot's would find. */
static struct {
    keel_scheduler_t scheduler;
    const keel_task_config_t *behind[UINT8_MAX];
} memory;

static keel_scheduler_t *const scheduler = &memory.scheduler;
static volatile uint32_t sink;

/* Hides a value from the compiler, which would turn some of these mistakes into others. */
static uint32_t hidden(uint32_t value)
{
    volatile uint32_t copy = value;

    return copy;
}

/* Functions of their own, so that a recorded address can be told to be in one. */
#define BREAKS __attribute__((noinline))

BREAKS void fault_undefined(void);
BREAKS void fault_bus(void);
BREAKS void fault_stack(void);
BREAKS void fault_division(void);
BREAKS void fault_null(void);
BREAKS void fault_execute(void);
BREAKS void fault_write(void);
BREAKS void fault_stop(void);
BREAKS void fault_interrupt(void);
BREAKS void fault_hang(void);
BREAKS void fault_jump(void);
BREAKS void fault_jump_far(void);
BREAKS void fault_lost_slot(void);
BREAKS void fault_lost_task(void);
BREAKS void fault_lost_name(void);

void fault_undefined(void)
{
    __asm volatile("udf #1");
}

void fault_bus(void)
{
    sink = WORD(hidden(NOWHERE));
}

/* Each call takes more of the stack, until the guard. */
void fault_stack(void)
{
    volatile uint32_t frame[32];

    frame[0] = hidden(1u);
    if (frame[0] != 0u) {
        fault_stack();
    }
    sink = frame[0];
}

void fault_division(void)
{
    sink = hidden(7u) / hidden(0u);
}

void fault_null(void)
{
    sink = WORD(hidden(NULL_PAGE));
}

/* A function that returns at once, in memory for data. */
void fault_execute(void)
{
    static const uint16_t code[2] = {0x4770u, 0x4770u}; /* bx lr */
    static uint16_t copy[2];

    copy[0] = code[0];
    copy[1] = code[1];
    ((function_t)(hidden((uint32_t)copy) | 1u))();
}

/* Where there is neither flash nor ITCM. */
void fault_jump(void)
{
    ((function_t)(hidden(WILD) | 1u))();
}

void fault_jump_far(void)
{
    ((function_t)(hidden(WILD_FAR) | 1u))();
}

static const keel_task_config_t **running_task(void)
{
    return &scheduler->queue.task[scheduler->queue.order[scheduler->running]];
}

/* The record's task is looked up by numbers and pointers that may be what is broken. */
void fault_lost_slot(void)
{
    for (uint32_t i = 0u; i < UINT8_MAX; i++) {
        memory.behind[i] = *running_task();
    }
    scheduler->queue.order[scheduler->running] = UINT8_MAX;
    __asm volatile("udf #2");
}

void fault_lost_task(void)
{
    *running_task() = (const keel_task_config_t *)hidden(NOWHERE);
    __asm volatile("udf #2");
}

void fault_lost_name(void)
{
    static keel_task_config_t broken;

    broken = **running_task();
    broken.name = (const char *)hidden(NOWHERE);
    *running_task() = &broken;
    __asm volatile("udf #2");
}

void fault_write(void)
{
    WORD(hidden(FLASH)) = 0u;
}

void fault_stop(void)
{
    keel_fault_stop(CODE);
}

/* Nobody handles interrupt 3. */
void fault_interrupt(void)
{
    WORD(NVIC_ISER) = 1u << 3u;
    WORD(NVIC_ISPR) = 1u << 3u;
    __asm volatile("dsb\n\tisb");
}

/* Never ends, and so never feeds. */
void fault_hang(void)
{
    keel_watchdog_start(WATCHDOG_US);
    for (;;) {
        sink = hidden(0u);
    }
}

static void body(void *context)
{
    (void)context;
    FAULT();
}

static const keel_task_config_t task = {.name = "breaker",
                                        .run = body,
                                        .period_us = PERIOD_US,
                                        .budget_us = BUDGET_US,
                                        .priority = KEEL_PRIORITY_REALTIME};

int main(void)
{
    const keel_scheduler_config_t settings = {.read_clock = keel_board_clock_us,
                                              .guard_us = GUARD_US,
                                              .utilisation_limit_ppm = KEEL_UTILISATION_FULL_PPM};

    keel_fault_watch(scheduler);
    if ((keel_scheduler_init(scheduler, &settings) == KEEL_OK) &&
        (keel_scheduler_add(scheduler, &task) == KEEL_OK) &&
        (keel_scheduler_start(scheduler) == KEEL_OK)) {
        keel_console_text("breaking\n");
        (void)keel_scheduler_step(scheduler);
    }
    keel_console_text("nothing broke\n");
    return 1;
}
