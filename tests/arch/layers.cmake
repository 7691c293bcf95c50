# The layers of the house, read off the #include lines.
# Run: cmake -DSOURCE=<project folder> -P layers.cmake
#
# A room may include its own headers and those of the rooms it may know. Third-party headers have
# owners.
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

set(rooms base data read model fit kernel report flow cmd)
set(knows_base "")
set(knows_data base)
set(knows_read base data)
set(knows_model base data)
set(knows_fit base data model)
set(knows_kernel base data model)
set(knows_report base data)
set(knows_flow base data read model fit kernel report)
set(knows_cmd base data read model fit kernel report flow)

# Third-party headers: pattern, then the rooms that may include it (joined by '+': lists do not nest).
set(third_party
  "^udunits2" base
  "^(sha2|md5|sha256|sha1|md4)\\.h" base
  "^(hdf5|H5)" data+read
  "^zip\\.h" read
  "^libxml/" read+flow
  "^(iconv|regex)\\.h" read
  "^gsl/gsl_errno" base+model+fit+kernel
  "^gsl/gsl_(sf_|math|const|poly)" model+fit+kernel
  "^gsl/" fit+kernel
  "^fftw3" fit
  "^(spawn\\.h|sys/wait\\.h)" report
  "^getopt\\.h" cmd)

if(NOT SOURCE)
  message(FATAL_ERROR "say where the project is: -DSOURCE=<folder>")
endif()

set(violations "")
set(n_files 0)
set(n_includes 0)

function(check_include file room header)
  if(header MATCHES "^weartrack/([a-z]+)\\.h$")
    set(other ${CMAKE_MATCH_1})
    if(other STREQUAL "weartrack" AND room STREQUAL "cmd")
      return()
    endif()
  elseif(header MATCHES "^([a-z]+)/[A-Za-z0-9_]+\\.(h|inc)$" AND CMAKE_MATCH_1 IN_LIST rooms)
    set(other ${CMAKE_MATCH_1})
  else()
    list(LENGTH third_party n)
    math(EXPR last "${n} - 1")
    foreach(i RANGE 0 ${last} 2)
      math(EXPR j "${i} + 1")
      list(GET third_party ${i} pattern)
      if(header MATCHES "${pattern}")
        list(GET third_party ${j} owners)
        string(REPLACE "+" ";" owners "${owners}")
        if(NOT room IN_LIST owners)
          set_property(GLOBAL APPEND PROPERTY violations
            "${file}: <${header}> belongs to ${owners}, not to ${room}")
        endif()
        return()
      endif()
    endforeach()
    return()
  endif()
  if(NOT other STREQUAL room AND NOT other IN_LIST knows_${room})
    set_property(GLOBAL APPEND PROPERTY violations "${file}: ${room} may not include ${other}")
  endif()
endfunction()

foreach(room IN LISTS rooms)
  file(GLOB sources "${SOURCE}/src/${room}/*.c" "${SOURCE}/src/${room}/*.h"
       "${SOURCE}/include/weartrack/${room}.h")
  foreach(source IN LISTS sources)
    math(EXPR n_files "${n_files} + 1")
    file(STRINGS "${source}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
    file(RELATIVE_PATH short "${SOURCE}" "${source}")
    foreach(line IN LISTS lines)
      math(EXPR n_includes "${n_includes} + 1")
      string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]+)[>\"].*$" "\\1" header "${line}")
      if(room STREQUAL "base" OR NOT short MATCHES "^include/" OR header MATCHES "^weartrack/"
         OR header MATCHES "^std")
        check_include("${short}" ${room} "${header}")
      else()
        set_property(GLOBAL APPEND PROPERTY violations
          "${short}: a public header includes <${header}>: nothing third-party inside")
      endif()
    endforeach()
  endforeach()
endforeach()

# Only cmd prints, exits and parses options.
foreach(room IN LISTS rooms)
  if(room STREQUAL "cmd")
    continue()
  endif()
  file(GLOB sources "${SOURCE}/src/${room}/*.c")
  foreach(source IN LISTS sources)
    file(RELATIVE_PATH short "${SOURCE}" "${source}")
    file(STRINGS "${source}" lines
      REGEX "(^|[^a-zA-Z_>.])(printf|puts|putchar|perror|exit|abort|setlocale|getopt|getopt_long)[ \t]*\\(")
    foreach(line IN LISTS lines)
      if(line MATCHES "^[ \t]*(/?\\*|//)")
        continue()
      endif()
      set_property(GLOBAL APPEND PROPERTY violations "${short}: only cmd may do this: ${line}")
    endforeach()
    file(STRINGS "${source}" lines REGEX "(^|[^a-zA-Z_])(stdout|stderr)([^a-zA-Z_]|$)")
    foreach(line IN LISTS lines)
      if(line MATCHES "^[ \t]*(/?\\*|//)" OR line MATCHES "\"[^\"]*(stdout|stderr)[^\"]*\"")
        continue()
      endif()
      set_property(GLOBAL APPEND PROPERTY violations "${short}: only cmd may print: ${line}")
    endforeach()
  endforeach()
endforeach()

get_property(violations GLOBAL PROPERTY violations)
if(n_files LESS 10 OR n_includes LESS 20)
  message(FATAL_ERROR "only ${n_files} files with ${n_includes} includes seen: wrong folder?")
endif()
if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "the layers are broken:\n  ${text}")
endif()
message(STATUS "${n_files} files, ${n_includes} includes: the layers hold")
