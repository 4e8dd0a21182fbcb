/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file telemetry.h
 * @brief Telemetry by MAVLink 2: what the copter tells ground stations, and what they may ask.
 *
 * A copter has up to COPTER_LINKS links, each with its own decoder, intervals, answers and bytes
 * per second (link_schedule.h). Nothing waits: what finds no room on a link is sent later, and what
 * does not fit into a queue is not sent; texts that a link missed are counted. A run is for one
 * link, looks at no more than COPTER_LINK_BYTES of it and COPTER_LINK_LOOKS beginnings of frames,
 * acts on at most one frame, and sends at most one: so its time is bounded, whatever comes.
 *
 * Requests of a ground station are in mavlink_receiver.c, and those of parameters in
 * mavlink_parameters.c. Commands that move the aircraft go through action_request.h.
 */
#ifndef COPTER_TELEMETRY_H
#define COPTER_TELEMETRY_H

#include "copter.h"
#include "ftp.h"
#include "keel/middleware/mavlink.h"
#include "keel/middleware/signing.h"
#include "link_schedule.h"
#include "mavlink_empty_lists.h"
#include "mavlink_messages.h"
#include "shell.h"

#include <stdbool.h>
#include <stdint.h>

#define COPTER_LINKS       3u
#define COPTER_LINK_BYTES  64u
#define COPTER_LINK_LOOKS  8u /**< Looks of a run that find a frame or a false beginning. */
#define COPTER_LINK_ACKS   4u
#define COPTER_LINK_ERRORS 4u
#define COPTER_TEXTS       16u
#define COPTER_TEXT_LENGTH 50u
#define COPTER_MODES       6u /**< That a pilot or a station may ask for: those of mode.h. */
#define COPTER_NAMED       3u /**< Values that NAMED_VALUE_INT tells in turn. */
/** No byte for longer than this: what is held of a frame is none. Radios pause within frames, for
 *  shorter than this; ground stations ask again after longer. */
#define COPTER_LINK_SILENCE_US 300000u
#define COPTER_WORDS           ((COPTER_PARAMETER_COUNT + 31u) / 32u)

/** The lines that links run on. */
typedef struct copter_lines {
    void *context; /**< What the functions are handed. */
    /** Takes up to size bytes that came; returns how many. */
    uint32_t (*read)(void *context, uint32_t link, uint8_t *bytes, uint32_t size);
    /** How many bytes can be written now. */
    uint32_t (*room)(void *context, uint32_t link);
    /** Writes a frame, for which there is room. */
    void (*write)(void *context, uint32_t link, const uint8_t *bytes, uint32_t size);
} copter_lines_t;

/** The limits of a link. */
typedef struct copter_link_config {
    uint32_t bytes_per_s; /**< That it carries; 0: there is no such link. */
    bool commands;        /**< What comes by it may arm, disarm, set modes and parameters. */
} copter_link_config_t;

/** A key: with one, frames are signed, and what is not signed with it is not taken. It comes from
 * whoever stands at the vehicle, never by a link. */
typedef struct copter_key {
    const uint8_t *key;          /**< KEEL_SIGNING_KEY_BYTES of them; null: there is none. */
    keel_signing_hash_fn_t hash; /**< SHA-256; null without a key. */
    uint64_t timestamp;          /**< Later than all that was signed before: see signing.h. */
} copter_key_t;

/** How telemetry is made. */
typedef struct copter_telemetry_config {
    copter_key_t key;
    copter_lines_t lines;
    copter_link_config_t link[COPTER_LINKS];
} copter_telemetry_config_t;

/** A link. */
typedef struct copter_link {
    keel_mavlink_t decoder;
    keel_mavlink_sender_t sender;
    copter_link_schedule_t schedule;
    uint8_t bytes[COPTER_LINK_BYTES]; /**< That came: of count, those from looked_at on wait. */
    uint32_t count;
    uint32_t looked_at;
    uint64_t ran_us;                             /**< When it had its last run. */
    uint64_t heard_us;                           /**< When its last byte came. */
    message_command_ack_t ack[COPTER_LINK_ACKS]; /**< To be sent, the oldest first. */
    uint32_t acks;
    message_param_error_t error[COPTER_LINK_ERRORS]; /**< The same. */
    uint32_t errors;
    uint32_t texts;      /**< Of telemetry.texts, those sent or missed. */
    uint32_t missed;     /**< Texts that were overwritten before they were sent. */
    uint32_t dropped;    /**< Answers for which there was no place. */
    uint32_t refused;    /**< Frames that may not be taken from this link. */
    message_ping_t ping; /**< To be sent. */
    message_timesync_t timesync;
    uint32_t wanted[COPTER_WORDS]; /**< Parameters to be sent, a bit each. */
    uint32_t parameter;            /**< The one sent last. */
    uint32_t named;                /**< Of the values of NAMED_VALUE_INT, the next one. */
    uint32_t modes;                /**< Modes to be sent as AVAILABLE_MODES, a bit each. */
    copter_replies_t replies;      /**< Of mavlink_empty_lists.h, to be sent. */
    copter_ftp_t ftp;
    copter_shell_t shell;
} copter_link_t;

/** A text for all links. */
typedef struct copter_text {
    uint8_t severity;
    char text[COPTER_TEXT_LENGTH];
} copter_text_t;

