/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file battery.h
 * @brief Battery monitor: charge, energy, remaining flight time and level, from one or two power
 *        modules (section II-A of the paper).
 *
 * The modules lie side by side between the battery, or the batteries of one voltage, and the
 * aircraft: their currents add up to I. Of their voltages the lower one is V, as an alarm that
 * comes too early costs a flight, and one that comes too late the aircraft; that they differ is
 * told. A step, T = 1 / rate_hz, from V, I, a battery of n cells with resistance R, and its charge
 * C, of which it had the part `initial` when the monitor began:
 *
 *     charge used    the sum of I T          energy used    the sum of V I T
 *     charge left    initial C - charge used, not below 0
 *     smoothed       J <- J + (I - J) / (1 + smoothing_steps), while the motors run
 *     time left      (charge left - critical_charge C) / J, not below 0, at most cap_s
 *     cell           V / n + min(I R / n, KEEL_BATTERY_SAG_LIMIT): what a cell has without load
 *
 * Sums are kept in integers, in quanta of 2^-20 A T and 2^-12 W T: a millisecond's charge is not
 * lost next to an hour's, nothing overflows, and nothing runs backwards (requirements BAT-007 and
 * BAT-008). A negative current is flagged and counts as 0: a battery is not charged in flight. The
 * time left is that until the level KEEL_BATTERY_CRITICAL, not that until the battery is empty.
 *
 * Two alarms, low and critical, look at the cell's voltage and at the charge left:
 *
 *     evidence for      the charge left is at most the alarm's part of C, or a new voltage came and
 *                       the cell is at its threshold or below
 *     evidence against  a new voltage came, and the cell is above the threshold; once the alarm is
 *                       raised, above it by voltage_margin at least; and the charge is enough
 *
 * A count goes up by 1 with evidence for, to settle_steps, down by 1 with evidence against, to 0,
 * and stays without any. At settle_steps the alarm is raised, at 0 it is taken back. So no single
 * sample raises one, whatever it says, and what flutters about a threshold does not make the alarm
 * flutter. An alarm for want of charge is not taken back, as no charge comes back.
 *
 * A module whose current does not come, is no number, or is out of the stated range is flagged; the
 * current that came last is held. After hold_steps such steps the module is lost. The charge used
 * is then not known any more, until a restart: the count goes on with the held current, as an
 * estimate, and the level is not KEEL_BATTERY_OK. The modules may come late after a start, as long
 * as no motor runs.
 *
 * For the mode machine, KEEL_BATTERY_LOW is KEEL_MODE_BATTERY_CRITICAL (time to return), and
 * KEEL_BATTERY_CRITICAL is KEEL_MODE_BATTERY_EMPTY (time to land).
 *
 * Single precision; one division in a step, and no library call. Sources must be compiled without
 * contraction of products and sums (ISO C mode, -std=c99, as all builds of Keel do).
 */
#ifndef KEEL_FLIGHT_BATTERY_H
#define KEEL_FLIGHT_BATTERY_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** The most power modules. */
#define KEEL_BATTERY_MODULES 2u

/** The most cells in series. */
#define KEEL_BATTERY_CELLS_MAX 14u

/** The most steps per second. */
#define KEEL_BATTERY_RATE_MAX_HZ 1000u

/** The greatest voltage, of a module, in V; current, of a module and of all of them, in A. */
#define KEEL_BATTERY_VOLTAGE_LIMIT 64.0f
#define KEEL_BATTERY_CURRENT_LIMIT 512.0f
#define KEEL_BATTERY_TOTAL_LIMIT   1024.0f

/** The least and the greatest charge of a battery, in Ah. */
#define KEEL_BATTERY_CAPACITY_MIN_AH 0.25f
#define KEEL_BATTERY_CAPACITY_MAX_AH 1000.0f

/** The greatest resistance of a battery, in ohm. */
#define KEEL_BATTERY_RESISTANCE_LIMIT 1.0f

/** The greatest voltage of a cell that is a threshold or a margin, in V. */
#define KEEL_BATTERY_CELL_LIMIT 5.0f

/** How much a cell's voltage is raised for its load at most, in V: a wrong current cannot hide an
 * empty battery for longer than that. */
#define KEEL_BATTERY_SAG_LIMIT 0.5f

/** The least and the greatest cap of the time left, in s. */
#define KEEL_BATTERY_CAP_MIN_S 1.0f
#define KEEL_BATTERY_CAP_MAX_S 100000.0f

/** The longest smoothing, in steps. Beyond, single precision would lose what a step adds: up to
 * here the smoothed current comes within 2^-9 of a current that lasts. */
#define KEEL_BATTERY_SMOOTHING_MAX 16384u

