# SPDX-License-Identifier: Apache-2.0
# `cmake --install`: headers, libraries, the licence, what find_package(Keel) reads, and keel.pc for pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(KEEL_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Keel)

install(TARGETS keel_rtos keel_middleware keel_flight EXPORT KeelTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/keel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/keel)
install(EXPORT KeelTargets NAMESPACE Keel:: DESTINATION ${KEEL_PACKAGE_DIR})

configure_package_config_file(
  cmake/KeelConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/KeelConfig.cmake
  INSTALL_DESTINATION ${KEEL_PACKAGE_DIR})
# Before 1.0.0 a minor version may change the interface.
write_basic_package_version_file(
  ${CMAKE_CURRENT_BINARY_DIR}/KeelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/KeelConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/KeelConfigVersion.cmake
        DESTINATION ${KEEL_PACKAGE_DIR})

# From the folder of keel.pc back to the prefix, so that an installed tree can be moved.
file(RELATIVE_PATH KEEL_PREFIX_FROM_PC
     ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/keel.pc.in ${CMAKE_CURRENT_BINARY_DIR}/keel.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/keel.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
