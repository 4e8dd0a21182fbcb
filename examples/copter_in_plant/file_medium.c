/* SPDX-License-Identifier: Apache-2.0 */
/* The file is open only while it is read or written, so that no byte waits in the process. */
#include "file_medium.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static bool read_file(void *context, uint32_t address, uint8_t *bytes, uint32_t count)
{
    FILE *const file = fopen((const char *)context, "rb");
    bool done = errno == ENOENT;

    memset(bytes, 0, count);
    if (file != NULL) {
        /* Behind its end there are zeros. */
        done = fseek(file, (long)address, SEEK_SET) == 0;
        if (done && (fread(bytes, 1u, count, file) < count)) {
            done = ferror(file) == 0;
        }
        (void)fclose(file);
    }
    return done;
}

static bool write_file(void *context, uint32_t address, const uint8_t *bytes, uint32_t count)
{
    FILE *file = fopen((const char *)context, "r+b");
    bool done = false;

    if ((file == NULL) && (errno == ENOENT)) {
        file = fopen((const char *)context, "w+b");
    }
    if (file != NULL) {
        done = (fseek(file, (long)address, SEEK_SET) == 0) &&
               (fwrite(bytes, 1u, count, file) == count);
        done = (fclose(file) == 0) && done;
    }
    return done;
}

keel_medium_t file_medium(const char *path)
{
    const keel_medium_t medium = {
        .read = read_file, .write = write_file, .erase = NULL, .context = (void *)path};

    return medium;
}
