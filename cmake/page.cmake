# The planner's page, built by `npm run build` in web/ and checked in, becomes part of the
# service library: building Turnwright needs no Node.
set(page ${PROJECT_SOURCE_DIR}/web/dist/index.html)
set(embedded ${PROJECT_BINARY_DIR}/page/embedded.cpp)
add_custom_command(OUTPUT ${embedded}
  COMMAND ${CMAKE_COMMAND} -D IN=${page} -D OUT=${embedded}
    -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
  DEPENDS ${page} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake)
target_sources(turnwright_service PRIVATE ${embedded})
