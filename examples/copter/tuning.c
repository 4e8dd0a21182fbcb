/* SPDX-License-Identifier: Apache-2.0 */
#include "tuning.h"

#include "keel/flight/altitude.h"

#include <stddef.h>

/* Steps of a save in a run: of 8 bytes each, so that 4 KiB are saved in 13 s at 10 Hz. */
#define STEPS_PER_RUN 8u

copter_settings_t copter_settings;

/* One of each unit, to see whether it takes its settings. */
typedef struct units {
    keel_virtual_imu_t imu;
    keel_virtual_imu_t slow;
    keel_filter_t force;
    keel_filter_t rate;
    keel_calibration_rest_t gyroscope;
    keel_calibration_field_t field;
    keel_attitude_t attitude;
    keel_altitude_t altitude;
    keel_position_t position;
    keel_reference_t reference;
    keel_battery_t battery;
    keel_mode_t mode;
    keel_cascade_t cascade;
    keel_mixer_t mixer;
} units_t;

static void set_fields(copter_settings_t *settings, const keel_parameter_entry_t *entry)
{
    *settings = copter_defaults;
    copter_apply_parameters(settings, entry);
}

/* The first reason of a unit not to take its settings. */
static keel_status_t try_units(const copter_settings_t *tried)
{
    static units_t unit;
    const keel_mixer_config_t mixer = {
        .geometry = keel_mixer_quad_x, .idle = tried->mixer.idle, .highest = tried->mixer.highest};
    const keel_status_t status[] = {
        keel_virtual_imu_init(&unit.imu, &tried->imu),
        keel_virtual_imu_init(&unit.slow, &tried->slow),
        keel_filter_init(&unit.force, COPTER_VOTE_HZ, tried->accelerometer_hz),
        keel_filter_init(&unit.rate, COPTER_VOTE_HZ, tried->gyroscope_hz),
        keel_calibration_rest_init(&unit.gyroscope, &tried->gyroscope),
        keel_calibration_field_init(&unit.field, &tried->field),
        keel_attitude_init(&unit.attitude, &tried->attitude),
        keel_altitude_init(&unit.altitude, &tried->altitude),
        keel_position_init(&unit.position, &tried->position),
        keel_reference_init(&unit.reference, &tried->reference),
        keel_battery_init(&unit.battery, &tried->battery),
        keel_mode_init(&unit.mode, &tried->mode),
        keel_cascade_init(&unit.cascade, &tried->cascade),
        keel_mixer_init(&unit.mixer, &mixer)};
    keel_status_t first = KEEL_OK;

    for (uint32_t i = 0u; (i < (sizeof status / sizeof status[0])) && (first == KEEL_OK); i++) {
        first = status[i];
    }
    return first;
}

static keel_status_t check_settings(void *context, const keel_parameter_entry_t *entry)
{
    static copter_settings_t tried;

    (void)context;
    set_fields(&tried, entry);
    return try_units(&tried);
}

static void load(copter_tuning_t *tuning, const keel_medium_t *memory)
{
    const keel_slots_config_t config = {.medium = *memory,
                                        .address = {COPTER_PARAMETER_FIRST, COPTER_PARAMETER_OTHER},
                                        .room = COPTER_PARAMETER_BYTES};

    if (keel_slots_init(&tuning->slots, &config) == KEEL_OK) {
        tuning->has_memory = true;
        tuning->found = keel_slots_load(&tuning->slots, tuning->image, &tuning->length);
    }
    if (tuning->found == KEEL_SLOTS_DONE) {
        tuning->loaded = keel_parameters_load(&tuning->table, tuning->image, tuning->length);
    }
}

bool copter_tuning_differs(const copter_tuning_t *tuning, uint16_t index)
{
    return keel_parameter_bits(tuning->entry[index].value) !=
           keel_parameter_bits(tuning->in_force[index].value);
}

/* Whether it changes anything. A parameter that waits for a restart stays as it is unless this is
 * one. Those are all parameters of the units that have them, so each unit's settings are either as
 * they were, or as the check has seen them. */
static bool put_in_force(copter_tuning_t *tuning, bool is_start)
{
    bool changes = is_start;

    for (uint16_t i = 0u; i < COPTER_PARAMETER_COUNT; i++) {
        if (is_start || (!copter_parameter[i].restarts && copter_tuning_differs(tuning, i))) {
            tuning->in_force[i] = tuning->entry[i];
            changes = true;
        }
    }
    if (changes) {
        set_fields(&copter_settings, tuning->in_force);
    }
    return changes;
}

keel_status_t copter_tuning_start(copter_tuning_t *tuning, const keel_medium_t *memory)
{
    const keel_parameters_config_t config = {.table = copter_parameter,
                                             .entry = tuning->entry,
                                             .count = COPTER_PARAMETER_COUNT,
                                             .check = check_settings,
                                             .context = NULL};
    const keel_status_t status = keel_parameters_init(&tuning->table, &config);

    if (status != KEEL_OK) {
        return status;
    }
    tuning->loaded = (keel_parameters_loaded_t){.taken = 0u};
    tuning->found = KEEL_SLOTS_NONE;
    tuning->saved = KEEL_SLOTS_DONE;
    tuning->has_memory = false;
    if (memory != NULL) {
        load(tuning, memory);
    }
    put_in_force(tuning, true);
    return KEEL_OK;
}

bool copter_tuning_apply(copter_tuning_t *tuning)
{
    return put_in_force(tuning, false);
}

keel_status_t copter_tuning_save(copter_tuning_t *tuning)
{
    keel_status_t status = KEEL_ERR_NULL;

    if (tuning->has_memory && (tuning->saved != KEEL_SLOTS_BUSY)) {
        status = keel_parameters_pack(&tuning->table, tuning->image, COPTER_PARAMETER_BYTES,
                                      &tuning->length);
    } else if (tuning->has_memory) {
        status = KEEL_ERR_STATE;
    } else {
        status = KEEL_ERR_NULL;
    }
    if (status == KEEL_OK) {
        status = keel_slots_begin(&tuning->slots, tuning->image, tuning->length);
    }
    if (status == KEEL_OK) {
        tuning->saved = KEEL_SLOTS_BUSY;
    }
    return status;
}

void copter_tuning_step(copter_tuning_t *tuning)
{
    for (uint32_t i = 0u; (i < STEPS_PER_RUN) && (tuning->saved == KEEL_SLOTS_BUSY); i++) {
        tuning->saved = keel_slots_step(&tuning->slots);
    }
}
