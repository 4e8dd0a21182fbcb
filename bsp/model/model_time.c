/* SPDX-License-Identifier: Apache-2.0 */
/* Time, and what ends a flight. */
#include "model.h"

#include <stdarg.h>
#include <stdio.h>

model_clock_t model_clock;

static char problem[MODEL_PROBLEM];

void model_clock_start(void)
{
    model_clock = (model_clock_t){0};
    problem[0] = '\0';
}

void model_clock_limit(uint64_t ticks)
{
    model_clock.limit = ticks;
}

void model_fail(const char *format, ...)
{
    va_list values;

    if (!model_clock.failed) {
        model_clock.failed = true;
        va_start(values, format);
        (void)vsnprintf(problem, sizeof problem, format, values);
        va_end(values);
    }
}

const char *model_problem(void)
{
    return problem;
}
