/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file version.h
 * @brief The version of Keel, by https://semver.org. All files that name it follow this one.
 *
 * Before 1.0.0 a new minor version may change the interface; CHANGELOG.md says how.
 */
#ifndef KEEL_VERSION_H
#define KEEL_VERSION_H

#define KEEL_VERSION_MAJOR 0
#define KEEL_VERSION_MINOR 9
#define KEEL_VERSION_PATCH 0

#endif
