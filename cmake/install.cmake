# find_package(turnwright) gives one target per domain, turnwright::<domain>.
include(CMakePackageConfigHelpers)

set(TURNWRIGHT_DATA_DIR ${CMAKE_INSTALL_DATADIR}/turnwright)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/turnwright)

install(TARGETS turnwright)
install(DIRECTORY include/turnwright DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY schemas materials tools machines parts DESTINATION ${TURNWRIGHT_DATA_DIR})
install(EXPORT turnwright NAMESPACE turnwright:: FILE turnwrightTargets.cmake
        DESTINATION ${package_dir})
configure_package_config_file(cmake/turnwrightConfig.cmake.in turnwrightConfig.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS TURNWRIGHT_DATA_DIR)
write_basic_package_version_file(turnwrightConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/turnwrightConfig.cmake
              ${PROJECT_BINARY_DIR}/turnwrightConfigVersion.cmake
        DESTINATION ${package_dir})
