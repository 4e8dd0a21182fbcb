/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mixer.h
 * @brief From torques and thrust to motors: the mixer of fig. 8.
 *
 * A command asks for a torque about each axis and for thrust; a geometry says what a motor adds to
 * each torque. Beyond their range, parts give way in a fixed order: yaw beyond its share first,
 * then thrust moves as far as roll, pitch and the share of yaw need, then the share of yaw gives
 * way, and only what is beyond all motors' span scales roll and pitch, both by one factor, so that
 * the craft tilts about the axis that was asked for. With range idle to highest, span = highest -
 * idle, and sums over motors i:
 *
 *     t_i = roll_i roll + pitch_i pitch, all scaled by span / (max t - min t) where that is below 1
 *     kept = the least of |yaw|, yaw_share and (span - (max t - min t)) / 2
 *     base = idle + thrust span, moved into [idle - min t + kept, highest - max t - kept]
 *     output_i = base + t_i + k yaw_i yaw, with the largest k from 0 to 1 for which all outputs are
 *                in [idle, highest]
 *
 * So a craft turns its nose at idle and at full thrust, too: of a yaw torque, the share is done
 * whatever thrust is asked for, as far as roll and pitch leave room.
 *
 * Flags tell what gave way, so that the integrators above stop for just these axes. Whatever the
 * command's bits are, an armed motor's output stays in [idle, highest], so that no motor of an
 * armed craft stands still, and a disarmed one's is exactly 0.
 *
 * Body axes are those of the field: x forward, y right, z down. A positive roll torque lowers the
 * right side, a positive pitch torque raises the nose, a positive yaw torque turns the nose right.
 */
#ifndef KEEL_FLIGHT_MIXER_H
#define KEEL_FLIGHT_MIXER_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** The most motors, and the fewest. */
#define KEEL_MIXER_MOTORS     8u
#define KEEL_MIXER_MOTORS_MIN 3u

/** The range of the idle output, and the least highest output; the greatest is 1. */
#define KEEL_MIXER_IDLE_MIN    0.03125f
#define KEEL_MIXER_IDLE_MAX    0.25f
#define KEEL_MIXER_HIGHEST_MIN 0.5f

/** The greatest share of yaw; the least is 0. */
#define KEEL_MIXER_YAW_SHARE_MAX 0.25f

/** About each axis some motor must turn the craft one way by this part of the strongest possible,
 * and some motor the other way. */
#define KEEL_MIXER_AUTHORITY 0.125f

/** The parts that gave way in a step: bits of keel_mixer_t.limited. */
#define KEEL_MIXER_YAW     0x01u /**< Yaw torque is less than asked for. */
#define KEEL_MIXER_RAISED  0x02u /**< Thrust is more than asked for. */
#define KEEL_MIXER_LOWERED 0x04u /**< Thrust is less than asked for. */
#define KEEL_MIXER_TILT    0x08u /**< Roll and pitch torque are less than asked for. */
#define KEEL_MIXER_COMMAND 0x10u /**< A part of the command was not finite or out of its range. */

/** The part of each unit of asked torque that a motor adds to its output, from -1 to 1. */
typedef struct keel_mixer_motor {
    float roll;
    float pitch;
    float yaw;
} keel_mixer_motor_t;

/** Where the motors are; those behind the number of motors are not looked at. */
typedef struct keel_mixer_geometry {
    keel_mixer_motor_t motor[KEEL_MIXER_MOTORS];
    uint8_t motors; /**< KEEL_MIXER_MOTORS_MIN to KEEL_MIXER_MOTORS. */
} keel_mixer_geometry_t;

/** The usual airframes. Motors are numbered clockwise as seen from above, from the front, or the
 * first to the right of it; the first, third and so on turn counter-clockwise. A Y6 has an upper
 * and a lower motor on each arm, numbered in this order; the upper ones turn counter-clockwise. */
extern const keel_mixer_geometry_t keel_mixer_quad_x;
extern const keel_mixer_geometry_t keel_mixer_quad_plus;
extern const keel_mixer_geometry_t keel_mixer_hexa_x;
extern const keel_mixer_geometry_t keel_mixer_hexa_plus;
extern const keel_mixer_geometry_t keel_mixer_octo_x;
extern const keel_mixer_geometry_t keel_mixer_octo_plus;
extern const keel_mixer_geometry_t keel_mixer_y6;

/** Outputs are parts of the greatest that a motor takes. */
typedef struct keel_mixer_config {
    keel_mixer_geometry_t geometry; /**< One of the above, or your own. */
    float idle;                     /**< The least output of an armed motor. */
    float highest;                  /**< The greatest. */
    float yaw_share; /**< Thrust gives way to yaw torque up to this; 0: not at all. */
} keel_mixer_config_t;

/** The command. */
typedef struct keel_mixer_command {
    float roll;   /**< Torque, -1 to 1. */
    float pitch;  /**< Torque, -1 to 1. */
    float yaw;    /**< Torque, -1 to 1. */
    float thrust; /**< 0 to 1. */
} keel_mixer_command_t;

/** A mixer, and what it puts out. */
typedef struct keel_mixer {
    keel_mixer_config_t config;
    float output[KEEL_MIXER_MOTORS]; /**< For each motor; 0 behind their number. */
    uint32_t limited;                /**< The parts that gave way last, in bits. */
} keel_mixer_t;

/**
 * Whether a configuration can be flown (requirement MIX-001).
 *
 * @param config the configuration, any bit pattern
 * @return KEEL_OK; KEEL_ERR_MOTORS for a number of motors out of its range; KEEL_ERR_GEOMETRY when
 *         a factor is not from -1 to 1, or no motor turns the craft about some axis one way by
 *         KEEL_MIXER_AUTHORITY; KEEL_ERR_LIMITS when idle, highest or the share of yaw is out of
 *         its range
 */
keel_status_t keel_mixer_check(const keel_mixer_config_t *config);

/**
 * Makes a mixer, disarmed (requirement MIX-002).
 *
 * @param mixer  the mixer
 * @param config its configuration; it is copied
 * @return what keel_mixer_check says: unless that is KEEL_OK, nothing is changed
 */
keel_status_t keel_mixer_init(keel_mixer_t *mixer, const keel_mixer_config_t *config);

/**
 * Puts out one command (requirements MIX-003 to MIX-009). The last operation on each output brings
 * it into its range, as sums may be rounded beyond it.
 *
 * @param mixer   the mixer
 * @param command the command, any bit pattern: a part that is not finite counts as 0, one out of
 *                its range as the end that is next to it, and KEEL_MIXER_COMMAND tells
 * @param armed   whether motors may turn; if not, the command is not looked at, and nothing gave
 *                way
 */
void keel_mixer_step(keel_mixer_t *mixer, const keel_mixer_command_t *command, bool armed);

KEEL_C_END

#endif
