# find_package(turnwright) gives one target per domain, turnwright::<domain>.  Component
# program: what a planner needs; library: the shared library; development: static libraries,
# headers and that package.
include(CMakePackageConfigHelpers)

set(TURNWRIGHT_DATA_DIR ${CMAKE_INSTALL_DATADIR}/turnwright)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/turnwright)

install(TARGETS turnwright COMPONENT program)
install(TARGETS turnwright_library EXPORT turnwright
        LIBRARY COMPONENT library NAMELINK_COMPONENT development)
set(data schemas materials tools machines shops parts languages)
install(DIRECTORY ${data} DESTINATION ${TURNWRIGHT_DATA_DIR} COMPONENT program)
# What the Python package holds of it.
install(FILES $<TARGET_FILE:turnwright_library> RENAME libturnwright.so
        DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT python EXCLUDE_FROM_ALL)
install(DIRECTORY ${data} DESTINATION ${TURNWRIGHT_DATA_DIR} COMPONENT python
        EXCLUDE_FROM_ALL)

set(manual ${PROJECT_BINARY_DIR}/turnwright.1)
add_custom_command(OUTPUT ${manual} DEPENDS turnwright cmake/manpage.cmake
  COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:turnwright> -D OUT=${manual}
    -D VERSION=${PROJECT_VERSION} -P ${PROJECT_SOURCE_DIR}/cmake/manpage.cmake)
add_custom_target(manual ALL DEPENDS ${manual})
install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES packaging/turnwright.bash-completion RENAME turnwright
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        COMPONENT program)
configure_file(packaging/turnwright.service turnwright.service @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/turnwright.service DESTINATION lib/systemd/system
        COMPONENT program)
# The documentation as HTML, where `cmake --build build/release --target site` has made it.
add_custom_target(site COMMAND ${PROJECT_SOURCE_DIR}/scripts/site ${PROJECT_BINARY_DIR}/site)
install(DIRECTORY ${PROJECT_BINARY_DIR}/site/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/html
        COMPONENT program OPTIONAL)
install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

install(DIRECTORY include/turnwright DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT development)
file(RELATIVE_PATH prefix_from_pc /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(packaging/turnwright.pc.in turnwright.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/turnwright.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(EXPORT turnwright NAMESPACE turnwright:: FILE turnwrightTargets.cmake
        DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(cmake/turnwrightConfig.cmake.in turnwrightConfig.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS TURNWRIGHT_DATA_DIR)
write_basic_package_version_file(turnwrightConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/turnwrightConfig.cmake
              ${PROJECT_BINARY_DIR}/turnwrightConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT development)

# cpack makes turnwright_<version>_<architecture>.deb, libturnwright0_.. and
# libturnwright-dev_.. of the components.
# What is packed was built before: packing does not build the tests.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program library development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "Turnwright's makers <turnwright@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "certified plans of turned parts")
set(CPACK_PACKAGE_DESCRIPTION
  "From a turned part's drawing to the cheapest clamping, passes, speed, feed and depth\n"
  "that keep it inside every tolerance: command line, HTTP service and a page for planners.")
string(CONCAT CPACK_PACKAGE_DESCRIPTION ${CPACK_PACKAGE_DESCRIPTION})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME turnwright)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libturnwright${PROJECT_VERSION_MAJOR})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "turnwright (= ${PROJECT_VERSION})")  # the data
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libturnwright-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libturnwright${PROJECT_VERSION_MAJOR} (= ${PROJECT_VERSION})" libboost1.74-dev libeigen3-dev
  libfmt-dev libnlopt-dev libnlopt-cxx-dev libspdlog-dev libsqlite3-dev libsqlitecpp-dev libssl-dev
  libpugixml-dev libtbb-dev libvalijson-dev libzip-dev nlohmann-json3-dev prometheus-cpp-dev
  zipcmp zipmerge ziptool zlib1g-dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
