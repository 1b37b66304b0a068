# Floor 1
tw_domain(base SOURCES errors.cpp least_squares.cpp PRIVATE_LIBS Eigen3::Eigen
          TESTS interval_test.cpp least_squares_test.cpp log_dual_test.cpp random_test.cpp
                root_test.cpp)
# Floor 2
tw_domain(optimise SOURCES local.cpp nnls.cpp branch_and_bound.cpp posynomial.cpp
          relaxation_search.cpp
  DEPENDS base PRIVATE_LIBS NLopt::nlopt_cxx Eigen3::Eigen
  TESTS local_test.cpp nnls_test.cpp branch_and_bound_test.cpp posynomial_test.cpp
        relaxation_search_test.cpp)
tw_domain(catalogue SOURCES chip_window.cpp iso1832.cpp DEPENDS base
          TESTS chip_window_test.cpp iso1832_test.cpp)
tw_domain(part SOURCES drawing.cpp cut.cpp shaft.cpp DEPENDS base
          TESTS drawing_test.cpp cut_test.cpp shaft_test.cpp)
# Floor 3
tw_domain(cutting SOURCES cut.cpp fixed.cpp material_fit.cpp milled.cpp spindle.cpp
  DEPENDS base catalogue optimise PRIVATE_LIBS Eigen3::Eigen
  TESTS cut_test.cpp fixed_test.cpp material_fit_test.cpp milled_test.cpp spindle_test.cpp)
tw_domain(deflection SOURCES beam.cpp beam_piece.cpp boring_bar.cpp chuck_identification.cpp
                             deviation_graph.cpp envelope.cpp
                             copying.cpp face.cpp feedback.cpp ovality.cpp response.cpp
                             rest.cpp ring.cpp shop_errors.cpp shoulder.cpp thrust.cpp
                             workpiece.cpp
          DEPENDS base part PRIVATE_LIBS Eigen3::Eigen fmt::fmt
          TESTS beam_test.cpp boring_bar_test.cpp chuck_identification_test.cpp
                deviation_graph_test.cpp
                envelope_test.cpp face_test.cpp
                feedback_test.cpp copying_test.cpp ovality_test.cpp response_test.cpp
                rest_test.cpp ring_test.cpp seed_test.cpp shop_errors_test.cpp
                shoulder_test.cpp thrust_test.cpp workpiece_test.cpp)
tw_domain(thermal SOURCES batch.cpp lag_fit.cpp lag_model.cpp network.cpp response.cpp
  DEPENDS base optimise PRIVATE_LIBS Eigen3::Eigen
  TESTS batch_test.cpp lag_fit_test.cpp lag_model_test.cpp network_test.cpp)
tw_domain(volumetric SOURCES agreement.cpp axis_table.cpp ball_bar.cpp compensation.cpp
          kinematics.cpp lathe_part.cpp minimum_zone.cpp nc_program.cpp nc_writer.cpp samba.cpp
  DEPENDS base catalogue PRIVATE_LIBS Eigen3::Eigen Boost::headers fmt::fmt
  TESTS agreement_test.cpp axis_table_test.cpp ball_bar_test.cpp compensation_test.cpp
        kinematics_test.cpp lathe_part_test.cpp linuxcnc_test.cpp minimum_zone_test.cpp samba_test.cpp)
tw_domain(milling SOURCES system.cpp free_vibration.cpp quadrature.cpp stretches.cpp propagator.cpp
                          series.cpp characteristic.cpp patch.cpp unit_circle.cpp tracking.cpp
                          chatter_frequency.cpp limits.cpp lobes.cpp uncertain.cpp multipliers.cpp collocation.cpp
                          samples.cpp spectrum.cpp semi_discretisation.cpp tfea.cpp
                         contact.cpp delay_map.cpp sheet.cpp turning.cpp cutter.cpp
                          simulation.cpp scanned_limits.cpp frf.cpp
          DEPENDS base PRIVATE_LIBS Boost::headers Eigen3::Eigen
          TESTS limits_test.cpp lobes_test.cpp uncertain_test.cpp multipliers_test.cpp accuracy_test.cpp checks_test.cpp
                cutter_test.cpp turning_test.cpp frf_test.cpp)
