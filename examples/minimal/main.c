/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 199309L /* For the host's clock and sleep. */

#include "keel/rtos/scheduler.h"
#include "keel/rtos/spread.h"
#include "keel/version.h"

#include <stdio.h>
#include <time.h>

#define LATENCY_US 100u    /* How late this host may wake; on a board, a few us. */
#define LONGEST_US 100000u /* How often a watchdog would have to be fed. */

static unsigned runs[3]; /* Of gyro, control and telemetry. */

/* On a board, a timer that counts microseconds and wraps. */
static uint32_t read_clock(void *context)
{
    struct timespec now;

    (void)context;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)(((uint64_t)now.tv_sec * 1000000u) + ((uint64_t)now.tv_nsec / 1000u));
}

/* On a board, the core waits for an interrupt; in an RTOS, its other threads run. */
static void sleep_for_us(uint32_t us)
{
    const struct timespec time = {.tv_sec = 0, .tv_nsec = (long)us * 1000L};

    if (us > 0u) {
        (void)nanosleep(&time, NULL);
    }
}

static void count(void *context)
{
    ++*(unsigned *)context;
}

static const keel_task_config_t tasks[] = {
    {.name = "gyro",
     .run = count,
     .context = &runs[0],
     .period_us = 1000u,
     .budget_us = 50u,
     .priority = KEEL_PRIORITY_REALTIME},
    {.name = "control",
     .run = count,
     .context = &runs[1],
     .period_us = 4000u,
     .budget_us = 200u,
     .priority = KEEL_PRIORITY_HIGH},
    {.name = "telemetry",
     .run = count,
     .context = &runs[2],
     .period_us = 20000u,
     .budget_us = 300u,
     .priority = KEEL_PRIORITY_LOW},
};

int main(void)
{
    static keel_scheduler_t scheduler;
    const keel_scheduler_config_t config = {
        .read_clock = read_clock, .guard_us = 20u, .utilisation_limit_ppm = 700000u, /* 70 % */
    };
    keel_status_t status = keel_scheduler_init(&scheduler, &config);
    uint32_t crowded;

    for (unsigned i = 0u; (i < 3u) && (status == KEEL_OK); i++) {
        status = keel_scheduler_add(&scheduler, &tasks[i]);
    }
    if (status == KEEL_OK) {
        status = keel_scheduler_spread(&scheduler, &crowded); /* Here all find room. */
    }
    if (status == KEEL_OK) {
        status = keel_scheduler_start(&scheduler); /* Refuses a set that cannot hold. */
    }
    while ((status == KEEL_OK) && (runs[2] < 50u)) { /* A second; in an aircraft, for ever. */
        status = keel_scheduler_step(&scheduler);
        sleep_for_us(keel_scheduler_idle_us(&scheduler, LATENCY_US, LONGEST_US));
    }
    printf("Keel %d.%d.%d: gyro %u, control %u, telemetry %u\n", KEEL_VERSION_MAJOR,
           KEEL_VERSION_MINOR, KEEL_VERSION_PATCH, runs[0], runs[1], runs[2]);
    return (status == KEEL_OK) ? 0 : 1;
}
