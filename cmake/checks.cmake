# Checks of the repository itself; each is a CMake script, so that it needs nothing more.
set(architecture ${PROJECT_SOURCE_DIR}/tests/architecture)
add_test(NAME architecture.floors
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -P ${architecture}/floors.cmake)
add_test(NAME architecture.layout
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -P ${architecture}/layout.cmake)
add_test(NAME architecture.refuses_layout
  COMMAND ${CMAKE_COMMAND} -D ROOT=${architecture}/layout -P ${architecture}/layout.cmake)
set_tests_properties(architecture.refuses_layout PROPERTIES PASS_REGULAR_EXPRESSION
  "src/planning stands above src/tolerance.*src/nc is missing")
add_test(NAME architecture.circles
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -P ${architecture}/circles.cmake)
add_test(NAME architecture.refuses_circle
  COMMAND ${CMAKE_COMMAND} -D ROOT=${architecture}/circle -P ${architecture}/circles.cmake)
set_tests_properties(architecture.refuses_circle PROPERTIES
  PASS_REGULAR_EXPRESSION "between two:\n  part/a\n  part/b\n  part/lower\n  part/upper\n")
add_test(NAME architecture.readers
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -P ${architecture}/readers.cmake)
add_test(NAME architecture.refuses_reader
  COMMAND ${CMAKE_COMMAND} -D ROOT=${architecture}/reader -P ${architecture}/readers.cmake)
set_tests_properties(architecture.refuses_reader PROPERTIES PASS_REGULAR_EXPRESSION
  "document/b.hpp: includes \"turnwright/planning/prepared_part.hpp\"")
# Reads a part document, linked with the readers alone: no planning, no tool paths.
add_executable(part_reader ${architecture}/part_reader.cpp src/planning/values/names.cpp)
target_link_libraries(part_reader PRIVATE tw_dev
  $<TARGET_FILE:turnwright_document> turnwright::tolerance turnwright::deflection
  turnwright::volumetric turnwright::catalogue nlohmann_json::nlohmann_json fmt::fmt)
target_include_directories(part_reader PRIVATE src include)
set_target_properties(part_reader PROPERTIES UNITY_BUILD OFF)
add_dependencies(part_reader turnwright_document)
add_test(NAME architecture.part_reader COMMAND part_reader ${PROJECT_SOURCE_DIR}
  ${PROJECT_SOURCE_DIR}/parts/pump-shaft.json)
set_tests_properties(architecture.part_reader PROPERTIES
  PASS_REGULAR_EXPRESSION "^4 elements, 2 setups")
foreach(house IN ITEMS upwards sideways solver unknown private)
  add_test(NAME architecture.refuses_${house}
    COMMAND ${CMAKE_COMMAND} -D ROOT=${architecture}/${house} -P ${architecture}/floors.cmake)
endforeach()
set_tests_properties(architecture.refuses_upwards PROPERTIES
  PASS_REGULAR_EXPRESSION "src/part/a.cpp: part \\(floor 2\\) includes planning \\(floor 5\\)")
set_tests_properties(architecture.refuses_sideways PROPERTIES PASS_REGULAR_EXPRESSION
  "include/turnwright/cutting/a.hpp: cutting \\(floor 3\\) includes chatter \\(floor 3\\)")
set_tests_properties(architecture.refuses_solver PROPERTIES PASS_REGULAR_EXPRESSION
  "src/deflection/a.cpp: deflection must not include <nlohmann/json.hpp>")
set_tests_properties(architecture.refuses_unknown PROPERTIES PASS_REGULAR_EXPRESSION
  "src/part/a.cpp: \"turnwright/elsewhere/b.hpp\" is in no floor")

set_tests_properties(architecture.refuses_private PROPERTIES PASS_REGULAR_EXPRESSION
  "include/turnwright/part/a.hpp: is installed, \"part/room/b.hpp\" is not")

add_test(NAME format.clang-format COMMAND ${CMAKE_COMMAND}
  -D ROOT=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/tests/format/clang-format.cmake)
set_tests_properties(format.clang-format PROPERTIES
  LABELS format SKIP_REGULAR_EXPRESSION "SKIPPED")

add_test(NAME install.find_package COMMAND ${CMAKE_COMMAND}
  -D BUILD_DIR=${PROJECT_BINARY_DIR} -D WORK_DIR=${PROJECT_BINARY_DIR}/install-test
  -D EXAMPLES=${PROJECT_SOURCE_DIR}/examples -D GENERATOR=${CMAKE_GENERATOR}
  -D SANITIZE=$<JOIN:${TURNWRIGHT_SANITIZE},$<COMMA>>
  -P ${PROJECT_SOURCE_DIR}/tests/install/run.cmake)
