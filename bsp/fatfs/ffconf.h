/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ffconf.h
 * @brief How FatFs R0.15 is built: one volume and one file, nothing that a black box does not need.
 *
 * Names and meanings are FatFs'. What is off is not compiled: what a card says reaches less code.
 */
#ifndef KEEL_BSP_FATFS_FFCONF_H
#define KEEL_BSP_FATFS_FFCONF_H

/** The release that these settings are for; FatFs refuses those of another one. */
#define FFCONF_DEF 80286

/* A file is made, extended, cut and removed, and the root directory is listed. */
#define FF_FS_READONLY 0
#define FF_FS_MINIMIZE 0

/* f_expand allocates a file in one piece, before the flight. */
#define FF_USE_EXPAND 1

/* The copter formats no card: a slip must not empty one. */
#define FF_USE_MKFS 0

#define FF_USE_FIND     0
#define FF_USE_FASTSEEK 0
#define FF_USE_CHMOD    0
#define FF_USE_LABEL    0
#define FF_USE_FORWARD  0
#define FF_USE_STRFUNC  0
#define FF_PRINT_LLI    0
#define FF_PRINT_FLOAT  0
#define FF_STRF_ENCODE  0

/* LOG00001.ULG is a short name. Long ones would need a table of Unicode and 600 bytes of RAM. */
#define FF_CODE_PAGE   437
#define FF_USE_LFN     0
#define FF_MAX_LFN     255
#define FF_LFN_UNICODE 0
#define FF_LFN_BUF     255
#define FF_SFN_BUF     12
#define FF_FS_RPATH    0

/* One card, without a partition table or with one: then its first FAT partition. */
#define FF_VOLUMES         1
#define FF_STR_VOLUME_ID   0
#define FF_MULTI_PARTITION 0
#define FF_MIN_SS          512
#define FF_MAX_SS          512
#define FF_LBA64           0
#define FF_MIN_GPT         0x10000000
#define FF_USE_TRIM        0

/* The file needs no buffer of its own: black_box.c writes its sectors past FatFs. So the volume's
 * one buffer keeps the directory's sector, and a new size costs one write and no read. */
#define FF_FS_TINY 1

/* exFAT has no second table and keeps a check over a file's entry in several places; FAT32 ends at
 * 2 TB, which is enough. */
#define FF_FS_EXFAT 0

/* There is no clock that knows the date: the same one for all files. */
#define FF_FS_NORTC   1
#define FF_NORTC_MON  1
#define FF_NORTC_MDAY 1
#define FF_NORTC_YEAR 2026

/* The count of free clusters on a FAT32 card is a hint, which is kept up to date. */
#define FF_FS_NOFSINFO 0

/* One file is open, by one task. */
#define FF_FS_LOCK      0
#define FF_FS_REENTRANT 0
#define FF_FS_TIMEOUT   0

#endif
