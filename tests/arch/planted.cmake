# The layer check must see what it is for: plants one violation of each kind in a copy of a small
# house and expects the check to fail on it and to pass without.
# Run: cmake -DSOURCE=<project folder> -DWORK=<scratch folder> -P planted.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

# `expected` is "pass" or the file that the check must name.
function(run_check expected what)
  execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${WORK}/house -P ${SOURCE}/tests/arch/layers.cmake
                  RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(expected STREQUAL "pass" AND NOT result EQUAL 0)
    message(FATAL_ERROR "the check fails on a good house: ${out}")
  elseif(NOT expected STREQUAL "pass" AND (result EQUAL 0 OR NOT out MATCHES "${expected}"))
    message(FATAL_ERROR "the check does not see: ${what}")
  endif()
endfunction()

function(fresh_house)
  file(REMOVE_RECURSE ${WORK}/house)
  file(COPY ${SOURCE}/src ${SOURCE}/include DESTINATION ${WORK}/house)
endfunction()

fresh_house()
run_check(pass "")
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
foreach(plant IN LISTS plants)
  string(REGEX MATCH "^([^|]+)\\|(.*)$" unused "${plant}")
  set(where ${CMAKE_MATCH_1})
  string(REPLACE "@" ";" what "${CMAKE_MATCH_2}") # a semicolon would part the list
  file(WRITE ${WORK}/house/src/${where} "${what}\n")
  run_check(src/${where} "${plant}")
  file(REMOVE ${WORK}/house/src/${where})
  if(EXISTS ${SOURCE}/src/${where})
    configure_file(${SOURCE}/src/${where} ${WORK}/house/src/${where} COPYONLY)
  endif()
endforeach()
file(WRITE ${WORK}/house/include/weartrack/fit.h "#include <gsl/gsl_math.h>\n")
run_check(include/weartrack/fit.h "a third-party header in a public header")
