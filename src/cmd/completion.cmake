# Completion of the command in bash and zsh, from what --help all says, which comes from the records of the
# options. Run: cmake -DPROGRAM=.. -DOUT=<folder> -P completion.cmake. SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

# Help as a list of lines; what a list of CMake or a word of zsh would take for its own is replaced.
function(help_of lines)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "\n                              +" "  " text "${text}") # what was wrapped
  string(REPLACE ";" "," text "${text}")
  string(REPLACE "[" "(" text "${text}")
  string(REPLACE "]" ")" text "${text}")
  string(REPLACE "'" "’" text "${text}")
  string(REPLACE ":" "\\:" text "${text}")
  string(REPLACE "\n" ";" text "${text}")
  set(${lines} "${text}" PARENT_SCOPE)
endfunction()

help_of(lines --help)
foreach(line IN LISTS lines)
  if(line MATCHES "^  ([a-z-]+) +([^ ].*)$" AND NOT CMAKE_MATCH_1 STREQUAL "help")
    list(APPEND names ${CMAKE_MATCH_1})
    string(APPEND zsh_names "    '${CMAKE_MATCH_1}:${CMAKE_MATCH_2}'\n")
  endif()
endforeach()
list(LENGTH names n)
if(n LESS 10)
  message(FATAL_ERROR "only ${n} subcommands in --help")
endif()
list(JOIN names " " all)

foreach(name IN LISTS names)
  set(options "")
  set(choices "")
  set(arguments "")
  help_of(lines ${name} --help all)
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^  (-([a-z]), |    )--([a-z-]+)( ([^ ]+))?(  +(.*))?$")
      continue()
    endif()
    set(letter "${CMAKE_MATCH_2}")
    set(option "${CMAKE_MATCH_3}")
    set(value "${CMAKE_MATCH_5}")
    string(REGEX REPLACE "  +" " " help "${CMAKE_MATCH_7}")
    if(help STREQUAL "")
      set(help "as in weartrack master")
    endif()
    string(APPEND options " --${option}")
    set(action "")
    if(value MATCHES "^[a-z]+(\\|[a-z]+)+$")
      string(REPLACE "|" " " words "${value}")
      string(APPEND choices "        --${option}) words=\"${words}\" ;;\n")
      set(action ":value:(${words})")
    elseif(value MATCHES "^(FILE|FOLDER|R)$")
      set(action ":file:_files")
    elseif(NOT value STREQUAL "")
      set(action ":${value}: ")
    endif()
    string(APPEND arguments " \\\n        '--${option}[${help}]${action}'")
    if(NOT letter STREQUAL "")
      string(APPEND options " -${letter}")
      string(APPEND arguments " \\\n        '-${letter}[${help}]${action}'")
    endif()
  endforeach()
  string(STRIP "${options}" options)
  if(options STREQUAL "")
    message(FATAL_ERROR "weartrack ${name} --help names no option")
  endif()
  string(APPEND bash_cases "    ${name})\n        options=\"${options}\"\n        case $before in\n${choices}        esac ;;\n")
  string(APPEND zsh_cases "  ${name})\n    _arguments${arguments} \\\n        '*:file:_files' ;;\n")
endforeach()

file(WRITE "${OUT}/weartrack" "# bash completion for weartrack, made by its build
_weartrack()
{
    local word=\${COMP_WORDS[COMP_CWORD]} before=\${COMP_WORDS[COMP_CWORD-1]} options= words=
    COMPREPLY=()
    if ((COMP_CWORD == 1)) || [[ \${COMP_WORDS[1]} == help ]]; then
        COMPREPLY=(\$(compgen -W \"${all} help --help --version\" -- \"$word\"))
        return
    fi
    case \${COMP_WORDS[1]} in
${bash_cases}    esac
    if [[ -n $words ]]; then
        COMPREPLY=(\$(compgen -W \"$words\" -- \"$word\"))
    elif [[ $word == -* ]]; then
        COMPREPLY=(\$(compgen -W \"$options\" -- \"$word\"))
    fi
}
complete -o default -F _weartrack weartrack
")
file(WRITE "${OUT}/_weartrack" "#compdef weartrack
# zsh completion for weartrack, made by its build
local -a subcommands
subcommands=(
${zsh_names}    'help:help of a subcommand')
if (( CURRENT == 2 )); then
  _describe subcommand subcommands
  return
fi
shift words
(( CURRENT-- ))
case $words[1] in
${zsh_cases}  help)
    _describe subcommand subcommands ;;
esac
")
