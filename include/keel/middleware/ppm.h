/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppm.h
 * @brief The pilot's radio: a decoder of PPM, edge by edge.
 *
 * All channels on one wire, one after another, each as the time from one rising edge to the next
 * (or from one falling edge to the next; of one kind alone): 800 to 2200 us. A frame ends, and the
 * next begins, with a longer time, the sync gap; there is one every 20 to 22.5 ms. Capturing edges
 * is the timer driver's affair.
 *
 * Judge only the sticks: another channel may be of any length below the sync gap, as that of a
 * knob at 150 % is, and whoever uses one takes what is beyond its end as the end.
 *
 * PPM has no check at all. So channels are taken only when as many frames in a row as are
 * configured are right as a whole and have as many channels each: an edge too few or too many makes
 * another number of them, and a jump in time another frame. That number stays as it is until a row
 * of another begins. An edge that is somewhat early or late is believed.
 *
 * A receiver that loses the radio stops sending edges, or goes on with channels that it was set to
 * send then; only the former shows: in age_us.
 *
 * All is integer arithmetic. All counts and times stay at UINT32_MAX.
 */
#ifndef KEEL_MIDDLEWARE_PPM_H
#define KEEL_MIDDLEWARE_PPM_H

#include "keel/c_declarations.h"
#include "keel/middleware/framing.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** The most channels of a frame. */
#define KEEL_PPM_CHANNELS 16

/** A configuration of a decoder. */
typedef struct keel_ppm_config {
    uint32_t lost_us;    /**< Channels that are older mean a lost radio, and a longer silence is no
                              sync gap, in us; more than sync_us. 100000, five frames, is usual. */
    uint16_t lowest_us;  /**< The shortest channel that is judged; 800 is usual. */
    uint16_t highest_us; /**< The longest, not below the shortest; 2200 is usual. */
    uint16_t sync_us;    /**< The shortest sync gap, above the longest channel; 2300 is usual. */
    uint16_t judged;     /**< The channels that are: bit i for channel i + 1; 0x000F is usual, the
                              sticks. */
    uint8_t least;       /**< The fewest channels of a right frame, 1 to KEEL_PPM_CHANNELS. */
    uint8_t frames_to_take; /**< So many right frames in a row; more than 0. */
} keel_ppm_config_t;

/** Counts since the start. */
typedef struct keel_ppm_count {
    uint32_t frames;  /**< Frames whose channels were taken. */
    uint32_t pulses;  /**< Frames refused for a channel that is judged and out of its range. */
    uint32_t numbers; /**< Frames refused for too few or too many channels. */
    uint32_t gaps;    /**< Frames that were right so far, and silence ended. */
} keel_ppm_count_t;

/** A decoder. Only the functions below write it; all of it may be read. */
typedef struct keel_ppm {
    keel_ppm_config_t config;            /**< The configuration. */
    keel_ppm_count_t count;              /**< Counts of events. */
    uint32_t age_us;                     /**< Since channels were taken; UINT32_MAX before. */
    uint32_t quiet_us;                   /**< Since the last edge, in us. */
    uint16_t channel[KEEL_PPM_CHANNELS]; /**< The last that were taken, in us; 0 before. */
    uint16_t next[KEEL_PPM_CHANNELS];    /**< Those of the frame that comes. */
    uint8_t channels;                    /**< How many were taken; 0 before. */
    uint8_t come;                        /**< How many came of the frame that comes. */
    uint8_t row_of;                      /**< How many the frames of this row have. */
    uint8_t row;                         /**< Right frames in a row, up to frames_to_take. */
    bool begun;                          /**< The frame that comes is right so far. */
} keel_ppm_t;

/**
 * Makes a decoder (requirements PPM-001 and PPM-002).
 *
 * @param ppm    the decoder
 * @param config what it is made from; copied
 * @return KEEL_OK; KEEL_ERR_LIMITS when a channel's range is empty, reaches the sync gap, or that
 *         reaches lost_us, or when least is not 1 to KEEL_PPM_CHANNELS; KEEL_ERR_LATCH when
 *         frames_to_take is 0; the first that applies: then nothing is changed
 */
keel_status_t keel_ppm_init(keel_ppm_t *ppm, const keel_ppm_config_t *config);

/**
 * Takes an edge (requirements PPM-003 to PPM-010).
 *
 * @param ppm        the decoder, initialised
 * @param elapsed_us the time since the edge before, as their timestamps differ, or since
 *                   keel_ppm_pass_time when that was called after it, in us; every microsecond is
 *                   told once
 * @return whether channels were taken: they are in ppm->channel then. Otherwise that is as it was
 */
bool keel_ppm_take(keel_ppm_t *ppm, uint32_t elapsed_us);

/**
 * Lets time pass in which no edge came (requirement PPM-008), so that age_us is up to date.
 *
 * @param ppm        the decoder, initialised
 * @param elapsed_us the time since the last call for this decoder, in us
 */
void keel_ppm_pass_time(keel_ppm_t *ppm, uint32_t elapsed_us);

/**
 * Whether the radio is lost (requirement PPM-011): channels are older than lost_us.
 *
 * @param ppm the decoder, initialised
 * @return true, too, before the first channels
 */
bool keel_ppm_is_lost(const keel_ppm_t *ppm);

KEEL_C_END

#endif
