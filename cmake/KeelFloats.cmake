# SPDX-License-Identifier: Apache-2.0
# The proofs are about C99 with IEEE 754 arithmetic in the order that is written, nothing fused
# (A-23 of specs/soundness.md). These flags ask a compiler for it, whatever the project around Keel asks
# for, and float_check.c looks whether they took effect.

set(KEEL_FLOATS_FOLDER ${CMAKE_CURRENT_LIST_DIR})

# What GCC and Clang are asked, and all compilers that are made of them.
set(KEEL_FLOAT_FLAGS_GNU
    -fno-fast-math -fno-unsafe-math-optimizations -fno-associative-math -fno-reciprocal-math
    -fno-finite-math-only -fsigned-zeros -ffp-contract=off)

# What it means when float_check.c ends with 1, 2, 3...
set(KEEL_FLOAT_QUESTIONS
    "fuses a product and a sum" "changes the order of sums" "divides by multiplying"
    "takes it that there is no NaN" "loses the sign of zero" "hides an overflow"
    "does not round to nearest" "flushes subnormal numbers to zero")

# The flags for the compiler as a list; of one that is not known the integrator has to say them.
function(keel_float_flags variable)
  if(CMAKE_C_COMPILER_ID MATCHES "GNU|Clang")
    list(JOIN KEEL_FLOAT_FLAGS_GNU " " flags)
  elseif(NOT DEFINED KEEL_FLOAT_FLAGS)
    message(FATAL_ERROR
            "Keel: for the compiler ${CMAKE_C_COMPILER} (${CMAKE_C_COMPILER_ID}) the flags that keep "
            "the arithmetic of the proofs are not known. Say them with -DKEEL_FLOAT_FLAGS=\"...\", "
            "none with \"\": nothing fused, no sum reordered, NaN and the sign of zero kept "
            "(docs/integration.md)")
  endif()
  set(KEEL_FLOAT_FLAGS "${flags}" CACHE STRING "The flags that keep the arithmetic of the proofs")
  separate_arguments(list UNIX_COMMAND "${KEEL_FLOAT_FLAGS}")
  set(${variable} ${list} PARENT_SCOPE)
endfunction()

# Stop when the compiler, with all flags that Keel's sources get, computes otherwise than the proofs.
function(keel_check_floats)
  keel_float_flags(flags)
  get_directory_property(around COMPILE_OPTIONS)
  string(GENEX_STRIP "${around}" around)
  set(CMAKE_C_STANDARD 99)
  set(CMAKE_C_EXTENSIONS OFF)
  set(CMAKE_TRY_COMPILE_CONFIGURATION Release)
  if(CMAKE_BUILD_TYPE)
    set(CMAKE_TRY_COMPILE_CONFIGURATION ${CMAKE_BUILD_TYPE})
  elseif(NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_C_FLAGS_RELEASE "") # Without a type of build, Keel's sources get no flags of one.
  endif()
  string(TOUPPER CMAKE_C_FLAGS_${CMAKE_TRY_COMPILE_CONFIGURATION} of_configuration)
  file(SHA256 ${KEEL_FLOATS_FOLDER}/float_check.c source)
  set(asked "${source} ${CMAKE_C_COMPILER} ${CMAKE_C_COMPILER_VERSION} ${CMAKE_C_FLAGS}"
            "${${of_configuration}} ${CMAKE_EXE_LINKER_FLAGS} ${around} ${flags}")
  if("${KEEL_FLOATS_CHECKED}" STREQUAL "${asked}")
    return()
  endif()

  set(place ${CMAKE_CURRENT_BINARY_DIR}/keel_float_check)
  unset(KEEL_FLOATS_COMPILE CACHE)
  unset(KEEL_FLOATS_RUN CACHE)
  if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY) # A board's program may need more to be linked.
    try_compile(KEEL_FLOATS_COMPILE ${place} ${KEEL_FLOATS_FOLDER}/float_check.c
                COMPILE_DEFINITIONS ${around} ${flags} OUTPUT_VARIABLE said)
    set(KEEL_FLOATS_RUN 0)
    set(how "compiled, and not run: what no macro tells, a run on the target does (docs/integration.md)")
  else()
    try_run(KEEL_FLOATS_RUN KEEL_FLOATS_COMPILE ${place} ${KEEL_FLOATS_FOLDER}/float_check.c
            COMPILE_DEFINITIONS ${around} ${flags} COMPILE_OUTPUT_VARIABLE said)
    set(how "run")
  endif()
  keel_judge_floats("${KEEL_FLOATS_COMPILE}" "${KEEL_FLOATS_RUN}" "${said}")
  message(STATUS "Keel: the check of the arithmetic was ${how}")
  set(KEEL_FLOATS_CHECKED "${asked}" CACHE INTERNAL "With what float_check.c was good")
endfunction()

# Say in words what float_check.c found. Flushing is the program's, not the compiler's: a linker that is
# called with -ffast-math does it, and none of Keel's flags can undo that.
function(keel_judge_floats compiled ended said)
  set(with "${CMAKE_C_COMPILER} with KEEL_FLOAT_FLAGS='${KEEL_FLOAT_FLAGS}'")
  list(LENGTH KEEL_FLOAT_QUESTIONS last)
  if(NOT compiled)
    message(FATAL_ERROR "Keel: the check of the arithmetic does not compile: ${with}\n${said}")
  elseif(ended EQUAL last)
    message(WARNING "Keel: a program of this project flushes subnormal numbers to zero, which the "
                    "proofs take not to happen (A-23 of specs/soundness.md)")
  elseif(NOT ended EQUAL 0)
    set(why "ends with ${ended}")
    if(ended MATCHES "^[1-9]$" AND ended LESS last)
      math(EXPR index "${ended} - 1")
      list(GET KEEL_FLOAT_QUESTIONS ${index} why)
    endif()
    message(FATAL_ERROR "Keel: not the arithmetic of the proofs (A-23 of specs/soundness.md): ${with} "
                        "${why}")
  endif()
endfunction()
