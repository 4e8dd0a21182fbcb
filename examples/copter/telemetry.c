/* SPDX-License-Identifier: Apache-2.0 */
/* Telemetry's task: takes what came on its links, and sends what is due. */
#include "telemetry.h"

#include "command.h"
#include "mavlink_modes.h"

#include <stddef.h>

#define MILLION   1000000u
#define PERIOD_US 4000u
#define WCET_US   250u
#define BUDGET_US 262u
#define PHASE_US  3100u
#define EVERYBODY 0u

#define NOTICES_US 10000000u /* They are told so often. */

/* Bytes of a frame around its payload. */
#define AROUND                                                                                     \
    ((uint32_t)KEEL_MAVLINK_HEADER_BYTES + (uint32_t)KEEL_MAVLINK_CHECKSUM_BYTES +                 \
     (uint32_t)KEEL_MAVLINK_SIGNATURE_BYTES)

/* How often each link is told what, from the start on. */
static const uint32_t interval_us[MESSAGES_SENT] = {
    [SENT_HEARTBEAT] = MILLION,
    [SENT_SYS_STATUS] = MILLION,
    [SENT_GPS_RAW_INT] = MILLION / 2u,
    [SENT_ATTITUDE] = MILLION / 20u,
    [SENT_LOCAL_POSITION_NED] = MILLION / 10u,
    [SENT_GLOBAL_POSITION_INT] = MILLION / 5u,
    [SENT_SERVO_OUTPUT_RAW] = MILLION / 5u,
    [SENT_RC_CHANNELS] = MILLION / 5u,
    [SENT_BATTERY_STATUS] = MILLION,
    [SENT_CURRENT_MODE] = 2u * MILLION,
    [SENT_FENCE_STATUS] = 2u * MILLION,
    [SENT_ESTIMATOR_STATUS] = MILLION,
    [SENT_HOME_POSITION] = 5u * MILLION,
    [SENT_EXTENDED_SYS_STATE] = MILLION,
    [SENT_SCALED_IMU] = MILLION,
    [SENT_SCALED_IMU2] = MILLION,
    [SENT_SCALED_IMU3] = MILLION,
    [SENT_SCALED_PRESSURE] = 2u * MILLION,
    [SENT_SYSTEM_TIME] = MILLION,
    [SENT_ATTITUDE_QUATERNION] = MILLION / 10u,
    [SENT_VFR_HUD] = MILLION / 4u,
    [SENT_ALTITUDE] = MILLION / 2u,
    [SENT_NAMED_VALUE_INT] = (5u * MILLION) / COPTER_NAMED, /* In turn. */
};

static const char *const states[KEEL_MODE_STATES] = {"disarmed",  "armed",   "flying",    "holding",
                                                     "returning", "landing", "terminated"};

uint32_t copter_telemetry_interval_us(uint32_t sent)
{
    return interval_us[sent];
}

bool copter_is_meant(const copter_link_t *link, uint8_t system, uint8_t component)
{
    return ((system == EVERYBODY) || (system == link->sender.system)) &&
           ((component == EVERYBODY) || (component == link->sender.component));
}

static keel_status_t start_link(copter_telemetry_t *self, uint32_t number)
{
    copter_link_t *const link = &self->link[number];

    link->parameter = COPTER_PARAMETER_COUNT - 1u; /* The first one is next. */
    link->sender = (keel_mavlink_sender_t){.system = self->system,
                                           .component = (uint8_t)MAV_COMP_ID_AUTOPILOT1};
    copter_link_schedule_init(&link->schedule, self->config.link[number].bytes_per_s);
    for (uint32_t i = 0u; i < MESSAGES_SENT; i++) {
        copter_link_schedule_repeat(&link->schedule, i, interval_us[i]);
    }
    copter_link_schedule_ask(&link->schedule, SENT_HEARTBEAT);
    return keel_mavlink_init(&link->decoder, messages_taken, MESSAGES_TAKEN);
}

