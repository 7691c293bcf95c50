# Every catalogue passes msgfmt --check without a word, and has nothing fuzzy or untranslated.
# Run: cmake -DMSGFMT=.. -DLANGUAGES=.. -P languages.cmake.
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)
set(ENV{LC_ALL} C) # of what --statistics says
file(GLOB catalogues ${LANGUAGES}/*.po)
if(NOT catalogues)
  message(FATAL_ERROR "no catalogue in ${LANGUAGES}")
endif()
foreach(catalogue IN LISTS catalogues)
  execute_process(COMMAND ${MSGFMT} --check --statistics --output-file=/dev/null ${catalogue}
    RESULT_VARIABLE status ERROR_VARIABLE words OUTPUT_QUIET)
  if(NOT status EQUAL 0 OR NOT words MATCHES "^[0-9]+ translated messages\\.\n$")
    message(SEND_ERROR "${catalogue}: ${words}")
  endif()
endforeach()
