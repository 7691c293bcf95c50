# A function has one exit for success and failure: there is no goto.
# Run: cmake -DSOURCE=<project folder> [-DPLANTED=ON] -P errors.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

file(GLOB_RECURSE files RELATIVE "${SOURCE}" "${SOURCE}/src/*.c" "${SOURCE}/src/*.h")
list(LENGTH files n)
if(n LESS 100)
  message(FATAL_ERROR "only ${n} files seen: wrong folder?")
endif()
set(found "")
foreach(file IN LISTS files)
  file(STRINGS "${SOURCE}/${file}" lines REGEX "^ +goto [a-z_]+;")
  if(lines)
    string(APPEND found "  ${file}:${lines}\n")
  endif()
endforeach()
if(PLANTED)
  string(APPEND found "  planted.c:    goto done;\n")
endif()
if(found)
  message(FATAL_ERROR "src/README.md, Errors: status is carried on, there is no goto:\n${found}")
endif()
