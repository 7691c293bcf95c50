# Private words have a standard term (table below). They occur in no message, help text, comment or man
# page. A phrase of two words is found across a line end and in a literal of two parts.
# Run: cmake -DSOURCE=<project folder> [-DPLANTED=ON] -P prose.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

# Lower case, with the character before or after the word; "|", then the standard term.
set(words
  " it cannot be said|the verdict is inconclusive"
  " would settle |would decide"
  " unsaid|unstated"
  " shared error|systematic error"
  " own error|standard error of the item"
  " common law |shared shift law"
  " common laws |shared shift laws"
  " lost work|hysteresis loss"
  " acts back|has feedback"
  " choices by hand|manual overrides"
  " held against |compared with"
  " taken for |treated as"
  " makes it smaller|reduces it"
  " worn tip|tip wear"
  " dent |imprint"
  " dents |imprints"
  " whole number|integer"
  " far values|outliers"
  " snap on |snap-in"
  " strange file|foreign file"
  " stranger |foreign file"
  " softness|strain softening"
  " the door |sandbox"
  " shortage|resource error"
  " twice and not alike|inconsistent"
  " what is gone|removed data"
  " what is said of|name the quantity"
  " that of those|name the quantity"
  " the same of the others|name the quantity"
  " nothing in this was of use|nothing found, and where"
  " none is better than another|inconclusive: all fit equally well"
  " lever |cantilever"
  " lever's |cantilever's"
  " levers |cantilevers")

set(found "")
set(n 0)
function(look file text)
  string(TOLOWER "${text}" text)
  # blanks, line ends, quotes, comment stars and markup separate words
  string(REGEX REPLACE "[ \n\t*\"#<>()]+|\\\\f[a-z]|\\\\&|[.,:](\\\\n)?[ \n\"]+" " " text "${text}")
  # terms of instruments
  string(REGEX REPLACE "(optical|light) lever|lever (degree|clock|/name)" "" text "${text}")
  foreach(row IN LISTS words)
    string(REGEX MATCH "^(.*)[|](.*)$" row "${row}")
    set(word "${CMAKE_MATCH_1}")
    set(term "${CMAKE_MATCH_2}")
    string(FIND "${text}" "${word}" at)
    if(NOT at EQUAL -1)
      string(SUBSTRING "${text}" ${at} 60 place)
      string(APPEND found "  ${file}:${place}... (${term})\n")
    endif()
  endforeach()
  math(EXPR n "${n} + 1")
  set(n ${n} PARENT_SCOPE)
  set(found "${found}" PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE files RELATIVE ${SOURCE}
     ${SOURCE}/src/*.c ${SOURCE}/src/*.h ${SOURCE}/src/*.js ${SOURCE}/src/*.html ${SOURCE}/src/*.md
     ${SOURCE}/include/*.h ${SOURCE}/man/*.[1-9] ${SOURCE}/formats/*.x*)
list(APPEND files README.md CHANGELOG.md)
foreach(file IN LISTS files)
  file(READ ${SOURCE}/${file} text)
  look(${file} "${text}")
endforeach()
if(PLANTED)
  look(planted_1.c "/* The lever bends. */")
  look(planted_2.c "wt_log_add(log, \"so it cannot \"\n     \"be said\")@")
endif()
if(n LESS 500)
  message(SEND_ERROR "only ${n} files seen")
endif()
if(NOT found STREQUAL "")
  message(SEND_ERROR "private words, with the standard term:\n${found}")
endif()