set_tests_properties(install.find_package PROPERTIES TIMEOUT 600)

foreach(step IN ITEMS build check unit round shop language builder odd)
  set(when)
  if(step MATCHES "^(builder|odd)$")
    set(when CONFIGURATIONS slow)
  endif()
  add_test(NAME page.${step} ${when} COMMAND ${CMAKE_COMMAND} -D STEP=${step}
    -D WEB=${PROJECT_SOURCE_DIR}/web -D WORK_DIR=${PROJECT_BINARY_DIR}/page/web
    -D PROGRAM=$<TARGET_FILE:turnwright> -P ${PROJECT_SOURCE_DIR}/web/test/run.cmake)
  set_tests_properties(page.${step} PROPERTIES LABELS page TIMEOUT 900
    SKIP_REGULAR_EXPRESSION "SKIPPED" RESOURCE_LOCK page)
endforeach()
set_tests_properties(page.round page.language PROPERTIES COST 100)  # seconds: begun first
set_tests_properties(page.builder page.odd PROPERTIES LABELS "page;slow")

add_test(NAME service.mcp COMMAND ${CMAKE_COMMAND}
  -D SOURCE=${PROJECT_SOURCE_DIR}/tests/service/mcp -D WORK_DIR=${PROJECT_BINARY_DIR}/mcp-test
  -D PROGRAM=$<TARGET_FILE:turnwright> -D DATA=${PROJECT_SOURCE_DIR}
  -P ${PROJECT_SOURCE_DIR}/tests/service/mcp/run.cmake)
