#!/bin/sh
# src/skeleton.sh writes a reader and a subcommand that compile, adds their rows once, and refuses
# names that exist. With `planted` the reader is written with an error, which the test must report.
#   skeleton.sh SOURCE WORK CC [planted]
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
source=$1 work=$2 cc=$3 planted=${4-}
failed=0

fail() {
  echo "skeleton: $*" >&2
  failed=1
}

rm -rf "$work"
mkdir -p "$work/tree"
cp -r "$source/src" "$source/include" "$source/formats" "$source/man" "$work/tree"
cd "$work/tree"
[ -z "$planted" ] || sed -i 's/return recognition_result(/return no_such_function(/' src/skeleton.sh
# from other folders, and with names that are first, last and in between
sh src/skeleton.sh reader aaa >"$work/log"
(cd src/read && sh ../skeleton.sh reader zzz9 >>"$work/log")
(cd / && sh "$work/tree/src/skeleton.sh" reader longestreadername >>"$work/log" 2>&1) &&
  fail "an id of 17 characters was accepted"
sh src/skeleton.sh reader kindofreaders123 >>"$work/log"
sh src/skeleton.sh subcommand a >>"$work/log"
sh src/skeleton.sh subcommand new-subcase >>"$work/log"

rows() { # FILE ROW...
  file=$1
  shift
  for row; do
    n=$(grep -cxF -- "$row" "$file") || true
    [ "$n" = 1 ] || fail "$file has the row \"$row\" $n times"
  done
}
rows src/read/readers.def 'READER(aaa)' 'READER(kindofreaders123)' 'READER(zzz9)'
rows src/read/CMakeLists.txt '  aaa/aaa.c' '  kindofreaders123/kindofreaders123.c' '  zzz9/zzz9.c)'
rows src/cmd/cmd.h 'int cmd_a(int argc, char **argv);' 'int cmd_new_subcase(int argc, char **argv);'
rows src/cmd/main.c '    {"a", cmd_a, "TODO: one line for the help"},' \
  '    {"new-subcase", cmd_new_subcase, "TODO: one line for the help"},'
rows src/cmd/CMakeLists.txt '  a.c' '  new_subcase.c'
for row in '^READER(gsf)$' '^READER(x3p)$'; do
  grep -q "$row" src/read/readers.def || fail "readers.def lost $row"
done
for file in fixtures/fuzz/aaa/seed0.aaa man/weartrack-a.1 man/weartrack-new-subcase.1; do
  [ -s "$file" ] || fail "$file is missing"
done
grep -rl '@[A-Z]*@' src/read/aaa src/read/zzz9 src/cmd/new_subcase.c man/weartrack-new-subcase.1 &&
  fail "a place of a template was not filled"

for file in src/read/aaa/aaa.c src/read/zzz9/zzz9.c src/read/kindofreaders123/kindofreaders123.c \
  src/cmd/a.c src/cmd/new_subcase.c src/cmd/main.c; do
  "$cc" -std=c17 -D_GNU_SOURCE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes \
    -Wmissing-prototypes -Wvla -Wundef -Wformat=2 -Wdouble-promotion -Werror -fsyntax-only \
    -Iinclude -Isrc "$file" || fail "$file does not compile"
done

# An existing name is refused and nothing is changed.
cp -r "$work/tree" "$work/before"
for call in 'reader aaa' 'reader gsf' 'reader stored' 'reader text' 'reader tidy' 'reader ntmdt-text' \
  'reader Abc' 'reader' 'subcommand a' 'subcommand ramp' 'subcommand new-case' 'subcommand message' \
  'subcommand help' 'subcommand two words' 'other name' ''; do
  # shellcheck disable=SC2086 # the words of the call
  sh src/skeleton.sh $call >"$work/refused" 2>&1 && fail "\"$call\" was accepted"
done
diff -r "$work/before" "$work/tree" || fail "a refused call changed a file"
exit $failed