keel_status_t copter_telemetry_start(copter_t *copter, copter_telemetry_t *telemetry,
                                     const copter_telemetry_config_t *config)
{
    static const copter_own_task_t task = {.name = "Telemetry",
                                           .body = copter_telemetry,
                                           .period_us = PERIOD_US,
                                           .wcet_us = WCET_US,
                                           .budget_us = BUDGET_US,
                                           .phase_us = PHASE_US};
    keel_status_t status = KEEL_OK;

    *telemetry = (copter_telemetry_t){.config = *config, .system = copter_settings.system};
    keel_signing_init(&telemetry->signing, 0u, config->key.hash);
    keel_signing_advance(&telemetry->signing, config->key.timestamp);
    if (config->key.key != NULL) {
        keel_signing_set_key(&telemetry->signing, config->key.key);
    }
    for (uint32_t i = 0u; (i < COPTER_LINKS) && (status == KEEL_OK); i++) {
        status = start_link(telemetry, i);
    }
    copter->telemetry = telemetry;
    return (status == KEEL_OK) ? copter_add(copter, &task) : status;
}

/* As much of a text as there is room for. */
static uint32_t append_text(char to[COPTER_TEXT_LENGTH], uint32_t at, const char *text)
{
    uint32_t end = at;

    for (uint32_t i = 0u; (text[i] != '\0') && (end < COPTER_TEXT_LENGTH); i++) {
        to[end] = text[i];
        end++;
    }
    return end;
}

void copter_text(copter_telemetry_t *self, uint8_t severity, const char *first, const char *then)
{
    copter_text_t *const text = &self->text[self->texts % COPTER_TEXTS];

    *text = (copter_text_t){.severity = severity};
    (void)append_text(text->text, append_text(text->text, 0u, first), then);
    self->texts++;
}

/* Says when the state machine's state is another. */
static void tell_state(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    const keel_mode_t *const mode = &copter->state.mode;

    if (mode->state != self->state) {
        const bool alone = (mode->state >= KEEL_MODE_HOLDING);

        copter_text(self, alone ? (uint8_t)MAV_SEVERITY_WARNING : (uint8_t)MAV_SEVERITY_INFO,
                    states[mode->state],
                    ((mode->cause & KEEL_MODE_RC_LOST) != 0u) ? ": radio link lost" : "");
        self->state = mode->state;
        if (mode->state == KEEL_MODE_ARMED) {
            copter_mavlink_tell_parameters(copter);
        }
    }
}

/* A message is asked for once, on each link. */
static void tell_at_once(copter_telemetry_t *self, uint32_t sent)
{
    for (uint32_t i = 0u; i < COPTER_LINKS; i++) {
        copter_link_schedule_ask(&self->link[i].schedule, sent);
    }
}

/* A mode that is another is told at once. */
static void tell_mode(copter_telemetry_t *self, uint8_t mode)
{
    if (mode != self->mode) {
        tell_at_once(self, SENT_CURRENT_MODE);
    }
    self->mode = mode;
}

/* Going out of the fence and coming back. */
static void tell_fence(copter_telemetry_t *self, bool is_outside)
{
    if (is_outside != self->is_outside) {
        tell_at_once(self, SENT_FENCE_STATUS);
    }
    self->is_outside = is_outside;
}

/* Says when the pilot is heard, or why not. */
static void tell_radio(copter_telemetry_t *self, const copter_pilot_t *pilot)
{
    const copter_heard_t heard = (copter_heard_t)pilot->ear.heard;

    if (pilot->ear.heard != self->heard) {
        copter_text(self,
                    (heard == COPTER_HEARD_PILOT) ? (uint8_t)MAV_SEVERITY_INFO
                                                  : (uint8_t)MAV_SEVERITY_WARNING,
                    "radio: ", copter_rc_words(heard, pilot->rc.protocol));
        self->heard = pilot->ear.heard;
    }
}

/* A copter that may fly without a place need not have a receiver. */
static bool is_expected(void)
{
    return (copter_settings.mode.required &
            (KEEL_MODE_CHECK_POSITION_ESTIMATE | KEEL_MODE_CHECK_HOME_POSITION)) != 0u;
}

/* Says when the satellite receiver is silent, as often as the notices at most: again and again
 * until motors turn, and once for each silence from then on. And when it sends again. */
