# Makes the .deb, installs it with dpkg into an empty root, plans there in a chroot from
# another folder, with the libraries it depends on and nothing else of this machine, then
# removes it and looks for what is left.  The root is bare: dependencies are declared
# (checked below) but not installed by dpkg.
find_program(dpkg dpkg)
find_program(shlibdeps dpkg-shlibdeps)
execute_process(COMMAND id -u OUTPUT_VARIABLE user OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT dpkg OR NOT shlibdeps OR NOT user EQUAL 0 OR SANITIZE)
  message("SKIPPED: needs dpkg, dpkg-dev and root, and a build without sanitizers")
  return()
endif()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE error)
  if(result)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}${error}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect text pattern)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "not ${pattern}:\n${text}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(cpack --config ${BUILD_DIR}/CPackConfig.cmake -B ${WORK_DIR}
    -D "CPACK_COMPONENTS_ALL=program\;library")
file(GLOB of_library ${WORK_DIR}/libturnwright0_*.deb)
run(dpkg-deb --contents ${of_library})
expect("${output}" "libturnwright\\.so\\.0 ->")
file(GLOB deb ${WORK_DIR}/turnwright_*.deb)
run(dpkg-deb --field ${deb} Depends)
expect("${output}" "libc6.*libstdc\\+\\+6")

set(root ${WORK_DIR}/root)
set(admin var/lib/dpkg)
file(MAKE_DIRECTORY ${root}/${admin}/info ${root}/${admin}/updates ${root}/home)
file(TOUCH ${root}/${admin}/status)
set(dpkg_here ${CMAKE_COMMAND} -E env PATH=$ENV{PATH}:/usr/sbin:/sbin
    ${dpkg} --root=${root} --force-depends --log=/dev/null)
run(${dpkg_here} --install ${deb})

# The shared libraries that the program is linked with, where the loader looks for them.
run(ldd ${root}/usr/bin/turnwright)
string(REGEX MATCHALL "/[^ \n]+\\.so[^ \n]*" libraries "${output}")
set(copied "")
foreach(library IN LISTS libraries)
  get_filename_component(folder ${library} DIRECTORY)
  file(COPY ${library} DESTINATION ${root}${folder} FOLLOW_SYMLINK_CHAIN)
  list(APPEND copied ${root}${library})
endforeach()
# In a mount namespace of its own with /proc, where a program reads its own place.
file(MAKE_DIRECTORY ${root}/proc)
set(inside unshare --mount sh -c
    "mount -t proc proc $0/proc && exec chroot $0 \"$@\"" ${root})
execute_process(COMMAND ${inside} /usr/bin/turnwright --version RESULT_VARIABLE barred
                OUTPUT_QUIET ERROR_VARIABLE why)
if(barred)
  message("SKIPPED: no chroot with /proc here: ${why}")
  return()
endif()
file(COPY ${PART} DESTINATION ${root}/home)
get_filename_component(part ${PART} NAME)
run(${inside} /usr/bin/turnwright plan /home/${part} --report /home/plan.html)
expect("${output}" "every limit is kept")
run(${inside} /usr/bin/turnwright list machines)
expect("${output}" "lathe-medium")
if(NOT EXISTS ${root}/usr/share/man/man1/turnwright.1 OR
   NOT EXISTS ${root}/lib/systemd/system/turnwright.service AND
   NOT EXISTS ${root}/usr/lib/systemd/system/turnwright.service)
  message(FATAL_ERROR "manual or unit are missing")
endif()

run(${dpkg_here} --purge turnwright)
file(GLOB_RECURSE left RELATIVE ${root} ${root}/*turnwright*)
if(left)
  message(FATAL_ERROR "left behind: ${left}")
endif()
