# The command loads the library of its build, in a sanitizer job a sanitized one. LD_LIBRARY_PATH has
# precedence over the build tree.
# Run: cmake -DCOMMAND=.. -DLIBRARY=.. -DNM=.. -DSANITIZED=<ON or OFF> -P loaded_library.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${CMAKE_COMMAND} -E env LD_TRACE_LOADED_OBJECTS=1 ${COMMAND}
  OUTPUT_VARIABLE out RESULT_VARIABLE rc)
if(NOT rc EQUAL 0 OR NOT out MATCHES "libweartrack[^ \n]* => ([^\n]+) \\(0x")
  message(FATAL_ERROR "the library that ${COMMAND} loads is not known: ${out}")
endif()
file(REAL_PATH "${CMAKE_MATCH_1}" loaded)
file(REAL_PATH "${LIBRARY}" built)
if(NOT loaded STREQUAL built)
  message(FATAL_ERROR "${COMMAND} loads ${loaded}, not ${built}: unset LD_LIBRARY_PATH")
endif()
execute_process(COMMAND ${NM} -D ${loaded} OUTPUT_VARIABLE symbols RESULT_VARIABLE rc)
if(NOT rc EQUAL 0)
  message(FATAL_ERROR "nm failed on ${loaded}")
endif()
if(SANITIZED AND NOT symbols MATCHES " U __(asan|tsan)_")
  message(FATAL_ERROR "${loaded} is not sanitized")
endif()
