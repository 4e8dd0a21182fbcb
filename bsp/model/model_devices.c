/* SPDX-License-Identifier: Apache-2.0 */
/* The devices of the board, register by register, and what they say of the plant.
 *
 * A sample is made of what the plant said last when a burst reads it, as the devices make one each
 * millisecond. One that the plant's count does not tell any more is silent: all ones are read of
 * it. One whose values stand repeats itself. */
#include "model.h"

#include <math.h>
#include <string.h>

#define SILENT_US  2500u   /* Of an inertial unit; a millisecond is one sample's time. */
#define QUIET_US   200000u /* Of barometer and magnetometer. */
#define UNITS      2u
#define FORCE_UNIT (9.80665 / 2048.0)            /* In m/s^2. */
#define RATE_UNIT  (0.017453292519943295 / 16.4) /* In rad/s. */
#define FIELD_UNIT (100.0 / 1320.0)              /* In microtesla. */
#define READ       0x80u
#define ONES       0xFFu

#define ICM_IDENTITY 0x98u
#define ICM_STATUS   0x3Au
#define ICM_SAMPLE   0x3Bu
#define ICM_POWER    0x6Bu
#define ICM_WHO      0x75u

#define BMI_IDENTITY  0x00u
#define BMI_SAMPLE    0x02u
#define BMI_WARMTH    0x08u
#define BMI_BANDWIDTH 0x10u
#define BMI_POWER     0x11u
#define BMI_RESET     0x14u
#define BMI_SUSPENDED 0x80u

#define MS_READ        0x00u
#define MS_RESET       0x1Eu
#define MS_PRESSURE    0x48u
#define MS_TEMPERATURE 0x58u
#define MS_PROM        0xA0u
#define MS_RESET_US    2800u
#define MS_CONVERT_US  9040u
#define MS_READING     0x1000000u /* Readings are below. */

#define IST_STATUS     0x02u
#define IST_FIELD      0x03u
#define IST_CONTROL_1  0x0Au
#define IST_CONTROL_2  0x0Bu
#define IST_CONTROL_3  0x0Du
#define IST_WARMTH     0x1Cu
#define IST_RESET_US   50000u
#define IST_MEASURE_US 6000u

/* A device of registers on an SPI. */
typedef struct model_part {
    uint8_t registers[128];
    bool selected;
    bool has_address;
    uint8_t address;
    uint64_t started_us;
} model_part_t;

/* The barometer. */
typedef struct model_barometer {
    uint8_t command;
    uint32_t come; /* Bytes since it was selected. */
    uint64_t busy_until_us;
    uint32_t converted; /* What the next reading gives; once. */
} model_barometer_t;

/* The memory. */
typedef struct model_memory_chip {
    uint8_t come[3];
    uint32_t count;
    bool writable;
} model_memory_chip_t;

/* The magnetometer. */
typedef struct model_field {
    uint8_t registers[256];
    uint8_t place;
    bool has_place;
    uint64_t reset_until_us; /* 0: it is not being reset. */
    uint64_t measured_at_us; /* 0: it measures nothing. */
} model_field_t;

/* When a count moved last. */
typedef struct model_moved {
    uint32_t count;
    uint64_t at_us;
} model_moved_t;

static sim_sensors_t sensors;
static model_part_t parts[MODEL_DEVICES]; /* Those that are such. */
static model_barometer_t barometer;
static model_memory_chip_t memory;
static uint8_t fram[MODEL_FRAM_BYTES];
static bool fram_changed;
static uint32_t fram_left; /* Bytes until the supply goes; 0: it does not. */
static bool is_cut;        /* It has gone. */
static bool is_off[UNITS]; /* Units that are not at their bus. */
static uint32_t absent;    /* Devices that the board was built without, a bit each. */
static model_field_t field;
static model_moved_t moved_unit[UNITS];
static model_moved_t moved_pressure;
static model_moved_t moved_field;

/* The data sheet's example. */
static const uint16_t prom[8] = {0x1234u, 40127u, 36924u, 23317u, 23282u, 33464u, 28312u, 0u};

sim_sensors_t *model_sensors(void)
{
    return &sensors;
}

uint8_t *model_fram(void)
{
    return fram;
}

bool model_fram_has_changed(void)
{
    const bool changed = fram_changed;

    fram_changed = false;
    return changed;
}

void model_devices_power(void)
{
    memset(parts, 0, sizeof parts);
    memset(&barometer, 0, sizeof barometer);
    memset(&memory, 0, sizeof memory);
    fram_left = 0u;
    is_cut = false;
    memset(&field, 0, sizeof field);
    field.registers[0] = 0x10u;
}

