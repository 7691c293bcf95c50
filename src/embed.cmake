# Puts files into the library, so that one file is installed and nothing is searched for at run
# time.
#
#   wt_embed(TARGET OUTPUT FILE...)
#
# adds to TARGET a C source, made at build time, with the files in the order given:
#   extern const embedded_text OUTPUT[];   (core/system/temporary.h; ends with a NULL name)
# and OUTPUT.h that declares it, to be included by its path below the build tree's src/.
# As a script (cmake -DOUTPUT=... -DNAME=... -DFILES=a|b -P embed.cmake) it writes that source.
#
# SPDX-License-Identifier: GPL-3.0-or-later

if(CMAKE_SCRIPT_MODE_FILE)
  string(REPLACE "|" ";" files "${FILES}")
  set(arrays "")
  set(rows "")
  set(index 0)
  foreach(file IN LISTS files)
    get_filename_component(base "${file}" NAME)
    file(READ "${file}" hex HEX)
    string(LENGTH "${hex}" digits)
    math(EXPR length "${digits} / 2")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
    string(APPEND arrays "static const unsigned char file_${index}[] = {${bytes}0};\n")
    string(APPEND rows "    {\"${base}\", (const char *)file_${index}, ${length}},\n")
    math(EXPR index "${index} + 1")
  endforeach()
  file(WRITE "${OUTPUT}.c.new"
    "#include \"core/system/temporary.h\"\n\nextern const embedded_text ${NAME}[];\n\n${arrays}\n"
    "const embedded_text ${NAME}[] = {\n${rows}    {0, 0, 0}};\n")
  file(RENAME "${OUTPUT}.c.new" "${OUTPUT}.c")
  return()
endif()

set(EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

function(wt_embed target output)
  set(files "")
  foreach(file IN LISTS ARGN)
    get_filename_component(file "${file}" ABSOLUTE)
    list(APPEND files "${file}")
  endforeach()
  set(made "${CMAKE_CURRENT_BINARY_DIR}/${output}")
  list(JOIN files "|" joined)
  add_custom_command(OUTPUT "${made}.c"
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${made}" "-DNAME=${output}" "-DFILES=${joined}"
            -P "${EMBED_SCRIPT}"
    DEPENDS ${files} "${EMBED_SCRIPT}"
    COMMENT "Embedding ${output}" VERBATIM)
  file(CONFIGURE OUTPUT "${made}.h" @ONLY CONTENT
    "#include \"core/system/temporary.h\"\n\nextern const embedded_text @output@[];\n")
  # The command belongs to this folder, the target may not.
  add_custom_target(${output}_source DEPENDS "${made}.c")
  add_dependencies(${target} ${output}_source)
  set_source_files_properties("${made}.c" PROPERTIES GENERATED TRUE)
  target_sources(${target} PRIVATE "${made}.c")
endfunction()