/** The least number of steps that raise an alarm: one does not. */
#define KEEL_BATTERY_SETTLE_MIN 2u

/** Quanta in the unit of keel_battery_sum_t. */
#define KEEL_BATTERY_QUANTA 1048576u

/* Events of the last step: keel_battery_t, flags. Those of module 1 are shifted by 1. */
#define KEEL_BATTERY_NO_VOLTAGE   0x0001u /**< Of module 0: none came, or none that can be. */
#define KEEL_BATTERY_NO_CURRENT   0x0004u /**< Of module 0: none came, or none that can be. */
#define KEEL_BATTERY_LOST         0x0010u /**< Of module 0: its current has been held too long. */
#define KEEL_BATTERY_REVERSED     0x0040u /**< Of module 0: a negative current, taken for none. */
#define KEEL_BATTERY_VOLTAGE_LOST 0x0100u /**< No module's voltage came for hold_steps. */
#define KEEL_BATTERY_SPREAD       0x0200u /**< The modules' voltages differ by too much. */
#define KEEL_BATTERY_SAG          0x0400u /**< The load's part in a cell is at its limit. */
#define KEEL_BATTERY_FULL         0x0800u /**< A sum is at its end, and stays there. */

/* The state of the count of charge: keel_battery_count_t. */
#define KEEL_BATTERY_WAITING   0u /**< Not all modules have come yet. */
#define KEEL_BATTERY_COUNTED   1u /**< Every current since the start is in it, or was held a bit. */
#define KEEL_BATTERY_UNCOUNTED 2u /**< A module was lost: it is an estimate until a restart. */

/* How much the battery still has: keel_battery_level_t. */
#define KEEL_BATTERY_UNKNOWN  0u /**< No alarm, but voltage or charge are not known. */
#define KEEL_BATTERY_OK       1u /**< All has been known for settle_steps, and there is no alarm. */
#define KEEL_BATTERY_LOW      2u /**< Time to return. */
#define KEEL_BATTERY_CRITICAL 3u /**< Time to land. */

/** The configuration of a monitor. */
typedef struct keel_battery_config {
    float capacity_ah;        /**< C, CAPACITY_MIN_AH to CAPACITY_MAX_AH, in Ah. */
    float initial;            /**< The part of it that the battery has, 0 to 1. */
    float resistance_ohm;     /**< R, 0 to RESISTANCE_LIMIT; too little is on the safe side. */
    float voltage_min;        /**< A module's least voltage that can be, 0 to voltage_max, in V. */
    float voltage_max;        /**< The greatest, to VOLTAGE_LIMIT, in V. */
    float voltage_spread;     /**< By what modules may differ, 0 to VOLTAGE_LIMIT, in V. */
    float current_min;        /**< How far offset may go below 0, -CURRENT_LIMIT to 0, in A. */
    float current_max;        /**< A module's greatest current, 0 to CURRENT_LIMIT, in A. */
    float current_expected;   /**< J at the start, in flight, 0 to TOTAL_LIMIT, in A. */
    float cap_s;              /**< The longest reported time left, CAP_MIN_S to CAP_MAX_S. */
    float low_voltage;        /**< Of a cell, critical_voltage to CELL_LIMIT, in V. */
    float critical_voltage;   /**< Of a cell, 0 to CELL_LIMIT, in V. */
    float voltage_margin;     /**< By what a cell must be above again, 0 to CELL_LIMIT, in V. */
    float low_charge;         /**< Part of C, critical_charge to 1. */
    float critical_charge;    /**< Part of C, 0 to 1. */
    uint16_t rate_hz;         /**< Steps per second, 1 to RATE_MAX_HZ. */
    uint16_t smoothing_steps; /**< Time constant of J, 0 to SMOOTHING_MAX, in steps. */
    uint16_t settle_steps;    /**< Steps that make a level, from SETTLE_MIN on. */
    uint16_t hold_steps;      /**< Steps without a sample that lose a module; at least 1. */
    uint8_t cells;            /**< n, in series, 1 to CELLS_MAX. */
    uint8_t modules;          /**< How many there are, 1 or 2. */
} keel_battery_config_t;

/** The measurements of a power module. Values may be any bit pattern. */
typedef struct keel_battery_reading {
    float voltage;    /**< In V. */
    float current;    /**< In A, positive when it leaves the battery. */
    bool has_voltage; /**< Whether there is a new one of each. */
    bool has_current;
} keel_battery_reading_t;

/** The inputs of a step. */
typedef struct keel_battery_sample {
    keel_battery_reading_t module[KEEL_BATTERY_MODULES]; /**< Those that there are. */
    bool running; /**< Whether the motors run: then J follows the current. */
} keel_battery_sample_t;

