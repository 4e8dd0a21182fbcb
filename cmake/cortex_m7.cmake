# SPDX-License-Identifier: Apache-2.0
# A CMake toolchain for the Cortex-M7 with double-precision FPU: -DCMAKE_TOOLCHAIN_FILE=this file.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

set(KEEL_TARGET_FLAGS "-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard")
set(CMAKE_C_FLAGS_INIT "${KEEL_TARGET_FLAGS}")
set(CMAKE_CXX_FLAGS_INIT "${KEEL_TARGET_FLAGS}")
