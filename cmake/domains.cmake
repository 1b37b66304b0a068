# What each domain uses, floor by floor (floors.txt).
tw_domain(base PRIVATE_LIBS Boost::headers Eigen3::Eigen fmt::fmt)
target_include_directories(turnwright_base PUBLIC  # base/say.hpp
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)

tw_domain(optimise DEPENDS base PRIVATE_LIBS NLopt::nlopt_cxx Eigen3::Eigen)
tw_domain(catalogue DEPENDS base PRIVATE_LIBS fmt::fmt)
tw_domain(part DEPENDS base PRIVATE_LIBS fmt::fmt)

tw_domain(cutting DEPENDS base catalogue optimise PRIVATE_LIBS Eigen3::Eigen fmt::fmt)
tw_domain(deflection DEPENDS base part PRIVATE_LIBS Eigen3::Eigen fmt::fmt
  TEST_DEPENDS document)
tw_domain(thermal DEPENDS base optimise PRIVATE_LIBS Eigen3::Eigen fmt::fmt)
tw_domain(gcode DEPENDS base catalogue PRIVATE_LIBS fmt::fmt)
tw_domain(toolpath DEPENDS base catalogue)
tw_domain(exchange DEPENDS base part PRIVATE_LIBS fmt::fmt Eigen3::Eigen
  TEST_DEPENDS document)
tw_domain(learning DEPENDS base PRIVATE_LIBS Boost::headers Eigen3::Eigen)
tw_domain(chatter DEPENDS base PRIVATE_LIBS Boost::headers Eigen3::Eigen fmt::fmt)
# Products of complex numbers without the search for infinities that C99's Annex G wants;
# sums keep their order.
target_compile_options(turnwright_chatter PRIVATE
  -fno-math-errno $<$<CXX_COMPILER_ID:GNU>:-fcx-limited-range>)
set_target_properties(turnwright_chatter PROPERTIES
  DISABLE_PRECOMPILE_HEADERS ON)  # other flags
# Some hundred eigenvalues take a minute with each step of Eigen's watched, in which nobody
# looks whether to leave.
if(TURNWRIGHT_FUZZ)
  set_source_files_properties(src/chatter/model/eigenvalues.cpp PROPERTIES
    COMPILE_OPTIONS -fno-sanitize=all)
