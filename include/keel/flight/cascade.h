/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file cascade.h
 * @brief The chained PID controllers of fig. 8: position, velocity, angle and rate.
 *
 * Eleven controllers (pid.h), one an axis, in four stages. Each stage has a step of its own, to be
 * called by a task of its own rate: set-points go down, limits go up.
 *
 *     position  north, east, height         ->  velocities            -> cascade.velocity
 *     velocity  north, east, climb          ->  tilt, thrust          -> cascade.tilt, .thrust
 *     angle     roll, pitch                 ->  body rates            -> cascade.rates
 *     rate      roll, pitch, yaw            ->  torques, thrust       -> cascade.command
 *
 * The set-point of a stage is an argument, so that the pilot's set-points (reference.h) go in at
 * any of them: keel_cascade_angle_step(&c, c.tilt, ...) follows the stage above, with the sticks'
 * angles in the place of c.tilt it follows the pilot.
 *
 * Reach: an axis takes set-points up to its reach; beyond they count as that. A configuration whose
 * outputs could be beyond what takes them is refused, so no stage asks for more than the next one
 * takes, and the rate stage for no more than the mixer does.
 *
 * Wind-up: an axis is at its limit when its output is, when it is asked for more than its reach,
 * and when what takes its output is at its limit in that direction, down to the mixer's flags.
 * While the axis below is at its limit, an integral does not move further in that direction. For
 * north and east an axis of the body counts that has more than half of its size in that direction.
 *
 * Modes: keel_cascade_enter tells which axes the mode flies. An axis that begins to run begins at
 * what is flown: its first output is the set-point that the axis below has, as far as its
 * integral's limits let it (keel_pid_enter). One whose estimate is not there stops, and asks for 0:
 * no torque, no turning, level, hovering, no speed. An axis that is given NaN, or a number beyond
 * KEEL_PID_INPUT_LIMIT, holds its output, and says so.
 *
 * Angles are sines, which the rows of the attitude's matrix give without trigonometry: roll is v_y,
 * pitch -v_x (attitude.h). A set-point of x rad taken as a sine is an angle of asin x: 1 % more at
 * 0.24, 4.7 % at 0.5, 13.1 % at KEEL_CASCADE_TILT_MAX. Accelerations become sines by a / g, which
 * at such angles is less than tan: 3 % at 0.24, 15 % at 0.5. They are turned by the direction of
 * the body's forward axis, (n_x, e_x), whose length is the cosine of pitch. Loops around these see
 * a gain that is off by as much. Both accelerations are limited to 1/sqrt 2 of what the reach of
 * roll and pitch allows, so that the tilt that the velocity stage asks for is within that in total.
 *
 * Fence: the reach of north, east and height is that of a box about home, height both above and
 * below. From position x and speed v towards a side at L, a set-point towards that side counts as
 * 0, so that the aircraft brakes, unless
 *
 *     x' = x + v T + A T^2 / 2,  v' = max(v + A T, 0):   x' <= L and v'^2 <= 2 a (L - x')
 *
 * A being the greatest acceleration of the vehicle towards the side, a what it brakes with at
 * least, T the reaction time, from a measurement to when the braking works that follows from the
 * next one. By a proof over the reals (proofs/cascade/fence.c) this stays inside of the fence,
 * with way to brake, at all times. That the aircraft does A, a and T is an assumption.
 *
 * No division, square root or trigonometry in a step. Single precision throughout. Sources must be
 * compiled without contraction of products and sums, as all builds of Keel do.
 */
#ifndef KEEL_FLIGHT_CASCADE_H
#define KEEL_FLIGHT_CASCADE_H

#include "keel/c_declarations.h"
#include "keel/flight/attitude.h"
#include "keel/flight/mixer.h"
#include "keel/flight/pid.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** @name Axes: from set-points to outputs. */
/** @{ */
#define KEEL_CASCADE_ROLL_RATE   0u  /**< rad/s about x to torque. */
#define KEEL_CASCADE_PITCH_RATE  1u  /**< rad/s about y to torque. */
#define KEEL_CASCADE_YAW_RATE    2u  /**< rad/s about z to torque. */
#define KEEL_CASCADE_ROLL        3u  /**< Sine, right side down, to rad/s. */
#define KEEL_CASCADE_PITCH       4u  /**< Sine, nose up, to rad/s. */
#define KEEL_CASCADE_NORTH_SPEED 5u  /**< m/s to m/s^2. */
#define KEEL_CASCADE_EAST_SPEED  6u  /**< m/s to m/s^2. */
#define KEEL_CASCADE_CLIMB       7u  /**< m/s, positive up, to thrust on top of hovering. */
#define KEEL_CASCADE_NORTH       8u  /**< m from home to m/s. */
#define KEEL_CASCADE_EAST        9u  /**< m from home to m/s. */
#define KEEL_CASCADE_HEIGHT      10u /**< m above home to m/s. */
#define KEEL_CASCADE_AXES        11u
/** @} */

/** The greatest reach: of rates, in rad/s; of sines; of speeds, in m/s; of distances, in m. */
#define KEEL_CASCADE_RATE_MAX     64.0f
#define KEEL_CASCADE_TILT_MAX     0.75f
#define KEEL_CASCADE_SPEED_MAX    100.0f
#define KEEL_CASCADE_DISTANCE_MAX 16384.0f

/** The greatest acceleration, in m/s^2, and the least braking. */
#define KEEL_CASCADE_ACCELERATION_MAX 64.0f
#define KEEL_CASCADE_BRAKING_MIN      0.25f

/** The longest reaction time, in s. */
#define KEEL_CASCADE_REACTION_MAX_S 4.0f

/** The factor from an acceleration in m/s^2 to a sine: 1/g. */
#define KEEL_CASCADE_PER_GRAVITY 0.101971618831157684326171875f

/** g in m/s^2; and g / sqrt 2, rounded down. */
#define KEEL_CASCADE_GRAVITY  9.8066501617431640625f
#define KEEL_CASCADE_DIAGONAL 6.93359375f

/** The bound of each component of the body's forward axis. */
#define KEEL_CASCADE_HEADING_MAX 1.0009765625f

/** From this part on, an axis of the body at its limit counts for north or east. */
#define KEEL_CASCADE_SHARE 0.5f

/** The configuration of a cascade. */
typedef struct keel_cascade_config {
    keel_pid_config_t pid[KEEL_CASCADE_AXES]; /**< Each at the rate of its stage. */
    float reach[KEEL_CASCADE_AXES];           /**< Greatest set-points, in the unit of the axis. */
    float hover;                              /**< Thrust that hovers, 0 to 1. */
    float acceleration;                       /**< A, in m/s^2. */
    float braking;                            /**< a, in m/s^2. */
    float reaction_s;                         /**< T, in s: at least a period of the speeds. */
} keel_cascade_config_t;

/** Whether something is at its limits. */
typedef struct keel_cascade_limit {
    bool at_min; /**< It, or what it acts on, goes no lower. */
    bool at_max; /**< It, or what it acts on, goes no higher. */
} keel_cascade_limit_t;

/** One controller of the cascade. */
typedef struct keel_cascade_axis {
    keel_pid_t pid;
    float reach;                /**< The greatest set-point. */
    keel_cascade_limit_t limit; /**< For the axis above: do not ask for more. */
    bool running;               /**< It controls; if not, it is entered again. */
    bool held;                  /**< The last step was none: the output is that before. */
} keel_cascade_axis_t;

/** The inputs of an axis in a step. */
typedef struct keel_cascade_input {
    float setpoint;             /**< Any bit pattern. */
    float measured;             /**< Any bit pattern. */
    float flown;                /**< The set-point of the axis below now. */
    keel_cascade_limit_t below; /**< Whether the axis below, or the mixer, is at its limit. */
    bool valid;                 /**< There is a measurement, and the mode flies this axis. */
} keel_cascade_input_t;

/** The fence, as a step needs it. */
typedef struct keel_cascade_fence {
    float gain;          /**< A T, in m/s. */
    float half_gain;     /**< A T / 2, in m/s. */
    float reaction_s;    /**< T, in s. */
    float twice_braking; /**< 2 a, in m/s^2. */
} keel_cascade_fence_t;

/** Along north, east and up: in m from home, or in m/s. */
typedef struct keel_cascade_vector {
    float north;
    float east;
    float up;
} keel_cascade_vector_t;

/** Of roll and pitch: sines of angles, or rates in rad/s. */
typedef struct keel_cascade_tilt {
    float roll;
    float pitch;
} keel_cascade_tilt_t;

/** The set-points of the rate stage. */
typedef struct keel_cascade_rates {
    float roll;   /**< About x, in rad/s. */
    float pitch;  /**< About y, in rad/s. */
    float yaw;    /**< About z, in rad/s. */
    float thrust; /**< 0 to 1. */
} keel_cascade_rates_t;

/** Where the aircraft is. */
typedef struct keel_cascade_estimate {
    keel_cascade_vector_t position; /**< In m from home. */
    keel_cascade_vector_t velocity; /**< In m/s. */
    float forward_north;            /**< The body's forward axis: n_x of attitude.h. */
    float forward_east;             /**< e_x of attitude.h. */
    bool has_place;                 /**< North and east are known, and the forward axis. */
    bool has_height;                /**< Height and climb rate are known. */
} keel_cascade_estimate_t;

/** A cascade, and what its stages ask for. */
typedef struct keel_cascade {
    keel_cascade_axis_t axis[KEEL_CASCADE_AXES];
    keel_cascade_fence_t fence;
    float hover;
    uint32_t axes;                  /**< The axes that the mode flies: bit 1u << axis. */
    uint32_t gave_way;              /**< The parts that the mixer gave up last. */
    keel_cascade_vector_t velocity; /**< The position stage asks for this, in m/s. */
    keel_cascade_tilt_t tilt;       /**< The velocity stage asks for this, in sines. */
    float thrust;                   /**< And for this. */
    keel_cascade_tilt_t rates;      /**< The angle stage asks for this, in rad/s. */
    keel_mixer_command_t command;   /**< The rate stage asks for this. */
} keel_cascade_t;

/**
 * Whether one axis of a configuration can be flown (requirement CAS-001): its controller can be
 * made, its reach is from 0 to the greatest, and its outputs are within what takes them. The other
 * numbers are looked at with each axis.
 *
 * @param config the configuration, any bit pattern
 * @param axis   the axis
 * @return KEEL_OK; KEEL_ERR_INPUT when there is no such axis; KEEL_ERR_LIMITS when a number is out
 *         of its range, the output's limits are beyond the reach of the axis below, -1 to 1 for a
 *         torque, 0 to 1 for the thrust, or for an acceleration beyond what the tilt allows or A,
 *         or within a, or the reaction time is below a period of the speeds; what keel_pid_init
 *         says of the controller
 */
keel_status_t keel_cascade_check(const keel_cascade_config_t *config, uint32_t axis);

/**
 * Makes a cascade, no axis of which runs (requirement CAS-002).
 *
 * @param cascade the cascade
 * @param config  what it is made from; copied
 * @return KEEL_OK, or what keel_cascade_check says of the first axis that is not good: then nothing
 *         is changed
 */
keel_status_t keel_cascade_init(keel_cascade_t *cascade, const keel_cascade_config_t *config);

/**
 * Flies the axes of a mode; the others stop (requirement CAS-003). Calling it again with the same
 * mode changes nothing. The sticks may go in at any stage of those that the mode flies:
 *
 *     ACRO            rates
 *     ANGLE           rates, roll and pitch
 *     LAND            rates, roll and pitch, climb
 *     ALTITUDE        rates, roll and pitch, climb and height
 *     POSITION, RETURN all
 *     any other       none: torques and thrust are 0
 *
 * @param cascade the cascade
 * @param mode    the mode in force (mode.h), any number
 */
void keel_cascade_enter(keel_cascade_t *cascade, uint8_t mode);

/**
 * One step of one axis (requirements CAS-004 to CAS-007). The stages do this for all of theirs.
 *
 * @param axis  the axis
 * @param input its inputs
 */
void keel_cascade_axis_step(keel_cascade_axis_t *axis, const keel_cascade_input_t *input);

/**
 * One step of the rate stage; the result is cascade->command (requirement CAS-008).
 *
 * @param cascade  the cascade
 * @param asked    rates and thrust, any bit patterns; a thrust out of its range counts as the end
 *                 that is next to it, NaN as 0
 * @param rate     the body's rates, in rad/s, any bit patterns
 * @param gave_way what the mixer gave up for the last command: its flags
 */
void keel_cascade_rate_step(keel_cascade_t *cascade, keel_cascade_rates_t asked,
                            keel_attitude_vector_t rate, uint32_t gave_way);

/**
 * One step of the angle stage; the result is cascade->rates (requirement CAS-009).
 *
 * @param cascade the cascade
 * @param asked   sines of roll and pitch, any bit patterns
 * @param down    down as the body sees it, v of attitude.h, any bit patterns
 * @param valid   whether that is known
 */
void keel_cascade_angle_step(keel_cascade_t *cascade, keel_cascade_tilt_t asked,
                             keel_attitude_vector_t down, bool valid);

/**
 * One step of the velocity stage; the results are cascade->tilt and cascade->thrust (requirements
 * CAS-010, CAS-011).
 *
 * @param cascade  the cascade
 * @param asked    velocities, any bit patterns; those towards a side of the fence that is near
 *                 count as 0
 * @param estimate where the aircraft is, any bit patterns
 */
void keel_cascade_velocity_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                const keel_cascade_estimate_t *estimate);

/**
 * One step of the position stage; the result is cascade->velocity (requirement CAS-013).
 *
 * @param cascade  the cascade
 * @param asked    a place, any bit patterns; one beyond the fence counts as the next one within
 * @param estimate where the aircraft is, any bit patterns
 */
void keel_cascade_position_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                const keel_cascade_estimate_t *estimate);

KEEL_C_END

#endif
