# Code depends on types, never on text that the program itself wrote, so that a better sentence does not
# change the behaviour. Text of users, files and libraries may be compared, and so may identifiers of one
# word (units, names of groups, tables, formats and options). wt_text_repeats is for text that is shown
# once.
# Run: cmake -DSOURCE=<project folder> [-DPLANTED=ON] -P typed.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

# A call with its arguments, which may contain calls.
set(call "(strn?cmp|strstr|strn?casecmp|memcmp|memmem|starts_with)\\(([^()]|\\([^()]*\\))*\\)")
# A literal of two words or an option; a member, column or part of an error with a sentence.
set(prose "\"[^\"]* [^\"]*\"|\"--[a-z]*\"")
set(sentences "[>.](message|advice|reason|remedy|note|sentence|caption|title|statement|because|why)[,)]")
# An id with a version, and what stands for the value of an option.
set(ids "(->|[.])format, WORD|[(, ]value, WORD")
set(errors "(err|error|failure|why)(->|[.])(place|expected|found|options)[,)]")
set(columns "_text\\([^)]*_(MESSAGE|REASON|WHY|NOTE|SENTENCE|REMEDY|SETTLED_BY|CAPTION|ITEM)\\)")
# Two numbers as they are shown, and the name of an axis.
set(shown "[.](text|chars), [^()]*[.](text|chars)\\)|\\((axis|letter), WORD\\)")

# Columns and keys whose texts are a closed list, and the lists: their enum is compared.
file(GLOB_RECURSE tables ${SOURCE}/src/*tables*.h)
set(enums "")
foreach(file IN LISTS tables)
  file(READ ${file} text)
  string(REGEX MATCHALL "X\\([A-Z_0-9]+,[^()]*(\\([^()]*\\)[^()]*)*ENUM\\(" rows "${text}")
  foreach(row IN LISTS rows)
    string(REGEX MATCH "^X\\(([A-Z_0-9]+)" unused "${row}")
    list(APPEND enums ${CMAKE_MATCH_1})
  endforeach()
endforeach()
file(READ ${SOURCE}/src/core/table/registry.h text)
string(REGEX MATCHALL "X\\([a-z_]+, [a-zA-Z_]+, [A-Z_]+\\)" rows "${text}")
set(lists "")
foreach(row IN LISTS rows)
  string(REGEX MATCH "^X\\(([a-z_]+)" unused "${row}")
  list(APPEND lists ${CMAKE_MATCH_1})
endforeach()
list(LENGTH enums n_enums)
list(LENGTH lists n_lists)
if(n_enums LESS 40 OR n_lists LESS 25)
  message(SEND_ERROR "only ${n_enums} columns and ${n_lists} closed lists found")
endif()
list(JOIN enums "|" enums)
list(JOIN lists "|" lists)
set(enums "[^A-Z_](${enums})\\)")
set(lists "[^a-z_](${lists})_text\\(|wt_(status_text|(${lists})_name)\\(")

# Text from other sources.
set(allowed
  "read/"                                          # foreign files
  "case/case.c: .*c->message"                # messages of libxml2
  "case/case.c: .* Expected is"
  "case/case.c: .*FILL IN"                   # mark in a case file
  "core/base/unit.c: .*xc2.xb0 C"                   # spelling of a unit
  "core/table/table.c: .*_mark"                    # parts of an estimate in a file
  "core/table/result.c: .*former"                  # files of former versions
  "report/figure_files.c: memmem.*attribute"       # drawings of gnuplot
  "cmd/remarks.c: strcmp.p->entry.text"            # order in a list
  "cmd/new_case.c: .*name=.\"generator"            # mark of a page in a folder
  "cmd/(files|options|main).c: .*\"--")             # the command line

set(found "")
set(n 0)
function(look file text)
  string(REPLACE ";" "," text "${text}")
  string(REGEX REPLACE "[][]" "|" text "${text}")
  # constants of two words
  string(REGEX MATCHALL "static const char (\\*const )?[a-z_]+(\\|[^=|]*\\|)? = \"[^\"]* [^\"]*\"" constants "${text}")
  set(named "")
  foreach(constant IN LISTS constants)
    string(REGEX MATCH "([a-z_]+)(\\|[^=|]*\\|)? = " unused "${constant}")
    string(APPEND named "|[ (]${CMAKE_MATCH_1}[,)]")
  endforeach()
  string(REGEX MATCHALL "${call}" calls "${text}")
  foreach(compared IN LISTS calls)
    math(EXPR n "${n} + 1")
    set(known FALSE)
    string(REGEX REPLACE "\"-?[^\" -][^\" ]*\"|\"\"" "WORD" compared "${compared}")
    if(compared MATCHES "${prose}|${sentences}|${errors}|${columns}|${enums}|${lists}${named}" OR compared MATCHES "${shown}|${ids}")
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
  look(planted/1.c "    if (strncmp(verdict, \"cannot say: \", 12) == 0)\n        x();\n")
  look(planted/2.c "    if (strcmp(c->reason, other) == 0)\n        x();\n")
  look(planted/3.c "    if (strstr(err->advice, \"--\") != NULL)\n        x();\n")
  look(planted/4.c "    if (strcmp(s->err.place, \"shifts\") == 0)\n        x();\n")
  look(planted/5.c "    if (strcmp(wt_table_text(t, 0, LIMITS_SEVERITY), word) == 0)\n        x();\n")
  look(planted/6.c "    if (strcmp(text, wt_severity_name(WT_NOTE)) == 0)\n        x();\n")
  look(planted/7.c "    if (strcmp(text, stated_verdict_text(VERDICT_YES)) == 0)\n        x();\n")
  look(planted/8.c "    static const char such[] = \"such as \";\n    if (strstr(text, such) != NULL)\n        x();\n")
  look(planted/10.c "    if (strcmp(low.text, high.text) == 0)\n        x();\n")
  look(planted/11.c "    if (strcmp(axis, \"y\") == 0)\n        x();\n")
  look(planted/12.c "    if (strncmp(input->format, \"given-columns\", 13) == 0)\n        x();\n")
  look(planted/13.c "    if (strcmp(value, \"FILE\") == 0)\n        x();\n")
  look(planted/14.c "    if (strcmp(inputs_text(t, 0, INPUTS_ROLE), \"dma\") == 0)\n        x();\n")
  look(planted/15.c "    if (strcmp(what_if_text(t, 0, WHAT_IF_CHOICE), words) == 0)\n        x();\n")
  look(planted/9.c "    if (strcmp(wt_table_text(t, row, FAILURES_MESSAGE), text) == 0)\n        x();\n")
endif()
if(n LESS 300)
  message(SEND_ERROR "only ${n} comparisons seen")
endif()
if(NOT found STREQUAL "")
  message(SEND_ERROR "comparisons with text that the program wrote:\n${found}")
endif()
