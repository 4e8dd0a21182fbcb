/* SPDX-License-Identifier: Apache-2.0 */
/* MAVLink's file transfer, to read alone. */
#include "ftp.h"

#include <string.h>

/* A payload: where its parts begin. */
#define AT_SESSION        2u
#define AT_OPCODE         3u
#define AT_SIZE           4u
#define AT_REQUEST        5u
#define AT_BURST_COMPLETE 6u
#define AT_OFFSET         8u
#define AT_DATA           12u

#define BYTE_BITS 8u
#define BYTE      0xFFu
#define WORD      4u

static uint32_t number_at(const uint8_t *from, uint32_t bytes)
{
    uint32_t number = 0u;

    for (uint32_t i = bytes; i > 0u; i--) {
        number = (number << BYTE_BITS) | from[i - 1u];
    }
    return number;
}

static void put_number(uint8_t *to, uint32_t bytes, uint32_t number)
{
    for (uint32_t i = 0u; i < bytes; i++) {
        to[i] = (uint8_t)((number >> (BYTE_BITS * i)) & BYTE);
    }
}

/* A path without the slashes that it begins with, up to a zero or its end. */
typedef struct path {
    const uint8_t *text;
    uint32_t length;
} path_t;

static path_t path_of(const uint8_t *payload)
{
    const uint32_t said = payload[AT_SIZE];
    const uint32_t most = (said < COPTER_FTP_DATA) ? said : COPTER_FTP_DATA;
    path_t path = {.text = &payload[AT_DATA]};
    uint32_t begin = 0u;
    uint32_t end;

    while ((begin < most) && (path.text[begin] == (uint8_t)'/')) {
        begin++;
    }
    end = begin;
    while ((end < most) && (path.text[end] != 0u)) {
        end++;
    }
    path.text = &path.text[begin];
    path.length = end - begin;
    return path;
}

static bool is_named(path_t path, const char *name)
{
    bool same = true;

    for (uint32_t i = 0u; same && (i < path.length); i++) {
        same = ((uint8_t)name[i] == path.text[i]); /* A name's end is no byte of a path. */
    }
    return same && (name[path.length] == '\0');
}

/* The file that is asked for: its number, or COPTER_FILES. */
static uint32_t file_at(path_t path)
{
    uint32_t found = COPTER_FILES;

    for (uint32_t i = 0u; i < COPTER_FILES; i++) {
        if (is_named(path, copter_file[i].name)) {
            found = i;
        }
    }
    return found;
}

static uint8_t error_of_path(copter_ftp_reply_t *reply, path_t path)
{
    const uint32_t file = file_at(path);

    reply->file = (uint8_t)((file < COPTER_FILES) ? file : 0u);
    return (uint8_t)((file < COPTER_FILES) ? MAV_FTP_ERR_NONE : MAV_FTP_ERR_FILENOTFOUND);
}

/* The place of who asks among those that read, or COPTER_FTP_READERS. */
static uint32_t reader_of(const copter_ftp_t *ftp, const copter_ftp_reply_t *reply)
{
    uint32_t found = COPTER_FTP_READERS;

    for (uint32_t i = 0u; i < COPTER_FTP_READERS; i++) {
        const copter_ftp_reader_t *const reader = &ftp->reader[i];

        if (reader->is_open && (reader->system == reply->system) &&
            (reader->component == reply->component)) {
            found = i;
        }
    }
    return found;
}

static void open_file(copter_ftp_t *ftp, const copter_ftp_reply_t *reply)
{
    uint32_t place = reader_of(ftp, reply);

    if (place == COPTER_FTP_READERS) {
        place = ftp->next_reader;
        ftp->next_reader = (place + 1u) % COPTER_FTP_READERS;
    }
    ftp->reader[place] = (copter_ftp_reader_t){.system = reply->system,
                                               .component = reply->component,
                                               .file = reply->file,
                                               .is_open = true};
}

static void close_file(copter_ftp_t *ftp, const copter_ftp_reply_t *reply)
{
    const uint32_t place = reader_of(ftp, reply);

    if (place < COPTER_FTP_READERS) {
        ftp->reader[place].is_open = false;
    }
}

static uint8_t error_of_open(copter_ftp_t *ftp, copter_ftp_reply_t *reply, path_t path)
{
    const uint8_t error = error_of_path(reply, path);

    if (error == MAV_FTP_ERR_NONE) {
        open_file(ftp, reply);
    }
    return error;
}

