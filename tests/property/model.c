/* SPDX-License-Identifier: Apache-2.0 */
#include "model.h"

#include <string.h>

#define TWO_31  2147483648u
#define TWO_32  4294967296u
#define HIGHEST 16

__extension__ typedef unsigned __int128 wide_t;

/* --- Lists --- */

static int position(const model_list_t *list, int task)
{
    for (int i = 0; i < list->length; i++) {
        if (list->item[i] == task) {
            return i;
        }
    }
    return -1;
}

static void append(model_list_t *list, int task)
{
    list->item[list->length] = task;
    list->length++;
}

static void drop(model_list_t *list, int task)
{
    const int at = position(list, task);

    if (at < 0) {
        return;
    }
    for (int i = at; i < (list->length - 1); i++) {
        list->item[i] = list->item[i + 1];
    }
    list->length--;
}

/* --- Admission --- */

static bool is_realtime(const model_declaration_t *is)
{
    return is->priority == HIGHEST;
}

/* The rules of admission.h, each as it is written there, over a whole set. */
static keel_status_t admissible(const model_t *m, const model_list_t *set)
{
    uint64_t demand = 0;
    uint64_t utilisation = 0;
    bool gaps = true;

    for (int i = 0; i < set->length; i++) {
        const model_declaration_t *const is = &m->task[set->item[i]].is;

        demand += is_realtime(is) ? is->budget : 0;
        utilisation += (is->budget * 1000000) / is->period;
        utilisation += (((is->budget * 1000000) % is->period) > 0) ? 1 : 0;
    }
    for (int i = 0; i < set->length; i++) {
        const model_declaration_t *const is = &m->task[set->item[i]].is;

        if (is_realtime(is) && ((demand + (2 * m->guard)) > is->period)) {
            return KEEL_ERR_REALTIME_DEMAND;
        }
        for (int j = 0; j < set->length; j++) {
            const model_declaration_t *const other = &m->task[set->item[j]].is;

            if (is_realtime(is) && !is_realtime(other) &&
                ((other->budget + m->guard + is->budget) > is->period)) {
                gaps = false;
            }
        }
    }
    if (!gaps) {
        return KEEL_ERR_BUDGET_GAP;
    }
    return (utilisation > m->limit) ? KEEL_ERR_UTILISATION : KEEL_OK;
}

/* All tasks in queue order. */
static model_list_t everything(const model_t *m)
{
    model_list_t all = m->realtime;

    for (int i = 0; i < m->others.length; i++) {
        append(&all, m->others.item[i]);
    }
    return all;
}

keel_status_t model_check(const model_t *m, int *admitted)
{
    const model_list_t all = everything(m);
    model_list_t some = {0, {0}};

    for (*admitted = 0; *admitted < all.length; (*admitted)++) {
        keel_status_t status;

        append(&some, all.item[*admitted]);
        status = admissible(m, &some);
        if (status != KEEL_OK) {
            return status;
        }
    }
    return KEEL_OK;
}

/* --- Setting up --- */

void model_init(model_t *m, int capacity, uint64_t guard, uint64_t limit, bool without_promotion)
{
    memset(m, 0, sizeof *m);
    m->capacity = capacity;
    m->guard = guard;
    m->limit = limit;
    m->without_promotion = without_promotion;
    m->running = MODEL_NO_TASK;
}

bool model_holds(const model_t *m, int task)
{
    return (position(&m->realtime, task) >= 0) || (position(&m->others, task) >= 0);
}

static keel_status_t declaration_error(const model_declaration_t *is)
{
    const bool known = ((is->priority >= 1) && (is->priority <= 4)) || is_realtime(is);

    if (!is->has_body) {
        return KEEL_ERR_NULL;
    }
    if ((is->period == 0) || (is->period >= TWO_31)) {
        return KEEL_ERR_PERIOD;
    }
    if (is->phase >= is->period) {
        return KEEL_ERR_PHASE;
    }
    if (is->budget == 0) {
        return KEEL_ERR_BUDGET_ZERO;
    }
    return known ? KEEL_OK : KEEL_ERR_PRIORITY;
}

