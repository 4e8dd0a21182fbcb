/**
 * @file status.h
 * @brief The result of every fallible Keel function.
 *
 * A function that returns anything but KEEL_OK has refused: nothing that the caller can observe
 * has changed (requirement STA-001; the one exception, a clock that breaks while a task runs, is
 * stated at keel_scheduler_finish). Each reason to refuse has a value of its own, so that a
 * caller can tell them apart without parsing anything.
 */
#ifndef KEEL_STATUS_H
#define KEEL_STATUS_H

/** Why a function refused, or KEEL_OK. */
typedef enum keel_status {
    KEEL_OK = 0,              /**< Done. */
    KEEL_ERR_NULL,            /**< A required pointer, or a task's function, is null. */
    KEEL_ERR_DUPLICATE,       /**< The task is in the queue already. */
    KEEL_ERR_FULL,            /**< The queue holds KEEL_QUEUE_CAPACITY tasks. */
    KEEL_ERR_UNKNOWN_TASK,    /**< The task is not in the queue. */
    KEEL_ERR_PERIOD,          /**< The period is 0 or at least 2^31 us. */
    KEEL_ERR_PHASE,           /**< The phase is not below the period. */
    KEEL_ERR_BUDGET_ZERO,     /**< The budget is 0. */
    KEEL_ERR_BUDGET_GAP,      /**< The budget can never fit between real-time releases. */
    KEEL_ERR_PRIORITY,        /**< The priority is neither 1..KEEL_PRIORITY_HIGH nor real-time. */
    KEEL_ERR_REALTIME_DEMAND, /**< Real-time budgets plus twice the guard exceed a period. */
    KEEL_ERR_UTILISATION,     /**< The utilisation exceeds the configured limit. */
    KEEL_ERR_CLOCK,           /**< The clock jumped backwards (or by 2^31 us or more). */
    KEEL_ERR_CONFIG,          /**< The guard or the utilisation limit is out of its range. */
    KEEL_ERR_STATE            /**< Not allowed now, for example a step before the start. */
} keel_status_t;

#endif
