/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file experiment.c
 * @brief Runs task sets on the virtual board, as told on standard input, and tells what happened.
 *
 * Input, one order a line; times in us, costs in ns:
 *
 *     policy keel|spread|edf|unguarded|paper|literal|ungated   spread: Keel, which finds the phases
 *     model constant|uniform|heavy|either
 *     costs TURN PASS DISPATCH
 *     set SEED DURATION FIRST GUARD LIMIT SKIP WITHOUT   the counter's first reading; the limit of
 *                                          utilisation, in ppm; SKIP 0 makes every turn; WITHOUT 1
 *                                          promotes nothing
 *     task PRIORITY PERIOD BUDGET WORK PHASE   BUDGET is declared, WORK is the longest run
 *     spike TASK RUN WORK                      one run that takes so long
 *     chain N TASK ... TASK                    a path from a sensor to an actuator
 *     run                                      and forget all of the above
 *
 * Output: one JSON object a line for each run, times in ns.
 *
 * Exit status: 0, or 1 for an order that is not understood.
 */
#include "bsp/host/host_board.h"
#include "keel/rtos/lateness.h"
#include "keel/rtos/load.h"
#include "keel/rtos/spread.h"
#include "rivals.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES   1000u /* Periods that eq. 15 is taken over. */
#define WINDOW_US 100000u
#define CHAINS    16u
#define LINE_SIZE 512u
#define NO_SAMPLE UINT64_MAX

typedef enum model {
    MODEL_CONSTANT,
    MODEL_UNIFORM, /* 50 % to 100 % of the longest run. */
    MODEL_HEAVY,   /* Pareto from 50 % on, shape 6, cut at 200 %: 1.6 % exceed the longest run. */
    MODEL_EITHER   /* The longest run, or next to nothing. */
} model_t;

typedef struct experiment experiment_t;

/* A task, and what is watched about it. */
typedef struct actor {
    experiment_t *experiment;
    keel_task_config_t config; /* Its address is the task. */
    uint32_t number;
    uint64_t work_ns;
    uint64_t spike_run, spike_ns;
    uint64_t runs, late;
    uint64_t due_us;            /* The release that its next run serves. */
    uint64_t first_ns, last_ns; /* Starts. */
    uint64_t longest_gap_ns;    /* Between two starts. */
    uint64_t worst_ns;          /* Response. */
    keel_lateness_t told;       /* By the kernel, before the start. */
    bool admitted;              /* It told anything. */
    double squares;             /* Of the deviations of its first periods. */
    uint64_t deviations;        /* How many periods these are. */
} actor_t;

/* A path: what each task of it last handed on is the time at which its sample was taken. */
typedef struct chain {
    uint32_t length;
    uint32_t task[KEEL_QUEUE_CAPACITY];
    uint64_t input[KEEL_QUEUE_CAPACITY], output[KEEL_QUEUE_CAPACITY];
    uint64_t latest; /* The sample behind the actuator's present value. */
    uint64_t outputs;
    uint64_t reaction_ns, freshness_ns;
    uint64_t event_ns; /* From an event that just misses its sample; see chain_actuate. */
} chain_t;

struct experiment {
    keel_scheduler_t *scheduler; /* It lies apart from the declarations. */
    host_board_t board;
    host_costs_t costs;
    rival_step_t step;
    model_t model;
    uint64_t random;
    uint64_t duration_us;
    uint32_t first_us, guard_us, utilisation_limit_ppm;
    bool skip, without_promotion, spread;
    uint32_t actors, chains;
    actor_t actor[KEEL_QUEUE_CAPACITY];
    chain_t chain[CHAINS];
    uint64_t fingerprint; /* Of which task started when. */
    uint64_t idle_least_us, idle_total_us, windows;
};

static uint64_t next_random(experiment_t *e)
{
    uint64_t x = e->random; /* xorshift64*, by Vigna. */

    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    e->random = x;
    return x * 0x2545F4914F6CDD1Du;
}

/* In (0, 1]. */
static double unit(experiment_t *e)
{
    return ((double)(next_random(e) >> 11) + 1.0) / 9007199254740992.0;
}

