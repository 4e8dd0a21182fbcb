/* SPDX-License-Identifier: Apache-2.0 */
#include "host_board.h"

void host_board_init(host_board_t *board, const keel_scheduler_t *scheduler,
                     const host_costs_t *costs, uint32_t first_us)
{
    *board = (host_board_t){.scheduler = scheduler, .costs = *costs, .first_us = first_us};
}

uint32_t host_board_read(void *board)
{
    host_board_t *const self = board;
    const keel_scheduler_t *const scheduler = self->scheduler;
    const uint64_t elapsed_us = self->now_ns / HOST_NS_PER_US;

    if ((scheduler->stage == KEEL_STAGE_READY) && (elapsed_us >= scheduler->wake_us)) {
        self->now_ns += self->costs.pass_ns;
        self->passes++;
    }
    return (uint32_t)(self->first_us + elapsed_us);
}

void host_board_work(host_board_t *board, uint64_t work_ns)
{
    board->now_ns += board->costs.dispatch_ns + work_ns;
}

void host_board_turn(host_board_t *board)
{
    board->now_ns += board->costs.turn_ns;
}

void host_board_idle(host_board_t *board, uint64_t end_ns)
{
    const uint64_t turn_ns = board->costs.turn_ns;
    const uint64_t wake_us = board->scheduler->wake_us;
    uint64_t until_ns = end_ns;

    if ((wake_us < (end_ns / HOST_NS_PER_US)) && ((wake_us * HOST_NS_PER_US) < end_ns)) {
        until_ns = wake_us * HOST_NS_PER_US;
    }
    if (until_ns <= board->now_ns) {
        return;
    }
    if (turn_ns == 0u) {
        board->now_ns = until_ns;
    } else {
        /* The turn that reaches the time is made by the loop itself. */
        board->now_ns += ((until_ns - board->now_ns - 1u) / turn_ns) * turn_ns;
    }
}