void model_devices_start(void)
{
    model_devices_power();
    memset(&sensors, 0, sizeof sensors);
    memset(fram, 0, sizeof fram);
    fram_changed = false;
    memset(is_off, 0, sizeof is_off);
    memset(moved_unit, 0, sizeof moved_unit);
    moved_pressure = (model_moved_t){0};
    moved_field = (model_moved_t){0};
}

void model_unit_unplug(uint32_t unit, bool off)
{
    is_off[unit] = off;
}

void model_devices_leave_out(uint32_t devices)
{
    absent = devices;
}

bool model_device_is_there(model_device_t device)
{
    const bool is_off_bus = (device == MODEL_ICM20689)
                                ? is_off[0]
                                : ((device <= MODEL_ACCELEROMETER) && is_off[1]);

    return !is_off_bus && ((absent & (1u << (uint32_t)device)) == 0u);
}

bool model_field_is_there(void)
{
    return (absent & (1u << (uint32_t)MODEL_IST8310)) == 0u;
}

void model_fram_cut(uint32_t bytes)
{
    fram_left = bytes;
}

static void follow_count(model_moved_t *moved, uint32_t count)
{
    if (moved->count != count) {
        *moved = (model_moved_t){count, model_now_us()};
    }
}

void model_devices_turn(void)
{
    for (uint32_t i = 0u; i < UNITS; i++) {
        follow_count(&moved_unit[i], sensors.imu[i].count);
    }
    follow_count(&moved_pressure, sensors.barometer.count);
    follow_count(&moved_field, sensors.magnetometer.count);
}

static bool is_silent(const model_moved_t *moved, uint64_t after_us)
{
    return (model_now_us() - moved->at_us) > after_us;
}

static int16_t counted(double value, double unit)
{
    const double count = round(value / unit);

    if (!(count > (double)INT16_MIN)) {
        return INT16_MIN;
    }
    return (count < (double)INT16_MAX) ? (int16_t)count : INT16_MAX;
}

/* A vector along the sensor's axes: both units, and the magnetometer's first two, are turned by a
 * quarter about the third, and upside down. */
static void turn_axes(const float body[3], double unit, double third, int16_t sensor[3])
{
    sensor[0] = counted(body[1], unit);
    sensor[1] = counted(body[0], unit);
    sensor[2] = counted(third * (double)body[2], unit);
}

/* --- ICM-20689. --- */

static void put_big(uint8_t *place, int16_t value)
{
    place[0] = (uint8_t)((uint16_t)value >> 8u);
    place[1] = (uint8_t)value;
}

static void put_little(uint8_t *place, int16_t value)
{
    place[0] = (uint8_t)value;
    place[1] = (uint8_t)((uint16_t)value >> 8u);
}

static void measure_icm(model_part_t *part)
{
    const sim_imu_t *const imu = &sensors.imu[0];
    uint8_t *const data = &part->registers[ICM_SAMPLE];
    int16_t force[3];
    int16_t rate[3];

    turn_axes(imu->accelerometer, FORCE_UNIT, -1.0, force);
    turn_axes(imu->gyroscope, RATE_UNIT, -1.0, rate);
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        put_big(&data[2u * axis], force[axis]);
        put_big(&data[8u + (2u * axis)], rate[axis]);
    }
    put_big(&data[6], counted((double)imu->temperature - 2500.0, 1.0 / 3.268));
}

static uint8_t read_icm(model_part_t *part, uint8_t place)
{
    if (place == ICM_WHO) {
        return ICM_IDENTITY;
    }
    if (place == ICM_STATUS) {
        return 1u;
    }
    if (place == ICM_SAMPLE) {
        measure_icm(part);
    }
    return part->registers[place];
}

static void write_icm(model_part_t *part, uint8_t place, uint8_t value)
{
    part->registers[place] = value;
    if ((place == ICM_POWER) && ((value & 0x80u) != 0u)) {
        memset(part->registers, 0, sizeof part->registers);
        part->registers[ICM_POWER] = 0x40u;
    }
}

/* --- BMI055. --- */

/* Rates in 16 bits; forces in the upper 12, of which one count is a 128th of g. */
static void measure_bmi(model_part_t *part, bool is_gyroscope)
{
    const sim_imu_t *const imu = &sensors.imu[1];
    int16_t values[3];

    if (is_gyroscope) {
        turn_axes(imu->gyroscope, RATE_UNIT, -1.0, values);
    } else {
        turn_axes(imu->accelerometer, FORCE_UNIT * 16.0, -1.0, values);
    }
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        const int32_t most = (values[axis] > 2047) ? 2047 : values[axis];
        const int32_t force = ((most < -2048) ? -2048 : most) * 16;

        put_little(&part->registers[BMI_SAMPLE + (2u * axis)],
                   is_gyroscope ? values[axis] : (int16_t)(force | 1));
    }
}

