/* SPDX-License-Identifier: Apache-2.0 */
#include "parameter_store.h"

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
    keel_filter_t stick;
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
    const keel_mixer_config_t mixer = {.geometry = keel_mixer_quad_x,
                                       .idle = tried->mixer.idle,
                                       .highest = tried->mixer.highest,
                                       .yaw_share = tried->mixer.yaw_share};
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
        keel_filter_init(&unit.stick, COPTER_CONTROL_HZ, tried->stick_hz),
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

static void load_kept(copter_parameter_store_t *store, const keel_medium_t *memory)
{
    const keel_slots_config_t config = {.medium = *memory,
                                        .address = {COPTER_PARAMETER_FIRST, COPTER_PARAMETER_OTHER},
                                        .room = COPTER_PARAMETER_BYTES};

    if (keel_slots_init(&store->slots, &config) == KEEL_OK) {
        store->has_memory = true;
        store->found = keel_slots_load(&store->slots, store->image, &store->length);
    }
    if (store->found == KEEL_SLOTS_DONE) {
        store->loaded = keel_parameters_load(&store->table, store->image, store->length);
    }
}

bool copter_parameter_store_differs(const copter_parameter_store_t *store, uint16_t index)
{
    return keel_parameter_bits(store->entry[index].value) !=
           keel_parameter_bits(store->in_force[index].value);
}

/* Whether it changes anything. A parameter that waits for a restart stays as it is unless this is
 * one. Those are all parameters of the units that have them, so each unit's settings are either as
 * they were, or as the check has seen them. */
static bool put_in_force(copter_parameter_store_t *store, bool is_start)
{
    bool changes = is_start;

    for (uint16_t i = 0u; i < COPTER_PARAMETER_COUNT; i++) {
        if (is_start ||
            (!copter_parameter[i].restarts && copter_parameter_store_differs(store, i))) {
            store->in_force[i] = store->entry[i];
            changes = true;
        }
    }
    if (changes) {
        set_fields(&copter_settings, store->in_force);
    }
    return changes;
}

keel_status_t copter_parameter_store_start(copter_parameter_store_t *store,
                                           const keel_medium_t *memory)
{
    const keel_parameters_config_t config = {.table = copter_parameter,
                                             .entry = store->entry,
                                             .count = COPTER_PARAMETER_COUNT,
                                             .check = check_settings,
                                             .context = NULL};
    const keel_status_t status = keel_parameters_init(&store->table, &config);

    if (status != KEEL_OK) {
        return status;
    }
    store->loaded = (keel_parameters_loaded_t){.taken = 0u};
    store->found = KEEL_SLOTS_NONE;
    store->saved = KEEL_SLOTS_DONE;
    store->has_memory = false;
    if (memory != NULL) {
        load_kept(store, memory);
    }
    put_in_force(store, true);
    return KEEL_OK;
}

bool copter_parameter_store_apply(copter_parameter_store_t *store)
{
    return put_in_force(store, false);
}

keel_status_t copter_parameter_store_save(copter_parameter_store_t *store)
{
    keel_status_t status = KEEL_ERR_NULL;

    if (store->has_memory && (store->saved != KEEL_SLOTS_BUSY)) {
        status = keel_parameters_pack(&store->table, store->image, COPTER_PARAMETER_BYTES,
                                      &store->length);
    } else if (store->has_memory) {
        status = KEEL_ERR_STATE;
    } else {
        status = KEEL_ERR_NULL;
    }
    if (status == KEEL_OK) {
        status = keel_slots_begin(&store->slots, store->image, store->length);
    }
    if (status == KEEL_OK) {
        store->saved = KEEL_SLOTS_BUSY;
    }
    return status;
}

void copter_parameter_store_step(copter_parameter_store_t *store)
{
    for (uint32_t i = 0u; (i < STEPS_PER_RUN) && (store->saved == KEEL_SLOTS_BUSY); i++) {
        store->saved = keel_slots_step(&store->slots);
    }
}
