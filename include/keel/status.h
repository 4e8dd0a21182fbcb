/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file status.h
 * @brief The result of every fallible Keel function.
 *
 * A function that returns anything but KEEL_OK has refused: nothing that the caller can observe
 * has changed. Requirement STA-001 lists the few exceptions, and each says at its function what it
 * writes: refusals that are counted, or that tell which task was in the way, and a clock that
 * breaks while tasks run. Each reason to refuse has a value of its own, so that a caller can tell
 * them apart without parsing anything.
 *
 * All layers share one enumeration, as a unit hands on what a unit below it says, and callers
 * handle one type; its sections tell which layer may say what. The RTOS layer returns none of the
 * last section, so whoever uses only that layer need not know it.
 */
#ifndef KEEL_STATUS_H
#define KEEL_STATUS_H

/** Why a function refused, or KEEL_OK. */
typedef enum keel_status {
    /* Any layer. */
    KEEL_OK = 0,    /**< Done. */
    KEEL_ERR_NULL,  /**< A required pointer, or a task's function, is null. */
    KEEL_ERR_STATE, /**< Not allowed now, for example a step before the start. */
    KEEL_ERR_FULL,  /**< No room: KEEL_QUEUE_CAPACITY tasks, or 65535 runs not taken yet. */

    /* The RTOS layer: a task's declaration, the set of tasks, the scheduler. */
    KEEL_ERR_PERIOD,          /**< The period is 0 or at least 2^31 us. */
    KEEL_ERR_PHASE,           /**< The phase is not below the period. */
    KEEL_ERR_BUDGET_ZERO,     /**< The budget is 0. */
    KEEL_ERR_PRIORITY,        /**< The priority is neither 1..KEEL_PRIORITY_HIGH nor real-time. */
    KEEL_ERR_DUPLICATE,       /**< The task is in the queue already. */
    KEEL_ERR_UNKNOWN_TASK,    /**< The task is not in the queue. */
    KEEL_ERR_REALTIME_DEMAND, /**< Real-time budgets plus twice the guard exceed a period. */
    KEEL_ERR_BUDGET_GAP,      /**< The budget can never fit between real-time releases. */
    KEEL_ERR_UTILISATION,     /**< The utilisation exceeds the configured limit. */
    KEEL_ERR_CONFIG,          /**< The guard or the utilisation limit is out of its range. */
    KEEL_ERR_CLOCK,           /**< The clock jumped backwards (or by 2^31 us or more). */

    /* The middleware and flight layers: sensors, filters, controllers. */
    KEEL_ERR_SENSORS,   /**< The number of sensors is not 2 to 4, or there is no such one. */
    KEEL_ERR_AGREEMENT, /**< The distance of full agreement, a, is out of its range. */
    KEEL_ERR_INITIAL,   /**< The initial output is not within the plausibility limits. */
    KEEL_ERR_AGE,       /**< The oldest age of a sample is 0. */
    KEEL_ERR_LATCH,     /**< The latch count is 0. */
    KEEL_ERR_FACTOR,    /**< The oversampling factor is 0. */
    KEEL_ERR_VALUE,     /**< A sample is not finite, or beyond the range that is stated. */
    KEEL_ERR_RATE,      /**< A sample rate is not finite or out of its range. */
    KEEL_ERR_CUTOFF,    /**< A filter's cut-off or a voter's factor n is out of its range. */
    KEEL_ERR_GAIN,      /**< A gain is negative, not finite or above its limit. */
    KEEL_ERR_LIMITS,    /**< Limits are not finite, out of range or in the wrong order. */
    KEEL_ERR_INPUT,     /**< An input is not finite or out of its range: nothing moves. */
    KEEL_ERR_MOTORS,    /**< The number of motors is out of its range. */
    KEEL_ERR_GEOMETRY   /**< A motor's factor is out of range, or an axis cannot be turned about. */
} keel_status_t;

#endif
