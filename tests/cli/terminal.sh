#!/bin/sh
# Output on a terminal: each subcommand prints at most 20 lines. A pipe gets all lines, and so does a
# terminal with --verbose (text) or -o - (tables). Usage: terminal.sh PROGRAM FIXTURES WORK
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
program=$1 fixtures=$2 case=$2/case work=$3
command -v script > /dev/null || { echo "no program script"; exit 0; }
rm -rf "$work"
mkdir -p "$work"
cd "$work"
failed=0
fail() {
  echo "FAIL $1" >&2
  cat screen >&2
  failed=1
}
lines() { wc -l < "$1"; }
# terminal ARGUMENT...: makes the call on a terminal; the file screen gets its text without progress
terminal() {
  line="'$program'"
  for word in "$@"; do line="$line '$word'"; done
  script -qec "$line" /dev/null < /dev/null > typescript 2>&1 || :
  tr -d '\r' < typescript | sed 's/.*'"$(printf '\033')"'\[K//' > screen
}
# short ARGUMENT...: at most 20 lines
short() {
  terminal "$@"
  [ -s screen ] || fail "nothing printed: $*"
  [ "$(lines screen)" -le 20 ] || fail "$(lines screen) lines: $*"
}
# long OPTION ARGUMENT...: a pipe gets more than 20 lines, and so does a terminal with the option
long() {
  option=$1
  shift
  short "$@"
  "$program" "$@" > pipe 2> err < /dev/null || fail "exit status of $*"
  [ "$(lines pipe)" -gt 20 ] || fail "$(lines pipe) lines in a pipe: $*"
  # shellcheck disable=SC2086 # an option and its value
  terminal "$@" $option
  [ "$(lines screen)" -ge "$(lines pipe)" ] || fail "$(lines screen) lines with $option: $*"
}
tables() { long '-o -' "$@"; }
text() { long --verbose "$@"; }

fit="--tip pyramid:half-angle=20deg,radius=20nm --spring-constant 0.3N/m"
slide="--material dma.h5 --roughness $case/road-1.gsf --pressure 0.4MPa --velocity 0.1m/s:1m/s:log:30"
slide="$slide --sliding-temperature 30degC --shear-stress 5MPa"
# Several words each.
# shellcheck disable=SC2086
{
  short indent $fit "$case"/bulk-1.jpk-force-map "$case"/bulk-2.jpk-force-map -o bulk.h5
  short indent $fit --group track "$case"/track-1.jpk-force-map "$case"/track-2.jpk-force-map -o track.h5
  short master "$case/dma.txt" -o dma.h5
  tables indent $fit "$case"/bulk-1.jpk-force-map
  tables master "$case/dma.txt"
  tables compare bulk.h5 track.h5
  tables friction $slide
  tables psd "$case/road-1.gsf"
  tables ramp "$fixtures/dma/ramp_storage.csv"
  tables record "$fixtures/record/steps.csv"
  tables sensitivity "$case"/bulk-1.jpk-force-map
  tables layer $slide --specific-wear-rate '1e-3mm^3/(N m)' --critical-energy 2e10J/m^3
}
short run --no-report "$case/case.xml" -o case.h5
text run --plan "$case/case.xml"
# The next command is named on a terminal only, and it takes the result.
# next WORDS CALL...: the call says so
next() {
  words=$1
  shift
  terminal "$@"
  tr -s ' \n' ' ' < screen | grep -qF "next weartrack $words " || fail "no next command: $*"
  "$program" "$@" 2>&1 | grep -q '^next' && fail "a next command in a pipe: $*"
  return 0
}
follows() { "$program" "$@" -o next.h5 > screen 2>&1 || fail "no such next command: $*"; }
# shellcheck disable=SC2086
{
  next 'compare BULK TRACK, the results of indent for both' indent $fit "$case"/bulk-1.jpk-force-map -o b.h5
  follows compare bulk.h5 track.h5
  next 'friction --material dma.h5, or compare BULK TRACK --master dma.h5' master "$case/dma.txt" -o dma.h5
  follows friction $slide
  follows compare bulk.h5 track.h5 --master dma.h5
  next 'layer with these options, a wear rate and a critical energy' friction $slide -o friction.h5
  follows layer $slide --specific-wear-rate '1e-3mm^3/(N m)' --critical-energy 2e10J/m^3
  next 'friction --roughness road.h5 --material DMA' psd "$case/road-1.gsf" -o road.h5
  follows friction ${slide%%--roughness*} --roughness road.h5 --pressure ${slide#*--pressure}
  next 'validate CASE.xml record.h5' record "$fixtures/record/steps.csv" -o record.h5
  terminal record "$fixtures/record/steps.csv"
  grep -qxF 'next     repeat with -o RESULT.h5, then weartrack validate CASE.xml RESULT.h5' screen ||
    fail 'no next command without a result'
  follows validate "$case/case.xml" record.h5
}
# One result is a list, in which no line is cut.
short summary case.h5
grep -q 'Is the track different?  *yes, softer' screen || fail "no answer in the list of summary"
grep -q '\.\.\.' screen && fail "a line of summary is cut"
"$program" indent -q $fit "$case"/bulk-1.jpk-force-map "$case/dma.txt" -o part.h5 2> screen ||
  [ $? = 3 ] || fail "no partial result"
short summary part.h5
grep -qx 'failed   1, see the table failures' screen || fail "the list of summary hides a failure"
terminal run -q --no-report --replicates 10 "$case/case.xml" -o quiet.h5
[ -s screen ] && fail "run -q prints on a terminal"
[ -s quiet.h5 ] || fail "run -q writes no result"
terminal summary -q part.h5
grep -q modulus_bulk screen || fail "no number by summary -q"
"$program" summary case.h5 > pipe
terminal summary case.h5 -o -
[ "$(lines screen)" -ge "$(lines pipe)" ] && grep -q modulus_ratio_low screen || fail "no row of summary with -o -"
tables table case.h5 friction
tables table case.h5 --list
text convert "$case"/bulk-1.jpk-force-map
text info "$case"/bulk-1.jpk-force-map
text info "$case"/bulk-1.jpk-force-map "$case"/bulk-2.jpk-force-map "$case"/dma.txt
text formats list
text formats show tidy
text new-case "$case"
short summary case.h5 dma.h5
short report case.h5
short info "$case"/missing.txt
short indent $fit "$case/dma.txt"
[ "$failed" = 0 ]
