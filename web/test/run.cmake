# STEP build: the page builds from its source to the bytes that are checked in.
# STEP check: types and accessibility of the components, by svelte-check.
# STEP unit: the page's own logic (test/unit), without a browser.
# STEP round, shop, language, builder, odd: rounds in Chromium (round.mjs, ..) of what the page
# shows, of programs and measured parts, of the page in German, of parts built on it and of what
# may go wrong; pictures in WORK_DIR/pictures.
# Each is skipped where node, npm's packages or Chromium are not to be had.
find_program(node node)
find_program(npm npm)
find_program(chromium NAMES chromium chromium-browser)
if(NOT node OR NOT npm OR (STEP MATCHES "^(round|shop|language|builder|odd)$" AND NOT chromium))
  message("SKIPPED: the page's tests need node, npm and chromium; scripts/setup --page installs them")
  return()
endif()

foreach(part IN ITEMS package.json package-lock.json .npmrc vite.config.js tsconfig.json
        index.html src test)
  file(COPY ${WEB}/${part} DESTINATION ${WORK_DIR})
endforeach()
cmake_path(GET WEB PARENT_PATH root)
file(COPY ${root}/languages DESTINATION ${WORK_DIR}/..)  # as it lies beside web/
file(SHA256 ${WEB}/package-lock.json lock)
if(NOT EXISTS ${WORK_DIR}/node_modules/${lock})
  execute_process(COMMAND ${npm} ci --no-audit --no-fund WORKING_DIRECTORY ${WORK_DIR}
                  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE why)
  if(failed)
    message("SKIPPED: npm ci brought no packages:\n${why}")
    return()
  endif()
  file(TOUCH ${WORK_DIR}/node_modules/${lock})
endif()

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${ARGN}: ${failed}")
  endif()
endfunction()

if(STEP STREQUAL "build")
  run(${npm} run build)
  file(SHA256 ${WORK_DIR}/dist/index.html built)
  file(SHA256 ${WEB}/dist/index.html kept)
  if(NOT built STREQUAL kept)
    message(FATAL_ERROR "web/dist/index.html is not what web/src builds to: npm run build")
  endif()
elseif(STEP STREQUAL "check")
  run(${npm} run check)
elseif(STEP STREQUAL "unit")
  set(ENV{TURNWRIGHT_ROOT} ${root})
  file(GLOB tests ${WORK_DIR}/test/unit/*.test.mjs)
  run(${node} --test ${tests})
else()
  set(ENV{CHROMIUM} ${chromium})
  run(${node} test/${STEP}.mjs ${PROGRAM} ${WORK_DIR}/pictures)
endif()
