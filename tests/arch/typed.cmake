# Code depends on types, never on text that the program itself wrote, so that a better sentence does not
# change the behaviour. Text of users, files and libraries may be compared, and so may identifiers of one
# word (units, names of groups, tables and options).
# Run: cmake -DSOURCE=<project folder> [-DPLANTED=ON] -P typed.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

# A call with its arguments, which may contain calls.
set(call "(strn?cmp|strstr|strn?casecmp|starts_with)\\(([^()]|\\([^()]*\\))*\\)")
# A literal of two words or an option; a member or column with a sentence.
set(prose "\"[^\"]* [^\"]*\"|\"--[a-z]*\"")
set(sentences "[>.](message|advice|reason|remedy|note|sentence|caption|title|statement|because|why)[,)]")
set(columns "_text\\([^)]*_(REASON|WHY|NOTE|SENTENCE|REMEDY|SETTLED_BY|CAPTION)\\)")

# Text from other sources, and messages that are printed once if they are equal.
set(allowed
  "read/"                                          # foreign files
  "case/case_parse.c: .*c->message"                # messages of libxml2
  "case/case_parse.c: .* Expected is"
  "case/case_parse.c: .*FILL IN"                   # mark in a case file
  "core/base/unit.c: .*xc2.xb0 C"                   # spelling of a unit
  "cmd/new_case.c: .*name=.\"generator"            # mark of a page in a folder
  "cmd/(info|options|main).c: .*\"--"                   # the command line
  "core/table/schema.c: .*\": \""                 # separates a verdict from its reason
  "indentation/indent_curves.c: .*failure->message")

set(found "")
set(n 0)
function(look file text)
  string(REPLACE ";" "," text "${text}")
  string(REGEX REPLACE "[][]" "|" text "${text}")
  string(REGEX MATCHALL "${call}" calls "${text}")
  foreach(compared IN LISTS calls)
    math(EXPR n "${n} + 1")
    set(known FALSE)
    string(REGEX REPLACE "\"-?[^\" -][^\" ]*\"|\"\"" "WORD" compared "${compared}")
    if(compared MATCHES "${prose}|${sentences}|${columns}")
      foreach(pattern IN LISTS allowed)
        if("${file}: ${compared}" MATCHES "^${pattern}")
          set(known TRUE)
        endif()
      endforeach()
      if(NOT known)
        string(APPEND found "  ${file}: ${compared}\n")
      endif()
    endif()
  endforeach()
  set(found "${found}" PARENT_SCOPE)
  set(n ${n} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE files RELATIVE ${SOURCE}/src ${SOURCE}/src/*.c ${SOURCE}/src/*.h)
foreach(file IN LISTS files)
  file(READ ${SOURCE}/src/${file} text)
  look(${file} "${text}")
endforeach()
if(PLANTED)
  look(study/planted.c "    if (strncmp(verdict, \"cannot say: \", 12) == 0)\n        x();\n")
  look(report/planted.c "    if (strcmp(c->reason, other) == 0)\n        x();\n")
  look(case/planted.c "    if (strstr(err->advice, \"--\") != NULL)\n        x();\n")
endif()
if(n LESS 300)
  message(SEND_ERROR "only ${n} comparisons seen")
endif()
if(NOT found STREQUAL "")
  message(SEND_ERROR "comparisons with text that the program wrote:\n${found}")
endif()