static uint64_t time_of_run(experiment_t *e, const actor_t *actor)
{
    const double work = (double)actor->work_ns;
    double share = 1.0;

    if (actor->spike_run == (actor->runs + 1u)) {
        return actor->spike_ns;
    }
    if (e->model == MODEL_UNIFORM) {
        share = 1.0 - (0.5 * (1.0 - unit(e)));
    } else if (e->model == MODEL_HEAVY) {
        share = fmin(0.5 * pow(unit(e), -1.0 / 6.0), 2.0);
    } else if (e->model == MODEL_EITHER) {
        share = (unit(e) < 0.5) ? 0.0 : 1.0;
    } else {
        /* Constant: the longest. */
    }
    return (uint64_t)(work * share);
}

/* --- Paths --- */

static void chain_begin(chain_t *chain, uint32_t number, uint64_t now_ns)
{
    for (uint32_t i = 0u; i < chain->length; i++) {
        if (chain->task[i] == number) {
            chain->input[i] = (i == 0u) ? now_ns : chain->output[i - 1u];
        }
    }
}

/* An event right after the latest sample that was acted on shows in the next one at the earliest.
   So that sample's age at its replacement is both how long the path takes to react to such an
   event, and how old the actuator's value becomes. */
static void chain_actuate(chain_t *chain, uint64_t sample_ns, uint64_t now_ns)
{
    const uint64_t age_ns = now_ns - sample_ns;

    if ((chain->latest != NO_SAMPLE) && ((now_ns - chain->latest) > chain->event_ns)) {
        chain->event_ns = now_ns - chain->latest;
    }
    if (age_ns > chain->freshness_ns) {
        chain->freshness_ns = age_ns;
    }
    if ((sample_ns != chain->latest) && (age_ns > chain->reaction_ns)) {
        chain->reaction_ns = age_ns;
    }
    chain->latest = sample_ns;
    chain->outputs++;
}

static void chain_end(chain_t *chain, uint32_t number, uint64_t now_ns)
{
    for (uint32_t i = 0u; i < chain->length; i++) {
        if ((chain->task[i] == number) && (chain->input[i] != NO_SAMPLE)) {
            chain->output[i] = chain->input[i];
            if ((i + 1u) == chain->length) {
                chain_actuate(chain, chain->input[i], now_ns);
            }
        }
    }
}

/* --- Tasks --- */

static void note_start(experiment_t *e, actor_t *actor, uint64_t now_ns)
{
    const uint64_t gap_ns = now_ns - actor->last_ns;

    if (actor->runs > 0u) {
        const double period_ns = (double)actor->config.period_us * HOST_NS_PER_US;
        const double off = (double)gap_ns - period_ns;

        if (actor->deviations < SAMPLES) {
            actor->squares += off * off;
            actor->deviations++;
        }
        if (gap_ns > actor->longest_gap_ns) {
            actor->longest_gap_ns = gap_ns;
        }
    } else {
        actor->first_ns = now_ns;
    }
    actor->last_ns = now_ns;
    e->fingerprint = ((e->fingerprint ^ now_ns) * 0x100000001B3u) ^ actor->number;
}

/* What the scheduler knows of a task: nothing when it was refused. */
static keel_task_report_t report_of(const actor_t *actor)
{
    keel_task_report_t report = {0};

    (void)keel_scheduler_report(actor->experiment->scheduler, &actor->config, &report);
    return report;
}

static void note_end(actor_t *actor, uint64_t now_ns)
{
    const uint64_t due_ns = actor->due_us * HOST_NS_PER_US;
    /* A rival may run what is not due. */
    const uint64_t response_ns = (now_ns > due_ns) ? (now_ns - due_ns) : 0u;
    const uint64_t deadline_ns = (uint64_t)actor->config.period_us * HOST_NS_PER_US;

    if (response_ns > actor->worst_ns) {
        actor->worst_ns = response_ns;
    }
    actor->late += (response_ns > deadline_ns) ? 1u : 0u;
    actor->runs++;
    actor->due_us = report_of(actor).release_us; /* The kernel has moved it on. */
}