/* There is one directory. */
static uint8_t error_of_list(const copter_ftp_reply_t *reply, path_t path)
{
    if ((path.length > 0u) && !is_named(path, ".")) {
        return (uint8_t)MAV_FTP_ERR_FILENOTFOUND;
    }
    return (uint8_t)((reply->offset < COPTER_FILES) ? MAV_FTP_ERR_NONE : MAV_FTP_ERR_EOF);
}

/* A burst of no bytes each would never end. */
static uint8_t error_of_read(const copter_ftp_t *ftp, copter_ftp_reply_t *reply)
{
    const uint32_t place = reader_of(ftp, reply);
    uint32_t error = MAV_FTP_ERR_NONE;

    if (place == COPTER_FTP_READERS) {
        return (uint8_t)MAV_FTP_ERR_INVALIDSESSION;
    }
    reply->file = ftp->reader[place].file;
    if (reply->size == 0u) {
        error = MAV_FTP_ERR_INVALIDDATASIZE;
    } else if (reply->offset >= copter_file[reply->file].size) {
        error = MAV_FTP_ERR_EOF;
    } else {
        /* There is something to read. */
    }
    return (uint8_t)error;
}

static uint8_t error_of_others(uint8_t opcode)
{
    const bool writes = (opcode >= MAV_FTP_OPCODE_CREATEFILE) && (opcode <= MAV_FTP_OPCODE_RENAME);

    return (uint8_t)(writes ? MAV_FTP_ERR_FILEPROTECTED : MAV_FTP_ERR_UNKNOWNCOMMAND);
}

/* The error of a request, and the file that it is about. */
static uint8_t error_of(copter_ftp_t *ftp, copter_ftp_reply_t *reply, const uint8_t *payload)
{
    uint8_t error = (uint8_t)MAV_FTP_ERR_NONE;

    switch (reply->opcode) {
    case MAV_FTP_OPCODE_NONE:
        break;
    case MAV_FTP_OPCODE_TERMINATESESSION:
    case MAV_FTP_OPCODE_RESETSESSION:
        close_file(ftp, reply);
        break;
    case MAV_FTP_OPCODE_LISTDIRECTORY:
        error = error_of_list(reply, path_of(payload));
        break;
    case MAV_FTP_OPCODE_OPENFILERO:
        error = error_of_open(ftp, reply, path_of(payload));
        break;
    case MAV_FTP_OPCODE_CALCFILECRC:
        error = error_of_path(reply, path_of(payload));
        break;
    case MAV_FTP_OPCODE_READFILE:
    case MAV_FTP_OPCODE_BURSTREADFILE:
        error = error_of_read(ftp, reply);
        break;
    default:
        error = error_of_others(reply->opcode);
        break;
    }
    return error;
}

static void remove_reply(copter_ftp_t *ftp, uint32_t at)
{
    for (uint32_t i = at + 1u; i < ftp->count; i++) {
        ftp->reply[i - 1u] = ftp->reply[i];
    }
    ftp->count--;
}

/* Whether a burst of whoever asks ends: it asks for another, or wants no more of it. */
static bool ends_burst(uint8_t opcode)
{
    return (opcode == MAV_FTP_OPCODE_BURSTREADFILE) || (opcode == MAV_FTP_OPCODE_OPENFILERO) ||
           (opcode == MAV_FTP_OPCODE_TERMINATESESSION) || (opcode == MAV_FTP_OPCODE_RESETSESSION);
}

static void end_burst(copter_ftp_t *ftp, uint8_t system, uint8_t component)
{
    for (uint32_t i = ftp->count; i > 0u; i--) {
        const copter_ftp_reply_t *const reply = &ftp->reply[i - 1u];

        if ((reply->opcode == MAV_FTP_OPCODE_BURSTREADFILE) && (reply->system == system) &&
            (reply->component == component)) {
            remove_reply(ftp, i - 1u);
        }
    }
}

bool copter_ftp_take(copter_ftp_t *ftp, const message_file_transfer_protocol_t *message,
                     uint8_t system, uint8_t component)
{
    const uint8_t *const payload = message->payload;
    copter_ftp_reply_t reply = {.offset = number_at(&payload[AT_OFFSET], WORD),
                                .session = payload[AT_SESSION],
                                .opcode = payload[AT_OPCODE],
                                .size = payload[AT_SIZE],
                                .system = system,
                                .component = component};

    reply.sequence = (uint16_t)((number_at(payload, 2u) + 1u) & UINT16_MAX);
    reply.error = error_of(ftp, &reply, payload);
    if (ends_burst(reply.opcode)) {
        end_burst(ftp, system, component);
    }
    if (ftp->count >= COPTER_FTP_REPLIES) {
        return false;
    }
    ftp->reply[ftp->count] = reply;
    ftp->count++;
    return true;
}

