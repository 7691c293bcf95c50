#!/bin/sh
# Output paths: if one of several outputs cannot be written, none is.
# Usage: output_paths.sh PROGRAM FIXTURES WORK
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
program=$1 case=$2/case work=$3
rm -rf "$work"
mkdir -p "$work/made"
cd "$work"
fail() {
  echo "FAIL $1" >&2
  cat said >&2
  exit 1
}
refuses() { # STATUS WORDS OPTION...: and writes nothing
  expected=$1 words=$2 status=0
  shift 2
  ls >before
  "$program" report -q "$@" >said 2>&1 || status=$?
  [ $status -eq "$expected" ] || fail "exit status $status: report $*"
  grep -q -e "$words" said || fail "not said: $words"
  ls >after
  cmp before after || fail "something is written: report $*"
}
touch before after said

fit="--tip pyramid:half-angle=20deg,radius=20nm --spring-constant 0.3N/m"
# shellcheck disable=SC2086 # a list of words
"$program" indent -q $fit "$case"/bulk-1.jpk-force-map -o all.h5
refuses 2 '-o -: .*give it a name' -o - all.h5
