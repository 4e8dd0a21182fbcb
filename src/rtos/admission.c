#include "keel/rtos/admission.h"

void keel_admission_init(keel_admission_t *admission, uint32_t guard_us, uint32_t utilisation_limit)
{
    admission->guard_us = guard_us;
    admission->utilisation_limit = utilisation_limit;
    admission->utilisation = 0u;
    admission->realtime_demand_us = 0u;
    admission->shortest_realtime_us = UINT64_MAX;
    admission->shortest_gap_us = UINT64_MAX;
    admission->longest_other_us = 0u;
    admission->tasks = 0u;
}

/*@ assigns \nothing;
  @ ensures \result == \min(a, b);
  @*/
static uint64_t minimum(uint64_t a, uint64_t b)
{
    return (a < b) ? a : b;
}

/*@ requires period_valid(period_us);
  @ assigns \nothing;
  @ ensures \result == utilisation(period_us, budget_us);
  @*/
static uint64_t utilisation_of(uint32_t period_us, uint32_t budget_us)
{
    const uint64_t scaled = (uint64_t)budget_us * KEEL_UTILISATION_FULL_PPM;

    return (scaled + (period_us - 1u)) / period_us;
}

/*@ assigns \nothing;
  @ ensures \result == \max(0, period_us - budget_us);
  @*/
static uint64_t gap_of(uint32_t period_us, uint32_t budget_us)
{
    return (budget_us < period_us) ? (period_us - budget_us) : 0u;
}

keel_status_t keel_admission_admit(keel_admission_t *admission, uint32_t priority,
                                   uint32_t period_us, uint32_t budget_us)
{
    const uint64_t utilisation = admission->utilisation + utilisation_of(period_us, budget_us);
    uint64_t demand_us = admission->realtime_demand_us;
    uint64_t shortest_us = admission->shortest_realtime_us;
    uint64_t gap_us = admission->shortest_gap_us;
    uint64_t other_us = admission->longest_other_us;

    if (priority == KEEL_PRIORITY_REALTIME) {
        demand_us += budget_us;
        shortest_us = minimum(shortest_us, period_us);
        gap_us = minimum(gap_us, gap_of(period_us, budget_us));
    } else if (budget_us > other_us) {
        other_us = budget_us;
    } else {
        /* A longer budget was admitted before: no limit changes. */
    }
    if ((demand_us > 0u) && ((demand_us + (2u * admission->guard_us)) > shortest_us)) {
        return KEEL_ERR_REALTIME_DEMAND;
    }
    if ((other_us > 0u) && ((other_us + admission->guard_us) > gap_us)) {
        return KEEL_ERR_BUDGET_GAP;
    }
    if (utilisation > admission->utilisation_limit) {
        return KEEL_ERR_UTILISATION;
    }
    admission->utilisation = utilisation;
    admission->realtime_demand_us = demand_us;
    admission->shortest_realtime_us = shortest_us;
    admission->shortest_gap_us = gap_us;
    admission->longest_other_us = other_us;
    admission->tasks++;
    return KEEL_OK;
}

keel_status_t keel_admission_queue(keel_admission_t *admission, const keel_queue_t *queue)
{
    /*@ loop invariant range: 0 <= i <= queue->count;
      @ loop invariant totals: totals_of(*admission, queue, i);
      @ loop invariant valid: admission_valid(*admission);
      @ loop invariant limits: admission->guard_us == \at(admission->guard_us, Pre) &&
      @     admission->utilisation_limit == \at(admission->utilisation_limit, Pre);
      @ loop invariant periods: \forall integer j; 0 <= j < i && j < queue->realtime_count ==>
      @     admission->shortest_realtime_us <= queue->period_us[queue->order[j]];
      @ loop invariant gaps: \forall integer j; 0 <= j < i && j < queue->realtime_count ==>
      @     admission->shortest_gap_us <= \max(0,
      @         queue->period_us[queue->order[j]] - queue->budget_us[queue->order[j]]);
      @ loop invariant others: \forall integer j; queue->realtime_count <= j < i ==>
      @     admission->longest_other_us >= queue->budget_us[queue->order[j]];
      @ loop invariant some: 0 < i && 0 < queue->realtime_count ==>
      @     admission->realtime_demand_us > 0;
      @ loop assigns i, *admission;
      @ loop variant queue->count - i;
      @*/
    for (uint32_t i = 0u; i < queue->count; i++) {
        const uint32_t slot = queue->order[i];
        const keel_status_t status = keel_admission_admit(
            admission, queue->priority[slot], queue->period_us[slot], queue->budget_us[slot]);

        if (status != KEEL_OK) {
            return status;
        }
    }
    return KEEL_OK;
}