# Products of complex numbers without the search for infinities that C99's Annex G wants;
# sums keep their order.
target_compile_options(turnwright_milling PRIVATE
                       -fno-math-errno $<$<CXX_COMPILER_ID:GNU>:-fcx-limited-range>)
set_target_properties(turnwright_milling PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)  # other flags
# Some hundred eigenvalues take a minute with each step of Eigen's watched, in which nobody
# looks whether to leave.
if(TURNWRIGHT_FUZZ)
  set_source_files_properties(src/milling/spectrum.cpp PROPERTIES COMPILE_OPTIONS -fno-sanitize=all)
endif()
tw_domain(multipass SOURCES problem.cpp rows.cpp relaxation.cpp conflict.cpp local_problem.cpp
          optimum.cpp single_pass.cpp
  DEPENDS base optimise PRIVATE_LIBS Eigen3::Eigen
  TESTS optimum_test.cpp certificate_test.cpp conflict_test.cpp single_pass_test.cpp)
if(BUILD_TESTING)
  target_link_libraries(multipass_test PRIVATE NLopt::nlopt_cxx)
endif()
# Floor 4
tw_domain(tolerance SOURCES iso286.cpp general.cpp piecewise.cpp acceptance.cpp budget.cpp
  DEPENDS base part PRIVATE_LIBS fmt::fmt
  TESTS iso286_test.cpp general_test.cpp piecewise_test.cpp acceptance_test.cpp
        budget_test.cpp)
# Floor 5
tw_domain(planning SOURCES names.cpp setup_geometry.cpp usable.cpp attempt.cpp allowance.cpp machine_share.cpp demand.cpp
          chain.cpp chebyshev.cpp bar_tip.cpp feature.cpp chatter.cpp
          recipe_model.cpp exchange.cpp feature_optimiser.cpp recipes.cpp fixed.cpp milled_geometry.cpp milled_places.cpp milled_search.cpp milled_choice.cpp milled.cpp setup_planner.cpp
          describe.cpp window.cpp
          tolerance_results.cpp limits.cpp first_order.cpp prices.cpp openable.cpp feasibility.cpp
          conflict_sets.cpp openings.cpp conflicts.cpp obstacle.cpp remedies.cpp outcome.cpp
          planned.cpp robust.cpp pareto.cpp what_if.cpp plan.cpp predict.cpp
          DEPENDS base part catalogue optimise deflection cutting volumetric milling tolerance
          PRIVATE_LIBS Eigen3::Eigen fmt::fmt
          TESTS allowance_test.cpp chebyshev_test.cpp machine_share_test.cpp chatter_test.cpp chip_breaker_test.cpp
                recipe_model_test.cpp window_test.cpp plan_test.cpp
                prices_test.cpp conflicts_test.cpp fixed_test.cpp milled_search_test.cpp milled_test.cpp
          TEST_DEPENDS document)
# Floor 6
tw_domain(nc SOURCES path.cpp site.cpp contour.cpp turning.cpp fixed.cpp program.cpp text.cpp
          DEPENDS base part catalogue cutting planning PRIVATE_LIBS fmt::fmt
          TESTS path_test.cpp program_test.cpp linuxcnc_test.cpp TEST_DEPENDS document)
# Floor 7
file(RELATIVE_PATH data_from_bin /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${CMAKE_INSTALL_DATADIR}/turnwright)
set_source_files_properties(src/document/data_folder.cpp PROPERTIES COMPILE_DEFINITIONS
  "TURNWRIGHT_DATA_FROM_BIN=\"${data_from_bin}\";TURNWRIGHT_SOURCE_DATA=\"${PROJECT_SOURCE_DIR}\"")
