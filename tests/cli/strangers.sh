#!/bin/sh
# Files of strangers that are no plain files of numbers: names that a terminal would obey, pipes,
# folders with very many files, cells without a value, values beyond reason.
# Usage: strangers.sh WEARTRACK FIXTURES WORK
# SPDX-License-Identifier: GPL-3.0-or-later
set -eu
weartrack=$1 fixtures=$2 work=$3
rm -rf "$work"; mkdir -p "$work"; cd "$work"
fail() { echo "$*"; cat said 2>/dev/null; exit 1; }
# refused STATUS WORDS ARGUMENT...: ends with the status, in time, and says the words
refused() {
  status=$1 words=$2; shift 2
  got=0; timeout 20 "$weartrack" "$@" > out 2> said || got=$?
  [ "$got" = "$status" ] || fail "$*: exit status $got, not $status"
  grep -q -- "$words" said || fail "$*: nothing about '$words'"
}
escape=$(printf '\033')
plain() { ! grep -q "$escape" said || fail "an escape character reaches the terminal"; }

# names
name=$(printf 'a\033]0;title\007b\nc.txt')
echo text > "$name"
refused 1 'a ]0;title b c.txt' info "$name"; plain
refused 1 'a ]0;title b c.txt' report -o r "$name"; plain
refused 1 'a.*]0;title' master "$name"; plain
refused 2 'no subcommand.*\\x1b' "$name"; plain
refused 2 '\\x1b' info "--format=$name" x; plain
[ "$(wc -l < said)" = 1 ] || fail "a line is made by a name"
cp "$fixtures/case/dma.txt" "$name"
"$weartrack" convert "$name" -o µ.tsv 2> said || fail "a name"; plain
refused 1 "absent-µ" report -o r absent-µ.h5

# pipes
mkfifo pipe
refused 1 'named pipe' info pipe
refused 1 'named pipe' convert pipe
mkdir folder; mkfifo folder/pipe; cp "$fixtures/case/dma.txt" folder
refused 3 'named pipe' master folder/pipe folder/dma.txt
timeout 20 "$weartrack" convert -q --no-provenance folder/dma.txt > direct
cat folder/dma.txt > pipe &
[ "$(timeout 20 "$weartrack" convert -q --no-provenance - < pipe | grep -c "^[0-9]")" = "$(grep -c "^[0-9]" direct)" ] || fail "a pipe as standard input"
cat > case.xml <<'EOF'
<case version="1"><dma><files>pipe</files></dma></case>
EOF
refused 1 'named pipe' run --no-report case.xml -o r.h5

# very many files: the time grows with their number, not with its square
mkdir many
(cd many && seq 40000 | xargs -n 2000 touch)
refused 1 'found files: 40000' master many

# cells without a value
printf 'f,E_stor,E_loss,T\nHz,MPa,MPa,C\n1,10,1,20\n2,inf,1,20\n4,12,NaN,20\n8,13,1,20\n16,14,-inf,20\n' > cells.csv
"$weartrack" convert --no-provenance cells.csv > out 2> said
grep -q 'line 4: "inf" in column 2 (E_stor) is no value' said || fail "inf"
grep -q 'line 5: "NaN" in column 3 (E_loss) is no value' said || fail "nan"
[ "$(grep -c '^[0-9]' out)" = 2 ] || fail "rows with a value"

# values beyond reason
refused 2 'at most 1e+06 m' indent --tip sphere:radius=1e300m x
refused 2 'at most 100000 K' master --reference-temperature 1e300K x
refused 2 'at most 1e+15 Pa' friction -m x --roughness y -v 1m/s -p 1e300Pa
"$weartrack" master -q "$fixtures/case/dma.txt" -o m.h5
refused 2 'at most 1e+15 rad/m' friction -m m.h5 --roughness self-affine:q0=1rad/m,q1=1e300rad/m,hurst=0.8,c0=1m^4 -v 1m/s -p 1Pa
