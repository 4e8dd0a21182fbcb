/* SPDX-License-Identifier: Apache-2.0 */
#include "wmm.h"

#define STEP     100000000 /* 10 degrees. */
#define NORTH    INT32_C(800000000)
#define EAST     INT32_C(1800000000)
#define PER_UNIT 0.003f /* Microtesla in a number of the table. */

/* Where a coordinate lies in the table: a step's number and the part of the step behind it. */
typedef struct place {
    uint32_t step;
    float part;
} place_t;

static int32_t limit_to(int32_t value, int32_t most)
{
    if (value > most) {
        return most;
    }
    return (value < -most) ? -most : value;
}

static place_t place_of(int32_t value, int32_t most, uint32_t steps)
{
    const uint32_t from = (uint32_t)((int64_t)limit_to(value, most) + most);
    const uint32_t step = from / (uint32_t)STEP;

    /* The last one has no step behind it. */
    return (step < steps) ? (place_t){step, (float)(from % (uint32_t)STEP) / (float)STEP}
                          : (place_t){steps - 1u, 1.0f};
}

static float interpolate(float first, float then, float part)
{
    return first + (part * (then - first));
}

copter_wmm_field_t copter_wmm_field(int32_t latitude, int32_t longitude)
{
    const place_t row = place_of(latitude, NORTH, COPTER_WMM_ROWS - 1u);
    const place_t column = place_of(longitude, EAST, COPTER_WMM_COLUMNS);
    const uint32_t next = (column.step + 1u) % COPTER_WMM_COLUMNS;
    float part[3];

    for (uint32_t k = 0u; k < 3u; k++) {
        const float south = interpolate((float)copter_wmm_table[row.step][column.step][k],
                                        (float)copter_wmm_table[row.step][next][k], column.part);
        const float north = interpolate((float)copter_wmm_table[row.step + 1u][column.step][k],
                                        (float)copter_wmm_table[row.step + 1u][next][k],
                                        column.part);

        part[k] = PER_UNIT * interpolate(south, north, row.part);
    }
    return (copter_wmm_field_t){part[0], part[1], part[2]};
}
