# SPDX-License-Identifier: Apache-2.0
# What CMakeLists.txt is made of.

set(KEEL_ROOT ${CMAKE_CURRENT_LIST_DIR}/..)
include(${CMAKE_CURRENT_LIST_DIR}/KeelFloats.cmake)

# The number that a header of Keel defines as a macro.
function(keel_defined variable header name)
  file(STRINGS ${KEEL_ROOT}/include/keel/${header} line REGEX "^#define ${name} [0-9]+u?$")
  if(NOT line MATCHES "([0-9]+)u?$")
    message(FATAL_ERROR "include/keel/${header} does not define ${name} as a number")
  endif()
  set(${variable} ${CMAKE_MATCH_1} PARENT_SCOPE)
endfunction()

# The version, of which version.h is the only source.
function(keel_read_version variable)
  foreach(part MAJOR MINOR PATCH)
    keel_defined(number version.h KEEL_VERSION_${part})
    list(APPEND numbers ${number})
  endforeach()
  list(JOIN numbers . version)
  set(${variable} ${version} PARENT_SCOPE)
endfunction()

# A number that the integrator may choose; unless chosen it is the header's own.
function(keel_number name header lowest highest text)
  if(NOT DEFINED ${name})
    keel_defined(default ${header} ${name})
    set(${name} ${default} CACHE STRING "${text}: ${lowest} to ${highest}")
  endif()
  if(NOT "${${name}}" MATCHES "^[1-9][0-9]*$" OR ${name} LESS lowest OR ${name} GREATER highest)
    message(FATAL_ERROR "${name} is '${${name}}', not a number from ${lowest} to ${highest}")
  endif()
endfunction()

# One layer as a static library, with the name Keel::<layer> for users.
function(keel_layer layer)
  file(GLOB sources CONFIGURE_DEPENDS ${KEEL_ROOT}/src/${layer}/*.c)
  add_library(keel_${layer} STATIC ${sources})
  add_library(Keel::${layer} ALIAS keel_${layer})
  set_target_properties(keel_${layer} PROPERTIES
    EXPORT_NAME ${layer} C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
  keel_float_flags(flags)
  target_compile_options(keel_${layer} PRIVATE ${flags})
  target_include_directories(keel_${layer} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
endfunction()