tw_domain(document SOURCES parse.cpp reader.cpp file.cpp finite.cpp fields.cpp material.cpp tool.cpp fixed_tool.cpp milling_cutter.cpp lathe.cpp
          catalogue.cpp data_folder.cpp references.cpp elements.cpp cuts.cpp stock.cpp bores.cpp tolerances.cpp
          setups.cpp operations.cpp milling.cpp what_if.cpp part_plan.cpp process_plan.cpp drawing.cpp acceptance.cpp budget.cpp
          deflection.cpp shaft_fields.cpp milled_shaft.cpp csv.cpp chuck.cpp thermal.cpp multipass.cpp calibrate_material.cpp frequency_response.cpp stability_request.cpp stability.cpp
          machine_fields.cpp calibrated_machine.cpp turned.cpp geometry.cpp ball_bar.cpp samba.cpp compare.cpp compensate.cpp nc.cpp
          DEPENDS base catalogue part cutting deflection multipass thermal milling volumetric tolerance planning nc PUBLIC_LIBS nlohmann_json::nlohmann_json PRIVATE_LIBS fmt::fmt
          TESTS schema_check.cpp acceptance_test.cpp chuck_test.cpp csv_test.cpp thermal_test.cpp stability_test.cpp deflection_test.cpp parse_test.cpp reader_test.cpp catalogue_test.cpp calibrate_material_test.cpp multipass_test.cpp
                malformed_test.cpp milling_test.cpp machine_errors_test.cpp geometry_test.cpp ball_bar_test.cpp samba_test.cpp compare_test.cpp compensate_test.cpp nc_test.cpp schema_test.cpp part_plan_test.cpp process_plan_test.cpp drawing_test.cpp)
if(BUILD_TESTING)
  target_compile_definitions(document_test PRIVATE VALIJSON_USE_EXCEPTIONS=1)
