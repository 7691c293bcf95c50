# The layer check must see what it is for: plants a violation of each kind, each in a file of its own,
# in a copy of the house and expects the check to name them all, and to pass without.
# Run: cmake -DSOURCE=<project folder> -DWORK=<scratch folder> -P planted.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

function(run_check)
  execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${WORK}/house -P ${SOURCE}/tests/arch/layers.cmake
                  RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
  set(result ${result} PARENT_SCOPE)
  set(out "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK}/house)
file(COPY ${SOURCE}/src ${SOURCE}/include DESTINATION ${WORK}/house)
run_check()
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the check fails on a good house: ${out}")
endif()
set(plants
  "read/planted.c|#include \"weartrack/fit.h\""
  "base/planted.c|#include \"weartrack/data.h\""
  "kernel/planted.c|#include \"report/planted.h\""
  "report/planted.c|#include <hdf5.h>"
  "flow/planted.c|#include \"cmd/cmd.h\""
  "model/planted.c|#include <gsl/gsl_multifit_nlinear.h>"
  "fit/planted.c|int f(void) { return printf(\"words\")@ }"
  "data/planted.c|void g(void) { exit(1)@ }"
  "fit/planted.c|void f(char *a, double b) { snprintf(a, 9, \"%.3g K\", b)@ }"
  "kernel/planted.c|#include \"planted.h\""
  "data/planted.c|long f(void) { return H5Fopen(\"a\", 0, 0)@ }"
  "read/text/planted.c|#include \"weartrack/fit.h\""
  "read/text/planted.c|int f(void) { return printf(\"words\")@ }"
  "read/bytes/planted.c|#include \"read/text/text.h\""
  "read/jpk/planted.h|#include \"read/nid/nid.h\""
  "read/jpk/planted.c|#include \"read/description/description.h\""
  "read/description/planted.c|#include \"read/text/text.h\""
  "read/text/planted.c|#include \"read/formats.h\""
  "read/reader.h|#include \"read/formats.h\""
  "read/new/planted.c|#include \"read/reader.h\""
  "flow/indentation/planted.c|#include \"flow/run/steps.h\""
  "flow/indentation/planted.c|#include <gsl/gsl_math.h>"
  "flow/indentation/planted.c|#include \"fit/sweeps/spectrum.h\""
  "flow/work/planted.c|#include \"flow/sweeps/master.h\""
  "flow/sweeps/planted.c|#include \"flow/sliding/friction.h\""
  "fit/indentation/planted.c|#include \"fit/sweeps/spectrum.h\""
  "cmd/planted.c|#include \"read/text/text.h\"")
set(n 0)
set(names include/weartrack/fit.h)
foreach(plant IN LISTS plants)
  string(REGEX MATCH "^([^|]+)\\|(.*)$" unused "${plant}")
  set(what "${CMAKE_MATCH_2}")
  math(EXPR n "${n} + 1")
  string(REPLACE "/planted." "/planted_${n}." where "src/${CMAKE_MATCH_1}")
  string(REPLACE "@" ";" what "${what}") # a semicolon would part the list
  file(WRITE ${WORK}/house/${where} "${what}\n")
  list(APPEND names ${where})
endforeach()
file(WRITE ${WORK}/house/include/weartrack/fit.h "#include <gsl/gsl_math.h>\n")
run_check()
foreach(name IN LISTS names)
  string(FIND "${out}" "${name}: " at)
  if(result EQUAL 0 OR at EQUAL -1)
    message(SEND_ERROR "the check does not see what is planted in ${name}")
  endif()
endforeach()
