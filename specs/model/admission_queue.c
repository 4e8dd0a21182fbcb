/* SPDX-License-Identifier: Apache-2.0 */
/* A whole queue; apart, as its proof needs no more of one task's admission than its verdict. */
#include "admission.h"

keel_status_t model_admission_queue(keel_admission_t *admission, const keel_queue_t *queue)
{
    keel_status_t status = KEEL_OK;

    /* ADM-004: the tasks in order, up to the first that is refused. */
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        const uint32_t slot = queue->order[i];

        if ((i < queue->count) && (status == KEEL_OK)) {
            status = model_admission_admit(admission, queue->priority[slot], queue->period_us[slot],
                                           queue->budget_us[slot]);
        }
    }
    return status;
}
