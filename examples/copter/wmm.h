/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file wmm.h
 * @brief The Earth's magnetic field by place.
 *
 * A table of the World Magnetic Model WMM2025 (NOAA, BGS), 10 degrees apart, on the line between
 * its neighbours along either way. Between 65 degrees south and north, where the field's horizontal
 * part is 8 uT at least, the direction of north is off by 1.2 degrees at most from the model's in
 * the middle of 2027, by 0.25 in the mean square; the inclination by 1.6 degrees, the strength by
 * 2.2 %. There the model's north drifts by up to 0.4 degrees a year, by 0.1 at half of the places
 * (tests/tools/test_world.py). It ends with 2029, and has errors of its own.
 */
#ifndef COPTER_WMM_H
#define COPTER_WMM_H

#include <stdint.h>

#define COPTER_WMM_ROWS    17u /**< Latitudes, from 80 degrees south to 80 degrees north. */
#define COPTER_WMM_COLUMNS 36u /**< Longitudes, from 180 degrees west on. */

/** The table, in 3 nT: north, east, down. */
extern const int16_t copter_wmm_table[COPTER_WMM_ROWS][COPTER_WMM_COLUMNS][3];

/** A field, Earth, in microtesla. */
typedef struct copter_wmm_field {
    float north;
    float east;
    float down;
} copter_wmm_field_t;

/**
 * The field at a place.
 *
 * @param latitude  in 1e-7 degrees; beyond 80 degrees counts as that
 * @param longitude in 1e-7 degrees; beyond 180 degrees counts as that
 */
copter_wmm_field_t copter_wmm_field(int32_t latitude, int32_t longitude);

#endif