static void body(void *context)
{
    actor_t *const actor = context;
    experiment_t *const e = actor->experiment;
    host_board_t *const board = &e->board;

    note_start(e, actor, board->now_ns);
    for (uint32_t i = 0u; i < e->chains; i++) {
        chain_begin(&e->chain[i], actor->number, board->now_ns);
    }
    host_board_work(board, time_of_run(e, actor));
    for (uint32_t i = 0u; i < e->chains; i++) {
        chain_end(&e->chain[i], actor->number, board->now_ns);
    }
    note_end(actor, board->now_ns);
}

/* --- A run --- */

static keel_status_t set_up(experiment_t *e)
{
    const keel_scheduler_config_t config = {.read_clock = host_board_read,
                                            .clock_context = &e->board,
                                            .guard_us = e->guard_us,
                                            .utilisation_limit_ppm = e->utilisation_limit_ppm,
                                            .without_promotion = e->without_promotion};
    keel_status_t status = keel_scheduler_init(e->scheduler, &config);

    host_board_init(&e->board, e->scheduler, &e->costs, e->first_us);
    for (uint32_t i = 0u; (i < e->actors) && (status == KEEL_OK); i++) {
        status = keel_scheduler_add(e->scheduler, &e->actor[i].config);
    }
    if ((status == KEEL_OK) && e->spread) {
        uint32_t crowded;

        status = keel_scheduler_spread(e->scheduler, &crowded);
    }
    for (uint32_t i = 0u; (i < e->actors) && (status == KEEL_OK); i++) {
        actor_t *const actor = &e->actor[i];

        actor->due_us = report_of(actor).release_us;
        actor->admitted = keel_scheduler_lateness(e->scheduler, &actor->config, &actor->told) ==
                          KEEL_OK;
    }
    return (status == KEEL_OK) ? keel_scheduler_start(e->scheduler) : status;
}

/* Eq. 14: the time without load of one window. */
static void note_window(experiment_t *e, keel_load_t *window)
{
    const uint64_t now_us = e->scheduler->clock.now_us;
    const uint64_t length_us = now_us - window->start_us;

    if (length_us >= WINDOW_US) {
        const uint64_t busy_us = e->scheduler->busy_us - window->busy_us;
        const uint64_t idle_us = ((length_us - busy_us) * WINDOW_US) / length_us;

        if ((e->windows == 0u) || (idle_us < e->idle_least_us)) {
            e->idle_least_us = idle_us;
        }
        e->idle_total_us += idle_us;
        e->windows++;
        keel_load_begin(window, now_us, e->scheduler->busy_us);
    }
}

/* Until when turns may be skipped: a window closes at the first turn that reaches its end. */
static uint64_t skip_until_ns(const keel_load_t *window, uint64_t end_ns)
{
    const uint64_t close_ns = (window->start_us + WINDOW_US) * HOST_NS_PER_US;

    return (close_ns < end_ns) ? close_ns : end_ns;
}

static keel_status_t run(experiment_t *e)
{
    const uint64_t end_ns = e->duration_us * HOST_NS_PER_US;
    keel_status_t status = set_up(e);
    keel_load_t window;

    keel_load_begin(&window, 0u, 0u);
    while ((status == KEEL_OK) && (e->board.now_ns < end_ns)) {
        status = e->step(e->scheduler);
        note_window(e, &window);
        if (e->skip) {
            host_board_idle(&e->board, skip_until_ns(&window, end_ns));
        }
        host_board_turn(&e->board);
    }
    return status;
}

/* --- What happened --- */

static void print_told(const actor_t *actor)
{
    (void)printf("\"admitted\": %s, \"told_us\": %" PRIu64 ", \"told_unpromoted_us\": %" PRIu64
                 ", \"told_promotes\": %s, \"told_skips\": %s, ",
                 actor->admitted ? "true" : "false", actor->told.late_us, actor->told.unpromoted_us,
                 actor->told.promotes ? "true" : "false", actor->told.skips ? "true" : "false");
}

