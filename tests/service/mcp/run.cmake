# The server beside the protocol's own client library, skipped where node or npm's packages
# are not to be had.
find_program(node node)
find_program(npm npm)
if(NOT node OR NOT npm)
  message("SKIPPED: the client of the protocol needs node and npm; scripts/setup --page installs them")
  return()
endif()
foreach(part IN ITEMS package.json package-lock.json .npmrc client.mjs)
  file(COPY ${SOURCE}/${part} DESTINATION ${WORK_DIR})
endforeach()
execute_process(COMMAND ${npm} ci --no-audit --no-fund WORKING_DIRECTORY ${WORK_DIR}
                RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE why)
if(failed)
  message("SKIPPED: npm ci brought no packages:\n${why}")
  return()
endif()
execute_process(COMMAND ${node} client.mjs ${PROGRAM} ${DATA} WORKING_DIRECTORY ${WORK_DIR}
                COMMAND_ERROR_IS_FATAL ANY)
