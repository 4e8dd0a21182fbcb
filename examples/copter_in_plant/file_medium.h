/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file file_medium.h
 * @brief A file as a medium of slots: what an FRAM is on a board.
 */
#ifndef FILE_MEDIUM_H
#define FILE_MEDIUM_H

#include "common/slots.h"

/**
 * A file as a medium. Bytes that were never written read as zeros.
 *
 * @param path of the file, which need not be there yet; used as long as the medium is
 * @return the medium, which needs no erasing
 */
keel_medium_t file_medium(const char *path);

#endif