static void print_actor(const actor_t *actor)
{
    const keel_task_report_t report = report_of(actor);
    const double count = (actor->deviations > 0u) ? (double)actor->deviations : 1.0;
    const uint64_t whole_ns = actor->last_ns - actor->first_ns;

    (void)fputs("{", stdout);
    print_told(actor);
    (void)printf("\"runs\": %" PRIu64 ", \"samples\": %" PRIu64 ", \"sigma\": %.6f, "
                 "\"mean\": %.6f, \"worst\": %" PRIu64 ", \"late\": %" PRIu64 ", ",
                 actor->runs, actor->deviations, sqrt(actor->squares / count),
                 (actor->runs > 1u) ? ((double)whole_ns / (double)(actor->runs - 1u)) : 0.0,
                 actor->worst_ns, actor->late);
    (void)printf("\"due\": %" PRIu64 ", \"gap\": %" PRIu64 ", \"last\": %" PRIu64
                 ", \"skipped\": %u, \"overruns\": %u, \"promotions\": %u}",
                 actor->due_us * HOST_NS_PER_US, actor->longest_gap_ns, actor->last_ns,
                 (unsigned)report.skipped, (unsigned)report.stats.overruns,
                 (unsigned)report.stats.promotions);
}

static void print_chain(const chain_t *chain)
{
    (void)printf("{\"outputs\": %" PRIu64 ", \"reaction\": %" PRIu64 ", \"freshness\": %" PRIu64
                 ", \"event\": %" PRIu64 "}",
                 chain->outputs, chain->reaction_ns, chain->freshness_ns, chain->event_ns);
}

static void print_result(const experiment_t *e, keel_status_t status)
{
    const uint64_t windows = (e->windows > 0u) ? e->windows : 1u;

    (void)printf("{\"status\": %d, \"fingerprint\": \"%016" PRIx64 "\", \"passes\": %" PRIu64
                 ", \"idle_mean_us\": %.3f, \"idle_least_us\": %" PRIu64 ", \"tasks\": [",
                 (int)status, e->fingerprint, e->board.passes,
                 (double)e->idle_total_us / (double)windows, e->idle_least_us);
    for (uint32_t i = 0u; i < e->actors; i++) {
        (void)fputs((i > 0u) ? ", " : "", stdout);
        print_actor(&e->actor[i]);
    }
    (void)fputs("], \"chains\": [", stdout);
    for (uint32_t i = 0u; i < e->chains; i++) {
        (void)fputs((i > 0u) ? ", " : "", stdout);
        print_chain(&e->chain[i]);
    }
    (void)puts("]}");
}

/* --- Orders --- */

static void reset(experiment_t *e)
{
    keel_scheduler_t *const scheduler = e->scheduler;

    (void)memset(e, 0, sizeof *e);
    (void)memset(scheduler, 0, sizeof *scheduler);
    e->scheduler = scheduler;
    e->step = keel_scheduler_step;
    e->random = 1u;
}

static bool order_policy(experiment_t *e, const char *words)
{
    static const struct {
        const char *name;
        rival_step_t step;
        bool spread;
    } policies[] = {
        {"keel\n", keel_scheduler_step, false},  {"spread\n", keel_scheduler_step, true},
        {"edf\n", rival_edf_step, false},        {"unguarded\n", rival_unguarded_step, false},
        {"paper\n", rival_paper_step, false},    {"literal\n", rival_literal_step, false},
        {"ungated\n", rival_ungated_step, false}};

    for (size_t i = 0u; i < (sizeof policies / sizeof policies[0]); i++) {
        if (strcmp(words, policies[i].name) == 0) {
            e->step = policies[i].step;
            e->spread = policies[i].spread;
            return true;
        }
    }
    return false;
}

static bool order_model(experiment_t *e, const char *words)
{
    static const char *const models[] = {"constant\n", "uniform\n", "heavy\n", "either\n"};

    for (uint32_t i = 0u; i < 4u; i++) {
        if (strcmp(words, models[i]) == 0) {
            e->model = (model_t)i;
            return true;
        }
    }
    return false;
}