endif()
# The plans of parts/ against a global search that shares only the physics with planning;
# reference_search writes the stored costs, the test runs a short form of it.
if(BUILD_TESTING)
  add_library(reference_search_lib STATIC EXCLUDE_FROM_ALL
    tests/reference_parts/global_search.cpp tests/reference_parts/surface_search.cpp)
  target_link_libraries(reference_search_lib PUBLIC turnwright::document
    PRIVATE tw_dev NLopt::nlopt_cxx)
  add_executable(reference_search EXCLUDE_FROM_ALL tests/reference_parts/reference_search.cpp)
  target_link_libraries(reference_search PRIVATE reference_search_lib tw_dev)
  add_executable(reference_parts_test tests/reference_parts/reference_parts_test.cpp
    tests/reference_parts/certificate_test.cpp)
  target_link_libraries(reference_parts_test PRIVATE reference_search_lib tw_dev
    GTest::gtest_main)
  foreach(program IN ITEMS reference_search reference_parts_test)
    target_compile_definitions(${program} PRIVATE
      TURNWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  endforeach()
  tw_quick_to_build(reference_parts_test)
  gtest_discover_tests(reference_parts_test TEST_PREFIX reference_parts.
    PROPERTIES TIMEOUT 600)
endif()
# What holds of any part, tried on random ones: here a few, more by RC_PARAMS.
if(BUILD_TESTING)
  add_executable(properties_test tests/properties/plan_properties_test.cpp)
  target_link_libraries(properties_test PRIVATE turnwright::document rapidcheck tw_dev
    GTest::gtest_main)
  target_compile_definitions(properties_test PRIVATE
    TURNWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  tw_quick_to_build(properties_test)
  gtest_discover_tests(properties_test TEST_PREFIX properties.
    PROPERTIES TIMEOUT 600 ENVIRONMENT "RC_PARAMS=seed=1 max_success=25")
endif()
tw_domain(report SOURCES text.cpp chuck_text.cpp thermal_text.cpp multipass_text.cpp material_text.cpp common.cpp plan_words.cpp setup_words.cpp setups.cpp proof.cpp fields.cpp layout.cpp
                           drawing.cpp budget_drawing.cpp window_drawing.cpp milled_drawing.cpp stability_chart.cpp contour.cpp stack.cpp svg.cpp
                           chart.cpp volumetric_drawing.cpp html_parts.cpp html.cpp stability_html.cpp
          DEPENDS base part volumetric planning PUBLIC_LIBS nlohmann_json::nlohmann_json PRIVATE_LIBS fmt::fmt
          TESTS text_test.cpp chuck_text_test.cpp thermal_text_test.cpp multipass_text_test.cpp material_text_test.cpp drawing_test.cpp budget_drawing_test.cpp
                window_drawing_test.cpp milled_drawing_test.cpp stability_chart_test.cpp volumetric_drawing_test.cpp html_test.cpp stability_html_test.cpp)
# Floor 8, 9
set_source_files_properties(src/service/answer.cpp PROPERTIES COMPILE_DEFINITIONS
  "TURNWRIGHT_VERSION=\"${PROJECT_VERSION}\"")
tw_domain(service SOURCES requests.cpp answer.cpp digest.cpp listing.cpp output.cpp
            batch/line.cpp batch/fatal_lines.cpp batch/job_store.cpp batch/batches.cpp
            batch/input.cpp batch/chunk.cpp batch/folder.cpp batch/known_answers.cpp batch/runner.cpp batch/slurm.cpp
            http/message.cpp http/openapi.cpp http/api.cpp http/host.cpp http/target.cpp http/keys.cpp http/metrics.cpp http/log.cpp
            http/connection.cpp http/server.cpp http/page.cpp
          DEPENDS base catalogue planning document report nc
          PRIVATE_LIBS OpenSSL::Crypto fmt::fmt spdlog::spdlog ZLIB::ZLIB SQLiteCpp
            SQLite::SQLite3 prometheus-cpp::core Boost::headers Threads::Threads TBB::tbb
          TESTS answer_test.cpp digest_test.cpp listing_test.cpp http_api_test.cpp
                malformed_requests_test.cpp
                batch_input_test.cpp batch_chunk_test.cpp batch_folder_test.cpp known_answers_test.cpp
                job_store_test.cpp little_memory.cpp server_test.cpp page_test.cpp)
# clang 14 has coroutines but does not say so, and cannot sanitize them.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15)
  target_compile_definitions(turnwright_service PUBLIC __cpp_impl_coroutine=201902L
    BOOST_ASIO_HAS_CO_AWAIT BOOST_ASIO_HAS_STD_COROUTINE)
  set_source_files_properties(src/service/http/connection.cpp src/service/http/server.cpp
    PROPERTIES COMPILE_OPTIONS -fno-sanitize=all SKIP_PRECOMPILE_HEADERS ON)
endif()
include(cmake/page.cmake)
add_executable(turnwright src/app/main.cpp src/app/batch.cpp src/app/progress_line.cpp src/app/serve.cpp)
target_link_libraries(turnwright PRIVATE turnwright::service tw_dev CLI11::CLI11)
if(BUILD_TESTING)
  add_executable(app_test tests/app/command_line_test.cpp tests/app/batch_test.cpp
    tests/app/killed_server_test.cpp
    tests/app/options_test.cpp tests/app/programs_test.cpp tests/app/readme_test.cpp)
  target_link_libraries(app_test PRIVATE turnwright::service tw_dev GTest::gtest_main)
  target_compile_definitions(app_test PRIVATE TURNWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    TURNWRIGHT_PROGRAM="$<TARGET_FILE:turnwright>" TURNWRIGHT_FAULTS="$<TARGET_FILE:faults>"
    TURNWRIGHT_SANITIZE="${TURNWRIGHT_SANITIZE}")
  add_dependencies(app_test turnwright faults)
  add_library(faults MODULE tests/app/faults.cpp)  # loaded before the C library
  target_link_libraries(faults PRIVATE tw_dev ${CMAKE_DL_LIBS})
  tw_quick_to_build(app_test)
  gtest_discover_tests(app_test TEST_PREFIX app. PROPERTIES TIMEOUT 600)
endif()
