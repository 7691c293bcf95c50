# Every structure and enumeration of the public headers stands in layout.c, and what stands there
# holds. Run: cmake -DINCLUDE=.. -DLAYOUT=.. -DCC=.. -P layout.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

file(READ ${LAYOUT} held)
file(GLOB headers "${INCLUDE}/weartrack/*.h")
foreach(header IN LISTS headers)
  file(STRINGS "${header}" lines REGEX "^(typedef )?(struct|enum) wt_[a-z0-9_]+ {")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^.*(wt_[a-z0-9_]+) {.*$" "\\1" name "${line}")
    if(NOT held MATCHES "\n[A-Z]+\\(${name},")
      message(SEND_ERROR "${name} is public and stands in no line of ${LAYOUT}")
    endif()
  endforeach()
endforeach()

execute_process(COMMAND ${CC} -std=c17 -Wall -Wextra -Werror -fsyntax-only -I${INCLUDE} ${LAYOUT}
                RESULT_VARIABLE rc ERROR_VARIABLE err)
if(NOT rc EQUAL 0)
  message(FATAL_ERROR "${err}")
endif()