set_tests_properties(service.mcp PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED" TIMEOUT 300)

add_test(NAME service.examples COMMAND bash
  ${PROJECT_SOURCE_DIR}/tests/service/examples.bash $<TARGET_FILE:turnwright>
  ${PROJECT_SOURCE_DIR})
set_tests_properties(service.examples PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED")
if(NOT TURNWRIGHT_SANITIZE)  # which takes terabytes of address space
  add_test(NAME service.attacks COMMAND ${PROJECT_SOURCE_DIR}/tests/service/attacks.py
    $<TARGET_FILE:turnwright> ${PROJECT_SOURCE_DIR} 50 50)
  set_tests_properties(service.attacks PROPERTIES TIMEOUT 600 COST 70)
endif()

# The Python package, made into a wheel and installed in a fresh environment.  A library with
# sanitizers cannot be loaded into a Python without them.
if(NOT TURNWRIGHT_SANITIZE)
  set(python ${PROJECT_SOURCE_DIR}/tests/python)
  set(python_work ${PROJECT_BINARY_DIR}/python-test)
  add_test(NAME python.wheel COMMAND bash ${python}/wheel.bash ${PROJECT_SOURCE_DIR}/python
    ${PROJECT_BINARY_DIR} ${python_work})
  set_tests_properties(python.wheel PROPERTIES FIXTURES_SETUP python)
  file(GLOB notebooks CONFIGURE_DEPENDS examples/notebooks/*.ipynb)
  add_test(NAME python.capabilities COMMAND bash ${python}/inside.bash ${python_work}
    ${python}/capabilities_test.py)
  add_test(NAME python.notebooks COMMAND bash ${python}/inside.bash ${python_work}
    ${python}/notebook_test.py ${notebooks})
  add_test(NAME python.load CONFIGURATIONS slow COMMAND bash ${python}/inside.bash
    ${python_work} ${python}/load_test.py)
  set(inside python.capabilities python.notebooks python.load)
  set_tests_properties(${inside} PROPERTIES FIXTURES_REQUIRED python
    ENVIRONMENT TURNWRIGHT_PROGRAM=$<TARGET_FILE:turnwright>)
  set_tests_properties(python.wheel ${inside} PROPERTIES LABELS python TIMEOUT 600
    SKIP_REGULAR_EXPRESSION "SKIPPED")
  set_tests_properties(python.load PROPERTIES LABELS "python;slow" TIMEOUT 1800)
endif()

# The documentation as a folder: no broken link, and search works without a server.
add_test(NAME docs.site COMMAND bash
  ${PROJECT_SOURCE_DIR}/tests/package/site.bash ${PROJECT_SOURCE_DIR}/scripts/site
  ${PROJECT_BINARY_DIR}/site-test)
set_tests_properties(docs.site PROPERTIES TIMEOUT 600
  SKIP_REGULAR_EXPRESSION "SKIPPED")
add_test(NAME docs.quotes COMMAND ${PROJECT_SOURCE_DIR}/scripts/quote --check)
add_test(NAME guide.commands COMMAND bash
  ${PROJECT_SOURCE_DIR}/tests/app/guide.bash $<TARGET_FILE:turnwright>
  ${PROJECT_SOURCE_DIR} guide 6 11)
add_test(NAME learn.commands COMMAND bash
  ${PROJECT_SOURCE_DIR}/tests/app/guide.bash $<TARGET_FILE:turnwright>
  ${PROJECT_SOURCE_DIR} learn 4 20)
add_test(NAME readme.commands COMMAND bash
  ${PROJECT_SOURCE_DIR}/tests/app/guide.bash $<TARGET_FILE:turnwright>
  ${PROJECT_SOURCE_DIR} README 2 20)

add_test(NAME package.deb COMMAND ${CMAKE_COMMAND}
  -D BUILD_DIR=${PROJECT_BINARY_DIR} -D WORK_DIR=${PROJECT_BINARY_DIR}/package-test
  -D PART=${PROJECT_SOURCE_DIR}/parts/pump-shaft.json -D SANITIZE=${TURNWRIGHT_SANITIZE}
  -P ${PROJECT_SOURCE_DIR}/tests/package/run.cmake)
add_test(NAME package.completion COMMAND bash
  ${PROJECT_SOURCE_DIR}/tests/package/completion.bash $<TARGET_FILE_DIR:turnwright>
  ${PROJECT_SOURCE_DIR}/packaging/turnwright.bash-completion)
set_tests_properties(package.deb PROPERTIES TIMEOUT 600 SKIP_REGULAR_EXPRESSION "SKIPPED")
add_test(NAME package.version COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR}
  -D VERSION=${PROJECT_VERSION} -P ${PROJECT_SOURCE_DIR}/tests/package/version.cmake)
add_test(NAME package.reproducible CONFIGURATIONS slow COMMAND bash
  ${PROJECT_SOURCE_DIR}/tests/package/reproducible.bash ${PROJECT_BINARY_DIR}
  ${PROJECT_BINARY_DIR}/reproducible-test)
set_tests_properties(package.reproducible PROPERTIES LABELS slow TIMEOUT 600
  SKIP_REGULAR_EXPRESSION "SKIPPED")
# A whole Debian is fetched: only `ctest -C slow` does that.
add_test(NAME package.clean-root CONFIGURATIONS slow COMMAND bash
  ${PROJECT_SOURCE_DIR}/tests/package/clean_root.bash ${PROJECT_BINARY_DIR}
  ${PROJECT_BINARY_DIR}/clean-root-test ${PROJECT_SOURCE_DIR}/parts/pump-shaft.json
  ${PROJECT_SOURCE_DIR}/examples)
set_tests_properties(package.clean-root PROPERTIES LABELS slow TIMEOUT 1800
  SKIP_REGULAR_EXPRESSION "SKIPPED")

# Reference parts as two other programs write them today; stored files are read in every run.
add_test(NAME exchange.live-writers CONFIGURATIONS slow COMMAND bash
  ${PROJECT_SOURCE_DIR}/tests/exchange/live_writers.bash $<TARGET_FILE:exchange_test>
  ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/live-writers)
set_tests_properties(exchange.live-writers PROPERTIES LABELS slow TIMEOUT 1800
  SKIP_REGULAR_EXPRESSION "SKIPPED")

# Choices among all machines; every run has those of one.
add_test(NAME planning.choices-of-machines CONFIGURATIONS slow
  COMMAND planning_test --gtest_filter=*OfTen*)
set_tests_properties(planning.choices-of-machines PROPERTIES LABELS slow TIMEOUT 1800
  ENVIRONMENT "TURNWRIGHT_SLOW=1")

# More parts drawn at random, and every depth of the literature's problem.
add_test(NAME nc.more-drawn-parts CONFIGURATIONS slow
  COMMAND nc_test --gtest_filter=${of_drawn_parts})
set_tests_properties(nc.more-drawn-parts PROPERTIES ENVIRONMENT "TURNWRIGHT_RANDOM_PARTS=200")
add_test(NAME multipass.every-depth CONFIGURATIONS slow
  COMMAND multipass_test --gtest_filter=LinearWitness.*)
set_tests_properties(multipass.every-depth PROPERTIES ENVIRONMENT "TURNWRIGHT_SLOW=1")
set_tests_properties(nc.more-drawn-parts multipass.every-depth PROPERTIES LABELS slow
  TIMEOUT 3600)

# A short batch; scripts/faults runs a long one.
add_test(NAME cluster.batch COMMAND bash ${PROJECT_SOURCE_DIR}/tests/cluster/batch.bash
  $<TARGET_FILE:turnwright> ${PROJECT_SOURCE_DIR} 300)
set_tests_properties(cluster.batch PROPERTIES LABELS cluster TIMEOUT 500 COST 50
  SKIP_REGULAR_EXPRESSION "SKIPPED")
