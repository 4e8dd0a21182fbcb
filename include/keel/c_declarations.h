/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file c_declarations.h
 * @brief Stands around the declarations of a header, so that C++ finds the functions of C.
 */
#ifndef KEEL_C_DECLARATIONS_H
#define KEEL_C_DECLARATIONS_H

#ifdef __cplusplus
#define KEEL_C_BEGIN extern "C" {
#define KEEL_C_END   }
#else
#define KEEL_C_BEGIN
#define KEEL_C_END
#endif

#endif