static bool order_costs(experiment_t *e, const char *words)
{
    host_costs_t *const costs = &e->costs;

    return sscanf(words, "%" SCNu32 " %" SCNu32 " %" SCNu32, &costs->turn_ns, &costs->pass_ns,
                  &costs->dispatch_ns) == 3;
}

static bool order_set(experiment_t *e, const char *words)
{
    uint64_t seed;
    unsigned skip, without;

    if (sscanf(words, "%" SCNu64 " %" SCNu64 " %" SCNu32 " %" SCNu32 " %" SCNu32 " %u %u", &seed,
               &e->duration_us, &e->first_us, &e->guard_us, &e->utilisation_limit_ppm, &skip,
               &without) != 7) {
        return false;
    }
    e->without_promotion = without != 0u;
    e->random = (seed * 0x9E3779B97F4A7C15u) | 1u;
    e->skip = skip != 0u;
    return true;
}

static bool order_task(experiment_t *e, const char *words)
{
    actor_t *const actor = &e->actor[e->actors];
    uint64_t work_us;

    if ((e->actors == KEEL_QUEUE_CAPACITY) ||
        (sscanf(words, "%" SCNu32 " %" SCNu32 " %" SCNu32 " %" SCNu64 " %" SCNu32,
                &actor->config.priority, &actor->config.period_us, &actor->config.budget_us,
                &work_us, &actor->config.phase_us) != 5)) {
        return false;
    }
    actor->config.run = body;
    actor->config.context = actor;
    actor->experiment = e;
    actor->number = e->actors;
    actor->work_ns = work_us * HOST_NS_PER_US;
    e->actors++;
    return true;
}

static bool order_spike(experiment_t *e, const char *words)
{
    uint64_t work_us, number;
    uint32_t task;

    if ((sscanf(words, "%" SCNu32 " %" SCNu64 " %" SCNu64, &task, &number, &work_us) != 3) ||
        (task >= e->actors)) {
        return false;
    }
    e->actor[task].spike_run = number;
    e->actor[task].spike_ns = work_us * HOST_NS_PER_US;
    return true;
}

static bool order_chain(experiment_t *e, const char *words)
{
    chain_t *const chain = &e->chain[e->chains];
    int used = 0;

    if ((e->chains == CHAINS) || (sscanf(words, "%" SCNu32 "%n", &chain->length, &used) != 1) ||
        (chain->length < 2u) || (chain->length > KEEL_QUEUE_CAPACITY)) {
        return false;
    }
    for (uint32_t i = 0u; i < chain->length; i++) {
        words += used;
        if ((sscanf(words, "%" SCNu32 "%n", &chain->task[i], &used) != 1) ||
            (chain->task[i] >= e->actors)) {
            return false;
        }
        chain->input[i] = NO_SAMPLE;
        chain->output[i] = NO_SAMPLE;
    }
    chain->latest = NO_SAMPLE;
    e->chains++;
    return true;
}

static bool order_run(experiment_t *e, const char *words)
{
    (void)words;
    print_result(e, run(e));
    reset(e);
    return true;
}

static bool obey(experiment_t *e, const char *line)
{
    static const struct {
        const char *name;
        bool (*obey)(experiment_t *e, const char *words);
    } orders[] = {{"policy ", order_policy}, {"model ", order_model}, {"costs ", order_costs},
                  {"set ", order_set},       {"task ", order_task},   {"spike ", order_spike},
                  {"chain ", order_chain},   {"run", order_run}};

    for (size_t i = 0u; i < (sizeof orders / sizeof orders[0]); i++) {
        const size_t length = strlen(orders[i].name);

        if (strncmp(line, orders[i].name, length) == 0) {
            return orders[i].obey(e, line + length);
        }
    }
    return false;
}

int main(void)
{
    static keel_scheduler_t scheduler;
    static experiment_t experiment = {.scheduler = &scheduler};
    static char line[LINE_SIZE];

    reset(&experiment);
    while (fgets(line, sizeof line, stdin) != NULL) {
        if (!obey(&experiment, line)) {
            (void)fprintf(stderr, "experiment: not understood: %s\n", line);
            return EXIT_FAILURE;
        }
    }
    return EXIT_SUCCESS;
}