static void tell_satellites(copter_telemetry_t *self, const copter_gps_t *gps, uint64_t now_us)
{
    if (!gps->is_silent) {
        if (self->is_silent) {
            copter_text(self, (uint8_t)MAV_SEVERITY_INFO, "GPS: ", "the receiver sends again");
        }
        self->is_silent = false;
    } else if (is_expected() && (!self->is_silent || !self->has_flown) &&
               (now_us >= self->silent_us)) {
        copter_text(self, (uint8_t)MAV_SEVERITY_WARNING,
                    "GPS: ", "nothing comes from the receiver");
        self->is_silent = true;
        self->silent_us = now_us + NOTICES_US;
    } else {
        /* It is no news. */
    }
}

/* Says where the height comes from when that is another. That there is one at first is no news. */
static void tell_height(copter_telemetry_t *self, const copter_vertical_t *vertical)
{
    static const char *const words[] = {[COPTER_HEIGHT_NONE] = "not known",
                                        [COPTER_HEIGHT_BAROMETER] = "by the barometer",
                                        [COPTER_HEIGHT_GPS] = "barometer fails, by satellites"};

    if (vertical->source != self->height) {
        if (self->had_height) {
            copter_text(self,
                        (vertical->source == COPTER_HEIGHT_BAROMETER)
                            ? (uint8_t)MAV_SEVERITY_INFO
                            : (uint8_t)MAV_SEVERITY_WARNING,
                        "height: ", words[vertical->source]);
        }
        self->had_height = true;
        self->height = vertical->source;
    }
}

/* Says when motors were stopped because it lies on its side. */
static void tell_crash(copter_telemetry_t *self, bool is_crashed)
{
    if (is_crashed && !self->is_crashed) {
        copter_text(self, (uint8_t)MAV_SEVERITY_CRITICAL,
                    "crashed: ", "lies on its side, motors stopped");
    }
    self->is_crashed = is_crashed;
}

/* Says when it lands because one inertial unit is left, or two that disagree. */
static void tell_unconfirmed(copter_telemetry_t *self, bool lands)
{
    if (lands && !self->is_unconfirmed) {
        copter_text(self, (uint8_t)MAV_SEVERITY_CRITICAL,
                    "landing: ", "no two inertial units agree");
    }
    self->is_unconfirmed = lands;
}

/* Tells the port's notices again and again, for whoever connects later, until motors turn. */
static void tell_notices(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    const copter_port_t *const port = copter->port;
    const uint64_t now_us = copter->scheduler.clock.now_us;

    self->has_flown = self->has_flown || copter->state.mode.motors;
    if (!self->has_flown && (now_us >= self->notices_us)) {
        for (uint32_t i = 0u; i < port->notice_count; i++) {
            const copter_notice_t *const notice = &port->notices[i];

            copter_text(self,
                        notice->is_urgent ? (uint8_t)MAV_SEVERITY_CRITICAL
                                          : (uint8_t)MAV_SEVERITY_WARNING,
                        notice->first, notice->then);
        }
        self->notices_us = now_us + NOTICES_US;
    }
}

/* The pilot hears this of votes. */
static const char *vote_words(uint8_t state)
{
    static const char *const words[] = {
        [KEEL_VOTER_MEAN] = "agree",
        [KEEL_VOTER_SINGLE] = "one is left",
        [KEEL_VOTER_MEDIAN] = "do not agree, median flies: vibration?",
        [KEEL_VOTER_DISAGREE] = "two are left and disagree",
        [KEEL_VOTER_NONE] = "none gives a sample"};

    return (state < (sizeof words / sizeof words[0])) ? words[state] : "";
}

/* Says when votes come about in another way: see imu.c for how long one stands. */
static void tell_votes(copter_telemetry_t *self, uint8_t *told, const char *which, uint8_t state)
{
    if (state != *told) {
        uint8_t severity = (uint8_t)MAV_SEVERITY_INFO;

        if (state >= KEEL_VOTER_DISAGREE) {
            severity = (uint8_t)MAV_SEVERITY_CRITICAL;
        } else if (state != KEEL_VOTER_MEAN) {
            severity = (uint8_t)MAV_SEVERITY_WARNING;
        } else {
            /* All is well again. */
        }
        copter_text(self, severity, which, vote_words(state));
        *told = state;
    }
}