endif()
tw_domain(multipass DEPENDS base optimise PRIVATE_LIBS Eigen3::Eigen)
if(BUILD_TESTING)
  target_link_libraries(multipass_test PRIVATE NLopt::nlopt_cxx)
  # Bonmin's optima stand beside ours where it is installed.
  find_library(BONMIN_LIBRARY bonmin)
  find_path(BONMIN_INCLUDE_DIR BonTMINLP.hpp PATH_SUFFIXES coin)
  if(BONMIN_LIBRARY AND BONMIN_INCLUDE_DIR)
    target_include_directories(multipass_test SYSTEM PRIVATE ${BONMIN_INCLUDE_DIR})
    target_compile_definitions(multipass_test PRIVATE HAVE_CSTDDEF)
    target_link_libraries(multipass_test PRIVATE ${BONMIN_LIBRARY} Cbc CoinUtils ipopt)
    set_source_files_properties(tests/multipass/bonmin_witness_test.cpp
      PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  else()
    set_source_files_properties(tests/multipass/bonmin_witness_test.cpp
      PROPERTIES HEADER_FILE_ONLY ON)
  endif()
endif()

tw_domain(volumetric DEPENDS base catalogue gcode
  PRIVATE_LIBS Eigen3::Eigen Boost::headers fmt::fmt
  TEST_DEPENDS document)
tw_domain(tolerance DEPENDS base part PRIVATE_LIBS fmt::fmt)

tw_domain(planning
  DEPENDS base part catalogue optimise deflection cutting volumetric chatter tolerance
  PRIVATE_LIBS Eigen3::Eigen fmt::fmt TBB::tbb
  TEST_DEPENDS document)
if(BUILD_TESTING)
  target_link_libraries(planning_test PRIVATE TBB::tbb)
endif()

# The plans of the reference parts, and of parts drawn at random, are made once.
string(JOIN ":" of_reference_parts "NcPrograms.OfEveryReferencePart*"
  "PlanAndProgram.OfReferenceParts*" "CutSimulation.OfReferenceParts*"
  "NcDialects.OfEveryReferencePart*" "NcGolden.*" "NcThroughLinuxCnc.OfReferenceParts*")
string(JOIN ":" of_drawn_parts "NcPrograms.OfRandomParts*" "PlanAndProgram.OfRandomParts*"
  "*CutSimulationOfRandomParts*" "NcPrograms.OfAwkwardParts*" "CutSimulation.OfAwkwardParts*")
tw_domain(nc DEPENDS base part catalogue cutting gcode toolpath planning
  PRIVATE_LIBS fmt::fmt
  TEST_DEPENDS document review
  TESTS_TOGETHER reference-parts ${of_reference_parts} drawn-parts ${of_drawn_parts})

tw_domain(review DEPENDS base part catalogue cutting gcode toolpath planning
  PRIVATE_LIBS fmt::fmt
  TEST_DEPENDS document nc
  TESTS_TOGETHER own-programs "ReviewOfOwnPrograms.*")

file(RELATIVE_PATH data_from_bin
  /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${CMAKE_INSTALL_DATADIR}/turnwright)
set_source_files_properties(src/document/catalogue/data_folder.cpp PROPERTIES COMPILE_DEFINITIONS
  "TURNWRIGHT_DATA_FROM_BIN=\"${data_from_bin}\";TURNWRIGHT_SOURCE_DATA=\"${PROJECT_SOURCE_DIR}\"")
tw_domain(document
  DEPENDS base catalogue part cutting deflection multipass thermal chatter gcode toolpath
    exchange learning volumetric tolerance planning nc review
  PUBLIC_LIBS nlohmann_json::nlohmann_json
  PRIVATE_LIBS fmt::fmt libzip::zip OpenSSL::Crypto pugixml::pugixml)
if(BUILD_TESTING)
  target_compile_definitions(document_test PRIVATE VALIJSON_USE_EXCEPTIONS=1)
endif()
tw_domain(report DEPENDS base part catalogue toolpath volumetric planning nc
  PUBLIC_LIBS nlohmann_json::nlohmann_json PRIVATE_LIBS fmt::fmt
  TEST_DEPENDS document)

set_source_files_properties(src/service/answer.cpp PROPERTIES COMPILE_DEFINITIONS
  "TURNWRIGHT_VERSION=\"${PROJECT_VERSION}\"")
tw_domain(service DEPENDS base catalogue planning document report gcode nc review
  PRIVATE_LIBS OpenSSL::Crypto fmt::fmt spdlog::spdlog ZLIB::ZLIB SQLiteCpp SQLite::SQLite3
    prometheus-cpp::core Boost::headers Threads::Threads TBB::tbb)
if(BUILD_TESTING)
  target_sources(service_test PRIVATE tests/document/schema_check.cpp)
  target_compile_definitions(service_test PRIVATE VALIJSON_USE_EXCEPTIONS=1)
endif()
# clang 14 has coroutines but does not say so, and cannot sanitize them.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15)
  target_compile_definitions(turnwright_service PUBLIC __cpp_impl_coroutine=201902L
    BOOST_ASIO_HAS_CO_AWAIT BOOST_ASIO_HAS_STD_COROUTINE)
  set_source_files_properties(src/service/http/arrival.cpp src/service/http/connection.cpp
    src/service/http/server.cpp PROPERTIES COMPILE_OPTIONS -fno-sanitize=all SKIP_PRECOMPILE_HEADERS ON)
endif()

# Switches over kinds of tolerance and over checks name every one of them.
foreach(domain IN ITEMS part tolerance planning nc document)
  target_compile_options(turnwright_${domain} PRIVATE -Wswitch-enum)
endforeach()

include(cmake/page.cmake)

file(GLOB app_sources CONFIGURE_DEPENDS src/app/*.cpp)
add_executable(turnwright ${app_sources})
target_link_libraries(turnwright PRIVATE turnwright::service tw_dev CLI11::CLI11
  turnwright_xlsxwriter)

# libturnwright, the request table as C functions.
file(RELATIVE_PATH data_from_lib
  /prefix/${CMAKE_INSTALL_LIBDIR} /prefix/${CMAKE_INSTALL_DATADIR}/turnwright)
set_source_files_properties(src/library/data_beside.cpp PROPERTIES COMPILE_DEFINITIONS
  "TURNWRIGHT_DATA_FROM_LIB=\"${data_from_lib}\"")
file(GLOB library_sources CONFIGURE_DEPENDS src/library/*.cpp)
set(exports ${PROJECT_SOURCE_DIR}/src/library/exports.map)
add_library(turnwright_library SHARED ${library_sources})
add_library(turnwright::library ALIAS turnwright_library)
set_target_properties(turnwright_library PROPERTIES OUTPUT_NAME turnwright EXPORT_NAME library
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR} LINK_DEPENDS ${exports}
  UNITY_BUILD OFF)
tw_for_shared_library(turnwright_library)
target_include_directories(turnwright_library PUBLIC
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
target_link_libraries(turnwright_library PRIVATE turnwright::service tw_dev ${CMAKE_DL_LIBS})
target_link_options(turnwright_library PRIVATE LINKER:--as-needed
  LINKER:--version-script=${exports})
tw_reuse_headers(turnwright_library tw_headers)

if(BUILD_TESTING)
  add_executable(library_test tests/library/library_test.c)
  set_target_properties(library_test PROPERTIES UNITY_BUILD OFF)
  target_link_libraries(library_test PRIVATE turnwright::library tw_dev Threads::Threads)
  add_test(NAME library.from_c COMMAND library_test ${PROJECT_SOURCE_DIR} ${PROJECT_VERSION})
  add_test(NAME library.symbols COMMAND ${CMAKE_NM} --dynamic --defined-only
    $<TARGET_FILE:turnwright_library>)
  set_tests_properties(library.symbols PROPERTIES PASS_REGULAR_EXPRESSION "T turnwright_answer"
    FAIL_REGULAR_EXPRESSION " [A-Z] [^tT]| T [^t]| T t[^u]")

  file(GLOB app_tests CONFIGURE_DEPENDS tests/app/*_test.cpp)
  add_executable(app_test ${app_tests})
  target_link_libraries(app_test PRIVATE turnwright::service tw_dev GTest::gtest_main
    libzip::zip pugixml::pugixml)
  string(REPLACE ";" "+" sanitizers "${TURNWRIGHT_SANITIZE}")
  target_compile_definitions(app_test PRIVATE TURNWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    TURNWRIGHT_PROGRAM="$<TARGET_FILE:turnwright>" TURNWRIGHT_FAULTS="$<TARGET_FILE:faults>"
    TURNWRIGHT_SANITIZE="${sanitizers}")
  add_dependencies(app_test turnwright faults)
  add_library(faults MODULE tests/app/faults.cpp)  # loaded before the C library
  target_link_libraries(faults PRIVATE tw_dev ${CMAKE_DL_LIBS})
  tw_quick_to_build(app_test)
  gtest_discover_tests(app_test TEST_PREFIX app. PROPERTIES TIMEOUT 600)

  # The plans of parts/ against a global search that shares only the physics with planning;
  # reference_search writes the stored costs, the test runs a short form of it.
  add_library(reference_search_lib STATIC EXCLUDE_FROM_ALL
    tests/reference_parts/global_search.cpp tests/reference_parts/surface_search.cpp)
  target_link_libraries(reference_search_lib PUBLIC turnwright::document
    PRIVATE tw_dev NLopt::nlopt_cxx)
  add_executable(reference_search EXCLUDE_FROM_ALL tests/reference_parts/reference_search.cpp)
  target_link_libraries(reference_search PRIVATE reference_search_lib tw_dev)
  add_executable(reference_parts_test
    tests/reference_parts/certificate_test.cpp tests/reference_parts/reference_parts_test.cpp)
  target_link_libraries(reference_parts_test PRIVATE reference_search_lib tw_dev
    GTest::gtest_main)
  foreach(program IN ITEMS reference_search reference_parts_test)
    target_compile_definitions(${program} PRIVATE
      TURNWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  endforeach()
  tw_quick_to_build(reference_parts_test)
  gtest_discover_tests(reference_parts_test TEST_PREFIX reference_parts.
    PROPERTIES TIMEOUT 600)

  # What holds of any part, tried on random ones: here a few, more by RC_PARAMS.
  add_executable(properties_test tests/properties/plan_properties_test.cpp
    tests/properties/remedies_test.cpp)
  target_link_libraries(properties_test PRIVATE turnwright::document rapidcheck tw_dev
    GTest::gtest_main)
  target_compile_definitions(properties_test PRIVATE
    TURNWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  tw_quick_to_build(properties_test)
  gtest_discover_tests(properties_test TEST_PREFIX properties.
    PROPERTIES TIMEOUT 600 ENVIRONMENT "RC_PARAMS=seed=1 max_success=25")

  # The models beside measured cuts.
  add_executable(reality_test tests/reality/reality_test.cpp)
  target_link_libraries(reality_test PRIVATE turnwright::document tw_dev GTest::gtest_main)
  target_compile_definitions(reality_test PRIVATE
    TURNWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  tw_quick_to_build(reality_test)
  gtest_discover_tests(reality_test TEST_PREFIX reality. PROPERTIES TIMEOUT 600)
endif()

# Unity builds (the release preset) compile a folder as one file.  Apart stay pictures whose
# sheets have measures of one name; requests that speak in the names of one domain where
# others speak in those of another; coroutines, for g++ 12 takes the frames of two files'
# coroutines for unused functions; and a replaced `new`, which it takes for a mismatch beside
# what uses it.
set_source_files_properties(src/report/picture/drawing.cpp
  src/report/picture/milled_drawing.cpp src/report/picture/path_drawing.cpp
  src/report/picture/stability_chart.cpp src/report/picture/window_drawing.cpp
  src/document/requests/chuck.cpp src/document/requests/deflection.cpp
  src/document/requests/overhang.cpp
  src/document/requests/stability.cpp src/document/requests/stability_request.cpp
  src/service/http/arrival.cpp src/service/http/connection.cpp
  tests/service/little_memory.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
if(BUILD_TESTING)
  set_target_properties(reference_parts_test PROPERTIES UNITY_BUILD OFF)
endif()
