/* SPDX-License-Identifier: Apache-2.0 */
#include "parameters.h"

#include "keel/middleware/range.h"

#include <stddef.h>
#include <string.h>

#define NAME_BYTES   ((uint32_t)KEEL_PARAMETER_NAME_LENGTH)
#define RECORD_BYTES ((uint32_t)KEEL_PARAMETER_RECORD_BYTES)

/* Where type and number are in a record. */
#define TYPE_AT   NAME_BYTES
#define NUMBER_AT (NAME_BYTES + 1u)

#define BITS_OF_BYTE 8u

/* Whether a value is of a row's type and within its range. */
static bool value_fits(const keel_parameter_t *row, const keel_parameter_value_t *value)
{
    if (value->type != row->initial.type) {
        return false;
    }
    if (value->type == KEEL_PARAMETER_FLOAT) {
        return keel_range_contains(value->real, row->lowest.real, row->highest.real);
    }
    return (row->lowest.whole <= value->whole) && (value->whole <= row->highest.whole);
}

/* Whether a row can be used at all. */
static bool row_is_right(const keel_parameter_t *row)
{
    const keel_parameter_type_t type = row->initial.type;

    return (row->lowest.type == type) && (row->highest.type == type) &&
           (row->name[KEEL_PARAMETER_NAME_LENGTH] == '\0') && value_fits(row, &row->initial);
}

/* The number that does not count is 0. */
static void put_value(keel_parameter_value_t *to, const keel_parameter_value_t *from)
{
    const bool is_real = from->type == KEEL_PARAMETER_FLOAT;

    to->type = from->type;
    to->real = is_real ? from->real : 0.0f;
    to->whole = is_real ? 0 : from->whole;
}

static keel_status_t ask_check(const keel_parameters_config_t *config)
{
    return config->check(config->context, config->entry);
}

static void put_defaults(const keel_parameters_config_t *config)
{
    for (uint16_t i = 0u; i < config->count; i++) {
        put_value(&config->entry[i].value, &config->table[i].initial);
        config->entry[i].refused = KEEL_OK;
    }
}

/* Names end at a zero, or with NAME_BYTES characters. */
static bool is_named(const keel_parameter_t *row, const char *name)
{
    for (uint32_t i = 0u; i < NAME_BYTES; i++) {
        if (row->name[i] != name[i]) {
            return false;
        }
        if (name[i] == '\0') {
            return true;
        }
    }
    return true;
}

uint32_t keel_parameter_bits(keel_parameter_value_t value)
{
    uint32_t bits = (uint32_t)value.whole;

    if (value.type == KEEL_PARAMETER_FLOAT) {
        (void)memcpy(&bits, &value.real, sizeof bits);
    }
    return bits;
}

keel_parameter_value_t keel_parameter_from_bits(keel_parameter_type_t type, uint32_t bits)
{
    keel_parameter_value_t value = {.type = type, .real = 0.0f, .whole = 0};

    if (type == KEEL_PARAMETER_FLOAT) {
        (void)memcpy(&value.real, &bits, sizeof bits);
    } else {
        (void)memcpy(&value.whole, &bits, sizeof bits);
    }
    return value;
}

static bool is_default(const keel_parameters_t *parameters, uint16_t index)
{
    return keel_parameter_bits(parameters->config.entry[index].value) ==
           keel_parameter_bits(parameters->config.table[index].initial);
}

static void write_record(uint8_t *record, const char *name, const keel_parameter_value_t *value)
{
    const uint32_t bits = keel_parameter_bits(*value);
    bool ended = false;

    for (uint32_t i = 0u; i < NAME_BYTES; i++) {
        ended = ended || (name[i] == '\0');
        record[i] = ended ? 0u : (uint8_t)name[i];
    }
    record[TYPE_AT] = (uint8_t)value->type;
    for (uint32_t i = 0u; i < (RECORD_BYTES - NUMBER_AT); i++) {
        record[NUMBER_AT + i] = (uint8_t)((bits >> (BITS_OF_BYTE * i)) & 0xFFu);
    }
}

/* The parameter that a record names, or their number. */
static uint16_t find_record(const keel_parameters_t *parameters, const uint8_t *record)
{
    char name[KEEL_PARAMETER_NAME_LENGTH];

    for (uint32_t i = 0u; i < NAME_BYTES; i++) {
        name[i] = (char)record[i];
    }
    return keel_parameters_find(parameters, name);
}

/* Types that there are none of stay so: no row has them. */
static keel_parameter_value_t record_value(const uint8_t *record)
{
    uint32_t bits = 0u;

    for (uint32_t i = 0u; i < (RECORD_BYTES - NUMBER_AT); i++) {
        bits |= (uint32_t)record[NUMBER_AT + i] << (BITS_OF_BYTE * i);
    }
    return keel_parameter_from_bits((keel_parameter_type_t)record[TYPE_AT], bits);
}

