#include "urpilot_tasks.h"

#include "keel/rtos/priority.h"

#define MS 1000u

const urpilot_task_t urpilot_task[URPILOT_TASK_COUNT] = {
    {"Scheduler analysis", KEEL_PRIORITY_LOW, 100u * MS, 10u},
    {"Stack", KEEL_PRIORITY_LOW, 100u * MS, 7u},
    {"ADC", KEEL_PRIORITY_LOW, 1000u * MS, 18u},
    {"Background power module", KEEL_PRIORITY_LOW, 20u * MS, 8u},
    {"Foreground power module", KEEL_PRIORITY_LOW, 100u * MS, 17u},
    {"Background barometer", KEEL_PRIORITY_HIGH, 10u * MS, 50u},
    {"Foreground barometer", KEEL_PRIORITY_MEDIUM_HIGH, 20u * MS, 50u},
    {"Background magnetometer", KEEL_PRIORITY_HIGH, 10u * MS, 350u},
    {"Foreground magnetometer", KEEL_PRIORITY_MEDIUM_HIGH, 20u * MS, 37u},
    {"Calibration magnetometer", KEEL_PRIORITY_LOW, 50u * MS, 41u},
    {"Background IMU", KEEL_PRIORITY_REALTIME, 1u * MS, 57u},
    {"Foreground IMU", KEEL_PRIORITY_REALTIME, 2u * MS, 37u},
    {"Calibration IMU", KEEL_PRIORITY_LOW, 50u * MS, 22u},
    {"GPS", KEEL_PRIORITY_MEDIUM, 20u * MS, 355u},
    {"Background radio", KEEL_PRIORITY_MEDIUM, 10u * MS, 21u},
    {"Foreground radio", KEEL_PRIORITY_MEDIUM, 20u * MS, 53u},
    {"Navigation", KEEL_PRIORITY_MEDIUM, 20u * MS, 47u},
    {"Angle rate control", KEEL_PRIORITY_REALTIME, 2u * MS, 83u},
    {"Angle control", KEEL_PRIORITY_HIGH, 2u * MS, 71u},
    {"Position control", KEEL_PRIORITY_HIGH, 10u * MS, 11u},
    {"State machine", KEEL_PRIORITY_LOW, 20u * MS, 11u},
};
