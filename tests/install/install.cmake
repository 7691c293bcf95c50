# Installs into an empty prefix, moves it, builds and runs a small consumer with the CMake package
# and with pkg-config, and runs the installed command.
# Run: cmake -DBUILD=.. -DSOURCE=.. -DWORK=.. -DCC=.. -DCFLAGS=.. -DGENERATOR=.. -P install.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE rc OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT rc EQUAL 0)
    list(JOIN ARGV " " text)
    message(FATAL_ERROR "${text}\nfailed (${rc}):\n${out}\n${err}")
  endif()
  set(output "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
# Nothing installed may know where it was installed to, or built.
file(RENAME ${WORK}/first ${WORK}/moved)
set(prefix ${WORK}/moved)

file(GLOB_RECURSE installed RELATIVE ${prefix} "${prefix}/*")
foreach(pattern IN ITEMS "^bin/weartrack$" "^lib/.*libweartrack\\.so" "^include/weartrack/base\\.h$"
        "^include/weartrack/weartrack\\.h$" "weartrack\\.pc$" "weartrack-config\\.cmake$"
        "share/man/man1/weartrack\\.1$" "share/man/man1/weartrack-run\\.1$"
        "share/man/man5/weartrack-case\\.5$" "share/weartrack/formats/.*\\.xml$"
        "share/weartrack/formats/weartrack-format\\.xsd$"
        "share/weartrack/formats/weartrack-case\\.xsd$" "share/weartrack/styles/.*\\.gp$")
  set(matching ${installed})
  list(FILTER matching INCLUDE REGEX "${pattern}")
  if(NOT matching)
    message(SEND_ERROR "not installed: ${pattern}")
  endif()
endforeach()
foreach(file IN LISTS installed)
  # sanitizers keep the names of source files for their reports
  if(CFLAGS MATCHES "-fsanitize")
    break()
  endif()
  if(file MATCHES "\\.(so[.0-9]*|h|pc|cmake|xml|xsd|gp|1|5)$" OR file STREQUAL "bin/weartrack")
    file(STRINGS ${prefix}/${file} hits REGEX "${SOURCE}/")
    if(hits)
      message(SEND_ERROR "${file} holds the path of the source folder")
    endif()
  endif()
endforeach()

separate_arguments(flags UNIX_COMMAND "${CFLAGS}")
run(${CMAKE_COMMAND} -G "${GENERATOR}" -S ${SOURCE}/tests/install/consumer -B ${WORK}/cmake
    -DCMAKE_C_COMPILER=${CC} "-DCMAKE_C_FLAGS=${CFLAGS}" -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${WORK}/cmake)
run(${WORK}/cmake/consumer)
if(NOT output MATCHES "^weartrack [0-9]+\\.[0-9]+\\.[0-9]+: G")
  message(FATAL_ERROR "the consumer says: ${output}")
endif()

file(GLOB_RECURSE pc "${prefix}/*/weartrack.pc")
get_filename_component(pc_dir ${pc} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_dir})
run(pkg-config --cflags --libs weartrack)
string(STRIP "${output}" pc_flags)
separate_arguments(pc_flags UNIX_COMMAND "${pc_flags}")
get_filename_component(lib_dir ${pc_dir} DIRECTORY)
run(${CC} -std=c17 ${flags} ${SOURCE}/tests/install/consumer/consumer.c -o ${WORK}/by_pc ${pc_flags} -lm
    -Wl,-rpath,${lib_dir})
run(${WORK}/by_pc)

run(${prefix}/bin/weartrack --version)
if(NOT output MATCHES "^weartrack [0-9]")
  message(FATAL_ERROR "the installed command says: ${output}")
endif()
run(${prefix}/bin/weartrack formats list)
