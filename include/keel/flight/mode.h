/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mode.h
 * @brief Arming, flight modes, failsafe and termination: one machine, driven by tables.
 *
 * Each step takes plain facts: what the pilot's last good frame said, what the estimators, the
 * landing detector, the fence and the battery say, and which of the checks before arming hold. It
 * tells whether motors may turn, which mode is in force, why it is not another, and what keeps the
 * aircraft from being armed.
 *
 * A fact counts only once it has settled: it was seen at each look for its time without a break.
 * One that is not seen counts no longer, at once. The pilot's facts are looked at
 * only in frames: between two of them they stay, and settle only in a step that has a frame. As no
 * time to settle is shorter than the longest silence that the link is allowed, it takes at least
 * three good frames in a row, so one or two frames, a glitch, or silence move nothing. After that
 * silence all that the pilot said is forgotten.
 *
 * Time is counted in what passed between steps (keel_clock_elapsed_us gives it across the wrap of
 * a counter), in sums that stay at their end, so nothing here ever wraps.
 *
 *                arms                 leaves the ground
 *     DISARMED ---------> ARMED ---------------------------> FLYING
 *         ^                 |  <-------------------------      | link lost
 *         | lands,          |         touches down             v
 *         | disarmed        | link lost                      HOLDING ---> RETURNING
 *         |                 v                                  |              |
 *         +------------- LANDING <-----------------------------+--------------+
 *
 * Besides, a pilot who moves the mode switch takes over from HOLDING, RETURNING and LANDING, and a
 * kill switch held leads from each state in which motors may turn to TERMINATED, which is left by
 * keel_mode_init only: it latches until the power is off. A pilot's return and landing, and those
 * for the fence and the battery, are the same states.
 */
#ifndef KEEL_FLIGHT_MODE_H
#define KEEL_FLIGHT_MODE_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** @name States. */
/** @{ */
#define KEEL_MODE_DISARMED   0u /**< On the ground; motors stand still. */
#define KEEL_MODE_ARMED      1u /**< On the ground; motors may turn. */
#define KEEL_MODE_FLYING     2u /**< The pilot flies. */
#define KEEL_MODE_HOLDING    3u /**< The link is lost: stays where it is for a time. */
#define KEEL_MODE_RETURNING  4u /**< Flies home. */
#define KEEL_MODE_LANDING    5u /**< Descends, until it is on the ground. */
#define KEEL_MODE_TERMINATED 6u /**< Motors stand still for good. */
#define KEEL_MODE_STATES     7u
/** @} */

/** @name Modes. One that lacks an estimate gives way to one with a lower number. */
/** @{ */
#define KEEL_MODE_ACRO     0u /**< The pilot commands rates. */
#define KEEL_MODE_LAND     1u /**< Descends with what estimates there are: the last resort. */
#define KEEL_MODE_ANGLE    2u /**< The pilot commands angles. */
#define KEEL_MODE_ALTITUDE 3u /**< Holds its altitude. */
#define KEEL_MODE_POSITION 4u /**< Holds its position. */
#define KEEL_MODE_RETURN   5u /**< Flies home. */
#define KEEL_MODE_NONE     6u /**< None: motors stand still, or the pilot has not said. */
/** @} */

/** @name Facts of the pilot: of frames. RC is radio control. */
/** @{ */
#define KEEL_MODE_RC_LINKED      0x0001u /**< A whole frame came, without its failsafe flag. */
#define KEEL_MODE_ARM_SWITCH_ON  0x0002u /**< The arm switch is on. */
#define KEEL_MODE_ARM_SWITCH_OFF 0x0004u /**< It is off. Between the two it is neither. */
#define KEEL_MODE_THROTTLE_LOW   0x0008u /**< The throttle is low. */
#define KEEL_MODE_KILL_SWITCH_ON 0x0010u /**< The kill switch is on. */
#define KEEL_MODE_SWITCH_UNMOVED 0x0020u /**< The mode switch is where it was. Not an input. */
/** @} */

