/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ftp.h
 * @brief MAVLink's file transfer, to read alone: the files are constant bytes of the image.
 *
 * Each station has one file open at most, whatever number it gives its session: some stations
 * choose one, some take the server's, some use 0 always. So its number is what it says. A request
 * that comes again, as its answer was lost, has the same answer. Answers wait in a queue; the data
 * of one are put together when its turn comes. A burst that is not over goes back to the end of
 * the queue.
 */
#ifndef COPTER_FTP_H
#define COPTER_FTP_H

#include "mavlink_messages.h"

#include <stdbool.h>
#include <stdint.h>

/** Answers that wait. */
#define COPTER_FTP_REPLIES 4u

/** Stations that read at a time. One more takes the place of the one that began first. */
#define COPTER_FTP_READERS 4u

/** Bytes that one message carries at most. */
#define COPTER_FTP_DATA 239u

/** The files. */
#define COPTER_FILES     2u
#define COPTER_FILE_MAIN 0u /**< Says what there is: MAVLink's general metadata. */

/** A file. */
typedef struct copter_file {
    const char *name;
    const char *entry; /**< Of a directory: F, the name, a tabulator, the size. */
    const uint8_t *bytes;
    uint32_t size;
    uint32_t crc; /**< CRC-32 as MAVLink has it: from 0 on, and not inverted. */
} copter_file_t;

/** Made by `make generate NAME=tables`. */
extern const copter_file_t copter_file[COPTER_FILES];

/** An answer that is to be sent. */
typedef struct copter_ftp_reply {
    uint32_t offset;
    uint16_t sequence;
    uint8_t session; /**< As it was said. */
    uint8_t file;    /**< Which one it is about. */
    uint8_t opcode;  /**< That was asked for. */
    uint8_t size;    /**< Of what is read, at most. */
    uint8_t error;   /**< MAV_FTP_ERR_NONE: it is done. */
    uint8_t system;  /**< Who asked. */
    uint8_t component;
} copter_ftp_reply_t;

/** A station that reads. */
typedef struct copter_ftp_reader {
    uint8_t system;
    uint8_t component;
    uint8_t file;
    bool is_open; /**< Otherwise there is none. */
} copter_ftp_reader_t;

/** Who reads, and answers, the oldest first. */
typedef struct copter_ftp {
    copter_ftp_reader_t reader[COPTER_FTP_READERS];
    uint32_t next_reader; /**< The place of one more. */
    copter_ftp_reply_t reply[COPTER_FTP_REPLIES];
    uint32_t count;
} copter_ftp_t;

/**
 * Takes a request.
 *
 * @param ftp       the answers
 * @param message   what is asked
 * @param system    who asks
 * @param component the same
 * @return whether there was room for the answer
 */
bool copter_ftp_take(copter_ftp_t *ftp, const message_file_transfer_protocol_t *message,
                     uint8_t system, uint8_t component);

/**
 * The next answer. A burst of which something is left is behind all others then.
 *
 * @param ftp     the answers
 * @param message filled
 * @return whether there is one
 */
bool copter_ftp_report(copter_ftp_t *ftp, message_file_transfer_protocol_t *message);

#endif