static void arm(model_t *m, int task, uint64_t from)
{
    const model_declaration_t is = m->task[task].is;

    memset(&m->task[task], 0, sizeof m->task[task]);
    m->task[task].is = is;
    m->task[task].release = from + is.phase;
}

keel_status_t model_add(model_t *m, int task)
{
    const keel_status_t status = declaration_error(&m->task[task].is);
    model_list_t all = everything(m);

    if (status != KEEL_OK) {
        return status;
    }
    if (model_holds(m, task)) {
        return KEEL_ERR_DUPLICATE;
    }
    if (all.length == m->capacity) {
        return KEEL_ERR_FULL;
    }
    append(&all, task);
    if ((m->stage != SETTING_UP) && (admissible(m, &all) != KEEL_OK)) {
        return admissible(m, &all);
    }
    arm(m, task, m->now);
    m->idle = false;
    append(is_realtime(&m->task[task].is) ? &m->realtime : &m->others, task);
    return KEEL_OK;
}

keel_status_t model_remove(model_t *m, int task)
{
    if (!model_holds(m, task)) {
        return KEEL_ERR_UNKNOWN_TASK;
    }
    drop(&m->realtime, task);
    drop(&m->others, task);
    drop(&m->pass, task);
    m->idle = false;
    if (m->running == task) {
        m->running = MODEL_NO_TASK;
    }
    return KEEL_OK;
}

keel_status_t model_start(model_t *m, uint64_t raw)
{
    const model_list_t all = everything(m);
    int admitted;
    keel_status_t status;

    if (m->stage != SETTING_UP) {
        return KEEL_ERR_STATE;
    }
    status = model_check(m, &admitted);
    if (status != KEEL_OK) {
        return status;
    }
    for (int i = 0; i < all.length; i++) {
        arm(m, all.item[i], 0);
    }
    m->now = 0;
    m->raw = raw;
    m->stage = BETWEEN;
    return KEEL_OK;
}

/* --- A step --- */

/* Time goes on by what the counter went on, which is below 2^31. */
static keel_status_t read_clock(model_t *m, uint64_t raw)
{
    const uint64_t elapsed = ((raw + TWO_32) - m->raw) % TWO_32;

    if (elapsed >= TWO_31) {
        return KEEL_ERR_CLOCK;
    }
    m->now += elapsed;
    m->raw = raw;
    return KEEL_OK;
}

keel_status_t model_begin(model_t *m, uint64_t raw)
{
    keel_status_t status;

    if (m->stage != BETWEEN) {
        return KEEL_ERR_STATE;
    }
    status = read_clock(m, raw);
    if (status == KEEL_OK) {
        m->stage = DECIDING;
        m->pass = m->realtime;
        m->idle = false;
    }
    return status;
}

static bool is_due(const model_t *m, int task)
{
    return m->task[task].release <= m->now;
}

/* Eq. 3: 1 + sp * age / T, counted up in exact fractions until the next whole number is too
 * much, at most 16. */
static int dynamic_priority(const model_t *m, int task)
{
    const model_task_t *const t = &m->task[task];
    const wide_t age = (m->now - t->release) + t->is.period;
    int dp = 1;

    while ((dp < HIGHEST) && ((t->is.priority * age) >= ((wide_t)(unsigned)dp * t->is.period))) {
        dp++;
    }
    return dp;
}

/* Whether a task would end, a guard before it included, before every real-time release. */
static bool leaves_room(const model_t *m, int task)
{
    const model_task_t *const t = &m->task[task];
    const uint64_t worst = (t->is.budget > t->remembered) ? t->is.budget : t->remembered;

    for (int i = 0; i < m->realtime.length; i++) {
        if ((m->now + m->guard + worst) > m->task[m->realtime.item[i]].release) {
            return false;
        }
    }
    return true;
}

