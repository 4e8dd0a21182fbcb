/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file rc.h
 * @brief The pilot's receiver, whatever of four protocols it speaks.
 *
 * All decoders listen until one of them has taken enough frames; from then on, until the next
 * start, that one alone does. SBUS has no checksum, so it must be heard for longer, and a right
 * frame of a protocol that has one begins anew what was heard of the others.
 */
#ifndef COPTER_RC_H
#define COPTER_RC_H

#include "keel/middleware/crsf.h"
#include "keel/middleware/ibus.h"
#include "keel/middleware/ppm.h"
#include "keel/middleware/sbus.h"
#include "port.h"

#include <stdbool.h>
#include <stdint.h>

#define COPTER_CHANNELS 16u

/** @name Protocols: the values of RC_PROTOCOL. */
/** @{ */
#define COPTER_PROTOCOL_ANY  0u /**< The one that is heard. */
#define COPTER_PROTOCOL_SBUS 1u
#define COPTER_PROTOCOL_CRSF 2u
#define COPTER_PROTOCOL_IBUS 3u
#define COPTER_PROTOCOL_PPM  4u
#define COPTER_PROTOCOLS     5u
/** @} */

/** @name Why frames were refused. */
/** @{ */
#define COPTER_REFUSED_STICK 0u /**< A stick is beyond its range. */
#define COPTER_REFUSED_FLAGS 1u /**< Flags that there are none of. */
#define COPTER_REFUSED_CHECK 2u /**< Checksum, footer, or number of channels. */
#define COPTER_REFUSED_BYTES 3u /**< Bytes of no frame; of CRSF, frames too short, too. */
#define COPTER_REFUSALS      4u
/** @} */

/** The state of the receiver in the last second. */
typedef enum copter_heard {
    COPTER_HEARD_YET = 0,  /**< The first second is not over. */
    COPTER_HEARD_PILOT,    /**< The pilot. */
    COPTER_HEARD_LOST,     /**< That it has lost the pilot. */
    COPTER_HEARD_NO_STICK, /**< Frames whose sticks are beyond their range. */
    COPTER_HEARD_FLAGS,    /**< Frames with flags that there are none of. */
    COPTER_HEARD_NOISE,    /**< Bytes that are no frames. */
    COPTER_HEARD_NOTHING   /**< Nothing. */
} copter_heard_t;

/** The configurations of all decoders. */
typedef struct copter_rc_config {
    uint8_t protocol; /**< COPTER_PROTOCOL_... */
    keel_sbus_config_t sbus;
    keel_crsf_config_t crsf;
    keel_ibus_config_t ibus;
    keel_ppm_config_t ppm;
} copter_rc_config_t;

/** A receiver. Read it freely. */
typedef struct copter_rc {
    keel_sbus_t sbus;
    keel_crsf_t crsf;
    keel_ibus_t ibus;
    keel_ppm_t ppm;
    uint32_t frames;                   /**< Of the protocol that is heard. */
    uint16_t channel[COPTER_CHANNELS]; /**< The last frame's, in us; 0 where it has none. */
    uint8_t protocol;                  /**< Which is heard; COPTER_PROTOCOL_ANY: none yet. */
    uint8_t row[COPTER_PROTOCOLS];     /**< Frames of each, while none is. */
    bool is_lost; /**< The last frame is not the pilot's: repeated or made up. */
} copter_rc_t;

/**
 * Begins to listen.
 *
 * @return KEEL_OK, or what the first decoder that refuses its configuration says
 */
keel_status_t copter_rc_init(copter_rc_t *self, const copter_rc_config_t *config);

/**
 * Takes a byte, or an edge of PPM.
 *
 * @return whether it ended a frame of the protocol that is heard
 */
bool copter_rc_take(copter_rc_t *self, const copter_byte_t *byte);

/** How many frames were refused for each reason, of all protocols that were listened to. */
void copter_rc_count(const copter_rc_t *self, uint32_t refused[COPTER_REFUSALS]);

/** Why nobody heard the pilot, in at most 43 letters; or which protocol he is heard by. */
const char *copter_rc_words(copter_heard_t heard, uint8_t protocol);

#endif