/* Takes a value that fits; checks the whole if it is asked to. */
static keel_status_t take_value(const keel_parameters_t *parameters, uint16_t index,
                                const keel_parameter_value_t *value, bool is_checked)
{
    keel_parameter_value_t *const now = &parameters->config.entry[index].value;
    const keel_parameter_value_t before = *now;
    keel_status_t status = KEEL_OK;

    if (!value_fits(&parameters->config.table[index], value)) {
        return KEEL_ERR_VALUE;
    }
    put_value(now, value);
    if (is_checked) {
        status = ask_check(&parameters->config);
    }
    if (status != KEEL_OK) {
        put_value(now, &before);
    }
    return status;
}

/* Loads each record; bytes behind the last whole one are none. */
static keel_parameters_loaded_t load_records(const keel_parameters_t *parameters,
                                             const uint8_t *image, uint32_t length, bool is_checked)
{
    keel_parameters_loaded_t loaded = {.taken = 0u, .refused = 0u, .unknown = 0u};

    put_defaults(&parameters->config);
    for (uint32_t at = 0u; (length - at) >= RECORD_BYTES; at += RECORD_BYTES) {
        const uint16_t index = find_record(parameters, &image[at]);

        if (index == parameters->config.count) {
            loaded.unknown++;
        } else {
            const keel_parameter_value_t value = record_value(&image[at]);
            const keel_status_t status = take_value(parameters, index, &value, is_checked);

            parameters->config.entry[index].refused = status;
            if (status == KEEL_OK) {
                loaded.taken++;
            } else {
                loaded.refused++;
            }
        }
    }
    return loaded;
}

keel_status_t keel_parameters_init(keel_parameters_t *parameters,
                                   const keel_parameters_config_t *config)
{
    keel_status_t status;

    if ((config->table == NULL) || (config->entry == NULL) || (config->check == NULL) ||
        (config->count == 0u)) {
        return KEEL_ERR_NULL;
    }
    for (uint16_t i = 0u; i < config->count; i++) {
        if (!row_is_right(&config->table[i])) {
            return KEEL_ERR_LIMITS;
        }
    }
    put_defaults(config);
    status = ask_check(config);
    if (status == KEEL_OK) {
        parameters->config = *config;
    }
    return status;
}

uint16_t keel_parameters_count(const keel_parameters_t *parameters)
{
    return parameters->config.count;
}

const char *keel_parameters_name(const keel_parameters_t *parameters, uint16_t index)
{
    return (index < parameters->config.count) ? parameters->config.table[index].name : NULL;
}

uint16_t keel_parameters_find(const keel_parameters_t *parameters, const char *name)
{
    uint16_t index = 0u;

    while ((index < parameters->config.count) &&
           !is_named(&parameters->config.table[index], name)) {
        index++;
    }
    return index;
}

keel_parameter_value_t keel_parameters_get(const keel_parameters_t *parameters, uint16_t index)
{
    return parameters->config.entry[index].value;
}

keel_status_t keel_parameters_set(keel_parameters_t *parameters, uint16_t index,
                                  keel_parameter_value_t value)
{
    keel_status_t status = KEEL_ERR_INPUT;

    if (index < parameters->config.count) {
        status = take_value(parameters, index, &value, true);
    }
    if (status == KEEL_OK) {
        parameters->config.entry[index].refused = KEEL_OK;
    }
    return status;
}

keel_status_t keel_parameters_set_by_name(keel_parameters_t *parameters, const char *name,
                                          keel_parameter_value_t value)
{
    return keel_parameters_set(parameters, keel_parameters_find(parameters, name), value);
}

keel_status_t keel_parameters_pack(const keel_parameters_t *parameters, uint8_t *image,
                                   uint32_t room, uint32_t *length)
{
    uint32_t at = 0u;

    for (uint16_t i = 0u; i < parameters->config.count; i++) {
        if (!is_default(parameters, i)) {
            if ((room - at) < RECORD_BYTES) {
                return KEEL_ERR_FULL;
            }
            write_record(&image[at], parameters->config.table[i].name,
                         &parameters->config.entry[i].value);
            at += RECORD_BYTES;
        }
    }
    *length = at;
    return KEEL_OK;
}

keel_parameters_loaded_t keel_parameters_load(keel_parameters_t *parameters, const uint8_t *image,
                                              uint32_t length)
{
    keel_parameters_loaded_t loaded = load_records(parameters, image, length, false);

    if (ask_check(&parameters->config) != KEEL_OK) {
        loaded = load_records(parameters, image, length, true);
    }
    return loaded;
}
