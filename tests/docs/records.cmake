# The pages and the schema contain the text of the records of parameters and tables; -DWRITE=ON writes it.
# Run: cmake -DTOOL=.. -DPROGRAM=.. -DSOURCE=<project folder> [-DWRITE=ON] -P records.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

set(n 0)
file(GLOB files "${SOURCE}/man/*.[15]" "${SOURCE}/formats/weartrack-case.xsd")
foreach(file IN LISTS files)
  file(READ ${file} old)
  if(NOT old MATCHES "(\\.[\\]\"|<!--) (options|parameters|choices|table|subcommands|results|figures|limits)")
    continue()
  endif()
  math(EXPR n "${n} + 1")
  execute_process(COMMAND ${TOOL} ${PROGRAM} ${file} OUTPUT_VARIABLE new ERROR_VARIABLE words
                  RESULT_VARIABLE rc)
  if(NOT rc EQUAL 0)
    message(SEND_ERROR "${file}: ${words}")
  elseif(WRITE AND NOT new STREQUAL old)
    file(WRITE ${file} "${new}")
    message(STATUS "written: ${file}")
  elseif(NOT new STREQUAL old)
    message(SEND_ERROR "${file} is not what the records say: build the target docs_write")
  endif()
endforeach()
if(n LESS 13)
  message(FATAL_ERROR "only ${n} files with a marker")
endif()