static int best_other(const model_t *m)
{
    int best = MODEL_NO_TASK;

    for (int i = 0; i < m->others.length; i++) {
        const int task = m->others.item[i];

        if (!is_due(m, task)) {
            continue;
        }
        if (!leaves_room(m, task) &&
            (m->without_promotion || (dynamic_priority(m, task) < HIGHEST))) {
            continue;
        }
        if ((best == MODEL_NO_TASK) || (dynamic_priority(m, task) > dynamic_priority(m, best))) {
            best = task;
        }
    }
    return best;
}

/* The first point of the task's grid that lies ahead. */
static void serve(model_t *m, int task)
{
    model_task_t *const t = &m->task[task];
    const uint64_t next = (m->now - ((m->now - t->release) % t->is.period)) + t->is.period;

    t->skipped += ((next - t->release) / t->is.period) - 1;
    t->release = next;
    m->running = task;
    m->stage = RUNNING;
}

int model_next(model_t *m)
{
    int task;

    if (m->stage != DECIDING) {
        return MODEL_NO_TASK;
    }
    while (m->pass.length > 0) {
        task = m->pass.item[0];
        drop(&m->pass, task);
        if (is_due(m, task)) {
            m->serving_realtime = true;
            serve(m, task);
            return task;
        }
    }
    task = best_other(m);
    if (task == MODEL_NO_TASK) {
        m->stage = BETWEEN;
        m->idle = true;
        return MODEL_NO_TASK;
    }
    if (!m->without_promotion && (dynamic_priority(m, task) == HIGHEST)) {
        m->task[task].promotions++;
    }
    m->serving_realtime = false;
    serve(m, task);
    return task;
}

keel_status_t model_finish(model_t *m, uint64_t raw)
{
    const uint64_t started = m->now;
    keel_status_t status;

    if (m->stage != RUNNING) {
        return KEEL_ERR_STATE;
    }
    status = read_clock(m, raw);
    m->busy += m->now - started;
    if ((status == KEEL_OK) && (m->running != MODEL_NO_TASK)) {
        model_task_t *const t = &m->task[m->running];

        t->last = m->now - started;
        t->longest = (t->last > t->longest) ? t->last : t->longest;
        t->overruns += (t->last > t->is.budget) ? 1 : 0;
        t->total += t->last;
        t->runs++;
        t->in_a_row = (t->last > t->is.budget) ? 0 : (t->in_a_row + 1);
        if (t->in_a_row >= 8) {
            t->forgotten += (t->remembered > 0) ? 1 : 0;
            t->remembered = 0;
        }
        if ((t->last > t->is.budget) && (t->last > t->remembered)) {
            t->remembered = t->last;
        }
    }
    m->stage = ((status == KEEL_OK) && m->serving_realtime) ? DECIDING : BETWEEN;
    m->running = MODEL_NO_TASK;
    return status;
}

/* When waiting alone makes something run: the first release or, of a task that waits for room, the
 * time from which on its dynamic priority is the highest. */
uint64_t model_wake(const model_t *m)
{
    const model_list_t all = everything(m);
    uint64_t wake = UINT64_MAX;

    for (int i = 0; i < all.length; i++) {
        const model_task_t *const t = &m->task[all.item[i]];
        uint64_t at = t->release;

        if (is_due(m, all.item[i]) && !is_realtime(&t->is)) {
            const uint64_t enough = (HIGHEST - 1u) * t->is.period; /* Of sp * age. */

            at += ((enough + t->is.priority - 1) / t->is.priority) - t->is.period;
            at = m->without_promotion ? UINT64_MAX : at;
        }
        wake = (at < wake) ? at : wake;
    }
    return wake;
}

keel_status_t model_resync(model_t *m, uint64_t raw)
{
    if (m->stage != BETWEEN) {
        return KEEL_ERR_STATE;
    }
    m->raw = raw;
    return KEEL_OK;
}
