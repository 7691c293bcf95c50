# The layers of the house, read off the #include lines.
# Run: cmake -DSOURCE=<project folder> -P layers.cmake
#
# A room is a folder of src, a sub-room a folder in it. A room may include its own headers and those
# of the rooms it may know; a sub-room may include what its row says.
# Third-party headers have owners.
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

# Which folders and single headers of its room a sub-room may include, beside its own. The files of
# the room itself may include all of it, but for those that have a row of their own.
set(within_data/tables data)
set(within_read/reader.h read/facts.h read/readers.def)
set(within_read/facts.h "")
set(within_read/facts.c read/facts.h)
set(within_read/force_source.h read/facts.h)
set(within_read/force_source.c read/bytes read/facts.h read/force_source.h read/force_contradiction.h)
set(within_read/force_contradiction.h read/force_source.h)
set(within_read/force_contradiction.c read/force_source.h read/force_contradiction.h)
set(within_read/images.h read/bytes read/facts.h)
set(within_read/bytes "")
set(within_read/description read/reader.h read/embedded_formats.h read/bytes)
set(within_read/text read/reader.h read/images.h read/facts.h read/force_source.h read/bytes read/description)
set(within_read/packed read/bytes)
set(within_read/hierarchy read/reader.h read/bytes)
set(within_read/gwyddion read/reader.h read/facts.h read/images.h read/bytes read/gwy)
set(within_read/afmformats read/reader.h read/hierarchy read/text read/description)
set(within_read/nhf read/reader.h read/force_source.h read/hierarchy read/text read/description)
set(within_read/ntmdt read/reader.h read/bytes read/text read/description)
set(within_read/stored read/reader.h read/facts.h read/force_source.h read/bytes read/description
  read/text)
# Abilities have one folder in fit and one in flow, of the same name. The files of fit itself are for
# all of them.
set(within_fit/calibration "")
set(within_fit/comparison fit)
set(within_fit/indentation fit)
set(within_fit/dwell fit fit/indentation)
set(within_fit/materials fit)
set(within_fit/ramp fit)
set(within_fit/record fit)
set(within_fit/spot "")
set(within_fit/strain "")
set(within_fit/surface fit)
set(within_fit/sweeps fit)
set(within_fit/validation fit fit/record)
set(within_flow/work "")
set(within_flow/calibration flow/work)
set(within_flow/indentation flow/work flow/materials)
set(within_flow/dwell flow/work flow/indentation)
set(within_flow/spot flow/work)
set(within_flow/surface flow/work)
set(within_flow/sweeps flow/work)
set(within_flow/ramp flow/work flow/sweeps)
set(within_flow/record flow/work)
set(within_flow/strain flow/work flow/sweeps)
set(within_flow/materials flow/work flow/sweeps flow/comparison/margin.h)
set(within_flow/sliding flow/work flow/materials flow/strain)
set(within_flow/layer flow/work flow/strain flow/sliding)
set(within_flow/collection flow/comparison/margin.h)
set(within_flow/comparison flow/work flow/materials flow/indentation flow/dwell)
set(abilities work calibration collection comparison indentation dwell record spot surface sweeps ramp strain materials sliding
  layer)
list(TRANSFORM abilities PREPEND flow/)
set(within_flow/errors ${abilities} flow/accuracy)
set(within_flow/validation ${abilities} flow/errors)
set(within_flow/accuracy flow/work)
set(within_flow/case flow/case_schema.h ${abilities})
set(within_flow/plan flow/case)
set(within_flow/answer flow/case flow/plan)
set(within_flow/run ${abilities} flow/errors flow/validation flow/case flow/plan flow/answer)
# The sub-rooms whose headers other rooms may include; those of an ability, the same ability may.
set(shown data/tables)

# Third-party headers: pattern, then the rooms that may include it (joined by '+': lists do not nest).
set(third_party
  "^udunits2" base
  "^seccomp\\.h" base
  "^sqlite3\\.h" data
  "^(sha2|md5|sha256|sha1|md4)\\.h" base
  "^(hdf5|H5)" data+read
  "^zlib\\.h" data+read+report
  "^(zip|libdeflate)\\.h" read
  "^libxml/" read+flow
  "^(iconv|regex)\\.h" read
  "^gsl/gsl_errno" base+model+fit+kernel
  "^gsl/gsl_(sf_|math|const|poly|interp|roots)" model+fit+kernel
  "^gsl/" fit+kernel
  "^fftw3" fit
  "^(spawn\\.h|sys/wait\\.h)" base+report
  "^getopt\\.h" cmd)

if(NOT SOURCE)
  message(FATAL_ERROR "say where the project is: -DSOURCE=<folder>")
endif()

# Each binary reader is a sub-room that knows what a reader is, and none of the others.
file(STRINGS "${SOURCE}/src/read/readers.def" rows REGEX "^READER\\(")
foreach(row IN LISTS rows)
  string(REGEX REPLACE "READER\\((.*)\\)" "read/\\1" row "${row}")
  if(NOT DEFINED within_${row})
    set(within_${row} read/reader.h read/facts.h read/force_source.h read/images.h read/bytes)
  endif()
endforeach()

set(n_files 0)
set(n_includes 0)

function(violation file words)
  set_property(GLOBAL APPEND PROPERTY violations "${file}: ${words}")
endfunction()

function(check_third_party file room header)
  list(LENGTH third_party n)
  math(EXPR last "${n} - 1")
  foreach(i RANGE 0 ${last} 2)
    math(EXPR j "${i} + 1")
    list(GET third_party ${i} pattern)
    if(header MATCHES "${pattern}")
      list(GET third_party ${j} owners)
      string(REPLACE "+" ";" owners "${owners}")
      if(NOT room IN_LIST owners)
        violation("${file}" "<${header}> belongs to ${owners}, not to ${room}")
      endif()
      return()
    endif()
  endforeach()
