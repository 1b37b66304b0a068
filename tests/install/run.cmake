# Installs the build into a folder of its own, builds the examples against it alone, by
# CMake and the one in C by pkg-config too, runs them and the installed program.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(result)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(prefix ${WORK_DIR}/prefix)
set(flags "")
if(SANITIZE)
  set(flags "-fsanitize=${SANITIZE}")
endif()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${EXAMPLES} -B ${WORK_DIR}/build -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_FLAGS=${flags} -D CMAKE_C_FLAGS=${flags}
    -D CMAKE_COMPILE_WARNING_AS_ERROR=ON)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build --parallel 2)

# What an example prints, by closed forms, standards and published values.
function(prints example pattern)
  run(${WORK_DIR}/build/${example} ${ARGN})
  if(NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${example} does not print ${pattern}:\n${output}")
  endif()
endfunction()
set(part ${prefix}/share/turnwright/parts/pump-shaft.json)
prints(catalogue "corner 0.8 mm, angle 80 deg, edge 12.90 mm")  # ISO 1832
prints(chatter "9000 1/min: stable below 2\\.[0-9]+ mm")
prints(cutting "f 0.2 mm: Fc 1145 N")  # 1800 MPa L^0.25 (ap f)^0.75 with L of the corner
prints(deflection "z 250 mm: .* 0.00 um with a tailstock")  # a rigid centre there
prints(exchange "d2: 30 mm in diameter, 32 mm long, fit k6.*3 mistakes")
prints(gcode "40.090 mm at feed")  # sqrt 5 + 30 + 5 pi/2
prints(multipass "cost 2.5580 per piece, nothing below 2.5580")  # docs/multipass.md
prints(nc "M30\n" ${part})
prints(optimise "0.707107 by 0.707107, multiplier 1.000")  # a square
prints(planning "cost 7.05[0-9]+ per part" ${part})  # README.md
# 4 (exp(-0.5) - exp(-2.1)) + 9 (exp(-1/18) - exp(-0.7/3))
prints(thermal "with the offset set every 5 parts: 3.32 um")
prints(tolerance "30 k6: \\+0.015 mm, \\+0.002 mm")  # ISO 286
prints(volumetric "X 100 mm: -5.00 um along Z")  # 50 urad over 100 mm

find_program(pkgconf NAMES pkg-config pkgconf)
if(pkgconf AND NOT SANITIZE)
  file(GLOB_RECURSE pc ${prefix}/*/turnwright.pc)
  cmake_path(GET pc PARENT_PATH folder)
  run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder} ${pkgconf} --cflags --libs turnwright)
  separate_arguments(options UNIX_COMMAND "${output}")
  run(cc ${EXAMPLES}/answer.c ${options} -Wl,-rpath,${folder}/.. -o ${WORK_DIR}/answer)
  execute_process(COMMAND ${WORK_DIR}/answer deflection INPUT_FILE ${part}
                  RESULT_VARIABLE status OUTPUT_VARIABLE output)
  if(NOT status EQUAL 2 OR NOT output MATCHES "\"pointer\":\"/shaft\"")
    message(FATAL_ERROR "the example in C, status ${status}: ${output}")
  endif()
endif()
run(${prefix}/bin/turnwright list materials)
if(NOT output MATCHES "C45")
  message(FATAL_ERROR "the installed program does not find its data: ${output}")
endif()
