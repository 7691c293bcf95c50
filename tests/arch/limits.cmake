# A named numerical constant has a comment with its reason in its line, above it, or above its group of
# declarations. Readers assess the reason.
# Run: cmake -DSOURCE=<project folder> -P limits.cmake
# With -DPLANTED=ON a number without one is added, which must be found.
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

set(constant "^ *static const (double|int|long|size_t|unsigned)[^(]* = [^;]*[0-9]")
set(define "^#define [A-Z_0-9]+ [(]?-?[0-9.]")
set(one_line "^ *enum {.*= *[(]?-?[0-9]")
set(opened "^ *enum {$")
set(member "^ +[A-Z_0-9]+ = [(]?-?[0-9]")

set(n 0)
set(without "")
function(look name text)
  string(REPLACE ";" "," text "${text}")
  string(REGEX REPLACE "[][]" "|" text "${text}")
  string(REPLACE "\\\n" "\n" text "${text}")
  string(REPLACE "\n" ";" lines "${text}")
  set(said FALSE) # a comment that ends in the line before, or above the group
  set(within FALSE)
  set(number 0)
  foreach(line IN LISTS lines)
    math(EXPR number "${number} + 1")
    set(is FALSE)
    if(line MATCHES "${opened}")
      set(within TRUE)
      set(is TRUE) # applies the comment above to its members
    elseif((line MATCHES "${constant}" AND NOT line MATCHES " char ") OR line MATCHES "${define}" OR line MATCHES "${one_line}" OR
           (within AND line MATCHES "${member}"))
      set(is TRUE)
      math(EXPR n "${n} + 1")
      if(NOT said AND NOT line MATCHES "/\\*")
        string(APPEND without "  ${name}:${number}: ${line}\n")
      endif()
    endif()
    if(line MATCHES "^ *}")
      set(within FALSE)
    endif()
    if(line MATCHES "\\*/" OR (is AND said))
      set(said TRUE)
    elseif(NOT line MATCHES "^ +[^ ]" OR line MATCHES "[,{}] *$") # continuation of a long line
      set(said FALSE)
    endif()
  endforeach()
  set(n ${n} PARENT_SCOPE)
  set(without "${without}" PARENT_SCOPE)
endfunction()

foreach(folder IN ITEMS core/math job indentation dma surface friction layer record study case)
  file(GLOB_RECURSE files RELATIVE ${SOURCE}/src ${SOURCE}/src/${folder}/*.c ${SOURCE}/src/${folder}/*.h)
  # sizes of drawings and the width of a vector are not numerical constants
  list(FILTER files EXCLUDE REGEX "/figures[a-z_]*[.]c$|core/math/simd[.]h$")
  foreach(file IN LISTS files)
    file(READ ${SOURCE}/src/${file} text)
    look(${file} "${text}")
  endforeach()
endforeach()
if(PLANTED)
  look(planted.c "int x;\n\nstatic const double magic = 0.37;\n")
endif()
if(n LESS 200)
  message(SEND_ERROR "only ${n} named numbers found")
endif()
if(NOT without STREQUAL "")
  message(SEND_ERROR "named numbers without a reason beside them:\n${without}")
endif()
