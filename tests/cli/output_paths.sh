#!/bin/sh
# Output paths: if one of several outputs cannot be written, none is. Curve sheets may go into a pipe, a
# database not to a terminal. Usage: output_paths.sh PROGRAM FIXTURES WORK
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
"$program" indent -q $fit "$case"/bulk-1.jpk-force-map -o plain.h5
# shellcheck disable=SC2086
"$program" indent -q $fit --curves all "$case"/bulk-1.jpk-force-map -o all.h5
for option in --sheets --browse -o; do
  refuses 2 "$option -: .*give it a name" $option - all.h5
done
refuses 2 '--sheets x: --browse has that name' --browse x --sheets x all.h5
refuses 2 '--sheets made/../x: --browse has that name' --browse x --sheets made/../x all.h5
refuses 2 '--browse ./x.html: -o has that name' -o x.html --browse ./x.html all.h5
for option in --sheets --browse; do
  refuses 1 'none/x' -o page.html $option none/x all.h5
  refuses 1 'indent --curves all' -o page.html $option x plain.h5
done

# Into the folder that is made for the page, and into a pipe, which has no place beside it.
"$program" report -q -o folder --sheets folder/sheets.pdf all.h5 2>said || fail "sheets in the folder of the page"
[ -s folder/sheets.pdf ] && [ -s folder/index.html ] || fail "both are there"
"$program" report -q --sheets /dev/stdout all.h5 2>said | cat >piped.pdf
head -c 5 piped.pdf | grep -q '%PDF-' || fail "sheets into a pipe"
[ "$(tail -n 1 piped.pdf)" = "%weartrack sheets" ] || fail "whole sheets into a pipe"
if TMPDIR=$work/none "$program" report -q --sheets /dev/stdout all.h5 2>said | cat >none.pdf; then :; fi
grep -q 'set TMPDIR' said || fail "that TMPDIR is no folder is said"
[ ! -s none.pdf ] || fail "nothing goes into the pipe"

# A terminal, where there is a program that makes one.
command -v script >/dev/null || exit 0
for output in '' '-o -'; do
  script -qec "'$program' summary --format sqlite $output all.h5" /dev/null </dev/null >said 2>&1 && fail "no failure"
  grep -q 'a terminal cannot show a database' said || fail "a database goes to a terminal"
done