/** @name Facts of the aircraft: at every step. */
/** @{ */
#define KEEL_MODE_LANDED           0x0040u /**< It stands on the ground. */
#define KEEL_MODE_AT_HOME          0x0080u /**< It is where a return leads to. */
#define KEEL_MODE_ATTITUDE_VALID   0x0100u /**< The attitude is estimated well. */
#define KEEL_MODE_ALTITUDE_VALID   0x0200u /**< The altitude is estimated well. */
#define KEEL_MODE_POSITION_VALID   0x0400u /**< The position is estimated well. */
#define KEEL_MODE_FENCE_BREACHED   0x0800u /**< The fence is breached. */
#define KEEL_MODE_BATTERY_CRITICAL 0x1000u /**< The battery is just enough to return. */
#define KEEL_MODE_BATTERY_EMPTY    0x2000u /**< The battery is just enough to land. */
#define KEEL_MODE_FACTS            14u
/** @} */

/** @name Other causes of a change of state, in keel_mode_t.cause. */
/** @{ */
#define KEEL_MODE_PILOT_ARMS        0x00010000u /**< The pilot arms, and nothing is in the way. */
#define KEEL_MODE_RC_LOST           0x00020000u /**< RC_LINKED has not settled. */
#define KEEL_MODE_LEAVES_GROUND     0x00040000u /**< Not landed, or the throttle not low. */
#define KEEL_MODE_TOUCHES_DOWN      0x00080000u /**< Landed and throttle low, both settled. */
#define KEEL_MODE_STAYS_LANDED      0x00100000u /**< Landed, settled, for that time in the state. */
#define KEEL_MODE_STATE_TIMES_OUT   0x00200000u /**< The state has lasted for its time. */
#define KEEL_MODE_PILOT_TAKES_OVER  0x00400000u /**< The pilot moved the mode switch to fly. */
#define KEEL_MODE_PILOT_ASKS_LAND   0x00800000u /**< The pilot asks for LAND. */
#define KEEL_MODE_PILOT_ASKS_RETURN 0x01000000u /**< The pilot asks for RETURN, with a position. */
#define KEEL_MODE_CAN_RETURN        0x02000000u /**< It has a position, and the failsafe returns. */
/** @} */

/** @name Checks before arming, by the application. All other bits are free for it. */
/** @{ */
#define KEEL_MODE_CHECK_GYROSCOPE         0x0001u
#define KEEL_MODE_CHECK_ACCELEROMETER     0x0002u
#define KEEL_MODE_CHECK_MAGNETOMETER      0x0004u
#define KEEL_MODE_CHECK_BAROMETER         0x0008u
#define KEEL_MODE_CHECK_POSITION_ESTIMATE 0x0010u
#define KEEL_MODE_CHECK_CALIBRATION       0x0020u
#define KEEL_MODE_CHECK_LEVEL_ATTITUDE    0x0040u
#define KEEL_MODE_CHECK_BATTERY_LEVEL     0x0080u
#define KEEL_MODE_CHECK_MOTORS            0x0100u
#define KEEL_MODE_CHECK_CPU_LOAD          0x0200u
#define KEEL_MODE_CHECK_STORAGE           0x0400u
#define KEEL_MODE_CHECK_HOME_POSITION     0x0800u
/** @} */

/** Range of the longest silence, in us: it catches a time in ms. */
#define KEEL_MODE_LOSS_LEAST_US 10000u
#define KEEL_MODE_LOSS_MOST_US  2000000u

/** The longest of all other times, in us: an hour. */
#define KEEL_MODE_TIME_MOST_US 3600000000u

