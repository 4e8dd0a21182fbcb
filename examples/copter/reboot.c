/* SPDX-License-Identifier: Apache-2.0 */
/* Starting anew, as a ground station asks: only with the motors off, and once the answer is on its
 * way and parameters are saved. */
#include "command.h"
#include "keel/middleware/range.h"

#include <stddef.h>

/* Until the answer has been sent, on a slow link too. */
#define ANSWER_US 1000000u

/* Places of parameters. */
#define AUTOPILOT 0u
#define COMPANION 1u
#define COMPONENT 2u
#define FORCE     5u

static uint32_t refuse_reboot(copter_t *copter, uint32_t result, const char *reason)
{
    copter_text(copter->telemetry, (uint8_t)MAV_SEVERITY_WARNING, "not rebooted: ", reason);
    return result;
}

/* The autopilot, as it is, and nothing else. */
static bool is_plain(const copter_command_t *command)
{
    const float reboot = (float)REBOOT_SHUTDOWN_ACTION_REBOOT;

    return keel_range_contains(command->param[AUTOPILOT], reboot, reboot) &&
           copter_command_is_empty(command->param[COMPANION]) &&
           copter_command_is_empty(command->param[COMPONENT]) &&
           copter_command_is_empty(command->param[FORCE]);
}

uint32_t copter_command_reboot(copter_t *copter, const copter_command_t *command)
{
    if (copter->port->reboot == NULL) {
        return refuse_reboot(copter, MAV_RESULT_UNSUPPORTED, "the board has no way");
    }
    if (!is_plain(command)) {
        return refuse_reboot(copter, MAV_RESULT_DENIED, "only the autopilot, not by force");
    }
    if (copter->state.mode.motors) {
        return refuse_reboot(copter, MAV_RESULT_TEMPORARILY_REJECTED, "armed");
    }
    copter->telemetry->reboots_us = copter->scheduler.clock.now_us + ANSWER_US;
    return MAV_RESULT_ACCEPTED;
}

void copter_reboot_step(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    const bool saves = self->saves || (copter->parameters.saved == KEEL_SLOTS_BUSY);

    if (self->reboots_us == 0u) {
        return;
    }
    if (copter->state.mode.motors) {
        (void)refuse_reboot(copter, 0u, "armed meanwhile");
        self->reboots_us = 0u;
    } else if ((copter->scheduler.clock.now_us >= self->reboots_us) && !saves) {
        self->reboots_us = 0u;
        copter->port->reboot(copter->port->context);
    } else {
        /* It waits. */
    }
}