/** The state of the count of charge: KEEL_BATTERY_WAITING, ... A plain number, as structures hold
 * it: an enumeration's size differs between compilers. */
typedef uint8_t keel_battery_count_t;

/** How much the battery still has: KEEL_BATTERY_UNKNOWN, ... A plain number, too. */
typedef uint8_t keel_battery_level_t;

/** A sum over steps: whole + part / KEEL_BATTERY_QUANTA, of A T or of 256 W T. */
typedef struct keel_battery_sum {
    uint32_t whole;
    uint32_t part; /**< Below KEEL_BATTERY_QUANTA. */
} keel_battery_sum_t;

/** An alarm. */
typedef struct keel_battery_alarm {
    uint16_t count; /**< Up with evidence, down without, 0 to settle_steps. */
    bool raised;
} keel_battery_alarm_t;

/** The last current of a module. */
typedef struct keel_battery_module {
    float current; /**< The last value, 0 to CURRENT_LIMIT, in A. */
    uint16_t age;  /**< Steps since, to hold_steps. */
} keel_battery_module_t;

/** Values that init computes from a configuration. */
typedef struct keel_battery_scale {
    float step_s;       /**< T, in s. */
    float unit_j;       /**< 256 T: a unit of the sum of energy, in J. */
    float gain;         /**< 1 / (1 + smoothing_steps). */
    float per_cell;     /**< 1 / n. */
    float sag;          /**< R / n, in ohm. */
    float per_capacity; /**< 1 / capacity. */
    uint32_t capacity;  /**< C, in A T. */
    uint32_t low;       /**< low_charge C, in A T. */
    uint32_t critical;  /**< critical_charge C, in A T. */
} keel_battery_scale_t;

/** A monitor. Only the functions below write it; all of it may be read. */
typedef struct keel_battery {
    keel_battery_config_t config;                       /**< As checked by init. */
    keel_battery_scale_t scale;                         /**< Values derived from it. */
    keel_battery_module_t module[KEEL_BATTERY_MODULES]; /**< The last currents. */
    keel_battery_sum_t charge;                          /**< Used since the start, in A T. */
    keel_battery_sum_t energy;                          /**< Used since the start, in 256 W T. */
    uint32_t initial;                                   /**< Charge at the start, in A T. */
    uint32_t left;                                      /**< Charge left, in A T. */
    float voltage;                                      /**< V, in V; what came last, 0 before. */
    float current;                 /**< I, in A; with what is held of a module. */
    float smoothed;                /**< J, in A. */
    float cell_voltage;            /**< Of a cell without load, in V. */
    float charge_c;                /**< Charge used, in C. */
    float energy_j;                /**< Energy used, in J. */
    float remaining;               /**< Charge left as a part of C, 0 to 1. */
    float remaining_s;             /**< Time left, 0 to cap_s, in s. */
    keel_battery_alarm_t low;      /**< Its thresholds are low_voltage and low_charge. */
    keel_battery_alarm_t critical; /**< critical_voltage and critical_charge. */
    uint16_t voltage_age;          /**< Steps since a voltage came, to hold_steps. */
    uint16_t known;                /**< Steps in a row in which all is known, to settle_steps. */
    uint32_t flags;                /**< KEEL_BATTERY_NO_VOLTAGE, ...: what the last step met. */
    keel_battery_count_t count;    /**< Whether the charge used is known: one of three. */
    keel_battery_level_t level;    /**< How much the battery still has: one of four. */
} keel_battery_t;

/**
 * Makes a monitor (requirements BAT-001 to BAT-003).
 *
 * @param battery the monitor
 * @param config  what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_RATE (rate_hz), KEEL_ERR_LIMITS (any other number), KEEL_ERR_AGE
 *         (hold_steps) or KEEL_ERR_INITIAL (initial), the first that applies, NaN included: then
 *         nothing is changed
 */
keel_status_t keel_battery_init(keel_battery_t *battery, const keel_battery_config_t *config);

/**
 * Starts again, with a battery that was changed or charged (requirement BAT-003). Not in flight.
 *
 * @param battery the monitor, initialised
 * @param part    the part of its charge that the battery has, 0 to 1; any bit pattern
 * @return KEEL_OK, or KEEL_ERR_INITIAL when it is not from 0 to 1: then nothing is changed
 */
keel_status_t keel_battery_restart(keel_battery_t *battery, float part);

/**
 * One step of the monitor (requirements BAT-004 to BAT-016). Call it at the configured rate,
 * whether there are samples or not; battery->flags says what it met.
 *
 * @param battery the monitor, initialised
 * @param sample  what was measured since the last step
 */
void keel_battery_step(keel_battery_t *battery, const keel_battery_sample_t *sample);

KEEL_C_END

#endif
