/* SPDX-License-Identifier: Apache-2.0 */
/* keel_scheduler_spread beside its executable specification (specs/model), which tries every phase
 * against every release: all sets of 3 tasks with periods up to 8 us and budgets up to 4 us, with
 * guards of 0 and 1 us and 0 to 3 real-time tasks. */
#include "actors.h"

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/spread.c"

#define PERIODS 8u
#define BUDGETS 4u
#define SETS    (PERIODS * PERIODS * PERIODS * BUDGETS * BUDGETS * BUDGETS)

void setUp(void)
{
    board_reset(0u);
}

void tearDown(void)
{
}

/* The next digit of a number, which it loses. */
static uint32_t digit(uint32_t *number, uint32_t base)
{
    const uint32_t value = *number % base;

    *number /= base;
    return value;
}

static void as_specified(uint32_t set, uint32_t guard_us, uint32_t realtime)
{
    static keel_scheduler_t expected;
    actor_t *const actors[3] = {&a, &b, &c};
    uint32_t crowded = 99u;
    uint32_t counted = 98u;

    board_init(guard_us);
    for (uint32_t i = 0u; i < 3u; i++) {
        actors[i]->config.period_us = digit(&set, PERIODS) + 1u;
        actors[i]->config.budget_us = digit(&set, BUDGETS) + 1u;
        actors[i]->config.phase_us = actors[i]->config.period_us - 1u;
        actors[i]->config.priority = (i < realtime) ? KEEL_PRIORITY_REALTIME : KEEL_PRIORITY_LOW;
        add(actors[i]);
    }
    expected = scheduler;
    succeeds(model_scheduler_spread(&expected, &counted), __LINE__);
    succeeds(keel_scheduler_spread(&scheduler, &crowded), __LINE__);
    TEST_ASSERT_EQUAL_UINT32(counted, crowded);
    TEST_ASSERT_EQUAL_MEMORY(&expected, &scheduler, sizeof expected);
}

static void SPR_002_all_sets_of_three_small_tasks(void)
{
    for (uint32_t set = 0u; set < SETS; set++) {
        for (uint32_t guard_us = 0u; guard_us < 2u; guard_us++) {
            for (uint32_t realtime = 0u; realtime <= 3u; realtime++) {
                as_specified(set, guard_us, realtime);
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(SPR_002_all_sets_of_three_small_tasks);
    return UNITY_END();
}