/** A sender that waits for an answer of the state machine. */
typedef struct copter_waiter {
    uint32_t link;
    uint16_t command; /**< 0: nobody. */
    uint8_t system;
    uint8_t component;
} copter_waiter_t;

/** Telemetry. Read it freely. */
typedef struct copter_telemetry {
    copter_telemetry_config_t config;
    copter_link_t link[COPTER_LINKS];
    keel_signing_t signing;           /**< Of all links, so that no frame counts by two of them. */
    copter_text_t text[COPTER_TEXTS]; /**< Text n is at n modulo COPTER_TEXTS. */
    uint32_t texts;                   /**< How many there were. */
    copter_waiter_t arm_waiter;
    copter_waiter_t mode_waiter;
    uint64_t reboots_us;    /**< When it starts anew, as a station asked; 0: nobody has. */
    uint32_t turn;          /**< The link that had the last run. */
    bool saves;             /**< Parameters were set, and are to be saved on the ground. */
    bool applies;           /**< The same, and are to be put in force there. */
    uint8_t system;         /**< The copter's number among vehicles. */
    uint8_t state;          /**< The state machine's, in the last run. */
    uint8_t mode;           /**< The mode that was told in the last run. */
    uint8_t heard;          /**< What was heard of the pilot's receiver, as it was told. */
    uint8_t height;         /**< Where the height came from, as it was told: copter_height_t. */
    bool had_height;        /**< It was known once. */
    bool is_silent;         /**< The satellite receiver, as it was told. */
    uint64_t silent_us;     /**< When that may be told again. */
    bool is_outside;        /**< Of the fence, in the last run. */
    bool is_crashed;        /**< As it was told. */
    bool is_unconfirmed;    /**< The same. */
    bool has_flown;         /**< Motors have turned since the start. */
    uint64_t notices_us;    /**< When the port's notices are to be told again. */
    uint32_t refusals;      /**< What was taken of state.refusals. */
    uint32_t turns;         /**< What was taken of calibration.turns. */
    uint64_t turned_us;     /**< When it was told that it turns. */
    uint32_t field_ends;    /**< What was taken of calibration.field_ends. */
    uint32_t keeps;         /**< The next parameter that a calibration has to set, */
    uint32_t keeps_end;     /**< and the one behind the last. */
    uint32_t sides;         /**< Of calibration.accelerometers, the sides that were told. */
    uint8_t side;           /**< And where it rested, */
    uint8_t levelling;      /**< and what went on. */
    uint8_t accelerometers; /**< The state of their votes, as it was told. */
    uint8_t gyroscopes;     /**< The same. */
    uint8_t latched[COPTER_IMUS]; /**< Of each unit, the channels that were in the last run. */
} copter_telemetry_t;

/**
 * Makes telemetry and adds its task.
 *
 * @param copter    a copter that was started
 * @param telemetry kept
 * @param config    copied
 * @return as copter_add
 */
keel_status_t copter_telemetry_start(copter_t *copter, copter_telemetry_t *telemetry,
                                     const copter_telemetry_config_t *config);

/** The task's body. */
void copter_telemetry(copter_t *copter);

/** How often a link is told one of messages_sent unless it asks for something else, in us; 0: only
 * when it is asked for. */
uint32_t copter_telemetry_interval_us(uint32_t sent);

/** Queues a text of two parts for all links; what does not fit is left out. */
void copter_text(copter_telemetry_t *self, uint8_t severity, const char *first, const char *then);

/** Whether a message is for the copter, by the target that it names; 0 means all. */
bool copter_is_meant(const copter_link_t *link, uint8_t system, uint8_t component);

/** @name The parts of telemetry. */
/** @{ */
/** Acts on the frame that a link's decoder has. */
void copter_mavlink_receive(copter_t *copter, uint32_t link);
/** Tells parameters, or why not. */
void copter_mavlink_read_parameter(copter_t *copter, uint32_t link,
                                   const keel_mavlink_frame_t *from,
                                   const message_param_request_read_t *message);
void copter_mavlink_list_parameters(copter_t *copter, uint32_t link);
/** Sets a parameter, if the link may. */
void copter_mavlink_set_parameter(copter_t *copter, uint32_t link, const keel_mavlink_frame_t *from,
                                  const message_param_set_t *message, bool may);
/** Says in words which parameters wait for a restart, and which stored values were not taken. */
void copter_mavlink_tell_parameters(copter_t *copter);
/** The same, for requests about missions and logs (mavlink_empty_lists.h). */
void copter_mavlink_receive_list(copter_t *copter, uint32_t link);
/** Fills the payload of an answer to those, if it is the next one of a link. */
bool copter_mavlink_report_list(copter_link_t *link, uint32_t sent, uint8_t *payload);
/** Tells of calibrations, and sets and saves the parameters of those that ended. */
void copter_keep_calibration(copter_t *copter);
/** Tells all that a parameter is set, as by copter_mavlink_set_parameter; it is saved, and put in
 * force on the ground. */
void copter_mavlink_parameter_is_set(copter_t *copter, uint16_t index);
/** Says why the pilot's attempt to arm failed, and answers those whose requests the state machine
 * decided. */
void copter_mavlink_pass_answers(copter_t *copter);
/** Fills the payload of one of messages_sent; returns whether there is anything to say. */
bool copter_mavlink_report(const copter_t *copter, copter_link_t *link, uint32_t sent,
                           uint8_t *payload);
/** @} */

#endif
