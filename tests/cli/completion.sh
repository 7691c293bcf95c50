#!/bin/bash
# Tests the built completion as bash uses it. Usage: completion.sh FOLDER
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
source "$1/weartrack"
fail() { echo "$*"; exit 1; }
# Prints the suggestions for the last word.
offer() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _weartrack
  offered=" ${COMPREPLY[*]-} "
}
has() { [[ $offered == *" $1 "* ]] || fail "$1 is not offered:$offered"; }
hasnt() { [[ $offered != *" $1 "* ]] || fail "$1 is offered:$offered"; }

complete -p weartrack | grep -q -- '-F _weartrack' || fail "no function for weartrack"
offer weartrack fr; has friction; hasnt master
offer weartrack help la; has layer
offer weartrack indent --; has --tip; has --spring-constant; has --strict; hasnt --pressure
offer weartrack friction --p; has --pressure; has --poisson-ratio; hasnt --tip
offer weartrack friction -; has -p; has -o
offer weartrack table --format ''; has csv; has json; hasnt --format
offer weartrack master --vertical-shift f; has free; hasnt none
offer weartrack convert so; [[ $offered == "  " ]] || fail "files are left to bash:$offered"