static uint8_t read_bmi(model_part_t *part, uint8_t place, bool is_gyroscope)
{
    if (place == BMI_IDENTITY) {
        return is_gyroscope ? 0x0Fu : 0xFAu;
    }
    if (place == BMI_SAMPLE) {
        measure_bmi(part, is_gyroscope);
    }
    if ((place == BMI_WARMTH) && !is_gyroscope) {
        return (uint8_t)counted((double)sensors.imu[1].temperature - 2300.0, 50.0);
    }
    if ((place == BMI_BANDWIDTH) && is_gyroscope) {
        return part->registers[place] | 0x80u; /* It always reads so. */
    }
    return part->registers[place];
}

static void write_bmi(model_part_t *part, uint8_t place, uint8_t value, bool is_gyroscope)
{
    if ((place == BMI_RESET) && (value == 0xB6u)) {
        memset(part->registers, 0, sizeof part->registers);
        part->registers[BMI_POWER] = BMI_SUSPENDED;
        part->started_us = model_now_us() + (is_gyroscope ? 30000u : 3000u);
    } else if ((place == BMI_POWER) || ((part->registers[BMI_POWER] & BMI_SUSPENDED) == 0u)) {
        part->registers[place] = value;
    } else {
        /* While it is suspended it takes nothing else. */
    }
}

/* --- Units on an SPI: an address, and bytes behind it. --- */

static uint8_t read_part(model_device_t device, uint8_t place)
{
    model_part_t *const part = &parts[device];

    if (model_now_us() < part->started_us) {
        return 0u;
    }
    return (device == MODEL_ICM20689) ? read_icm(part, place)
                                      : read_bmi(part, place, device == MODEL_GYROSCOPE);
}

static void write_part(model_device_t device, uint8_t place, uint8_t value)
{
    if (device == MODEL_ICM20689) {
        write_icm(&parts[device], place, value);
    } else {
        write_bmi(&parts[device], place, value, device == MODEL_GYROSCOPE);
    }
}

static uint8_t exchange_part(model_device_t device, uint8_t byte)
{
    model_part_t *const part = &parts[device];
    const uint8_t place = part->address & 0x7Fu;
    uint8_t answer = 0u;

    if (is_silent(&moved_unit[(device == MODEL_ICM20689) ? 0u : 1u], SILENT_US)) {
        return ONES;
    }
    if (!part->has_address) {
        part->has_address = true;
        part->address = byte;
        return 0u;
    }
    if ((part->address & READ) != 0u) {
        answer = read_part(device, place);
    } else {
        write_part(device, place, byte);
    }
    part->address = (uint8_t)((part->address & READ) | ((place + 1u) & 0x7Fu));
    return answer;
}

/* --- MS5611. --- */

/* As the data sheet has it, of second order below 20 degrees: in 0.01 degrees, and in Pa. */
static double temperature_of(double reading)
{
    const double off = reading - ((double)prom[5] * 256.0);
    const double first = 2000.0 + ((off * (double)prom[6]) / 8388608.0);

    return (first < 2000.0) ? (first - ((off * off) / 2147483648.0)) : first;
}

static double pressure_of(double reading, double temperature)
{
    const double off = temperature - ((double)prom[5] * 256.0);
    const double first = 2000.0 + ((off * (double)prom[6]) / 8388608.0);
    const double cold = (first < 2000.0) ? ((first - 2000.0) * (first - 2000.0)) : 0.0;
    const double offset = ((double)prom[2] * 65536.0) + (((double)prom[4] * off) / 128.0) -
                          (2.5 * cold);
    const double scale = ((double)prom[1] * 32768.0) + (((double)prom[3] * off) / 256.0) -
                         (1.25 * cold);

    return (((reading * scale) / 2097152.0) - offset) / 32768.0;
}