/* As many entries of the directory as there is room for, from one on; tells their bytes. */
static uint32_t list_entries(uint32_t from, uint8_t data[COPTER_FTP_DATA])
{
    uint32_t size = 0u;

    for (uint32_t i = from; i < COPTER_FILES; i++) {
        const uint32_t more = (uint32_t)strlen(copter_file[i].entry) + 1u;

        if (more > (COPTER_FTP_DATA - size)) {
            break;
        }
        (void)memcpy(&data[size], copter_file[i].entry, more);
        size += more;
    }
    return size;
}

/* Bytes of a file; tells how many. */
static uint32_t read_file(const copter_ftp_reply_t *reply, uint8_t data[COPTER_FTP_DATA])
{
    const copter_file_t *const file = &copter_file[reply->file];
    const uint32_t left = file->size - reply->offset;
    uint32_t size = (reply->size < COPTER_FTP_DATA) ? reply->size : COPTER_FTP_DATA;

    if (size > left) {
        size = left;
    }
    (void)memcpy(data, &file->bytes[reply->offset], size);
    return size;
}

/* Writes the data of an answer; tells its bytes. */
static uint32_t write_data(const copter_ftp_reply_t *reply, uint8_t data[COPTER_FTP_DATA])
{
    uint32_t size = 0u;

    if (reply->error != MAV_FTP_ERR_NONE) {
        data[0] = reply->error;
        return 1u;
    }
    switch (reply->opcode) {
    case MAV_FTP_OPCODE_LISTDIRECTORY:
        size = list_entries(reply->offset, data);
        break;
    case MAV_FTP_OPCODE_OPENFILERO:
        put_number(data, WORD, copter_file[reply->file].size);
        size = WORD;
        break;
    case MAV_FTP_OPCODE_CALCFILECRC:
        put_number(data, WORD, copter_file[reply->file].crc);
        size = WORD;
        break;
    case MAV_FTP_OPCODE_READFILE:
    case MAV_FTP_OPCODE_BURSTREADFILE:
        size = read_file(reply, data);
        break;
    default:
        /* That it is done is all. */
        break;
    }
    return size;
}

/* A burst behind so many bytes: with what is left of it to the end of the queue, in which its own
 * place has become free; tells whether it is complete. */
static bool is_complete(copter_ftp_t *ftp, copter_ftp_reply_t *reply, uint32_t size)
{
    reply->offset += size;
    reply->sequence = (uint16_t)((reply->sequence + 1u) & UINT16_MAX);
    if (reply->offset < copter_file[reply->file].size) {
        ftp->reply[ftp->count] = *reply;
        ftp->count++;
        return false;
    }
    return true;
}

bool copter_ftp_report(copter_ftp_t *ftp, message_file_transfer_protocol_t *message)
{
    copter_ftp_reply_t reply;
    uint8_t *const payload = message->payload;
    uint32_t size;

    if (ftp->count == 0u) {
        return false;
    }
    reply = ftp->reply[0];
    remove_reply(ftp, 0u);
    *message = (message_file_transfer_protocol_t){.target_system = reply.system,
                                                  .target_component = reply.component};
    size = write_data(&reply, &payload[AT_DATA]);
    put_number(payload, 2u, reply.sequence);
    payload[AT_SESSION] = reply.session;
    payload[AT_OPCODE] = (uint8_t)((reply.error == MAV_FTP_ERR_NONE) ? MAV_FTP_OPCODE_ACK
                                                                     : MAV_FTP_OPCODE_NAK);
    payload[AT_SIZE] = (uint8_t)size;
    payload[AT_REQUEST] = reply.opcode;
    put_number(&payload[AT_OFFSET], WORD, reply.offset);
    if ((reply.opcode == MAV_FTP_OPCODE_BURSTREADFILE) && (reply.error == MAV_FTP_ERR_NONE)) {
        payload[AT_BURST_COMPLETE] = is_complete(ftp, &reply, size) ? 1u : 0u;
    }
    return true;
}