/** How a machine behaves. */
typedef struct keel_mode_config {
    uint32_t loss_us;     /**< The link is lost after so long without a good frame. */
    uint32_t regain_us;   /**< It is up again after so long with good ones. */
    uint32_t request_us;  /**< How long switches and the throttle must rest to count. */
    uint32_t kill_us;     /**< How long the kill switch must be held. */
    uint32_t landed_us;   /**< How long it must stand on the ground to have landed. */
    uint32_t estimate_us; /**< How long an estimate must be good before a mode rests on it. */
    uint32_t alarm_us;    /**< How long fence, battery and home must say so. */
    uint32_t idle_us;     /**< Disarms itself after so long armed on the ground. */
    uint32_t hold_us;     /**< How long HOLDING lasts. */
    uint32_t return_us;   /**< How long RETURNING lasts at most. */
    uint32_t required;    /**< The checks that must hold, not 0. */
    bool returns;         /**< The failsafe returns where it can; it lands otherwise. */
} keel_mode_config_t;

/** The inputs of a step. */
typedef struct keel_mode_input {
    uint32_t elapsed_us; /**< Since the last step. */
    uint32_t facts;      /**< Facts of the pilot and of the aircraft; unknown bits are ignored. */
    uint32_t checks;     /**< The checks that hold now: a bit not set has not been shown. */
    uint8_t asked;       /**< Where the mode switch is; a frame with no such mode is none. */
} keel_mode_input_t;

/** The obstacles to arming. */
typedef struct keel_mode_refusal {
    uint32_t checks; /**< Required checks that do not hold. */
    uint32_t facts;  /**< RC_LINKED, THROTTLE_LOW, LANDED: not settled; ARM_SWITCH_OFF: the switch
                          was not seen off since the link came up or since the last attempt;
                          SWITCH_UNMOVED: the mode switch does not rest at a mode that the pilot can
                          fly now; KILL_SWITCH_ON, FENCE_BREACHED, BATTERY_CRITICAL, BATTERY_EMPTY:
                          it is so. */
} keel_mode_refusal_t;

/** A machine. Only the functions below write it; all of it may be read. */
typedef struct keel_mode {
    keel_mode_config_t config;
    uint32_t settle_us[KEEL_MODE_FACTS]; /**< How long each fact takes to settle. */
    uint32_t held_us[KEEL_MODE_FACTS];   /**< How long it was seen, until it settled. */
    uint32_t silence_us;                 /**< Since the last good frame. */
    uint32_t state_us;                   /**< In this state. */
    uint32_t seen;                       /**< Facts at the last look. */
    uint32_t settled;                    /**< Facts that count. */
    uint32_t overridden;                 /**< Alarms that the pilot took over from. */
    uint32_t cause;                      /**< The facts and other causes that led here. */
    uint32_t missing;                    /**< Estimates that the wanted mode lacks. */
    keel_mode_refusal_t blocking;        /**< In DISARMED: what stands in the way now. */
    keel_mode_refusal_t refused;         /**< The obstacles at the last attempt to arm. */
    uint8_t state;
    uint8_t mode;     /**< The mode in force. */
    uint8_t asked;    /**< The mode that the pilot asks for; KEEL_MODE_NONE without a link. */
    uint8_t rests_at; /**< Where the mode switch was in the last frame. */
    bool ready;       /**< The arm switch was seen off: switching on is an attempt to arm. */
    bool motors;      /**< Motors may turn. */
} keel_mode_t;

/**
 * Makes a machine: disarmed, nothing seen yet (requirements MOD-001 and MOD-002). It is the only
 * way out of TERMINATED.
 *
 * @param mode   the machine
 * @param config how it behaves
 * @return KEEL_OK; KEEL_ERR_LIMITS when a time is out of its range; KEEL_ERR_INPUT when no check is
 *         required. Nothing changes then
 */
keel_status_t keel_mode_init(keel_mode_t *mode, const keel_mode_config_t *config);

/**
 * Takes a step (requirements MOD-003 to MOD-012).
 *
 * @param mode  the machine, initialised
 * @param input what is so now, any bit pattern
 */
void keel_mode_step(keel_mode_t *mode, const keel_mode_input_t *input);

KEEL_C_END

#endif
