/* SPDX-License-Identifier: Apache-2.0 */
#include "common/progress.h"

uint32_t keel_progress_sum(uint32_t a, uint32_t b)
{
    return (a <= (UINT32_MAX - b)) ? (a + b) : UINT32_MAX;
}

keel_progress_t keel_progress_none(void)
{
    const keel_progress_t none = {.age_us = UINT32_MAX};

    return none;
}

void keel_progress_pass(keel_progress_t *progress, uint32_t elapsed_us)
{
    progress->passed_us = keel_progress_sum(progress->passed_us, elapsed_us);
    progress->age_us = keel_progress_sum(progress->age_us, elapsed_us);
}

void keel_progress_begin(keel_progress_t *progress)
{
    progress->passed_us = 0u;
}

void keel_progress_sample(keel_progress_t *progress)
{
    progress->age_us = 0u;
    progress->in_row = 0u;
}

bool keel_progress_fail(keel_progress_t *progress, uint32_t limit)
{
    bool enough;

    progress->failures = keel_progress_next(progress->failures);
    progress->in_row++;
    enough = progress->in_row >= limit;
    if (enough) {
        progress->in_row = 0u;
    }
    return enough;
}

uint32_t keel_progress_next(uint32_t count)
{
    return keel_progress_sum(count, 1u);
}