endfunction()

# `folder` is the room or sub-room of the file, `row` its row in the table if it has one.
function(check_include file room folder row header quoted)
  string(REGEX REPLACE "^[a-z]+/?(.*)$" "\\1" ability "${folder}")
  if(header MATCHES "^weartrack/([a-z]+)\\.h$")
    set(other ${CMAKE_MATCH_1})
    set(other_folder ${other})
    if(other STREQUAL "weartrack" AND room STREQUAL "cmd")
      return()
    endif()
  elseif(header MATCHES "^(([a-z]+)[a-z0-9/]*)/[A-Za-z0-9_]+\\.(h|inc|def)$" AND CMAKE_MATCH_2 IN_LIST rooms)
    set(other ${CMAKE_MATCH_2})
    set(other_folder ${CMAKE_MATCH_1})
  elseif(quoted)
    violation("${file}" "\"${header}\" does not begin with its room")
    return()
  else()
    check_third_party("${file}" ${room} "${header}")
    return()
  endif()
  string(REGEX REPLACE "^[a-z]+/?(.*)$" "\\1" other_ability "${other_folder}")
  if(NOT other STREQUAL room)
    if(NOT other IN_LIST knows_${room})
      violation("${file}" "${room} may not include ${other}")
    elseif(NOT other_folder STREQUAL other AND NOT other_folder IN_LIST shown
           AND NOT other_ability STREQUAL ability)
      violation("${file}" "${other_folder} is for ${other} alone")
    endif()
  elseif(DEFINED within_${row} AND NOT header MATCHES "^weartrack/" AND NOT row STREQUAL other_folder
         AND NOT other_folder IN_LIST within_${row} AND NOT header IN_LIST within_${row})
    violation("${file}" "${row} may not include ${header}")
  endif()
endfunction()

# Only cmd prints, exits and parses options.
function(check_quiet file source)
  file(STRINGS "${source}" lines
    REGEX "(^|[^a-zA-Z_>.])(printf|puts|putchar|perror|exit|abort|setlocale|getopt|getopt_long)[ \t]*\\(")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^[ \t]*(/?\\*|//)")
      violation("${file}" "only cmd may do this: ${line}")
    endif()
  endforeach()
  file(STRINGS "${source}" lines REGEX "(^|[^a-zA-Z_])(stdout|stderr)([^a-zA-Z_]|$)")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^[ \t]*(/?\\*|//)" AND NOT line MATCHES "\"[^\"]*(stdout|stderr)[^\"]*\"")
      violation("${file}" "only cmd may print: ${line}")
    endif()
  endforeach()
endfunction()

# The locale of the program does not choose the decimal point: numbers that are not whole are printed
# by clocale_print, or between clocale_enter and clocale_leave.
function(check_locale file source)
  file(READ "${source}" text)
  string(REPLACE ";" "@" text "${text}")
  if(text MATCHES "[^a-z_](snprintf\\([^@]*%[-+ 0-9]*(\\.[1-9*][0-9]*)?[efg][^@a-z][^@]*)@"
     AND NOT text MATCHES "clocale_enter")
    violation("${file}" "the locale of the program chooses the decimal point: ${CMAKE_MATCH_1}")
  endif()
endfunction()

# HDF5 comes in through one door (hdf5_door.h).
function(check_door file source)
  file(STRINGS "${source}" lines REGEX "(^|[^a-zA-Z_])(H5Fopen|H5Fis_[a-z0-9]+|H5LT[a-z_]+)[ \t]*\\(")
  if(lines AND NOT file STREQUAL "src/data/hdf5_door.c")
    violation("${file}" "only src/data/hdf5_door.c may do this: ${lines}")
  endif()
endfunction()

foreach(room IN LISTS rooms)
  file(GLOB_RECURSE sources "${SOURCE}/src/${room}/*.c" "${SOURCE}/src/${room}/*.h")
  foreach(source IN LISTS sources ITEMS "${SOURCE}/include/weartrack/${room}.h")
    if(NOT EXISTS "${source}")
      continue()
    endif()
    math(EXPR n_files "${n_files} + 1")
    file(STRINGS "${source}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
    file(RELATIVE_PATH short "${SOURCE}" "${source}")
    set(folder ${room})
    if(short MATCHES "^src/(.*)/[^/]*$")
      set(folder ${CMAKE_MATCH_1})
      if(NOT folder STREQUAL room AND NOT DEFINED within_${folder})
        violation("${short}" "${folder} has no row in the table of sub-rooms")
      endif()
    endif()
    set(row ${folder})
    string(REGEX REPLACE "^src/" "" path "${short}")
    if(DEFINED within_${path})
      set(row ${path})
    endif()
    foreach(line IN LISTS lines)
      math(EXPR n_includes "${n_includes} + 1")
      string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]+)[>\"].*$" "\\1" header "${line}")
      string(FIND "${line}" "\"" quoted)
      math(EXPR quoted "${quoted} + 1")
      if(room STREQUAL "base" OR NOT short MATCHES "^include/" OR header MATCHES "^weartrack/"
         OR header MATCHES "^std")
        check_include("${short}" ${room} ${folder} ${row} "${header}" ${quoted})
      else()
        violation("${short}" "a public header includes <${header}>: nothing third-party inside")
      endif()
    endforeach()
    if(NOT room STREQUAL "cmd" AND short MATCHES "\\.c$")
      check_quiet("${short}" "${source}")
      check_locale("${short}" "${source}")
    endif()
    check_door("${short}" "${source}")
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