static uint32_t reading_of_temperature(void)
{
    uint32_t low = 1u;
    uint32_t high = MS_READING - 2u;

    while (low < high) {
        const uint32_t middle = low + ((high - low) / 2u);

        if (temperature_of((double)middle) < (double)sensors.barometer.temperature) {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return low;
}

static uint32_t reading_of_pressure(void)
{
    const double temperature = (double)reading_of_temperature();
    uint32_t low = 1u;
    uint32_t high = MS_READING - 2u;

    while (low < high) {
        const uint32_t middle = low + ((high - low) / 2u);

        if (pressure_of((double)middle, temperature) < (double)sensors.barometer.pressure) {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return low;
}

static void obey(uint8_t command)
{
    const uint64_t now_us = model_now_us();

    if (command == MS_RESET) {
        barometer.busy_until_us = now_us + MS_RESET_US;
    } else if (((command == MS_PRESSURE) || (command == MS_TEMPERATURE)) &&
               (now_us >= barometer.busy_until_us)) {
        barometer.busy_until_us = now_us + MS_CONVERT_US;
        barometer.converted = (command == MS_PRESSURE) ? reading_of_pressure()
                                                       : reading_of_temperature();
    } else {
        /* It is busy, or asks for bytes. */
    }
}

/* The four bits that guard the PROM: a remainder by 0x3000, bit by bit. */
static uint16_t prom_check(void)
{
    uint32_t rest = 0u;

    for (uint32_t i = 0u; i < 16u; i++) {
        rest ^= ((i % 2u) == 0u) ? ((uint32_t)prom[i / 2u] >> 8u) : (prom[i / 2u] & 0xFFu);
        for (uint32_t bit = 0u; bit < 8u; bit++) {
            rest = ((rest & 0x8000u) != 0u) ? ((rest << 1u) ^ 0x3000u) : (rest << 1u);
        }
    }
    return (uint16_t)((rest >> 12u) & 0xFu);
}

static uint8_t answer_reading(uint32_t behind)
{
    const uint32_t answer = (model_now_us() >= barometer.busy_until_us) ? barometer.converted : 0u;

    if (behind == 2u) {
        barometer.converted = 0u;
    }
    return (uint8_t)(answer >> (8u * (2u - behind)));
}

static uint8_t exchange_barometer(uint8_t byte)
{
    const uint32_t behind = barometer.come - 1u;

    if ((sensors.barometer.count > 0u) && is_silent(&moved_pressure, QUIET_US)) {
        return ONES;
    }
    barometer.come++;
    if (barometer.come == 1u) {
        barometer.command = byte;
        obey(byte);
        return 0xFEu;
    }
    if ((barometer.command >= MS_PROM) && (barometer.command < (MS_PROM + 16u)) && (behind < 2u)) {
        const uint32_t place = (barometer.command - MS_PROM) / 2u;
        const uint32_t word = (place == 7u) ? prom_check() : prom[place];

        return (uint8_t)(word >> (8u * (1u - behind)));
    }
    return ((barometer.command == MS_READ) && (behind < 3u)) ? answer_reading(behind) : ONES;
}

/* --- FM25V02: it is never busy. --- */

/* The byte after the last one that may be written is not. */
static void write_memory(uint32_t place, uint8_t byte)
{
    if (is_cut) {
        return;
    }
    fram[place] = byte;
    fram_changed = true;
    if (fram_left > 0u) {
        fram_left--;
        is_cut = fram_left == 0u;
    }
    if (is_cut) {
        model_reset(MODEL_BY_POWER);
    }
}

static uint8_t exchange_memory(uint8_t byte)
{
    static const uint8_t identity[9] = {0x7Fu, 0x7Fu, 0x7Fu, 0x7Fu, 0x7Fu,
                                        0x7Fu, 0xC2u, 0x22u, 0x08u};
    const uint32_t count = memory.count;
    uint32_t place;

    memory.count++;
    if (count < 3u) {
        memory.come[count] = byte;
    }
    if ((count > 0u) && (memory.come[0] == 0x9Fu)) {
        return identity[(count - 1u) % sizeof identity];
    }
    if (count < 3u) {
        return 0u;
    }
    place = ((((uint32_t)memory.come[1] << 8u) | memory.come[2]) + (count - 3u)) % MODEL_FRAM_BYTES;
    if ((memory.come[0] == 0x02u) && memory.writable) {
        write_memory(place, byte);
    }
    return (memory.come[0] == 0x03u) ? fram[place] : 0u;
}

/* A write is enabled by the opcode before, for once. */
static void end_memory(void)
{
    if (memory.count > 0u) {
        memory.writable = (memory.come[0] == 0x06u) ||
                          (memory.writable && (memory.come[0] != 0x02u));
    }
    memory.count = 0u;
}

/* --- All at the SPIs. --- */

void model_device_select(model_device_t device, bool selected)
{
    parts[device].has_address = false;
    if (device == MODEL_MS5611) {
        barometer.come = 0u;
    } else if ((device == MODEL_FRAM) && !selected) {
        end_memory();
    } else {
        /* The others begin with an address. */
    }
}

uint8_t model_device_exchange(model_device_t device, uint8_t byte)
{
    if (device == MODEL_MS5611) {
        return exchange_barometer(byte);
    }
    return (device == MODEL_FRAM) ? exchange_memory(byte) : exchange_part(device, byte);
}

/* --- IST8310: its first axes lie as the units' do, its third one points the other way. --- */

static void measure_field(void)
{
    int16_t counts[3];

    turn_axes(sensors.magnetometer.field, FIELD_UNIT, 1.0, counts);
    for (uint32_t axis = 0u; axis < 3u; axis++) {
        const bool is_fine = (field.registers[IST_CONTROL_3] & (0x10u << axis)) != 0u;

        put_little(&field.registers[IST_FIELD + (2u * axis)],
                   is_fine ? counts[axis] : (int16_t)(counts[axis] / 4));
    }
    put_little(&field.registers[IST_WARMTH], 321);
    field.registers[IST_STATUS] = ((field.registers[IST_STATUS] & 1u) != 0u) ? 3u : 1u;
    field.registers[IST_CONTROL_1] = 0u;
}

/* What has ended by now. */
static void pass_field(void)
{
    const uint64_t now_us = model_now_us();

    if ((field.reset_until_us != 0u) && (now_us >= field.reset_until_us)) {
        field.reset_until_us = 0u;
        memset(field.registers, 0, sizeof field.registers);
        field.registers[0] = 0x10u;
    }
    if ((field.measured_at_us != 0u) && (now_us >= field.measured_at_us)) {
        field.measured_at_us = 0u;
        if (!is_silent(&moved_field, QUIET_US)) {
            measure_field();
        }
    }
}

void model_field_begin(bool reads)
{
    pass_field();
    if (!reads) {
        field.has_place = false;
    }
}

static void write_field(uint8_t place, uint8_t byte)
{
    const bool is_known = (place == IST_CONTROL_1) || (place == IST_CONTROL_2) ||
                          (place == 0x0Cu) || (place == IST_CONTROL_3) || (place == 0x41u) ||
                          (place == 0x42u);

    if ((field.reset_until_us != 0u) || !is_known) {
        return;
    }
    field.registers[place] = byte;
    if ((place == IST_CONTROL_2) && ((byte & 1u) != 0u)) {
        field.reset_until_us = model_now_us() + IST_RESET_US;
        field.measured_at_us = 0u;
    } else if ((place == IST_CONTROL_1) && ((byte & 0xFu) == 1u)) {
        field.measured_at_us = model_now_us() + IST_MEASURE_US;
    } else {
        /* It is a setting. */
    }
}

void model_field_take(uint8_t byte)
{
    pass_field();
    if (field.has_place) {
        write_field(field.place, byte);
        field.place++;
    } else {
        field.place = byte;
        field.has_place = true;
    }
}

uint8_t model_field_give(void)
{
    const uint8_t place = field.place;

    pass_field();
    field.place++;
    if ((place >= IST_FIELD) && (place < (IST_FIELD + 6u))) {
        field.registers[IST_STATUS] = 0u;
    }
    return field.registers[place];
}

/* --- The converter's inputs. --- */

/* Of the power modules: 18.1 to one, and 36.367515 A a volt; a count is 3.3 V / 4096. */
static uint32_t module_count(uint32_t channel)
{
    const sim_power_t *const power = &sensors.power[channel / 2u];
    const double volt = ((channel % 2u) == 0u) ? ((double)power->voltage / 18.1)
                                               : ((double)power->current / 36.367515);
    const double count = round((volt * 4096.0) / 3.3);

    if (!(count > 0.0)) {
        return 0u;
    }
    return (count < 4095.0) ? (uint32_t)count : 4095u;
}

/* Of the reference of 1.21 V, of which the maker counted 1502 at 3.3 V; and of the temperature, of
 * which he counted 943 at 30 and 1186 at 110 degrees. */
uint32_t model_count(uint32_t channel)
{
    const double supply = (sensors.chip.count > 0u) ? (double)sensors.chip.supply : 3300.0;
    const double warm = (sensors.chip.count > 0u) ? (double)sensors.chip.temperature : 3000.0;

    if (channel < 4u) {
        return module_count(channel);
    }
    if (channel == 17u) {
        return (uint32_t)round((3300.0 * 1502.0) / supply);
    }
    if (channel == 18u) {
        return (uint32_t)round(((943.0 + ((warm - 3000.0) * 243.0 / 8000.0)) * 3300.0) / supply);
    }
    return (channel == 10u) ? 3138u : 2071u; /* The board's own supplies. */
}
