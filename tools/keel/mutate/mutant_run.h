/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mutant_run.h
 * @brief What a harness and its sources are compiled with when they are executed on this machine.
 *
 * An arbitrary value is drawn from an input; an assumption that does not hold ends the execution;
 * an assertion that does not hold refutes what is executed. With KEEL_RUN_REPLAY the same is for
 * CBMC, which has assumptions and assertions of its own: the values are those of one execution.
 */
#ifndef MUTANT_RUN_H
#define MUTANT_RUN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef KEEL_RUN_REPLAY

/* KEEL_RUN_VALUE, which gives the value of a place, stands before this header is included. */
static uint32_t keel_run_place;

static uint64_t keel_run_next(void)
{
    const uint32_t place = keel_run_place;

    keel_run_place = place + 1u;
    return KEEL_RUN_VALUE(place);
}

static uint64_t keel_run_int(size_t size)
{
    (void)size;
    return keel_run_next();
}

static bool keel_run_bool(void)
{
    return keel_run_next() != 0u;
}

static float keel_run_float(void)
{
    union {
        uint32_t bits;
        float value;
    } both;

    both.bits = (uint32_t)keel_run_next();
    return both.value;
}

#else

/* Of one execution: objects of the harness and its sources begin each with what C gives them. */
#pragma clang section bss = "keel_zero" data = "keel_data"

/* A harness, and the numbers that stand in its files: what it compares with is among them. */
typedef struct {
    const char *name;
    void (*run)(void);
    const double *numbers;
    size_t count;
} keel_run_entry_t;

uint64_t keel_run_int(size_t size);
bool keel_run_bool(void);
float keel_run_float(void);
void keel_run_assume(bool holds);
void keel_run_assert(bool holds, const char *text);
bool keel_run_equal(float a, float b);

#define __CPROVER_assume(condition)       keel_run_assume((condition) ? true : false)
#define __CPROVER_assert(condition, text) keel_run_assert((condition) ? true : false, text)
#define __CPROVER_equal(a, b)             keel_run_equal(a, b)

#endif

#endif
