# Every file in C and C++ is as clang-format 14 (Debian 12) leaves it; other versions differ.
#   cmake -D ROOT=<source folder> -P clang-format.cmake
find_program(CLANG_FORMAT NAMES clang-format-14 clang-format)
if(NOT CLANG_FORMAT)
  message("SKIPPED: clang-format is not installed")
  return()
endif()
execute_process(COMMAND ${CLANG_FORMAT} --version OUTPUT_VARIABLE version)
if(NOT version MATCHES "version 14\\.")
  message("SKIPPED: clang-format 14 is wanted, found ${version}")
  return()
endif()

set(files "")
foreach(folder IN ITEMS include src tests bench examples)
  file(GLOB_RECURSE found ${ROOT}/${folder}/*.[ch] ${ROOT}/${folder}/*.[ch]pp)
  list(APPEND files ${found})
endforeach()
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror ${files}
  RESULT_VARIABLE result ERROR_VARIABLE report)
if(result)
  message("${report}")
  message(FATAL_ERROR "mend with: clang-format -i FILE")
endif()