/* Says when a unit is voted out, in one channel or more, and when it is back in all. */
static void tell_units(copter_telemetry_t *self, const keel_virtual_imu_t *imu)
{
    static const char *const unit[COPTER_IMUS] = {
        "inertial unit 1: ", "inertial unit 2: ", "inertial unit 3: "};

    for (uint32_t i = 0u; i < COPTER_IMUS; i++) {
        if ((imu->latched[i] != 0u) && (self->latched[i] == 0u)) {
            copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, unit[i], "voted out");
        } else if ((imu->latched[i] == 0u) && (self->latched[i] != 0u)) {
            copter_text(self, (uint8_t)MAV_SEVERITY_INFO, unit[i], "votes again");
        } else {
            /* As it was, or in more channels or fewer. */
        }
        self->latched[i] = imu->latched[i];
    }
}

static void tell_imu(copter_telemetry_t *self, const copter_imu_t *imu)
{
    tell_votes(self, &self->accelerometers, "accelerometers: ", imu->accelerometer.state);
    tell_votes(self, &self->gyroscopes, "gyroscopes: ", imu->gyroscope.state);
    tell_units(self, &imu->virtual_imu);
}

/* Whoever does not sign, where frames are signed, is not heard. */
static void take_frame(copter_t *copter, uint32_t number, const keel_mavlink_frame_t *frame)
{
    copter_telemetry_t *const self = copter->telemetry;

    if (keel_signing_accepts(&self->signing, frame)) {
        copter_mavlink_receive(copter, number);
    } else {
        self->link[number].refused++;
    }
}

/* Reads what came when nothing waits; whether the line is silent. */
static bool read_line(copter_t *copter, uint32_t number)
{
    const copter_lines_t *const lines = &copter->telemetry->config.lines;
    copter_link_t *const link = &copter->telemetry->link[number];

    if (link->looked_at == link->count) {
        link->count = lines->read(lines->context, number, link->bytes, COPTER_LINK_BYTES);
        link->looked_at = 0u;
        link->heard_us = (link->count > 0u) ? copter->scheduler.clock.now_us : link->heard_us;
    }
    return (link->count == 0u) &&
           ((copter->scheduler.clock.now_us - link->heard_us) > COPTER_LINK_SILENCE_US);
}

/* Acts on one frame at most; what is behind it waits for the next run, as does what is behind so
 * many looks that found a frame or a false beginning of one. */
static void receive_bytes(copter_t *copter, uint32_t number)
{
    copter_link_t *const link = &copter->telemetry->link[number];
    const bool silent = read_line(copter, number);
    keel_mavlink_look_t seen = KEEL_MAVLINK_NOTHING;
    uint32_t looks = 0u;
    bool more = true;

    while (more && (seen != KEEL_MAVLINK_FRAME) && (looks < COPTER_LINK_LOOKS)) {
        seen = silent ? keel_mavlink_gap(&link->decoder) : keel_mavlink_look(&link->decoder);
        if (seen != KEEL_MAVLINK_NOTHING) {
            looks++;
        } else if (link->looked_at < link->count) {
            (void)keel_mavlink_take(&link->decoder, link->bytes[link->looked_at]);
            link->looked_at++;
        } else {
            more = false;
        }
    }
    if (seen == KEEL_MAVLINK_FRAME) {
        take_frame(copter, number, &link->decoder.frame);
    }
}

/* Messages that wait in queues are asked for. */
static void ask_for_queues(const copter_telemetry_t *self, copter_link_t *link)
{
    bool wanted = false;

    for (uint32_t i = 0u; i < COPTER_WORDS; i++) {
        wanted = wanted || (link->wanted[i] != 0u);
    }
    if (wanted) {
        copter_link_schedule_ask(&link->schedule, SENT_PARAM_VALUE);
    }
    if (link->errors > 0u) {
        copter_link_schedule_ask(&link->schedule, SENT_PARAM_ERROR);
    }
    if (link->modes != 0u) {
        copter_link_schedule_ask(&link->schedule, SENT_AVAILABLE_MODES);
    }
    if (link->acks > 0u) {
        copter_link_schedule_ask(&link->schedule, SENT_COMMAND_ACK);
    }
    if (link->texts != self->texts) {
        copter_link_schedule_ask(&link->schedule, SENT_STATUSTEXT);
    }
    if (link->replies.count > 0u) {
        copter_link_schedule_ask(&link->schedule, link->replies.reply[0].sent);
    }
    if (link->ftp.count > 0u) {
        copter_link_schedule_ask(&link->schedule, SENT_FILE_TRANSFER_PROTOCOL);
    }
    if (copter_shell_waits(&link->shell)) {
        copter_link_schedule_ask(&link->schedule, SENT_SERIAL_CONTROL);
    }
}

/* Sends who is next, if the link has room for it. */
static void send_next(copter_t *copter, uint32_t number)
{
    copter_telemetry_t *const self = copter->telemetry;
    const copter_lines_t *const lines = &self->config.lines;
    copter_link_t *const link = &self->link[number];
    const uint32_t next = copter_link_schedule_next(&link->schedule);
    uint8_t payload[KEEL_MAVLINK_PAYLOAD_MAX] = {0};
    keel_mavlink_packet_t packet;
    uint32_t length;
    uint32_t size = 0u;

    if (next == COPTER_LINK_SCHEDULE_NONE) {
        return;
    }
    length = messages_sent[next].longest;
    if (!copter_link_schedule_affords(&link->schedule, length + AROUND) ||
        (lines->room(lines->context, number) < (length + AROUND))) {
        return;
    }
    if (copter_mavlink_report(copter, link, next, payload)) {
        size = keel_signing_write(&self->signing, &link->sender, &messages_sent[next], payload,
                                  (uint8_t)length, &packet);
        lines->write(lines->context, number, packet.bytes, size);
    }
    copter_link_schedule_sent(&link->schedule, next, size);
}

/* Parameters are saved on the ground, and the last of several that were set saves them all. */
static void save_parameters(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;
    copter_parameter_store_t *const store = &copter->parameters;

    if (self->saves && !copter->state.mode.motors && (store->saved != KEEL_SLOTS_BUSY)) {
        self->saves = false;
        if (copter_parameter_store_save(store) != KEEL_OK) {
            copter_text(self, (uint8_t)MAV_SEVERITY_WARNING, "parameters: ", "not saved");
        }
    }
}

static void run_link(copter_t *copter, uint32_t number)
{
    copter_link_t *const link = &copter->telemetry->link[number];
    const uint64_t now_us = copter->scheduler.clock.now_us;
    const uint64_t passed_us = now_us - link->ran_us;

    link->ran_us = now_us;
    receive_bytes(copter, number);
    copter_link_schedule_step(&link->schedule,
                              (passed_us < MILLION) ? (uint32_t)passed_us : MILLION);
    ask_for_queues(copter->telemetry, link);
    send_next(copter, number);
}

/* The next link that is there; the same again when it is the only one. */
static uint32_t next_link(const copter_telemetry_t *self)
{
    uint32_t next = self->turn;

    for (uint32_t i = COPTER_LINKS; i > 0u; i--) {
        const uint32_t number = (self->turn + i) % COPTER_LINKS;

        if (self->config.link[number].bytes_per_s > 0u) {
            next = number;
        }
    }
    return next;
}

void copter_telemetry(copter_t *copter)
{
    copter_telemetry_t *const self = copter->telemetry;

    tell_notices(copter);
    tell_state(copter);
    tell_mode(self, copter_mavlink_mode_told(copter));
    tell_fence(self, (copter->state.mode.seen & KEEL_MODE_FENCE_BREACHED) != 0u);
    tell_radio(self, &copter->pilot);
    tell_satellites(self, &copter->gps, copter->scheduler.clock.now_us);
    tell_height(self, &copter->estimate.vertical);
    tell_crash(self, copter->estimate.vertical.is_crashed);
    tell_unconfirmed(self, copter->state.lands_unconfirmed);
    tell_imu(self, &copter->imu);
    copter_keep_calibration(copter);
    copter_mavlink_pass_answers(copter);
    save_parameters(copter);
    copter_reboot_step(copter);
    self->turn = next_link(self);
    if (self->applies && (copter->state.mode.state == KEEL_MODE_DISARMED)) {
        self->applies = false;
        copter_retune(copter); /* That is enough for a run. */
    } else if (self->config.link[self->turn].bytes_per_s > 0u) {
        run_link(copter, self->turn);
    } else {
        /* There is no link. */
    }
}
